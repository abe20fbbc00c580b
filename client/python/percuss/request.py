# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""A request: which bodies touch where.

SI units. Quaternions are (w, x, y, z), world = R(q) body; body frame: origin in the centre of mass, rods
and beams along x. Vectors may be given as anything that numpy makes an array of.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any, Generic, Optional, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _abi, _convert, _json
from .vocabulary import (
    MAX_BODIES,
    MAX_CONTACTS,
    MAX_CONTACTS_OBLIQUE,
    MAX_DELASSUS,
    Choice,
    Compliance,
    ContactModel,
    Dents,
    Friction,
    Method,
    Parameter,
)

FloatArray = NDArray[np.float64]
_ChoiceType = TypeVar("_ChoiceType", bound=Choice)


class _Vector:
    """A dataclass field that is a float array of fixed length, whatever was assigned to it."""

    def __init__(self, *default: float) -> None:
        self._default = default

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    @overload
    def __get__(self, instance: None, owner: type) -> tuple[float, ...]: ...

    @overload
    def __get__(self, instance: object, owner: type) -> FloatArray: ...

    def __get__(self, instance: object | None, owner: type) -> FloatArray | tuple[float, ...]:
        if instance is None:  # dataclass asks the class for the default
            return self._default
        vector: FloatArray = instance.__dict__[self._name]
        return vector

    def __set__(self, instance: object, value: ArrayLike) -> None:
        vector = np.array(value, dtype=np.float64)
        if vector.shape != (len(self._default),):
            raise ValueError(f"{self._name}: shape {vector.shape}: {len(self._default)} numbers are allowed")
        instance.__dict__[self._name] = vector


class _Quantity:
    """A dataclass field that is a number in SI units, whatever text with a unit was assigned to it."""

    def __init__(self, quantity: str, default: float = 0.0) -> None:
        self._quantity, self._default = quantity, default

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, instance: object | None, owner: type) -> float:
        if instance is None:  # dataclass asks the class for the default
            return self._default
        value: float = instance.__dict__[self._name]
        return value

    def __set__(self, instance: object, value: float | str) -> None:
        instance.__dict__[self._name] = _convert.number(self._name, value, self._quantity)


class _Chosen(Generic[_ChoiceType]):
    """A dataclass field that is a choice, whatever name or number of one was assigned to it."""

    def __init__(self, default: _ChoiceType) -> None:
        self._default = default

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, instance: object | None, owner: type) -> _ChoiceType:
        if instance is None:
            return self._default
        value: _ChoiceType = instance.__dict__[self._name]
        return value

    def __set__(self, instance: object, value: _ChoiceType | str) -> None:
        instance.__dict__[self._name] = type(self._default).of(value)


@dataclass
class BodyMotion:
    """One body at the stated instant."""

    id: str
    """Its name in the server's catalogue, up to 63 bytes."""
    position: _Vector = _Vector(0.0, 0.0, 0.0)
    """Of the centre of mass, world, m."""
    orientation: _Vector = _Vector(1.0, 0.0, 0.0, 0.0)
    """Unit quaternion (w, x, y, z), world = R(q) body."""
    velocity: _Vector = _Vector(0.0, 0.0, 0.0)
    """Of the centre of mass, world, m/s."""
    angular_velocity: _Vector = _Vector(0.0, 0.0, 0.0)
    """World, rad/s."""
    state: str = ""
    """Token of an earlier reply (Reply.states_after); empty: at rest, without dents."""
    elapsed: _Quantity = _Quantity("time")
    """s since that state, which is as at `window` of its reply, or a text with a unit: "20ms"."""
    specimen: str = ""
    """Name of a durable object on a rig; empty: none."""
    overrides: dict[Parameter, float] = field(default_factory=dict)
    """Parameters of the body in this request only, instead of the catalogue's."""


@dataclass
class ContactPlace:
    """Where bodies[a] meets bodies[b]."""

    a: int
    b: int
    point: _Vector = _Vector(0.0, 0.0, 0.0)
    """World, m."""
    normal: _Vector = _Vector(0.0, 0.0, 0.0)
    """World, unit, from b to a."""
    gap: _Quantity = _Quantity("length")
    """m, or a text with a unit; negative: the bodies overlap already."""
    gap_acceleration: float = 0.0
    """n.(a_A - a_B), m/s^2; negative presses."""


@dataclass
class Contact(ContactPlace):
    """A contact of bodies[a] on bodies[b]."""

    friction: float = 0.0
    """Coefficient of friction; 0: the catalogue's for the two materials, none if it states none."""
    tangent: _Vector = _Vector(0.0, 0.0, 0.0)
    """World, first tangential direction, made normal to `normal`; zero: the world axis least parallel to it is."""


@dataclass
class Options:
    """What to compute, and how well; 0 selects a default."""

    tolerance: float = 0.0
    """On the restitution; 0: 1e-3."""
    horizon: _Quantity = _Quantity("time")
    """s, or a text with a unit: "20ms"; 0: the longer of 20 ms and two longest periods."""
    contact_model: _Chosen[ContactModel] = _Chosen(ContactModel.AUTO)
    """It and the next three: a member, or its name: "closed-form"."""
    method: _Chosen[Method] = _Chosen(Method.MODAL)
    compliance: _Chosen[Compliance] = _Chosen(Compliance.DEFAULT)
    dents: _Chosen[Dents] = _Chosen(Dents.KEEP)
    conditioning: bool = False
    """Also report d(restitution)/d(speed)."""
    trace: bool = False
    """The server also writes the force history on topic percuss/v1/Trace."""
    deadline: _Quantity = _Quantity("time")
    """s, or a text with a unit, from arrival until the server gives up; 0: none."""
    friction: _Chosen[Friction] = _Chosen(Friction.MICRO_SLIP)
    """Law of the tangential forces where a coefficient is stated: a member, or its name: "plain"."""


@dataclass
class Request:
    """Up to 64 bodies and 64 contacts at one instant."""

    bodies: list[BodyMotion] = field(default_factory=list)
    contacts: list[Contact] = field(default_factory=list)
    delassus: Optional[ArrayLike] = None
    """The caller's w^T M^-1 w, 1/kg, of n contacts: n x n for their normals, or 3n x 3n, which friction needs: rows
    normal, first and second tangent of contact 0, then of contact 1, ... A list of all its numbers will do. None: the
    server computes its own."""
    options: Options = field(default_factory=Options)
    sequence: int = 0
    """0: the client counts. Set it to repeat a request after a time-out."""

    @classmethod
    def from_json(cls, source: str | bytes | Mapping[str, Any]) -> Request:
        """Of a JSON text, or of its object as json.loads gives it, as `percuss query --request` reads it, but without
        `client`: who asks says it. Raises a ValueError that names the member, its value and what is allowed."""
        return _of_json(source if isinstance(source, Mapping) else _json.parse(source))

    def to_json(self) -> dict[str, Any]:
        """The object that json.dumps makes a text of, which from_json and `percuss query --request` read."""
        matrix, members = _delassus(self), _json.write(self)
        members["delassus"] = None if matrix is None else matrix.tolist()
        return {name: one for name, one in members.items() if name not in ("delassus", "sequence") or one}


def _fill_bodies(bodies: Sequence[BodyMotion], target: Any) -> None:
    for i, body in enumerate(bodies):
        _convert.fill(body, target[i], f"bodies[{i}]")
        target[i].override_count = len(body.overrides)
        for k, (parameter, value) in enumerate(body.overrides.items()):
            target[i].overrides[k] = _abi.Override(parameter, value)


def _index(field_name: str, index: int) -> None:
    # ctypes would take it modulo 2^32
    if not 0 <= index < MAX_BODIES:
        raise ValueError(f"{field_name}: {index}: 0..{MAX_BODIES - 1} is allowed")


def _fill_contacts(contacts: Sequence[Contact], target: Any) -> None:
    for i, contact in enumerate(contacts):
        _index(f"contacts[{i}].a", contact.a)
        _index(f"contacts[{i}].b", contact.b)
        _convert.fill(contact, target[i], f"contacts[{i}]")


def _check_count(field_name: str, count: int, most: int) -> None:
    if count > most:
        raise ValueError(f"{field_name}: {count} are too many; up to {most} are allowed")


def _delassus(request: Request) -> FloatArray | None:
    if request.delassus is None:
        return None
    n = len(request.contacts)
    matrix = np.ascontiguousarray(request.delassus, dtype=np.float64)
    for rows in (n, 3 * n):
        if matrix.shape in ((rows, rows), (rows * rows,)):
            break
    else:
        raise ValueError(
            f"delassus: shape {matrix.shape}: ({n}, {n}), contacts x contacts, or ({3 * n}, {3 * n}), with both tangents "
            "of each, is allowed"
        )
    if rows > n > MAX_CONTACTS_OBLIQUE:
        raise ValueError(
            f"delassus: shape {matrix.shape}: of normals and tangents up to {MAX_CONTACTS_OBLIQUE} contacts are allowed, "
            f"not {n}"
        )
    return matrix.reshape(rows, rows)


def fill(request: Request, target: _abi.Request) -> object:
    """Writes the request into the C struct. The result must live as long as `target` is used."""
    _check_count("bodies", len(request.bodies), MAX_BODIES)
    _check_count("contacts", len(request.contacts), MAX_CONTACTS)
    if not 0 <= request.sequence < 2**64:
        raise ValueError(f"sequence: {request.sequence}: 0..2^64-1 is allowed")
    matrix = _delassus(request)
    target.sequence = request.sequence
    target.body_count = len(request.bodies)
    target.contact_count = len(request.contacts)
    _fill_bodies(request.bodies, target.bodies)
    _fill_contacts(request.contacts, target.contacts)
    if matrix is not None:
        target.delassus = matrix.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
        target.delassus_rows = len(matrix)
    _convert.fill(request.options, target.options, "options")
    return matrix


def _read_body(body: Any) -> BodyMotion:
    overrides = {Parameter(one.parameter): one.value for one in body.overrides[: body.override_count]}
    return _convert.read(body, BodyMotion, overrides=overrides)


def read_scene(source: _abi.Request) -> Request:
    """The bodies and contacts of a C struct, with default options."""
    return Request(
        [_read_body(body) for body in source.bodies[: source.body_count]],
        [_convert.read(contact, Contact) for contact in source.contacts[: source.contact_count]],
    )


def _matrix_of_json(value: Any, n: int) -> FloatArray:
    """Rows of numbers, or all numbers in one list, of n contacts."""
    if not _json.is_array(value):
        _json.fail("delassus", f"an array is needed, not {_json.kind_of(value)}")
    flat = not (value and _json.is_array(value[0]))
    if flat and len(value) not in (n * n, 9 * n * n):
        _json.fail("delassus", f"{n * n} numbers are needed, or {9 * n * n} with both tangents, not {len(value)}")
    rows = (n if len(value) == n * n else 3 * n) if flat else len(value)
    if rows not in (n, 3 * n):
        needed = f"{n} rows are needed, one a contact, or {3 * n} with both tangents"
        _json.fail("delassus", f"{needed}, not {rows}")
    if rows * rows > MAX_DELASSUS:
        many = f"{rows} rows are too many: of normals and tangents up to {MAX_CONTACTS_OBLIQUE} contacts are allowed"
        _json.fail("delassus", f"{many}, not {n}")
    if flat:
        return np.array(_json.read_numbers(value, "delassus", rows * rows)).reshape(rows, rows)
    return np.array([_json.read_numbers(row, f"delassus[{i}]", rows) for i, row in enumerate(value)])


def _of_json(value: Any) -> Request:
    if not isinstance(value, Mapping):
        _json.fail("", f"a request is an object, not {_json.kind_of(value)}")
    if "client" in value:
        _json.fail("client", "is who asks, not read here: percuss.connect(id=...) and percuss.Local(id=...) take it")
    _json.check_object(value, "", [field.name for field in fields(Request)])
    request = Request()
    for i, one in enumerate(_json.read_array(value.get("bodies", []), "bodies", MAX_BODIES)):
        request.bodies.append(BodyMotion(""))
        _json.read_into(request.bodies[i], one, f"bodies[{i}]")
    for i, one in enumerate(_json.read_array(value.get("contacts", []), "contacts", MAX_CONTACTS)):
        request.contacts.append(Contact(0, 0))
        _json.read_into(request.contacts[i], one, f"contacts[{i}]")
    if "delassus" in value:
        request.delassus = _matrix_of_json(value["delassus"], len(request.contacts))
    _json.read_into(request.options, value.get("options", {}), "options")
    if "sequence" in value:
        request.sequence = _json.read_whole(value["sequence"], "sequence", 1, 63)
    return request
