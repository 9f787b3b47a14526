"""What goes wrong, as exceptions. All of them are ``Error``, and most are a built-in exception too."""

from __future__ import annotations


class Error(Exception):
    """Something that the library refuses. Nothing has changed by the refused call.

    ``status`` is the number of the ``surehit_status`` of the C interface. ``element`` is which element is at fault: a
    triangle, a vertex, a path or another one, as the message says. It is 0 where nothing is said about it.
    """

    def __init__(self, message: str, status: int, element: int) -> None:
        super().__init__(message)
        self.status = status
        self.element = element


class OutOfMemory(Error, MemoryError):
    """Memory ran out."""


class InvalidValue(Error, ValueError):
    """A value is none of those that are allowed."""


class OutOfRange(Error, IndexError):
    """There is no triangle with this id."""


class InvalidMesh(Error, ValueError):
    """A mesh or its masks cannot be used. ``element`` is the vertex or the triangle at fault."""


class InvalidInstance(Error, ValueError):
    """A pose or a motion cannot be used, or an id is that of no instance."""


_KINDS: dict[int, type[Error]] = {1: OutOfMemory, 7: InvalidValue, 8: OutOfRange, 9: InvalidValue}


def error_of(message: str, status: int, element: int) -> Error:
    """Returns the exception for a status of the C interface. Its message begins with the name of a function in C."""
    kind = Error
    if 100 <= status < 200:
        kind = InvalidMesh
    elif 200 <= status < 300:
        kind = InvalidInstance
    return _KINDS.get(status, kind)(message.partition(": ")[2] or message, status, element)
