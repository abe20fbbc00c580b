# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""What a server announces of itself and its catalogue, and the placing of two of its bodies."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _abi, _server_abi
from ._convert import read
from .errors import check
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
    return read(source, Body, supports=(Support(first), Support(second)), parameters=parameters, sites=sites)


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
    )


def find(name: str, body: Body | str, known: dict[str, Body]) -> Body:
    """The body, or that of the catalogue with this id; `name` is for messages."""
    if isinstance(body, Body):
        return body
    if body not in known:
        raise ValueError(f"{name}: {body!r}: not in the catalogue, which has {', '.join(known)}")
    return known[body]


def contact_pair(
    a: Body,
    b: Body,
    speed: float,
    at_a: float = 0.5,
    at_b: float = 0.5,
    site_a: str | None = None,
    site_b: str | None = None,
) -> Request:
    """A request in which two bodies touch at their default sites; a moves with `speed` (m/s, > 0)
    straight at b, and all else is at rest. at_a, at_b: where along a beam its site is, 0 (end at -x)
    to 1 (end at +x). site_a, site_b: the name of a site.

    Default sites: sphere and block: top (+z); half-space: origin; cylinder: end at +x; rod: end at +x if
    that is free, else at -x; beam: +z side; mesh: its first site with a name. b stands unrotated at the origin, the normal is the outward
    one of its site. InvalidArgument for a shape that cannot be placed, or a number out of range.
    """
    first, second = write_body(a), write_body(b)
    pair = _server_abi.Pair(ctypes.pointer(first), ctypes.pointer(second), speed, at_a, at_b)
    pair.site_a, pair.site_b = (None if name is None else name.encode() for name in (site_a, site_b))
    request = _abi.Request()
    check(_abi.library.percuss_contact_pair(ctypes.byref(pair), ctypes.byref(request)))
    return read_scene(request)
