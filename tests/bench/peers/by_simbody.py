# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Simbody, by simbody.cpp: chains of rigid bodies, its own contact of spheres."""

import math

import compiled
import numpy as np
from scenes import (
    ALUMINIUM,
    BAR,
    DROP,
    END,
    GRAVITY,
    HALF,
    LENGTH,
    RADIUS,
    ROW,
    SPEED,
    STRIKER,
    anvil,
    contact_of,
    exported,
    height_left,
    reference,
    restitution,
)

VERSION = "Simbody " + compiled.version("libsimbody-dev")
CASES = [
    (pieces, *setting)
    for pieces in (25, 50, 100)
    for setting in [*(("merson", accuracy) for accuracy in (1e-3, 1e-4, 1e-5, 1e-7)), ("cpodes", 1e-3), ("cpodes", 1e-5)]
]
CASES += [(200, "merson", 1e-4)]


def bounce(integrator, accuracy):
    """Hertz's stiffness, with what percuss export says of Hunt and Crossley's dissipation: d = 3/2 of Simbody's."""
    dissipation = exported("drake", "bounce")[0]["dissipation"] / 1.5
    no_piece, still = (0.0, 0.0, 0.0), 0.0
    seconds, (speed, fallen) = compiled.ask(
        "simbody", "bounce", 1, integrator, accuracy, END, still, STRIKER, RADIUS, anvil().stiffness, *no_piece, GRAVITY, DROP, dissipation
    )
    return np.array([(DROP - fallen + 0.5 * speed**2 / GRAVITY) / height_left()]), seconds


def run(scene, pieces, integrator, accuracy):
    if scene == "bounce":
        return bounce(integrator, accuracy)
    kind, number, piece = "balls", 2 if scene == "balls" else ROW, (0.0, 0.0, 0.0)
    if scene == "rod":
        length = LENGTH / pieces
        kind, number, piece = "rod", pieces, (BAR / pieces, ALUMINIUM[0] * math.pi * HALF**2 / length, length)
    elif scene == "beam":
        half = pieces // 2  # pieces on a side of the one in the middle
        length = LENGTH / (2 * half + 1)
        kind, number, piece = "beam", half, (BAR / LENGTH * length, ALUMINIUM[0] * math.pi / 4.0 * HALF**4 / length, length)
    speed, window, k = SPEED[scene], reference(scene)[1], contact_of(scene)
    seconds, after = compiled.ask(
        "simbody", kind, number, integrator, accuracy, 1.0001 * window, speed, STRIKER, RADIUS, k, *piece, 0.0, 0.0, 0.0
    )
    return -np.array(after[:ROW]) / speed if scene == "row" else restitution(scene, after[0]), seconds
