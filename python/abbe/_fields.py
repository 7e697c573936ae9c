"""Fields and figures of reports."""

import html as markup
import json
from types import SimpleNamespace


class Fields(SimpleNamespace):
    """Group of fields: `.name`, or `["name"]` for names that are not Python identifiers."""

    def __init__(self, pairs):
        super().__init__(**pairs)

    def __getitem__(self, name):
        return vars(self)[name]

    def __iter__(self):
        return iter(vars(self))

    def __len__(self):
        return len(vars(self))


class Figure:
    """Figure: `.title`, `.svg` (the picture), and `.scene` (its content as plain dicts and lists)."""

    def __init__(self, title, svg, scene):
        self.title = title
        self.svg = svg
        self._scene = scene

    @property
    def scene(self):
        return json.loads(self._scene)

    def __eq__(self, other):
        return isinstance(other, Figure) and (self.svg, self._scene) == (other.svg, other._scene)

    def _repr_svg_(self):
        return self.svg

    def __repr__(self):
        return f"<abbe figure: {self.title}>"


def html(columns, most=60):
    """Format the first `most` rows of a table as HTML."""
    head = "".join(f"<th>{markup.escape(name)}</th>" for name in columns)
    rows = list(zip(*columns.values(), strict=True))
    body = "".join("<tr>" + "".join(f"<td>{_cell(value)}</td>" for value in row) + "</tr>" for row in rows[:most])
    more = f"<p>{len(rows) - most} more rows</p>" if len(rows) > most else ""
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"


def _cell(value):
    if value is None:
        return ""
    return f"{value:.6g}" if isinstance(value, float) else markup.escape(str(value))
