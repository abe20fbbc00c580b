# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""scipy: the modal equations as everyone writes them; the ball that bounces by events on parabolas and on each blow."""

import math
import time

import numpy as np
import scipy
from scenes import (
    DROP,
    END,
    GRAVITY,
    ROW,
    SPEED,
    STRIKER,
    anvil,
    bar_modes,
    contact_of,
    height_left,
    reference,
    restitution,
)
from scipy.integrate import solve_ivp

VERSION = f"scipy {scipy.__version__}"
CASES = [
    (modes, method, tolerance)
    for modes in (10, 20, 40, 80, 160)
    # LSODA's matrices take minutes of more modes
    for method in (("RK45", "DOP853", "LSODA") if modes < 40 else ("RK45", "DOP853"))
    for tolerance in (1e-3, 1e-5, 1e-7)
] + [(10, method, 1e-9) for method in ("RK45", "DOP853", "LSODA")]  # for bodies without modes


def event(function, direction):
    function.terminal, function.direction = True, direction
    return function


def blow(contact, speed, method, tolerance):
    """Loading to the turn, then unloading to the dent: the speed after, the depth that the ball leaves, and the time."""

    def part(force, start, until):
        solved = solve_ivp(
            lambda _, y: (y[1], GRAVITY - force(y[0]) / STRIKER),
            (0.0, 1e-3),
            start,
            method=method,
            rtol=tolerance,
            atol=(1e-6 * tolerance, tolerance),
            events=until,
        )
        return solved.y[0, -1], solved.y[1, -1], solved.t[-1]

    deepest, _, loading = part(contact.load, (0.0, speed), event(lambda _, y: y[1], -1))
    dent, largest = contact.dent(deepest), contact.load(deepest)

    def unload(d):
        return largest * (max(d - dent, 0.0) / (deepest - dent)) ** 1.5

    depth, after, unloading = part(unload, (deepest, 0.0), event(lambda _, y: y[0] - dent, -1))
    return -after, depth, loading + unloading


def bounce(method, tolerance):
    began = time.process_time()
    speed = math.sqrt(2.0 * GRAVITY * DROP)
    now = speed / GRAVITY
    while now < END:
        up, depth, blown = blow(anvil(), speed, method, tolerance)
        speed = math.sqrt(up**2 - 2.0 * GRAVITY * depth)  # at the height where the next blow begins
        now += blown + (up + speed) / GRAVITY
    seconds = time.process_time() - began
    return np.array([0.5 * speed**2 / GRAVITY / height_left()]), seconds


def run(scene, modes, method, tolerance):
    if scene == "bounce":
        return bounce(method, tolerance)
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
