# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Time histories of an impact.

    traced = percuss.trace(question, client)               # a Client or a Local
    contact = traced.contacts[0]
    print(contact.time[contact.force.argmax()], contact.force.max())

SI units.
"""

import copy
import ctypes
from dataclasses import MISSING, dataclass, field, fields
from typing import Any, ClassVar, Optional

import numpy as np

from . import _abi, _convert, _page, _plots, _tables, request
from .client import Client
from .errors import CallError
from .reply import Reply
from .request import FloatArray, Request

_library = _abi.library


def _nothing() -> FloatArray:
    return np.zeros(0)


@dataclass(frozen=True)
class ContactTrace:
    """One contact, arrays of one length: dense while the bodies touch, enough where they do not."""

    time: FloatArray
    """s from the stated instant, ascending."""
    force: FloatArray
    """N."""
    indentation: FloatArray
    """m; 0 while open."""
    gap: FloatArray
    """Of the rigid bodies, m."""
    gap_rate: FloatArray
    """Of the rigid bodies, m/s."""
    displacement_a: FloatArray
    """m, of body a at the contact along the normal, since the stated instant; with vibration, without the local
    indentation. nan where the request brought its own delassus, as the three that follow."""
    velocity_a: FloatArray
    """m/s."""
    displacement_b: FloatArray
    velocity_b: FloatArray
    force_tangential_1: FloatArray = field(default_factory=_nothing)
    """N, on body a along the first tangent of the contact; empty without friction, as the three that follow."""
    force_tangential_2: FloatArray = field(default_factory=_nothing)
    """N, along the second."""
    slip_1: FloatArray = field(default_factory=_nothing)
    """m/s, of body a's point against body b's along the first tangent, with vibration."""
    slip_2: FloatArray = field(default_factory=_nothing)
    """m/s, along the second."""


_OF_ALL = frozenset(one.name for one in fields(ContactTrace) if one.default_factory is MISSING)


def _slides(contact: ContactTrace) -> bool:
    return len(contact.slip_1) > 0


def _filled(contact: ContactTrace, name: str) -> FloatArray:
    found: FloatArray = getattr(contact, name)
    return found if len(found) else np.full(len(contact.time), np.nan)


@dataclass(frozen=True)
class Trace:
    """A reply with its time histories."""

    reply: Reply
    contacts: tuple[ContactTrace, ...]
    """In the order of the request; empty when it was refused."""
    names: tuple[tuple[str, str], ...] = ()
    """Ids of bodies a and b of each contact."""
    question: Optional[Request] = None
    """What was asked."""
    _client: ClassVar[Optional[Client]] = None

    def to_dataframe(self) -> Any:
        """A row an instant of a contact: contact, and the members of ContactTrace, those of friction where any contact
        has it, nan of one without."""
        names = [one.name for one in fields(ContactTrace) if one.name in _OF_ALL or any(map(_slides, self.contacts))]
        parts = [
            {"contact": np.full(len(one.time), i), **{name: _filled(one, name) for name in names}}
            for i, one in enumerate(self.contacts)
        ]
        return _tables.stack(parts, ("contact", *names))

    def plot(self, figure: Any = None) -> Any:
        """Draws a column for each contact: displacements and velocities of the bodies, the force, the indentation, with
        friction the slip, the tangential force and its way in Coulomb's circle, from the first of its sub-impacts to a
        quarter of their time after the last.

        Returns a matplotlib Figure of its own (`.savefig`, or a notebook's last line), or the given one drawn into."""
        return _plots.trace(self, figure)

    def to_html(self, client: Optional[Client] = None, title: str = "") -> _page.Page:
        """The page that `percuss query --html` writes: the bodies in motion, force, gap and energy over time, the
        numbers, the request; about 300 kB, which need no network. A str, which a notebook shows.

        client: whose catalogue says the shapes of the bodies; None: of the one that was asked. ValueError of a
        refusal, which has no histories."""
        client = client or self._client
        if self.question is None or not self.contacts:
            raise ValueError(f"to_html: a trace without histories ({self.reply.status}) has no page")
        known = client.bodies() if client else {}
        bodies = [known.get(one.id) for one in self.question.bodies]
        return _page.trace(self, bodies, title or " on ".join(self.names[0]))

    def __getstate__(self) -> dict[str, Any]:
        """A copy in another process has no client."""
        return {name: value for name, value in self.__dict__.items() if name != "_client"}

    def _repr_html_(self) -> str:
        rows = [
            (i, len(one.time), 1e3 * float(one.time[-1]), float(one.force.max()), 1e6 * float(one.indentation.max()))
            for i, one in enumerate(self.contacts)
        ]
        heads = ["contact", "instants", "until/ms", "largest force/N", "largest indentation/um"]
        tables = self.reply._repr_html_() + _tables.html("histories", heads, rows)
        try:
            return tables + self.to_html()._repr_html_()
        except (ValueError, CallError, FileNotFoundError):  # refused, or the client is closed: the tables alone
            return tables


def _read(source: Any) -> ContactTrace:
    arrays = {one.name: _convert.array(getattr(source, one.name), source.count) for one in fields(ContactTrace)}
    return ContactTrace(**arrays)


def trace(question: Request, client: Client, timeout: float = 10.0) -> Trace:
    """As client.solve, with the time histories of the answer. A refusal has none: see Trace.reply.status."""
    asked, answer, histories = _abi.Request(), _abi.Reply(), _abi.Trace()
    kept = request.fill(question, asked)
    code: int = _library.percuss_solve_traced(
        client._open, ctypes.byref(asked), timeout, ctypes.byref(answer), ctypes.byref(histories)
    )
    del kept
    try:
        client._check(code)
        contacts = tuple(_read(one) for one in histories.contacts[: histories.contact_count])
        names = tuple((question.bodies[one.a].id, question.bodies[one.b].id) for one in question.contacts[: len(contacts)])
        traced = Trace(_convert.read(answer, Reply), contacts, names, copy.deepcopy(question))
        object.__setattr__(traced, "_client", client)  # who was asked is no part of the answer
        return traced
    finally:
        _library.percuss_trace_free(ctypes.byref(histories))
        _library.percuss_reply_free(ctypes.byref(answer))
