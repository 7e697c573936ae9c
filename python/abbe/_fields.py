"""Fields and figures of reports."""

from __future__ import annotations

import dataclasses
import html as markup
import json
from collections.abc import ItemsView, Iterator, KeysView, Mapping
from os import PathLike
from pathlib import Path
from types import MethodType
from typing import TYPE_CHECKING, Any, Generic, TypeVar, get_args, get_origin, get_type_hints

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

T = TypeVar("T")


class Fields:
    """Group of fields: `.name`, or `["name"]` for names that are not Python identifiers. `dict(group)` is a dict of them."""

    def __init__(self, pairs: Mapping[str, Any], /) -> None:
        vars(self).update(pairs)

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and vars(self) == vars(other)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in vars(self).items())})"

    def __getitem__(self, name: str) -> Any:
        return vars(self)[name]

    def __contains__(self, name: object) -> bool:
        return name in vars(self)

    def __iter__(self) -> Iterator[str]:
        return iter(vars(self))

    def __len__(self) -> int:
        return len(vars(self))

    def keys(self) -> KeysView[str]:
        return vars(self).keys()

    def items(self) -> ItemsView[str, Any]:
        return vars(self).items()

    def get(self, name: str, default: Any = None) -> Any:
        return vars(self).get(name, default)

    if not TYPE_CHECKING:
        # Some groups have a field of this name.
        def values(self):
            return vars(self).values()

        # Methods that `dict()` and functions of a group need, whatever its fields are called.
        def __getattribute__(self, name):
            method = name in ("keys", "items", "get")
            return MethodType(getattr(type(self), name), self) if method else super().__getattribute__(name)


Mapping.register(Fields)


class Named(Fields, Generic[T]):
    """Values by names of the machine, such as those of its joint variables: `.q1`, `["q1"]`. Functions take it as a configuration."""

    if TYPE_CHECKING:

        def __getitem__(self, name: str) -> T: ...
        def items(self) -> ItemsView[str, T]: ...

    def __getattr__(self, name: str) -> T:
        raise AttributeError(f"there is no value `{name}`")


def fields(text: str, report: type) -> Fields:
    """Read the fields of a report from JSON, with the groups of its class in abbe.reports."""
    hints = _hints(report)
    return Fields({name: _shaped(value, hints.get(name)) for name, value in json.loads(text).items()})


def _shaped(value: Any, hint: Any) -> Any:
    """Return dicts as the groups that a type says."""
    for one in (hint, *get_args(hint)):
        if isinstance(value, list) and get_origin(one) is list:
            return [_shaped(each, get_args(one)[0]) for each in value]
        if isinstance(value, dict) and get_origin(one) is Named:
            return Named({name: _shaped(each, get_args(one)[0]) for name, each in value.items()})
        if isinstance(value, dict) and isinstance(one, type) and issubclass(one, Fields):
            hints = _hints(one)
            return one({name: _shaped(each, hints.get(name)) for name, each in value.items()})
    if isinstance(value, list):
        return [_shaped(each, None) for each in value]
    return Fields({name: _shaped(each, None) for name, each in value.items()}) if isinstance(value, dict) else value


_HINTS: dict[type, dict[str, Any]] = {}


def _hints(group: type) -> dict[str, Any]:
    return _HINTS.get(group) or _HINTS.setdefault(group, get_type_hints(group))


class Figure:
    """Figure: `.title`, `.svg` (the picture), and `.scene` (its content as plain dicts and lists)."""

    title: str
    svg: str

    def __init__(self, title: str, svg: str, scene: str) -> None:
        self.title = title
        self.svg = svg
        self._scene = scene

    @property
    def scene(self) -> dict[str, Any]:
        """Content of the figure as plain dicts and lists."""
        return json.loads(self._scene)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Figure) and (self.svg, self._scene) == (other.svg, other._scene)

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"<abbe figure: {self.title}>"


def html(columns: Mapping[str, list[Any]], most: int = 60) -> str:
    """Format the first `most` rows of a table as HTML."""
    head = "".join(f"<th>{markup.escape(name)}</th>" for name in columns)
    rows = list(zip(*columns.values(), strict=True))
    body = "".join("<tr>" + "".join(f"<td>{_cell(value)}</td>" for value in row) + "</tr>" for row in rows[:most])
    more = f"<p>{len(rows) - most} more rows</p>" if len(rows) > most else ""
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"


def _cell(value: Any) -> str:
    if value is None:
        return ""
    return f"{value:.6g}" if isinstance(value, float) else markup.escape(str(value))


class Page:
    """HTML page that needs no network. Notebooks show it in a frame that can load nothing."""

    def __init__(self, title: str, html: str, height: int) -> None:
        self.title = title
        self.html = html
        self.height = height

    def save(self, path: str | PathLike[str], *, overwrite: bool = False) -> None:
        """Writes the page to a file. Raises FileExistsError if it exists, unless `overwrite` is true."""
        with open(path, "w" if overwrite else "x", encoding="utf-8") as file:
            file.write(self.html)

    def _repr_html_(self) -> str:
        content = markup.escape(self.html)
        style = f"width: 100%; height: {int(self.height)}px; border: 0"
        return f'<iframe title="{markup.escape(self.title)}" sandbox="allow-scripts" srcdoc="{content}" style="{style}"></iframe>'

    def __repr__(self) -> str:
        return f"<abbe page: {self.title}>"


@dataclasses.dataclass(frozen=True, eq=False)
class Commands:
    """Corrected joint commands of one or many configurations."""

    q: NDArray[np.float64]
    """(…, nq): corrected commands, within the joint limits."""

    left: NDArray[np.float64]
    """(…, 6): ΔX that remains in F_0, in the length unit and rad."""

    reason: str | None | list[str | None]
    """Reason as text, or None if the configuration is compensated to the tolerance; a list for many configurations."""

    def __repr__(self) -> str:
        reasons = self.reason if isinstance(self.reason, list) else [self.reason]
        missed = sum(reason is not None for reason in reasons)
        return f"<abbe commands: q of shape {self.q.shape}, {missed or 'none'} not compensated to the tolerance>"


def write(pages: list[tuple[str, str]], folder: str | PathLike[str], overwrite: bool) -> list[str]:
    """Write files into a folder, which is made if necessary. Return their names."""
    Path(folder).mkdir(parents=True, exist_ok=True)
    paths = [Path(folder, name) for name, _ in pages]
    if there := [path for path in paths if path.exists() and not overwrite]:
        raise FileExistsError(f"{there[0]} is there already")
    for path, (_, text) in zip(paths, pages, strict=True):
        with open(path, "w" if overwrite else "x", encoding="utf-8", newline="") as file:
            file.write(text)
    return [name for name, _ in pages]


def names(own: Mapping[str, Any], fields: Fields) -> list[str]:
    """Return the public names of a report."""
    return [name for name in own if not name.startswith("_")] + list(fields)
