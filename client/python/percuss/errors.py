# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Exceptions: a call that failed, and a request that the server refused."""

import ctypes
import difflib
from collections.abc import Iterable
from typing import Any

from . import _abi
from .vocabulary import Result, Status


class PercussError(Exception):
    """Whatever this package raises of its own. It goes from process to process as it is (pickle)."""

    def __reduce__(self) -> tuple[Any, ...]:
        # not by calling the class, which takes more than the text that is kept
        return _again, (type(self), self.args, self.__dict__)


def _again(kind: type[PercussError], args: tuple[Any, ...], members: dict[str, Any]) -> PercussError:
    error = kind.__new__(kind, *args)
    error.args = args
    error.__dict__.update(members)
    return error


class CallError(PercussError):
    """A call of the library did not succeed; the text names the field, its value and what is allowed."""

    def __init__(self, result: Result, message: str) -> None:
        super().__init__(message)
        self.result = result


class AnswerTimeout(CallError, TimeoutError):
    """No answer in time."""


class NoServer(CallError, ConnectionError):
    """No server was found, or the client is not connected."""


class Incompatible(CallError, ConnectionError):
    """A server is there, but of another wire version or configuration."""


class InvalidArgument(CallError, ValueError):
    """An argument that cannot be sent."""


class WindowFull(CallError):
    """Too many outstanding requests."""


class UnknownSequence(CallError, LookupError):
    """Never sent, collected already, cancelled, or waited for by another thread."""


class Cancelled(CallError):
    """The call was given up."""


class TransportError(CallError):
    """DDS failed."""


class Refused(PercussError):
    """The server refused the request; raised by Reply.raise_for_status only."""

    def __init__(self, status: Status, message: str) -> None:
        super().__init__(f"{status.name}: {message}")
        self.status = status


class UnknownName(PercussError, KeyError, ValueError):
    """A body, a site or a specimen that is not there; the text lists those that are."""

    def __init__(self, path: str, name: str, known: Iterable[str], where: str) -> None:
        names = list(known)
        near = difflib.get_close_matches(name, names, 1)
        guess = f"; did you mean {near[0]!r}?" if near else ""
        super().__init__(f"{path}: {name!r}: not {where}, which has {', '.join(names) or 'none'}{guess}")

    def __str__(self) -> str:
        # a KeyError shows its text in quotes
        return str(self.args[0])


_CLASSES: dict[Result, type[CallError]] = {
    Result.TIMEOUT: AnswerTimeout,
    Result.NO_SERVER: NoServer,
    Result.INCOMPATIBLE: Incompatible,
    Result.INVALID_ARGUMENT: InvalidArgument,
    Result.WINDOW_FULL: WindowFull,
    Result.UNKNOWN_SEQUENCE: UnknownSequence,
    Result.TRANSPORT: TransportError,
    Result.CANCELLED: Cancelled,
}


def check(code: int, library: ctypes.CDLL = _abi.library, text: str = "percuss_error_text") -> None:
    """Raises the exception of a result other than OK of that library. In the thread of the call, right after it."""
    result = Result(code)
    if result == Result.OK:
        return
    what: bytes = _abi.library.percuss_result_text(code)
    why: bytes = getattr(library, text)()
    message = f"{what.decode()}: {why.decode(errors='replace')}"
    if result == Result.NO_MEMORY:
        raise MemoryError(message)
    raise _CLASSES.get(result, CallError)(result, message)
