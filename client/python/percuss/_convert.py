# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Between C structs and dataclasses whose members have the same names."""

from __future__ import annotations

import ctypes
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any, TypeVar, get_args, get_origin, get_type_hints

import numpy as np

from . import _abi
from .errors import InvalidArgument
from .vocabulary import ID_SIZE, Choice, Id, Result

_Class = TypeVar("_Class")
_hints: Any = cache(get_type_hints)


def number(path: str, value: float | str, quantity: str) -> float:
    """A number in SI units; a text is read as the command line does: "300mm/s". `path` is for messages."""
    if not isinstance(value, str):
        return value
    found = ctypes.c_double()
    code: int = _abi.library.percuss_quantity_parse(value.encode(), quantity.encode(), ctypes.byref(found))
    if code != Result.OK:
        why: bytes = _abi.library.percuss_error_text()
        raise InvalidArgument(Result(code), f"{path}: {text(why)}")
    return found.value


def text(octets: bytes) -> str:
    """A string of the library; bytes that are not UTF-8 are shown as such rather than fatal."""
    return octets.decode(errors="backslashreplace")


@cache
def _counters(struct: Any) -> dict[str, str]:
    """The member that stands before each: of a list it is how many there are."""
    names = [field[0] for field in struct._fields_]
    return dict(zip(names[1:], names))


def array(pointer: Any, count: int) -> Any:
    """A copy of the numbers there; counts are signed, so that they may be subtracted."""
    if not count or not pointer:
        return np.zeros(0)
    numbers = np.ctypeslib.as_array(pointer, (count,))
    return numbers.astype(np.int64 if numbers.dtype.kind == "u" else numbers.dtype)


def _value(value: Any, hint: Any) -> Any:
    if isinstance(value, ctypes.Array):
        return Id(bytes(value)) if hint is Id else np.array(value)
    if isinstance(value, ctypes.Structure):
        return read(value, hint)
    if isinstance(value, bytes):
        return text(value)
    return hint(value) if isinstance(hint, type) and issubclass(hint, Choice) else value


def _list(pointer: Any, count: int, hint: Any) -> Any:
    """A structured array or a tuple, as the member is declared."""
    # an array's type is no class in every numpy (2.5: NDArray is an alias of its own); a tuple's is
    if get_origin(hint) is tuple:
        return tuple(_value(one, get_args(hint)[0]) for one in pointer[:count])
    octets = ctypes.string_at(pointer, count * ctypes.sizeof(pointer._type_))
    return np.frombuffer(octets, dtype=np.dtype(pointer._type_))


def read(source: Any, kind: type[_Class], **known: Any) -> _Class:
    """The dataclass from a C struct, but for the members that are `known`; nothing of the struct is kept."""
    struct: Any = type(source)
    for name, hint in _hints(kind).items():
        if name in known:
            continue
        value = getattr(source, name)
        if isinstance(value, ctypes._Pointer):
            known[name] = _list(value, getattr(source, _counters(struct)[name]), hint)
        else:
            known[name] = _value(value, hint)
    return kind(**known)


def _plain(path: str, value: Any) -> Any:
    """The value as ctypes takes it."""
    if isinstance(value, str):
        octets = value.encode()
        if len(octets) >= ID_SIZE or b"\0" in octets:
            raise ValueError(f"{path}: {value!r}: up to {ID_SIZE - 1} bytes without zeros are allowed")
        return octets
    return tuple(value.tolist()) if isinstance(value, np.ndarray) else value


def fill(source: Any, target: Any, path: str) -> None:
    """Writes a dataclass into a C struct, but for its dictionaries; `path` is for messages."""
    assert is_dataclass(source)
    for field in fields(source):
        value = getattr(source, field.name)
        if not isinstance(value, dict):
            setattr(target, field.name, _plain(f"{path}.{field.name}", value))
