# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Simulations whose impacts are the slow scale's: the loop, and one of bodies that no joint holds."""

import ctypes
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _abi, _convert
from . import _slow_abi as abi
from .request import BodyMotion, FloatArray
from .slowscale import Contact, Engine, Inertia, SlowScale, _write_contacts

_library = abi.library


def _turned(orientation: FloatArray, by: FloatArray) -> FloatArray:
    """A quaternion turned by a rotation vector, world."""
    angle = float(np.linalg.norm(by))
    w, v = np.cos(0.5 * angle), by * (np.sin(0.5 * angle) / angle if angle > 0.0 else 0.5)
    u = orientation[1:]
    turned: FloatArray = np.array([w * orientation[0] - v @ u, *(w * u + orientation[0] * v + np.cross(v, u))])
    turned /= np.linalg.norm(turned)
    return turned


def rotation(orientation: ArrayLike) -> FloatArray:
    """The matrix world <- body of a quaternion (w, x, y, z)."""
    w, x, y, z = np.asarray(orientation, dtype=np.float64)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    matrix: FloatArray = np.eye(3) + 2.0 * w * cross + 2.0 * cross @ cross
    return matrix


class World(Engine):
    """An engine that `run` can drive."""

    def contacts(self) -> Sequence[Contact]:
        """All pairs nearer than a few millimetres, overlapping ones too, at the present state."""
        raise NotImplementedError("contacts")

    def step(self, size: float) -> None:
        """Goes on by `size`, s, without forces between the bodies of the contacts."""
        raise NotImplementedError("step")

    def save(self) -> Any:
        """The present state, time included, for `restore`."""
        raise NotImplementedError("save")

    def restore(self, saved: Any) -> None:
        """Goes back there; the same state may be restored several times."""
        raise NotImplementedError("restore")


def run(world: World, slow: SlowScale, end: float, size: float, fixed: bool = False) -> None:
    """Goes on to `end` in steps of up to `size`, s, that end where a sub-impact or a touch is. `fixed`: all steps have
    that size, and none is taken back: by `move`, touches within them count; `save` and `restore` are not needed."""
    while fixed and world.now() < end - 1e-12:
        world.step(size)
        slow.advance(world.contacts())
    while world.now() < end - 1e-12:
        before, step = world.save(), min(size, end - world.now(), slow.next() - world.now())
        # what is behind by a rounding is played without a step
        world.step(max(0.0, step))
        if slow.due(world.contacts()):
            _locate(world, slow, before, step)
        slow.advance(world.contacts())


def _locate(world: World, slow: SlowScale, before: Any, size: float) -> None:
    """Goes back to just after the touch: the earliest moment of the step at which an impact is due."""
    early, late = 0.0, size
    while late - early > 1e-15:
        middle = 0.5 * (early + late)
        if middle in (early, late):
            break
        world.restore(before)
        world.step(middle)
        early, late = (early, middle) if slow.due(world.contacts()) else (middle, late)
    world.restore(before)
    world.step(late)


class FreeBodies(World):
    """Bodies that fly and turn freely, with the impacts' mathematics of libpercuss-slowscale; `contacts` is to be given
    by who derives from it, who knows their shapes."""

    def __init__(
        self, bodies: Sequence[BodyMotion], inertias: Sequence[Inertia], gravity: ArrayLike = (0.0, 0.0, 0.0)
    ) -> None:
        """gravity: m/s^2, on all bodies of finite mass."""
        if len(bodies) != len(inertias):
            raise ValueError(f"inertias: {len(inertias)}: as many as bodies, {len(bodies)}, are allowed")
        self.time = 0.0
        self._bodies = (_abi.BodyMotion * len(bodies))()
        self._inertias = (abi.Inertia * len(bodies))(*[abi.Inertia(one.mass, one.moments) for one in inertias])
        self._gravity = np.array(gravity, dtype=np.float64)
        for i, body in enumerate(bodies):
            _convert.fill(body, self._bodies[i], f"bodies[{i}]")

    def now(self) -> float:
        return self.time

    def motion(self, body: int) -> BodyMotion:
        return _convert.read(self._bodies[body], BodyMotion, overrides={})

    def gap_rates(self, contacts: Sequence[Contact]) -> FloatArray:
        rates = (ctypes.c_double * len(contacts))()
        _library.percuss_slow_gap_rates(self._bodies, len(contacts), _write_contacts(contacts), rates)
        return np.array(rates)

    def delassus(self, contacts: Sequence[Contact]) -> FloatArray:
        n = len(contacts)
        matrix = (ctypes.c_double * (n * n))()
        _library.percuss_slow_free_delassus(self._bodies, self._inertias, n, _write_contacts(contacts), matrix)
        return np.array(matrix).reshape(n, n)

    def oblique(self, contacts: Sequence[Contact]) -> FloatArray:
        n = len(contacts)
        matrix = (ctypes.c_double * (9 * n * n))()
        _library.percuss_slow_free_oblique(self._bodies, self._inertias, n, _write_contacts(contacts), matrix)
        return np.array(matrix).reshape(3 * n, 3 * n)

    def apply(self, contact: Contact, impulse: float) -> None:
        _library.percuss_slow_free_apply(self._bodies, self._inertias, _write_contacts([contact]), impulse)

    def apply_vector(self, contact: Contact, impulse: FloatArray) -> None:
        numbers = (ctypes.c_double * 3)(*impulse.tolist())
        _library.percuss_slow_free_apply_vector(self._bodies, self._inertias, _write_contacts([contact]), numbers)

    def move(self, contact: Contact, moment: float) -> None:
        _library.percuss_slow_free_move(self._bodies, self._inertias, _write_contacts([contact]), moment)

    def move_vector(self, contact: Contact, moment: FloatArray) -> None:
        numbers = (ctypes.c_double * 3)(*moment.tolist())
        _library.percuss_slow_free_move_vector(self._bodies, self._inertias, _write_contacts([contact]), numbers)

    def step(self, size: float) -> None:
        """Goes on by `size`, s: on parabolas, exactly, and turning by the midpoint rule, exactly about a principal
        axis."""
        self.time += size
        for body, inertia in zip(self._bodies, self._inertias):
            gravity = self._gravity if np.isfinite(inertia.mass) else np.zeros(3)
            velocity = np.array(body.velocity)
            body.position = tuple(np.array(body.position) + size * velocity + 0.5 * size**2 * gravity)
            body.velocity = tuple(velocity + size * gravity)
            self._turn(body, np.array(inertia.moments), size)

    @staticmethod
    def _turn(body: _abi.BodyMotion, moments: FloatArray, size: float) -> None:
        start, rate = np.array(body.orientation), np.array(body.angular_velocity)
        if not rate.any():
            return
        free = bool(np.isfinite(moments).all())
        momentum = rotation(start) @ (moments * (rotation(start).T @ rate)) if free else rate

        def rate_at(orientation: FloatArray) -> FloatArray:
            r = rotation(orientation)
            there: FloatArray = r @ ((r.T @ momentum) / moments) if free else rate
            return there

        end = _turned(start, size * rate_at(_turned(start, 0.5 * size * rate)))
        body.orientation, body.angular_velocity = tuple(end), tuple(rate_at(end))

    def save(self) -> tuple[float, bytes]:
        return self.time, bytes(self._bodies)

    def restore(self, saved: tuple[float, bytes]) -> None:
        self.time = saved[0]
        ctypes.memmove(self._bodies, saved[1], len(saved[1]))

    def energy(self) -> float:
        """Of the rigid motion, J: of the bodies of finite mass, by velocity and by height."""
        total = 0.0
        for body, inertia in zip(self._bodies, self._inertias):
            if np.isfinite(inertia.mass):
                velocity, position = np.array(body.velocity), np.array(body.position)
                total += inertia.mass * float(0.5 * velocity @ velocity - self._gravity @ position)
            rate = rotation(body.orientation).T @ np.array(body.angular_velocity)
            if rate.any() and np.isfinite(inertia.moments).all():
                total += 0.5 * float(rate @ (np.array(inertia.moments) * rate))
        return total
