# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""scipy: the modal equations as everyone writes them."""

import math
import time

import numpy as np
import scipy
from scenes import ROW, SPEED, STRIKER, bar_modes, contact_of, reference, restitution
from scipy.integrate import solve_ivp

VERSION = f"scipy {scipy.__version__}"
CASES = [
    (modes, method, tolerance)
    for modes in (10, 20, 40, 80, 160)
    # LSODA's matrices take minutes of more modes
    for method in (("RK45", "DOP853", "LSODA") if modes < 40 else ("RK45", "DOP853"))
    for tolerance in (1e-3, 1e-5, 1e-7)
]


def run(scene, modes, method, tolerance):
    speed, window, k = SPEED[scene], reference(scene)[1], contact_of(scene)
    if scene == "row":
        n = ROW

        def motion(_, y):
            d = np.maximum(y[: n - 1] - y[1:n], 0.0)
            force = k * d * np.sqrt(d) / STRIKER
            return np.concatenate([y[n:], np.concatenate([[0.0], force]) - np.concatenate([force, [0.0]])])

        start = np.zeros(2 * n)
        start[n] = speed
        scale = np.concatenate([np.full(n, 1e-6), np.full(n, speed)])
    else:
        omega, phi = (np.zeros(1), np.ones(1) / math.sqrt(STRIKER)) if scene == "balls" else bar_modes(scene, modes)
        n, square = len(omega), omega**2

        def motion(_, y):
            d = y[0] - phi @ y[2 : 2 + n]
            force = k * d * math.sqrt(d) if d > 0.0 else 0.0
            return np.concatenate([[y[1], -force / STRIKER], y[2 + n :], phi * force - square * y[2 : 2 + n]])

        start = np.zeros(2 + 2 * n)
        start[1] = speed
        scale = np.concatenate([[1e-6, speed], np.full(n, 1e-6), np.full(n, speed)])
    began = time.process_time()
    solved = solve_ivp(
        motion, (0.0, 1.0001 * window), start, method=method, rtol=tolerance, atol=tolerance * scale, dense_output=False
    )
    seconds = time.process_time() - began
    y = solved.y[:, -1]
    if scene == "row":
        return -y[ROW:] / speed, seconds
    return restitution(scene, y[1]), seconds
