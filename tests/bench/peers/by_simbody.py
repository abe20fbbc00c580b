# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Simbody, by simbody.cpp: chains of rigid bodies, its own contact of spheres."""

import math

import compiled
import numpy as np
from scenes import ALUMINIUM, BAR, HALF, LENGTH, RADIUS, ROW, SPEED, STRIKER, contact_of, reference, restitution

VERSION = "Simbody " + compiled.version("libsimbody-dev")
CASES = [
    (pieces, *setting)
    for pieces in (25, 50, 100)
    for setting in [*(("merson", accuracy) for accuracy in (1e-3, 1e-4, 1e-5, 1e-7)), ("cpodes", 1e-3), ("cpodes", 1e-5)]
]
CASES += [(200, "merson", 1e-4)]


def run(scene, pieces, integrator, accuracy):
    kind, number, piece = "balls", 2 if scene == "balls" else ROW, (0.0, 0.0, 0.0)
    if scene == "rod":
        length = LENGTH / pieces
        kind, number, piece = "rod", pieces, (BAR / pieces, ALUMINIUM[0] * math.pi * HALF**2 / length, length)
    elif scene == "beam":
        half = pieces // 2  # pieces on a side of the one in the middle
        length = LENGTH / (2 * half + 1)
        kind, number, piece = "beam", half, (BAR / LENGTH * length, ALUMINIUM[0] * math.pi / 4.0 * HALF**4 / length, length)
    speed, window = SPEED[scene], reference(scene)[1]
    seconds, after = compiled.ask(
        "simbody", kind, number, integrator, accuracy, 1.0001 * window, speed, STRIKER, RADIUS, contact_of(scene), *piece
    )
    return -np.array(after) / speed if scene == "row" else restitution(scene, after[0]), seconds
