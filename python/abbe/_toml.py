"""TOML of dicts and of the objects of `abbe.spec`."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Iterable, Mapping
from numbers import Integral, Real
from typing import Any

from ._abbe import Machine, load


class Keys:
    """Keys of a table. What is None is left out."""

    def to_dict(self) -> dict[str, Any]:
        """Return the keys as a spec file has them."""
        found: dict[str, Any] = {}
        # Those of a base class come last: a source begins with its name.
        own = type(self).__annotations__
        for field in sorted(dataclasses.fields(self), key=lambda field: field.name not in own):  # type: ignore[arg-type]
            value = getattr(self, field.name)
            if value is not None:
                table = found.setdefault(field.metadata["table"], {}) if "table" in field.metadata else found
                table[field.metadata.get("key", field.name)] = _plain(value)
        return found


class File(Keys):
    """Keys of a spec file."""

    def to_toml(self) -> str:
        """Return the text of the spec file."""
        return toml(self)

    def load(self) -> Machine:
        """Return the machine. Raises SpecError, with place and remedy in the text of `to_toml`, if the spec is wrong."""
        return load(text=self.to_toml())


def _plain(value: Any) -> Any:
    """Return a value with dicts in place of objects."""
    if isinstance(value, Keys):
        return value.to_dict()
    if isinstance(value, Mapping):
        return {name: _plain(each) for name, each in value.items()}
    return [_plain(each) for each in value] if isinstance(value, (list, tuple)) else value


def toml(value: Mapping[str, Any] | Keys) -> str:
    """Format a dict as TOML: a section for each table, and for each of a list of tables."""
    plain: dict[str, Any] = _plain(value)
    keys, sections = "", ""
    for name, each in plain.items():
        tables = each if isinstance(each, list) else [each]
        if not tables or not all(isinstance(table, Mapping) for table in tables):
            keys += f"{_key(name)} = {_inline(each)}\n"
            continue
        heading = f"[[{_key(name)}]]" if isinstance(each, list) else f"[{_key(name)}]"
        for table in tables:
            sections += f"\n{heading}\n" + "".join(f"{_key(key)} = {_inline(one)}\n" for key, one in table.items())
    return keys + sections if keys else sections.lstrip("\n")


def _inline(value: Any) -> str:
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(name)} = {_inline(each)}" for name, each in value.items()) + " }"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, Real):
        return repr(int(value) if isinstance(value, Integral) else float(value))
    if isinstance(value, Iterable):
        return "[" + ", ".join(map(_inline, value)) + "]"
    raise TypeError(f"values are texts, numbers, lists and dicts, not {type(value).__name__}")


def _key(name: str) -> str:
    return name if name.isidentifier() and name.isascii() else json.dumps(name, ensure_ascii=False)
