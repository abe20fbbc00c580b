# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The same impact at many speeds, of one or several bodies at rest and contact models.

    sweep = percuss.sweep("steel-sphere", ["al-rod", "al-beam"], np.linspace(0.1, 0.4, 31), client)
    for curve in sweep.curves:
        print(curve.b, curve.restitution.min())
    sweep.to_dataframe().to_csv("sweep.csv")

SI units; undefined numbers are nan.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _convert, _page, _plots, _tables
from .client import Client
from .errors import WindowFull
from .reply import Reply
from .request import FloatArray, Options, Request
from .server import Body, contact_pair, find
from .vocabulary import ContactModel, Status

_OUTSTANDING = 16
"""Enough to keep a server's workers busy, few enough for its queue."""
_BUSY_PAUSE = 0.001
"""s before a busy server is asked again."""
_COLUMNS = ("speed", "restitution", "error", "impulse", "sub_impacts", "significant", "end_time", "status", "error_total")


@dataclass(frozen=True)
class Curve:
    """One body at rest with one contact model; arrays of one length."""

    a: str
    b: str
    contact_model: ContactModel
    """As asked for."""
    speed: FloatArray
    """m/s."""
    restitution: FloatArray
    error: FloatArray
    """Estimated, of the restitution, by time steps and modes."""
    impulse: FloatArray
    """N s."""
    sub_impacts: NDArray[np.int64]
    significant: NDArray[np.int64]
    """Those that are not negligible."""
    end_time: FloatArray
    """s."""
    error_total: FloatArray
    """Of the restitution, that of the models with it; nan: not known, as to a server of 0.1.0."""
    replies: tuple[Reply, ...] = field(repr=False)

    @property
    def status(self) -> tuple[Status, ...]:
        """Of each answer; a refusal has no numbers."""
        return tuple(reply.status for reply in self.replies)

    def _columns(self) -> dict[str, Any]:
        names = {"b": self.b, "contact_model": self.contact_model.text}
        return {**names, **{name: getattr(self, name) for name in _COLUMNS}, "status": [one.name for one in self.status]}


@dataclass(frozen=True)
class Sweep:
    """A curve for every body at rest and contact model."""

    curves: tuple[Curve, ...]
    question: Request | None = field(default=None, repr=False, compare=False)
    """Its first point."""

    def raise_for_status(self) -> "Sweep":
        """Returns the sweep if every point was answered; raises Refused otherwise."""
        for curve in self.curves:
            for reply in curve.replies:
                reply.raise_for_status()
        return self

    def to_dataframe(self) -> Any:
        """A row a point: b, contact_model, and what the command line writes: speed, restitution, error, impulse,
        sub_impacts, significant, end_time, status, error_total."""
        return _tables.stack([curve._columns() for curve in self.curves], ("b", "contact_model", *_COLUMNS))

    def plot(self, figure: Any = None) -> Any:
        """Draws the restitution with its total error over the speed, the number of sub-impacts below.

        Returns a matplotlib Figure of its own (`.savefig`, or a notebook's last line), or the given one drawn into."""
        return _plots.sweep(self, figure)

    def to_html(self, title: str = "", logarithmic: bool = False) -> _page.Page:
        """The page that `percuss sweep --html` writes: restitution, sub-impacts, duration, peak force and impulse over
        the speed, with bars of the total error, and all numbers; about 200 kB, which need no network. A str, which a
        notebook shows. logarithmic: the axis of the speeds."""
        names = {curve.b for curve in self.curves}
        on = names.pop() if len(names) == 1 else "bodies at rest"
        return _page.sweep(self, title or (f"{self.curves[0].a} on {on}" if self.curves else "sweep"), logarithmic)

    def _repr_html_(self) -> str:
        return "".join(
            _tables.html(
                f"{curve.a} on {curve.b}, contact model {curve.contact_model.text}",
                ["speed/(m/s)", "restitution", "error", "impulse/(N s)", "sub-impacts", "end/ms", "status"],
                [
                    (*map(float, numbers), int(count), 1e3 * float(end), str(status))
                    for *numbers, count, end, status in zip(
                        curve.speed,
                        curve.restitution,
                        np.where(np.isnan(curve.error_total), curve.error, curve.error_total),
                        curve.impulse,
                        curve.sub_impacts,
                        curve.end_time,
                        curve.status,
                    )
                ],
            )
            for curve in self.curves
        )


def sweep(
    a: Body | str,
    b: Body | str | Sequence[Body | str],
    speeds: ArrayLike | Sequence[object],
    client: Client,
    *,
    contact_model: ContactModel | str | Sequence[ContactModel | str] | None = None,
    options: Options | None = None,
    at_a: float | str = 0.5,
    at_b: float | str = 0.5,
    site_a: str | None = None,
    site_b: str | None = None,
    at: float | str | None = None,
    timeout: float = 10.0,
    angle: float = 0.0,
    spin: float = 0.0,
    friction: float = 0.0,
) -> Sweep:
    """Asks for the impact of a on b at every speed, m/s or texts with units, > 0. Bodies by their ids in the catalogue, or as
    client.bodies() has them; of b and contact_model one or several: a curve for each. contact_model: None: that of
    the options. at_a, at_b, site_a, site_b, at, angle, spin, friction: as of contact_pair. timeout: s that one answer is waited for. Refused points
    have their status and no numbers: see Sweep.raise_for_status."""
    options = options or Options()
    bodies_b = [b] if isinstance(b, (str, Body)) else list(b)
    given = [options.contact_model] if contact_model is None else contact_model
    models = [given] if isinstance(given, (str, ContactModel)) else list(given)
    known = client.bodies(timeout) if any(isinstance(one, str) for one in (a, *bodies_b)) else {}
    first, others = find("a", a, known), [find("b", one, known) for one in bodies_b]
    values = _values(speeds)
    if values.ndim != 1 or not (np.isfinite(values) & (values > 0.0)).all():
        raise ValueError(f"speeds: {speeds!r}: a list of numbers > 0 is allowed")
    curves = []
    first_question = None
    for other in others:
        for model in map(ContactModel.of, models):
            places = (at_a, at_b, site_a, site_b)
            questions = [
                contact_pair(first, other, speed, *places, at=at, angle=angle, spin=spin, friction=friction)
                for speed in values
            ]
            for question in questions:
                question.options = replace(options, contact_model=model)
            first_question = first_question or next(iter(questions), None)
            curves.append(_curve(first, other, model, values, _ask(client, questions, timeout)))
    return Sweep(tuple(curves), first_question)


def _values(speeds: Any) -> FloatArray:
    """Texts with units among them are read one by one."""
    if isinstance(speeds, str):
        speeds = [speeds]
    if isinstance(speeds, Sequence):
        speeds = [_convert.number("speeds", one, "speed") if isinstance(one, str) else one for one in speeds]
    values: FloatArray = np.atleast_1d(np.asarray(speeds, dtype=np.float64))
    return values


def _ask(client: Client, questions: Sequence[Request], timeout: float) -> list[Reply]:
    """Several at a time; a busy server is asked again."""
    replies: list[Reply] = []
    outstanding: deque[tuple[int, Request]] = deque()
    left = deque(questions)
    try:
        while left or outstanding:
            if left and len(outstanding) < _OUTSTANDING:
                try:
                    outstanding.append((client.submit(left[0]), left[0]))
                    left.popleft()
                    continue
                except WindowFull:
                    # of a small window, or of one that the caller uses besides
                    if not outstanding:
                        raise
            reply = client.wait(outstanding[0][0], timeout)
            _, question = outstanding.popleft()
            while reply.status == Status.BUSY:
                time.sleep(_BUSY_PAUSE)
                reply = client.solve(question, timeout)
            replies.append(reply)
    finally:
        for sequence, _ in outstanding:
            client.cancel(sequence)
    return replies


def _curve(a: Body, b: Body, model: ContactModel, speeds: FloatArray, replies: Sequence[Reply]) -> Curve:
    rows = [_row(reply) for reply in replies]
    columns = [np.array(column) for column in zip(*rows)] or [np.zeros(0)] * 7
    restitution, error, impulse, sub_impacts, significant, end_time, total = columns
    numbers = (restitution, error, impulse, sub_impacts, significant, end_time, total)
    return Curve(a.id, b.id, model, speeds, *numbers, replies=tuple(replies))


def _row(reply: Reply) -> tuple[float, float, float, int, int, float, float]:
    if not reply.contacts:
        return np.nan, np.nan, np.nan, 0, 0, np.nan, np.nan
    contact = reply.contacts[0]
    return (
        contact.restitution,
        reply.error.restitution,
        contact.impulse,
        contact.sub_impact_count,
        contact.significant,
        contact.end_time,
        reply.error.total,
    )
