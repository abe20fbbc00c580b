# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Requests and replies as JSON: the names are those of the dataclasses, the messages those of `percuss query`."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from .vocabulary import ID_SIZE, Choice, EndReason, FrictionState, Id, Parameter, Status


def fail(path: str, why: str) -> NoReturn:
    """Raises the ValueError that names the member: "bodies[0].velocity: 3 numbers are needed, not 2"."""
    said = f"{path}: {why}" if path else why
    raise ValueError(re.sub(r"[\x00-\x1f\x7f]", "?", said))  # text of a file goes to a terminal


def kind_of(value: Any) -> str:
    """What a JSON value is, for messages."""
    if value is None:
        return "null"
    kinds: tuple[tuple[Any, str], ...] = (
        (bool, "true or false"),
        ((int, float), "a number"),
        (str, "text"),
        (Mapping, "an object"),
        (Sequence, "an array"),
    )
    return next((name for kind, name in kinds if isinstance(value, kind)), type(value).__name__)


def check_object(value: Any, path: str, members: Sequence[str]) -> Mapping[str, Any]:
    """The value, if it is an object that has no other members than these."""
    if not isinstance(value, Mapping):
        fail(path, f"an object is needed, not {kind_of(value)}")
    for name in value:
        if name not in members:
            fail(f"{path}.{name}" if path else str(name), f"unknown member; allowed are: {', '.join(members)}")
    return value


def is_array(value: Any) -> bool:
    return kind_of(value) == "an array"


def read_array(value: Any, path: str, most: int) -> Sequence[Any]:
    if not is_array(value):
        fail(path, f"an array is needed, not {kind_of(value)}")
    if len(value) > most:
        fail(path, f"up to {most} are allowed, not {len(value)}")
    array: Sequence[Any] = value
    return array


def read_number(value: Any, path: str) -> float:
    if kind_of(value) != "a number":
        fail(path, f"a number is needed, not {kind_of(value)}")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        fail(path, f"{str(value)[:20]}: a number of up to 1.8e308 is needed")
    return number


def read_numbers(value: Any, path: str, count: int) -> list[float]:
    """Of an array of exactly so many."""
    if not is_array(value):
        fail(path, f"{count} numbers are needed, not {kind_of(value)}")
    if len(value) != count:
        fail(path, f"{count} numbers are needed, not {len(value)}")
    return [read_number(one, f"{path}[{i}]") for i, one in enumerate(value)]


def read_whole(value: Any, path: str, least: int, bits: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value < 2**bits:
        fail(path, f"a whole number >= {least} is needed")
    return value


def _read_text(value: Any, path: str) -> str:
    if not isinstance(value, str):
        fail(path, f"text is needed, not {kind_of(value)}")
    octets = value.encode(errors="surrogatepass")
    if len(octets) >= ID_SIZE:
        fail(path, f"up to {ID_SIZE - 1} bytes are allowed, not {len(octets)}")
    if re.search("[\0\ud800-\udfff]", value):
        fail(path, "text without zeros and halves of characters is needed")
    return value


def _read_choice(value: Any, path: str, default: Choice) -> Choice:
    allowed = {one.text: one for one in type(default)}
    names = ", ".join(allowed)
    if not isinstance(value, str):
        fail(path, f"one of {names} is needed, not {kind_of(value)}")
    if value not in allowed:
        fail(path, f"'{value}' is not one of: {names}")
    return allowed[value]


def _read_overrides(value: Any, path: str) -> dict[Parameter, float]:
    """In the order of the parameters, not in that of the file."""
    given = check_object(value, path, [one.text for one in Parameter])
    numbers = {name: read_number(number, f"{path}.{name}") for name, number in given.items()}
    return {one: numbers[one.text] for one in Parameter if one.text in numbers}


def _read_member(value: Any, path: str, default: Any) -> Any:
    """What the JSON value says for a member that has this value by default."""
    if isinstance(default, np.ndarray):
        return read_numbers(value, path, len(default))
    if isinstance(default, dict):
        return _read_overrides(value, path)
    if isinstance(default, Choice):
        return _read_choice(value, path, default)
    if isinstance(default, str):
        return _read_text(value, path)
    if isinstance(default, bool):
        if not isinstance(value, bool):
            fail(path, f"true or false is needed, not {kind_of(value)}")
        return value
    return read_number(value, path) if isinstance(default, float) else read_whole(value, path, 0, 32)


def read_into(target: Any, value: Any, path: str) -> None:
    """Reads an object into a dataclass; members that are absent leave it as it is."""
    for name, one in check_object(value, path, [field.name for field in fields(target)]).items():
        setattr(target, name, _read_member(one, f"{path}.{name}", getattr(target, name)))


def _without_duplicates(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    members = dict(pairs)
    if len(members) < len(pairs):
        names = [name for name, _ in pairs]
        fail(next(name for name in names if names.count(name) > 1), "is there twice")
    return members


def _constant(name: str) -> NoReturn:
    fail("", f"{name} is no number of JSON")


def parse(text: str | bytes) -> Any:
    """The value that a JSON text holds."""
    try:
        return json.loads(text, object_pairs_hook=_without_duplicates, parse_constant=_constant)
    except RecursionError:
        fail("", "nested too deeply")


def _write_rows(rows: NDArray[np.void]) -> list[dict[str, Any]]:
    """Of a structured array: an object a row."""
    names = rows.dtype.names or ()
    written = [dict(zip(names, map(write, row))) for row in rows]
    for one in written:
        if "friction_state" in one:
            one["friction_state"] = write(FrictionState(one["friction_state"]))
    return written


def write(value: Any) -> Any:
    """As JSON has it, of dictionaries, lists, texts and numbers; null: undefined or infinite."""
    if is_dataclass(value):
        return {field.name: write(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, Choice):
        return value.name if isinstance(value, (Status, EndReason)) else value.text
    if isinstance(value, Id):
        return str(value)
    if isinstance(value, np.ndarray) and value.dtype.names:
        return _write_rows(value)
    if isinstance(value, (np.ndarray, np.generic)):
        return write(value.tolist())
    if isinstance(value, dict):
        return {key.text: write(one) for key, one in value.items()}
    if isinstance(value, (tuple, list)):
        return [write(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
