# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The slow scale of a co-simulation: tells an engine when an impact is due, asks what it does, and applies the answer::

    slow = percuss.slowscale.SlowScale(["steel-sphere", "al-beam"], engine, client)
    while engine.now() < end:
        engine.step(min(size, slow.next() - engine.now()))
        slow.advance(engine.contacts())

libpercuss-slowscale does the work; docs/integrating.md explains it, <percuss/slowscale.h> is its reference. SI
units, world axes, quaternions as in `percuss.BodyMotion`. What an engine's method raises, `due` or `advance` raises.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import _abi, _convert, request
from . import _slow_abi as abi
from .client import Client
from .errors import check
from .reply import Reply
from .request import BodyMotion, FloatArray, Options
from .vocabulary import Choice

_library = abi.library


class Application(Choice):
    """How an answer is applied."""

    LIST = 0
    """Each sub-impact at its time; what has not happened can be revoked."""
    TOTAL = 1
    """The whole impulse at the start."""


@dataclass
class _Feature(request.ContactPlace):
    feature: int = 0
    """Tells several contacts of the same two bodies apart."""


@dataclass
class Contact(request.Contact, _Feature):  # in this order `feature` is the seventh argument
    """Two bodies that touch, or nearly; a and b are indices of the engine's bodies. The normal points from b to a.
    friction and tangent: as of a request, where the engine has `oblique`, or all bodies are `free` or `fixed`."""


class Engine:
    """What the slow scale must know and do. To be derived from: `now`, `gap_rates`, `delassus`, `motion`, one of
    `apply` and `push`, and better with `move`; for friction with `oblique`, and `apply_vector` and `move_vector` or
    `push`. All at the present state."""

    def now(self) -> float:
        """Time of the simulation, s."""
        raise NotImplementedError("now")

    def gap_rates(self, contacts: Sequence[Contact]) -> ArrayLike:
        """n.(v_a - v_b) at the point of each contact, m/s; < 0 approaches."""
        raise NotImplementedError("gap_rates")

    def delassus(self, contacts: Sequence[Contact]) -> ArrayLike:
        """w^T M^-1 w, contacts x contacts, 1/kg: what a unit impulse at each changes the rate of each by."""
        raise NotImplementedError("delassus")

    def oblique(self, contacts: Sequence[Contact]) -> ArrayLike:
        """Optional, for friction of bodies that joints hold: w^T M^-1 w of normals and tangents, 3n x 3n for up to 21
        contacts, 1/kg. Row 3i is the normal of contacts[i], 3i + 1 its `tangent` (stated here, unit), 3i + 2 normal x
        tangent."""
        raise NotImplementedError("oblique")

    def motion(self, body: int) -> BodyMotion:
        """Pose and velocities of a body, in the frame of the catalogue; its id and token are not read."""
        raise NotImplementedError("motion")

    def apply(self, contact: Contact, impulse: float) -> None:
        """Changes the velocities by M^-1 w impulse, N s: + along the normal on a, - on b."""
        raise NotImplementedError("apply")

    def push(self, body: int, impulse: FloatArray, point: FloatArray) -> None:
        """Instead of `apply`: an impulse, N s, on one body at a point. Called for a, then with the opposite for b."""
        raise NotImplementedError("push")

    def apply_vector(self, contact: Contact, impulse: FloatArray) -> None:
        """Beside `apply`, or instead: an impulse with all components, N s, world, on a at the contact's point, and
        against it on b. Called where an impulse has a tangential part, by friction."""
        raise NotImplementedError("apply_vector")

    def move(self, contact: Contact, moment: float) -> None:
        """Optional: changes the positions by M^-1 w moment, N s^2. Impulses of ringing bodies often lie before the
        instant of the question; applied late without it, they take energy."""
        raise NotImplementedError("move")

    def move_vector(self, contact: Contact, moment: FloatArray) -> None:
        """Beside `move`, or instead: as `apply_vector` is to `apply`."""
        raise NotImplementedError("move_vector")


@dataclass(frozen=True)
class Body:
    """A body of the engine."""

    id: str
    """In the service's catalogue."""
    fixed: bool = False
    """Holds still whatever hits it: does not couple the impacts on it."""
    free: bool = False
    """No joint holds it, and its inertia is the catalogue's. Without `oblique` of the engine an impact has friction
    where all of its bodies are free or fixed; the service then takes the catalogue's inverse masses, and compares."""


@dataclass(frozen=True)
class Report:
    """What was done about an impact."""

    time: float
    contacts: tuple[Contact, ...]
    """The group."""
    gap_rate: FloatArray
    """Before it."""
    delassus: FloatArray
    impulse: FloatArray
    restitution: FloatArray
    """nan where there is no compression."""
    reply: Optional[Reply]
    """None: the declared restitution was used."""
    message: str
    """Why, and what else the user should know; empty: nothing."""
    declared: int
    """Impacts with the declared restitution so far, this one included."""


@dataclass(frozen=True)
class Counts:
    """How often."""

    impacts: int
    """Groups solved."""
    requests: int
    """Questions put; one an impact, unless one of the next two."""
    repeated: int
    """Questions put again: state unknown, horizon too short."""
    preempted: int
    """Questions put again up to the moment when another body hit."""
    declared: int
    """Impacts with the declared restitution."""


@dataclass(frozen=True)
class Inertia:
    """Inertia of a body that no joint holds."""

    mass: float
    """kg; inf: immovable."""
    moments: tuple[float, float, float] = (math.inf, math.inf, math.inf)
    """The principal ones, about the axes of the body, kg m^2."""


def _read_contact(source: Any) -> Contact:
    return _convert.read(source, Contact)


def _write_contacts(contacts: Sequence[Contact]) -> Any:
    target = (abi.Contact * len(contacts))()
    for i, contact in enumerate(contacts):
        for name in ("a", "b", "feature"):
            # ctypes would take it modulo 2^32
            if not 0 <= getattr(contact, name) < 2**32:
                raise ValueError(f"contacts[{i}].{name}: {getattr(contact, name)}: 0..2^32-1 is allowed")
        _convert.fill(contact, target[i], f"contacts[{i}]")
    return target


def _array(pointer: Any, *shape: int) -> FloatArray:
    """A copy of the library's doubles."""
    octets = ctypes.string_at(pointer, 8 * math.prod(shape))
    return np.frombuffer(octets, dtype=np.float64).reshape(shape)


def _write_array(name: str, value: ArrayLike, target: Any, *shape: int) -> None:
    array = np.ascontiguousarray(value, dtype=np.float64)
    if array.shape != shape:
        raise ValueError(f"{name}: shape {array.shape}: {shape} is needed")
    ctypes.memmove(target, array.ctypes.data, array.nbytes)


def _read_report(source: Any) -> Report:
    n = source.count
    contacts = tuple(_read_contact(one) for one in source.contacts[:n])
    numbers = (_array(source.gap_rate, n), _array(source.delassus, n, n), _array(source.impulse, n))
    reply = _convert.read(source.reply.contents, Reply) if source.reply else None
    restitution, message = _array(source.restitution, n), _convert.text(source.message)
    return Report(source.time, contacts, *numbers, restitution, reply, message, source.declared)


class _Callbacks:
    """An engine as C calls it. What a method raises is kept until C has returned."""

    def __init__(self, engine: Engine, report: Callable[[Report], None] | None) -> None:
        self._engine = engine
        self._report = report
        self.raised: BaseException | None = None

    def _call(self, function: Callable[[], None]) -> bool:
        try:
            function()
        except BaseException as error:  # Ctrl-C, too: C cannot be unwound
            self.raised = self.raised or error
            return False
        return True

    def _probe(self, view: Any) -> None:
        n = view.count
        contacts = [_read_contact(one) for one in view.contacts[:n]]
        _write_array("gap_rates", self._engine.gap_rates(contacts), view.gap_rate, n)
        if view.delassus:
            _write_array("delassus", self._engine.delassus(contacts), view.delassus, n, n)
        if view.bodies:
            for index in sorted({body for contact in contacts for body in (contact.a, contact.b)}):
                motion = self._engine.motion(index)
                for name in ("position", "orientation", "velocity", "angular_velocity"):
                    setattr(view.bodies[index], name, tuple(getattr(motion, name).tolist()))

    def _oblique(self, count: int, source: Any, target: Any) -> None:
        contacts = [_read_contact(one) for one in source[:count]]
        _write_array("oblique", self._engine.oblique(contacts), target, 3 * count, 3 * count)

    def _push(self, body: int, impulse: Any, point: Any) -> None:
        self._engine.push(body, _array(impulse, 3), _array(point, 3))

    def _now(self) -> float:
        times: list[float] = []
        return times[0] if self._call(lambda: times.append(float(self._engine.now()))) else math.nan

    def fill(self, config: abi.Config) -> None:
        """Gives C those methods that the engine has."""
        call, engine, report = self._call, self._engine, self._report

        def has(name: str) -> bool:
            return getattr(type(engine), name) is not getattr(Engine, name)

        config.engine.probe = abi.Probe(lambda _, view: call(lambda: self._probe(view.contents)))
        config.engine.now = abi.Now(lambda _: self._now())
        def vector(function: Callable[[Contact, FloatArray], None]) -> Any:
            return abi.ApplyVector(
                lambda _, contact, numbers: call(lambda: function(_read_contact(contact.contents), _array(numbers, 3)))
            )

        if has("apply"):
            config.engine.apply = abi.Apply(
                lambda _, contact, impulse: call(lambda: engine.apply(_read_contact(contact.contents), impulse))
            )
        # who pushes each body needs none of the pair
        if has("apply_vector") and not has("push"):
            config.engine.apply_vector = vector(engine.apply_vector)
        if has("oblique"):
            config.engine.oblique = abi.Oblique(lambda _, *view: call(lambda: self._oblique(*view)))
        if has("push"):
            config.engine.push = abi.Push(lambda _, *push: call(lambda: self._push(*push)))
        if has("move"):
            config.move = abi.Apply(
                lambda _, contact, moment: call(lambda: engine.move(_read_contact(contact.contents), moment))
            )
        if has("move_vector"):
            config.move_vector = vector(engine.move_vector)
        if report is not None:
            config.report = abi.ReportFunction(
                lambda _, what: (call(lambda: report(_read_report(what.contents))), None)[1]
            )


class SlowScale:
    """The slow scale of one engine. One thread at a time; `close`, or a `with` statement, frees it."""

    def __init__(
        self,
        bodies: Sequence[Body | str],
        engine: Engine,
        client: Client | None,
        *,
        application: Application = Application.LIST,
        options: Options | None = None,
        restitution: float = 0.5,
        rest_speed: float = 0.0,
        group_gap: float = 1e-5,
        fall_back: bool = False,
        report: Callable[[Report], None] | None = None,
        timeout: float = 60.0,
        reconnect: float = 10.0,
        velocity_lag: float = 0.0,
    ) -> None:
        """bodies: of the engine, in the order of its indices; a str is the id in the catalogue. client: a Client or
        Local, connected or not; None: every impact has the declared `restitution`, 0..1. rest_speed: m/s; slower
        approaches are no impacts; 0: derived from what presses. group_gap: m; a coupled pair this near joins an impact.
        fall_back: where no answer comes, or it is a refusal, the declared restitution is used, reported and counted;
        False: such an impact is an error of `advance`. report: called for each impact. timeout: s, for an answer;
        reconnect: s, for a server to be found. velocity_lag: s, how long before the state's time the engine's
        velocities hold: h / 2 where steps of the size h move the positions by the velocities of their end, -h / 2 where
        by those of their start."""
        self._handle = ctypes.c_void_p()
        self._callbacks = _Callbacks(engine, report)
        self._client = client
        known = [body if isinstance(body, Body) else Body(body) for body in bodies]
        names = (abi.Body * len(known))(*[abi.Body(body.id.encode(), body.fixed, body.free) for body in known])
        config = _library.percuss_slow_config_default()
        config.body_count, config.bodies = len(known), names
        self._callbacks.fill(config)
        if client is not None:
            self._link = _abi.library.percuss_slow_link_default(client._open)
            self._link.timeout, self._link.reconnect = timeout, reconnect
            config.service = _abi.library.percuss_slow_link_service(ctypes.byref(self._link))
        _convert.fill(options or Options(), config.options, "options")
        config.application, config.restitution = application, restitution
        config.rest_speed, config.group_gap, config.fall_back = rest_speed, group_gap, fall_back
        config.velocity_lag = velocity_lag
        # the thunks of the callbacks live as long as this
        self._config = config
        self._check(_library.percuss_slow_create(ctypes.byref(config), ctypes.byref(self._handle)))

    def close(self) -> None:
        """Forgets what is being played; may be called again."""
        handle, self._handle = self._handle, ctypes.c_void_p()
        _library.percuss_slow_free(handle)

    def __enter__(self) -> "SlowScale":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __del__(self) -> None:
        if getattr(self, "_handle", None):
            self.close()

    @property
    def _open(self) -> ctypes.c_void_p:
        if not self._handle:
            raise ValueError("the slow scale is closed")
        if self._client is not None:
            self._client._open  # raises where it is closed
        return self._handle

    def _raise(self) -> None:
        """What the engine's methods raised goes first: the library only says that they failed."""
        raised, self._callbacks.raised = self._callbacks.raised, None
        if raised is not None:
            raise raised
        if self._client is not None:
            self._client._settle()

    def _check(self, code: int) -> None:
        self._raise()
        check(code, _library, "percuss_slow_error_text")

    def due(self, contacts: Sequence[Contact]) -> bool:
        """Whether an impact is due among these contacts, all those near touching at a trial state: for event
        location. Changes nothing and asks nobody."""
        target = _write_contacts(contacts)
        due: bool = _library.percuss_slow_due(self._open, len(target), target)
        self._raise()
        return due

    def next(self) -> float:
        """Time of the next sub-impact to be played, s: let the step end there. inf: none."""
        time: float = _library.percuss_slow_next(self._open)
        return time

    def advance(self, contacts: Sequence[Contact]) -> None:
        """To be called at every accepted state, with all contacts near touching: plays the sub-impacts whose time has
        come, then solves the impacts that are due. Without fall_back, an impact without an answer raises (NoServer,
        AnswerTimeout, InvalidArgument for one that is refused); it then has not happened: call again."""
        target = _write_contacts(contacts)
        self._check(_library.percuss_slow_advance(self._open, len(target), target))

    def rests(self, a: int, b: int, feature: int = 0) -> bool:
        """Whether the pair lay together at the last `advance`: the engine's own contact has to carry it."""
        return bool(_library.percuss_slow_rests(self._open, a, b, feature))

    @property
    def counts(self) -> Counts:
        """What was done so far."""
        return _convert.read(_library.percuss_slow_counts(self._open), Counts)
