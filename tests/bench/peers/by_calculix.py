# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""CalculiX, as engineers set such impacts up: a mass, Hertz's spring, linear bars. Its solids are in solids.py."""

import numpy as np
from calculix import row, struck, truss_rod
from scenes import ALUMINIUM, HALF, LENGTH, RADIUS, ROW, SPEED, STRIKER, contact_of, reference, restitution

VERSION = "CalculiX 2.20, springs and bars"
CASES = [(25, 5e-6), (50, 2e-6), (100, 5e-6), (100, 2e-6), (200, 2e-6), (200, 1e-6)]


def run(scene, cells, step):
    if scene == "beam":
        raise NotImplementedError("its beams have shear: see below")
    if scene == "bounce":
        raise NotImplementedError("10 s would be millions of its steps")
    speed, window, stiffness = SPEED[scene], 1.0001 * reference(scene)[1], contact_of(scene)
    if scene == "rod":
        body = truss_rod(cells, HALF, LENGTH, ALUMINIUM)
        after, seconds = struck(body, STRIKER, stiffness, speed, 1, f"{-2.0 * RADIUS}, 0, 0", step, window)
        return restitution(scene, after), seconds
    after, seconds = row(2 if scene == "balls" else ROW, STRIKER, stiffness, speed, step, window)
    return np.array([after[1] - after[0]]) / speed if scene == "balls" else -after / speed, seconds
