"""Errors that are also errors of Python."""

from ._abbe import SpecError


class MissingFileError(SpecError, FileNotFoundError):
    """A file that does not exist: a SpecError, and a FileNotFoundError."""

    def __new__(cls, *arguments: object) -> "MissingFileError":
        # Libraries that pickle errors on their own, such as Dask's, create them by this.
        return FileNotFoundError.__new__(cls, *arguments)
