# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The page of one impact, as `percuss query --html` writes it."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _abi
from .vocabulary import Choice, EndReason, FrictionState, Id, Parameter, Status

if TYPE_CHECKING:
    from .request import Request
    from .server import Body
    from .traces import Trace

_MARK = "@DATA@"


def _template() -> str:
    """The page without an impact: of an installed package beside this file, of a build beside the library."""
    places = [Path(__file__).with_name("impact.html"), Path(_abi.library._name).resolve().with_name("impact.html")]
    for place in places:
        if place.exists():
            return place.read_text(encoding="utf-8")
    raise FileNotFoundError(f"the page impact.html was not found: {', '.join(map(str, places))}")


def _name(choice: Choice) -> str:
    """As the command line prints it in JSON."""
    return choice.name if isinstance(choice, (Status, EndReason)) else choice.text


def _plain(value: Any) -> Any:
    """As json takes it, with the names that `percuss --json` has; undefined and infinite numbers are null."""
    if is_dataclass(value):
        return {one.name: _plain(getattr(value, one.name)) for one in fields(value)}
    if isinstance(value, Choice):
        return _name(value)
    if isinstance(value, Id):
        return str(value)
    if isinstance(value, np.ndarray):
        return [_plain(one) for one in value]
    if isinstance(value, np.void):
        row = {name: value[name] for name in value.dtype.names or ()}
        if "friction_state" in row:
            row["friction_state"] = FrictionState(row["friction_state"])
        return {name: _plain(one) for name, one in row.items()}
    if isinstance(value, np.generic):
        return _plain(value.item())
    if isinstance(value, dict):
        return {_plain(key): _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _request(question: "Request") -> Any:
    plain = _plain(question)
    del plain["sequence"]
    if question.delassus is None:
        del plain["delassus"]
    else:
        plain["delassus"] = _plain(np.asarray(question.delassus, dtype=np.float64))
    return plain


def _body(body: "Body | None") -> Any:
    if body is None:
        return None
    plain = _plain(body)
    parameters = {one.text: body.parameters.get(one) for one in Parameter if one != Parameter.RADIUS}
    del plain["parameters"]
    return {**plain, **_plain(parameters)}


def _histories(trace: Any) -> Any:
    """Seven digits are more than can be seen."""
    columns = {one.name: getattr(trace, one.name) for one in fields(trace)}
    return {
        name: [None if not math.isfinite(x) else float(f"{x:.7g}") for x in values]
        for name, values in columns.items()
        if len(values) and not name.startswith("velocity")
    }


def trace(traced: "Trace", bodies: Sequence["Body | None"], title: str) -> str:
    """`bodies`: of the catalogue, those of the request in its order."""
    assert traced.question is not None
    data = {
        "title": title,
        "request": _request(traced.question),
        "reply": _plain(traced.reply),
        "bodies": [_body(body) for body in bodies],
        "trace": [_histories(contact) for contact in traced.contacts],
    }
    # no sign of the data ends the page's script element
    return _template().replace(_MARK, json.dumps(data).replace("<", "\\u003c"), 1)
