# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""What a server announces of itself and its catalogue, and the placing of two of its bodies."""

from __future__ import annotations

import ctypes
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol, TypeVar

import numpy as np

from . import _abi, _convert, _server_abi
from ._convert import read
from .errors import InvalidArgument, UnknownName, check
from .request import FloatArray, Request, read_scene
from .vocabulary import Id, Parameter, Support, TaskKind


@dataclass(frozen=True)
class Site:
    """A place on a body that has a name."""

    name: str
    point: FloatArray
    """Body frame, m."""
    normal: FloatArray
    """Outward, unit, body frame."""


@dataclass(frozen=True)
class RelaxationTerm:
    """A term of a Prony series."""

    share: float
    """Of the instantaneous modulus, that a sudden strain loses."""
    time: float
    """s, in which it falls to 1/e of that."""


@dataclass(frozen=True)
class ContactLaw:
    """A force law that the catalogue states for the contacts of two materials."""

    name: str
    kind: str
    """power, hysteresis, hunt-crossley, points."""
    stiffness: float
    """N/m^exponent; nan: of points, as the next three."""
    exponent: float
    hysteresis: float
    """Share of the work of loading that is lost."""
    dissipation: float
    """s/m."""
    deviation: float
    """Of the force, one standard deviation over it."""
    points: str
    """File of loading, as the catalogue names it; empty: none."""
    point_count: int
    """Of loading."""
    max_indentation: float
    """m, of the last point; nan: of no points, as the next two."""
    max_force: float
    """N."""
    unloading: str
    """File; empty: the way of loading."""
    residual_indentation: float
    """m, where unloading from the last point ends."""


@dataclass(frozen=True)
class MaterialPair:
    """What the catalogue states of the contacts of two materials."""

    material_a: str
    """The first by name."""
    material_b: str
    friction: float
    """Coefficient; nan: not stated."""
    friction_deviation: float
    """Standard deviation of it."""
    law: ContactLaw | None
    """Which contact model auto takes; None: none is stated."""


@dataclass(frozen=True)
class Body:
    """A body of the catalogue."""

    id: str
    shape: str
    """sphere, rod, beam, cylinder, block, half-space, mesh."""
    material: str
    mass: float
    """kg; inf: half-space."""
    description: str
    """Dimensions, theory and ends in words."""
    half_extents: FloatArray
    """Half the size along the body's x, y, z, m; half-space: 0."""
    radius: float
    """Sphere, rod, round beam, cylinder, m; 0: none."""
    tip_radius: float
    """Of a rod's ends, m; inf: flat; other shapes: 0."""
    supports: tuple[Support, Support]
    """Of a rod or beam at its ends at -x and +x."""
    parameters: dict[Parameter, float]
    """What a request may override; inf: a yield stress that it never reaches."""
    inertia: FloatArray
    """Diagonal of the tensor about the centre of mass, kg m^2."""
    products: FloatArray
    """Its elements yz, zx, xy; 0: the axes are principal."""
    sites: tuple[Site, ...]
    """Places with names: mesh."""
    loss_factor: float = np.nan
    """Of its material; nan: not stated, or an older server."""
    loss_frequency: float = np.nan
    """Hz, at which that was measured; nan: not stated."""
    relaxation: tuple[RelaxationTerm, ...] = ()
    """Of its material: a Prony series."""
    rate_reference: float = np.nan
    """1/s, of the yield stress by the rate of strain; nan: it is that of any rate."""
    rate_exponent: float = np.nan
    """Of Cowper and Symonds; nan: by the coefficient."""
    rate_coefficient: float = np.nan
    """Of Johnson and Cook; nan: by the exponent."""


@dataclass(frozen=True)
class Task:
    """Something that a server is doing, or has still to do."""

    client: Id
    """Who waits for it; zeros: nobody."""
    sequence: int
    """Its number, of that client."""
    kind: TaskKind
    running: bool
    """False: it waits for its turn."""
    age: float
    """s, since it was asked for."""
    done: float
    """Share of it, 0..1; nan: not known."""


@dataclass(frozen=True)
class Server:
    """A server of the domain."""

    server: Id
    version: str
    catalogue_revision: str
    catalogue: str
    """File."""
    host: str
    process: int
    state: str
    """ready, draining."""
    workers: int
    bodies: int
    queue_length: int
    queue_capacity: int
    answered: int
    refused: int
    uptime: float
    """s."""
    activity: str
    """What a long computation is doing."""
    progress: float
    """0..1; nan: nothing is running."""
    specimens: int
    """That it keeps."""
    tasks: tuple[Task, ...]
    """What it does and what waits, 16 at most: those that run before those that wait, the oldest first."""
    all_tasks: int
    """How many there are, listed or not."""


@dataclass(frozen=True)
class Dent:
    """A patch of a surface that yielded; point in the body frame, m, N."""

    point: FloatArray
    size: float
    """Radius of the patch."""
    max_indentation: float
    max_force: float
    residual_indentation: float
    """Depth that stays."""
    contact_radius: float
    """At the largest force."""


@dataclass(frozen=True)
class Specimen:
    """A body whose dents the server keeps on disk."""

    name: str
    body: str
    impacts: int
    """Counted on it."""
    dents: tuple[Dent, ...]


def read_body(source: Any) -> Body:
    """Copies a C body."""
    first, second = source.supports
    parameters = {one: source.parameters[one] for one in Parameter if not np.isnan(source.parameters[one])}
    sites = tuple(read(site, Site) for site in source.sites[: source.site_count])
    relaxation = tuple(read(term, RelaxationTerm) for term in source.relaxation[: source.relaxation_count])
    known = {"parameters": parameters, "sites": sites, "relaxation": relaxation}
    return read(source, Body, supports=(Support(first), Support(second)), **known)


def read_pair(source: Any) -> MaterialPair:
    """Copies a C pair of materials."""
    return read(source, MaterialPair, law=read(source.law, ContactLaw) if source.law.name else None)


def write_body(body: Body) -> _server_abi.Body:
    """The C body."""
    return _server_abi.Body(
        body.id.encode(),
        body.shape.encode(),
        body.material.encode(),
        body.mass,
        body.description.encode(),
        tuple(body.half_extents.tolist()),
        body.radius,
        body.tip_radius,
        body.supports,
        tuple(body.parameters.get(one, np.nan) for one in Parameter),
        tuple(body.inertia.tolist()),
        tuple(body.products.tolist()),
        len(body.sites),
        tuple((site.name.encode(), tuple(site.point.tolist()), tuple(site.normal.tolist())) for site in body.sites),
        body.loss_factor,
        body.loss_frequency,
        len(body.relaxation),
        tuple((term.share, term.time) for term in body.relaxation),
        body.rate_reference,
        body.rate_exponent,
        body.rate_coefficient,
    )


_Value = TypeVar("_Value")


class _Named(dict[str, _Value]):
    """By names; one that is not there is refused with those that are."""

    _path, _where = "", ""

    def __missing__(self, name: str) -> _Value:
        raise UnknownName(self._path, name, self, self._where)


class Bodies(_Named[Body]):
    """Of a catalogue, by id, sorted."""

    _path, _where = "body", "in the catalogue"
    pairs: tuple[MaterialPair, ...] = ()
    """Of their materials, those of which the catalogue states friction or a law, sorted by both names."""
    catalogue_revision: str = ""
    """Hash of the catalogue, as replies have it; empty: an older server."""


class Specimens(_Named[Specimen]):
    """That a server keeps, by name, sorted."""

    _path, _where = "specimen", "kept by the server"


class _Catalogued(Protocol):
    """A Client or a Local."""

    def bodies(self, timeout: float = 3.0) -> Bodies: ...


def find(name: str, body: Body | str, known: Mapping[str, Body]) -> Body:
    """The body, or that of the catalogue with this id; `name` is for messages."""
    if isinstance(body, Body):
        return body
    if body not in known:
        raise UnknownName(name, body, known, "in the catalogue")
    return known[body]


def _end(body: Body, word: str, path: str) -> float:
    """Which end of a beam that is held at one of them is its tip, or its root."""
    free = [one == Support.FREE for one in body.supports]
    if free[0] == free[1]:
        ends = " and ".join(one.text for one in body.supports)
        raise ValueError(f"{path}: {word!r}: the ends of {body.id} are {ends}, so that it has no tip and no root; "
                         "0 is its end at -x, 1 that at +x")
    return 1.0 if free[1] == (word == "tip") else 0.0


def _along(body: Body, text: str, path: str) -> float:
    """A place along a beam, as the command line reads it."""
    word = text.strip()
    if word in ("tip", "root"):
        return _end(body, word, path)
    if word == "middle":
        return 0.5
    percent = word.endswith("%")
    try:
        value = _convert.number(path, word[:-1] if percent else word, "number") / (100.0 if percent else 1.0)
        end = 1.0
    except InvalidArgument:
        # with a unit: from its end at -x
        try:
            value, end = _convert.number(path, word, "length"), 2.0 * float(body.half_extents[0])
        except InvalidArgument:
            value, end = np.nan, 1.0
    if not 0.0 <= value <= end:
        raise ValueError(f"{path}: {text!r}: a fraction of the length of {body.id}, 0..1, per cent of it, a length from "
                         f"its end at -x of up to {2.0 * float(body.half_extents[0]):g} m, middle, tip or root is allowed")
    return value / end


def place(body: Body, at: float | str, path: str) -> tuple[float, str | None]:
    """The fraction of a beam's length, and the name of a site: one of them is meant."""
    if not isinstance(at, str):
        return at, None
    if body.sites:
        names = [site.name for site in body.sites]
        if at not in names:
            raise UnknownName(path, at, names, f"a site of {body.id}")
        return 0.5, at
    if body.shape != "beam":
        raise ValueError(f"{path}: {at!r}: {body.id} ({body.shape}) has no sites, and is no beam: it is hit where it always is")
    return _along(body, at, path), None


def is_placed(body: Body) -> bool:
    """Whether there is a choice of where it is hit."""
    return body.shape == "beam" or bool(body.sites)


def contact_pair(
    a: Body | str,
    b: Body | str,
    speed: float | str,
    at_a: float | str = 0.5,
    at_b: float | str = 0.5,
    site_a: str | None = None,
    site_b: str | None = None,
    *,
    at: float | str | None = None,
    client: _Catalogued | None = None,
    bodies: Mapping[str, Body] | None = None,
    angle: float = 0.0,
    spin: float = 0.0,
    friction: float = 0.0,
) -> Request:
    """A request in which two bodies touch at their default sites; a moves with `speed` (m/s, > 0, or a text with a
    unit: "300mm/s") straight at b, and all else is at rest. a, b: of client.bodies(), or their ids in the catalogue of
    `client` or among `bodies`.

    at_a, at_b: where along a beam its site is, 0 (end at -x) to 1 (end at +x), or as the command line has it: "25%",
    "0.3m" from the end at -x, "middle", and of a beam that is held at one end "tip" or "root"; of a mesh the name of a
    site, as site_a, site_b. at: the same of b, or of a where b leaves no choice.

    Default sites: sphere and block: top (+z); half-space: origin; cylinder: end at +x; rod: end at +x if
    that is free, else at -x; beam: +z side; mesh: its first site with a name. b stands unrotated at the origin, the normal is the outward
    one of its site.

    angle: rad, of a's flight from the normal, less than pi/2 in magnitude; `speed` is that along it. It leans towards the
    contact's tangent: the world axis that is least parallel to the normal (x before y before z), made normal to it. spin:
    rad/s, of a about tangent x normal, at the contact that faces b it adds to the slip along the tangent. friction: the
    coefficient; 0: the catalogue's for the two materials, if any.

    InvalidArgument for a shape that cannot be placed, or a number out of range; UnknownName, a
    KeyError, lists what there is.
    """
    names = [f"{name}: {one!r}" for name, one in (("a", a), ("b", b)) if isinstance(one, str)]
    if names and client is None and bodies is None:
        raise ValueError(f"{', '.join(names)}: a name needs `client` or `bodies`, in whose catalogue it is looked up")
    if bodies is None:
        bodies = client.bodies() if names and client is not None else {}
    first_body, second_body = find("a", a, bodies), find("b", b, bodies)
    if at is not None:
        if is_placed(second_body):
            at_b = at
        elif is_placed(first_body):
            at_a = at
        else:
            warnings.warn("at has no effect: neither body is a beam or has sites", stacklevel=2)
    place_a, named_a = place(first_body, at_a, "at_a" if at is None else "at")
    place_b, named_b = place(second_body, at_b, "at_b" if at is None else "at")
    site_a, site_b = site_a or named_a, site_b or named_b
    first, second = write_body(first_body), write_body(second_body)
    value = _convert.number("speed", speed, "speed")
    pair = _server_abi.Pair(ctypes.pointer(first), ctypes.pointer(second), value, place_a, place_b)
    pair.site_a, pair.site_b = (None if name is None else name.encode() for name in (site_a, site_b))
    pair.angle, pair.spin, pair.friction = angle, spin, friction
    request = _abi.Request()
    check(_abi.library.percuss_contact_pair(ctypes.byref(pair), ctypes.byref(request)))
    return read_scene(request)
