# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Pages for a browser, as the command line's --html writes them."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import fields
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _abi, _json
from .vocabulary import Parameter

if TYPE_CHECKING:
    from .ensemble_reply import EnsembleReply
    from .reply import Reply
    from .server import Body
    from .sweeps import Curve, Sweep
    from .traces import Trace

_MARK = "@DATA@"
_SAMPLES = 4000
"""Of an ensemble at most: more points cannot be told apart."""


class Page(str):
    """A page as text, which a notebook shows in a frame."""

    def _repr_html_(self) -> str:
        # a frame of its own, whose scripts see nothing of the notebook
        return (
            f'<iframe sandbox="allow-scripts" srcdoc="{escape(self)}" title="percuss" '
            'style="width: 100%; height: 900px; border: 1px solid #d0d0d0"></iframe>'
        )


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


def _page(data: dict[str, Any]) -> Page:
    # no sign of the data ends the page's script element
    return Page(_template().replace(_MARK, json.dumps(data).replace("<", "\\u003c"), 1))


def trace(traced: "Trace", bodies: Sequence["Body | None"], title: str) -> Page:
    """`bodies`: of the catalogue, those of the request in its order."""
    assert traced.question is not None
    return _page(
        {
            "title": title,
            "request": traced.question.to_json(),
            "reply": traced.reply.to_json(),
            "bodies": [_body(body) for body in bodies],
            "trace": [_histories(contact) for contact in traced.contacts],
        }
    )


def _of_contact(reply: "Reply", read: Any) -> Any:
    return _json.write(float(read(reply.contacts[0]))) if reply.contacts else None


def _peak_force(contact: Any) -> float:
    """nan: not all sub-impacts are listed."""
    peaks = contact.sub_impacts["peak_force"]
    return float(peaks.max(initial=0.0)) if len(peaks) == contact.sub_impact_count else math.nan


def _columns(curve: "Curve") -> dict[str, Any]:
    columns = {name: _json.write(column) for name, column in curve._columns().items()}
    for name, read in (
        ("impulse_error", lambda one: one.impulse_error),
        ("peak_force", _peak_force),
        ("impulse_tangential_1", lambda one: one.impulse_tangential[0]),
        ("tangential_restitution", lambda one: one.tangential_restitution),
    ):
        columns[name] = [_of_contact(reply, read) for reply in curve.replies]
    return columns


def _warnings(swept: "Sweep") -> Iterator[str]:
    """Each kind once, with where it was first: those that differ in numbers alone are of one kind."""
    first: dict[str, str] = {}
    counts: dict[str, int] = {}
    total = sum(len(curve.replies) for curve in swept.curves)
    for curve in swept.curves:
        for speed, reply in zip(curve.speed, curve.replies):
            for warning in reply.warnings:
                kind = re.sub(r"[-+.0-9e]+", "0", warning)
                first.setdefault(kind, f"first on {curve.b} at {speed:.6g} m/s: {warning}")
                counts[kind] = counts.get(kind, 0) + 1
    for kind, said in first.items():
        yield f"{counts[kind]} of {total} points, {said}"


def sweep(swept: "Sweep", title: str, logarithmic: bool) -> Page:
    reply = next((reply for curve in swept.curves for reply in curve.replies), None)
    data: dict[str, Any] = {
        "kind": "sweep",
        "a": swept.curves[0].a if swept.curves else "",
        "title": title,
        "by_angle": False,
        "logarithmic": logarithmic,
        "curves": [_columns(curve) for curve in swept.curves],
        "measured": [],
        "warnings": list(_warnings(swept)),
    }
    if reply is not None:
        data.update(version=reply.version, catalogue_revision=reply.catalogue_revision)
    if swept.question is not None:
        note = "Its first point by this request, as percuss query --request FILE takes it, with the same catalogue:"
        data.update(request=swept.question.to_json(), request_note=note)
    return _page(data)


def ensemble(reply: "EnsembleReply", title: str) -> Page:
    assert reply.question is not None
    other = ("statistics", "rows", "columns", "question")
    members = {one.name: _json.write(getattr(reply, one.name)) for one in fields(reply) if one.name not in other}
    rows = np.zeros((0, 0)) if reply.rows is None else reply.rows[:_SAMPLES]
    return _page(
        {
            "kind": "ensemble",
            "title": title,
            "request": reply.question.scene.to_json(),
            "request_note": "The impact in the middle by this request, as percuss query --request FILE takes it, "
            "with the same catalogue:",
            "reply": {**members, "statistics": [_json.write(one) for one in reply.statistics.values()]},
            "columns": list(reply.columns),
            "samples": [[float(f"{x:.7g}") if math.isfinite(x) else None for x in row] for row in rows],
        }
    )
