# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The page of one impact, as `percuss query --html` writes it."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _abi, _json
from .vocabulary import Parameter

if TYPE_CHECKING:
    from .server import Body
    from .traces import Trace

_MARK = "@DATA@"


def _template() -> str:
    """The page without an impact: of an installed package beside this file, of a build beside the library."""
    places = [Path(__file__).with_name("page.html"), Path(_abi.library._name).resolve().with_name("page.html")]
    for place in places:
        if place.exists():
            return place.read_text(encoding="utf-8")
    raise FileNotFoundError(f"the page page.html was not found: {', '.join(map(str, places))}")


def _body(body: "Body | None") -> Any:
    if body is None:
        return None
    members = _json.write(body)
    parameters = members.pop("parameters")
    return {**members, **{one.text: parameters.get(one.text) for one in Parameter if one != Parameter.RADIUS}}


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
        "request": traced.question.to_json(),
        "reply": traced.reply.to_json(),
        "bodies": [_body(body) for body in bodies],
        "trace": [_histories(contact) for contact in traced.contacts],
    }
    # no sign of the data ends the page's script element
    return _template().replace(_MARK, json.dumps(data).replace("<", "\\u003c"), 1)
