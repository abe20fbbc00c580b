# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The restitution of a scene and what it is known to: a coarser basis, longer steps, fewer modes, and the compliance next
to the contact that a Hertz contact leaves open."""

from dataclasses import dataclass

import numpy as np

import ball
import impact
from box import Box
from cylinder import Cylinder

LOCAL = 0.02
"""Of compliance times modulus and radius: Hertz's pressure may act along the surface's normal or the contact's."""


@dataclass
class Body:
    """fine and coarse are of Young's modulus and density 1."""

    shape: str
    size: tuple
    poisson: float
    fine: object
    coarse: object


def body_of(shape, size, poisson, budget=1000):
    """shape: box (x, y, z) or cylinder (radius, length along x), m; made of a longest side of 1."""
    if shape == "cylinder":
        radius, length = size
        scale = max(2 * radius, length)
        along = int(np.clip(12 + 3.0 * length / radius, 16, 64))
        out = int(np.clip(5 + 1.3 * radius / length, 6, 24))
        turn = int(np.clip(8 + 2 * radius / length, 9, 40))
        counts = ((along, out, turn), (along - max(3, along // 7), out - 1, turn - 2))
        made = [Cylinder(radius / scale, length / scale, poisson, c) for c in counts]
    else:
        scale = max(size)
        sides = np.array(size) / scale
        counts = counts_of(sides, budget)
        static = counts_of(sides, 2400, 3.0)
        if np.prod(static) <= np.prod(counts):
            static = counts
        made = [Box(sides, poisson, counts, static), Box(sides, poisson, _fewer(counts), _fewer(static))]
    return Body(shape, tuple(size), poisson, *made)


def counts_of(sides, most, dense=None):
    """Polynomials as the sides ask for: up to `most` in a class. dense: no more than these per shortest side."""
    short = sides.min()
    for step in range(400, 0, -1):
        density = step / 40 if dense is None else min(step / 40, dense)
        counts = [int(np.clip(round(5 + density * s / short), 7, 90)) for s in sides]
        if 3 * np.prod(counts) / 8 <= most:
            return tuple(counts)
    return (7, 7, 7)


def _fewer(counts):
    return tuple(max(c - max(1, round(c / 7)), 5) for c in counts)


def restitution(body, at, normal, material, sphere, radius, speed):
    """e, its error, and the number of sub-impacts; at: m, from the centre. Unsettled: it is not known."""
    bar = body.size[0] if body.shape == "cylinder" and abs(normal[0]) < 0.5 else None
    hertz = impact.Hertz(sphere, material, radius, bar)
    scale = max(2 * body.size[0], body.size[1]) if body.shape == "cylinder" else max(body.size)
    young, density = material["young"], material["density"]
    mass = density * scale**3
    clock = scale * np.sqrt(density / young)
    own = 4 / 3 * np.pi * radius**3 * sphere["density"]
    place = np.asarray(at) / scale
    w = 1 / own + body.fine.rigid(place, normal) / mass
    force, duration = hertz.rigid_blow(w, speed)
    contact = float(np.sqrt(np.prod(hertz.axes(force))))
    ball_own = ball.flexibility(sphere["young"], sphere["poisson"], radius, contact)

    def of(model, extra=0.0, **keys):
        omega, shape = model.modes(place, normal)
        more = {} if bar is None else {"contact": contact / scale}
        flexibility = model.flexibility(place, normal, **more) / (young * scale) + ball_own + extra
        return impact.restitution(hertz, w, speed, omega / clock, shape / np.sqrt(mass), flexibility, **keys)

    e, blows = of(body.fine)
    local = LOCAL / (sphere["young"] * radius) + (LOCAL / (young * bar) if bar else 0.0)
    parts = [of(body.coarse)[0] - e, of(body.fine, steps=200)[0] - e, of(body.fine, cut=40.0)[0] - e, of(body.fine, extra=local)[0] - e]
    return e, float(np.sqrt(np.sum(np.square(parts)))) + 1e-5, blows
