# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Random scenes: bodies of a class, ten blows of balls on each. The same numbers give the same scenes anywhere."""

import math
import random
from dataclasses import dataclass

CLASSES = {
    "beam-round": "a round bar as a beam, on its side",
    "beam-square": "a square bar as a beam, on the axis",
    "beam-square-aside": "beside the axis",
    "beam-flat": "a bar of 0.5 to 2 breadths on the depth as a beam, on the axis",
    "beam-flat-aside": "beside the axis",
    "strip": "a strip as a beam, breadth over depth 2.5 to 8",
    "block-2": "a block, longest over shortest side 2 to 4",
    "block-4": "4 to 8",
    "block-8": "8 to 20",
    "side-4": "a cylinder on its side, length over radius 4 to 8",
    "side-8": "8 to 20",
    "end-8": "a cylinder on its end, 8 to 20",
}
BLOWS = 10
TOLERANCES = (1e-2, 1e-3, 1e-4)
LARGEST = 0.1  # half-axis of a contact over the radius that is least, beyond which it is not Hertz's


@dataclass
class Scene:
    name: str
    kind: str
    shape: str
    size: tuple  # box: x, y, z; cylinder: radius, length along x
    material: dict
    ball: dict
    radius: float
    at: tuple
    normal: tuple
    speed: float
    tolerance: float


def _log(r, low, high):
    return low * (high / low) ** r.random()


def _material(r, poisson):
    return {"young": _log(r, 3e9, 400e9), "poisson": poisson, "density": _log(r, 1000.0, 12000.0)}


def _sizes(r, kind):
    depth = _log(r, 2e-3, 40e-3)
    if kind == "beam-round":
        return "cylinder", (0.5 * depth, depth * _log(r, 6.0, 24.0))
    if kind.startswith(("side", "end")):
        radius = 0.5 * depth
        return "cylinder", (radius, radius * (_log(r, 4.0, 8.0) if kind == "side-4" else _log(r, 8.0, 20.0)))
    if kind.startswith("beam"):
        breadth = depth * (1.0 if "square" in kind else _log(r, 0.5, 2.0))
        return "box", (max(depth, breadth) * _log(r, 6.0, 24.0), breadth, depth)
    if kind == "strip":
        breadth = depth * _log(r, 2.5, 8.0)
        return "box", (min(breadth * _log(r, 2.0, 12.0), 40 * depth), breadth, depth)
    low, high = {"block-2": (2.0, 4.0), "block-4": (4.0, 8.0), "block-8": (8.0, 20.0)}[kind]
    longest = depth * _log(r, low, high)
    sides = [longest, _log(r, depth, longest), depth]
    r.shuffle(sides)
    return "box", tuple(sides)


def _place(r, kind, shape, size, margin):
    """A place on the surface, and its normal; None: too small for the margin."""

    def within(half):
        return None if half <= margin else r.uniform(-(half - margin), half - margin)

    if shape == "cylinder":
        radius, length = size
        if kind.startswith("end"):
            if margin >= radius:
                return None
            rho, angle = (radius - margin) * math.sqrt(r.random()), r.uniform(-math.pi, math.pi)
            return (0.5 * length, rho * math.cos(angle), rho * math.sin(angle)), (1.0, 0.0, 0.0)
        x = within(0.5 * length)
        return None if x is None else ((x, 0.0, radius), (0.0, 0.0, 1.0))
    axis = 2
    if kind.startswith("block") and r.random() < 0.4:
        axis = r.randrange(3)
    elif kind.startswith("block"):
        axis = size.index(min(size))
    at = [within(0.5 * s) for s in size]
    at[axis] = 0.5 * size[axis]
    if any(a is None for a in at):
        return None
    if kind in ("beam-square", "beam-flat") or (kind == "strip" and r.random() < 0.5):
        at[1] = 0.0
    return tuple(at), tuple(1.0 if i == axis else 0.0 for i in range(3))


def _half_axis(scene):
    """Of the contact, by a circle of the same mean curvature, for a rigid blow; over it the least radius."""
    bar = scene.size[0] if scene.shape == "cylinder" and scene.normal[2] == 1.0 else math.inf
    across = 1 / scene.radius + 1 / bar
    radius = 1 / math.sqrt(across / scene.radius)
    modulus = 1 / sum((1 - m["poisson"] ** 2) / m["young"] for m in (scene.ball, scene.material))
    volume = scene.size[0] * scene.size[1] * scene.size[2] if scene.shape == "box" else math.pi * scene.size[0] ** 2 * scene.size[1]
    mass = 1 / (3 / (4 * math.pi * scene.radius**3 * scene.ball["density"]) + 1 / (volume * scene.material["density"]))
    stiffness = 4 / 3 * modulus * math.sqrt(radius)
    depth = (1.25 * mass * scene.speed**2 / stiffness) ** 0.4
    # the longer half-axis of the ellipse
    return math.sqrt(radius * depth) * (across * scene.radius) ** 0.3, min(scene.radius, bar)


def draw(seed, kind, number):
    """The blows on one body."""
    r = random.Random(f"{seed} {kind} {number}")
    shape, size = _sizes(r, kind)
    poisson = r.uniform(0.0, 0.45)
    thickness = 2 * size[0] if shape == "cylinder" else min(size)
    found = []
    while len(found) < BLOWS:
        name = f"{kind}-{seed}-{number}-{len(found)}"
        scene = Scene(
            name, kind, shape, size, _material(r, poisson), _material(r, r.uniform(0.0, 0.45)), thickness * _log(r, 0.1, 2.0),
            (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), _log(r, 0.02, 3.0), r.choice(TOLERANCES),
        )
        if kind.startswith("end"):
            scene.normal = (1.0, 0.0, 0.0)
        axis, least = _half_axis(scene)
        if axis > LARGEST * least:
            continue
        place = _place(r, kind, shape, size, 2 * axis)
        if place is not None:
            scene.at, scene.normal = place
            found.append(scene)
    return found
