"""Fields of reports, by name."""

from types import SimpleNamespace


class Fields(SimpleNamespace):
    """A group of fields: `.name`, or `["name"]` where a name is no word of Python's."""

    def __init__(self, pairs):
        super().__init__(**pairs)

    def __getitem__(self, name):
        return vars(self)[name]

    def __iter__(self):
        return iter(vars(self))

    def __len__(self):
        return len(vars(self))


class Figure:
    """A picture."""

    def __init__(self, svg):
        self.svg = svg

    def _repr_svg_(self):
        return self.svg


def text(fields):
    """What is a number or a text, line by line; of the rest, how much there is."""
    lines = []
    for name, value in vars(fields).items():
        if isinstance(value, list):
            value = f"[{len(value)}]"
        elif isinstance(value, Fields):
            value = ", ".join(vars(value))
        lines.append(f"{name}: {value}")
    return "\n".join(lines) + "\n"
