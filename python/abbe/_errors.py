"""Errors that are also errors of Python."""

from ._abbe import SpecError


class MissingFileError(SpecError, FileNotFoundError):
    """A file that does not exist: a SpecError, and a FileNotFoundError."""
