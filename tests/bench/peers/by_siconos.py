# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Siconos, by siconos.cpp: bodies by their modes, and each of its laws of an impact."""

import math

import compiled
import numpy as np
from scenes import ONE_E, ROW, SPEED, STRIKER, bar_modes, contact_of, reference, restitution

VERSION = "Siconos " + compiled.version("libsiconos-kernel-dev")
# modes, law, and its step: s; the tolerance of lsodar; of liu the part of the impulse before
CASES = [(modes, "hertz", step) for modes in (10, 20, 40, 80, 160) for step in (16e-6, 4e-6, 1e-6)]
CASES += [(modes, "hertz", 0.25e-6) for modes in (10, 20, 40)]
CASES += [(modes, "lsodar", tolerance) for modes in (10, 20, 40) for tolerance in (1e-3, 1e-5, 1e-7)]
CASES += [(40, "newton", 1e-6)]
CASES += [(1, "liu", part) for part in (1e-2, 1e-3, 1e-4)]


def linear(scene, modes):
    """M, K (diagonals), the speeds before, H (each contact's approach by the coordinates): the first coordinate is the striker's."""
    if scene == "row":
        return np.full(ROW, STRIKER), np.zeros(ROW), SPEED[scene] * np.eye(ROW)[0], np.eye(ROW - 1, ROW) - np.eye(ROW - 1, ROW, 1)
    omega, phi = (np.zeros(1), np.ones(1) / math.sqrt(STRIKER)) if scene == "balls" else bar_modes(scene, modes)
    n = len(omega)
    mass, stiffness = np.concatenate([[STRIKER], np.ones(n)]), np.concatenate([[0.0], omega**2])
    return mass, stiffness, SPEED[scene] * np.eye(n + 1)[0], np.concatenate([[1.0], -phi])[None, :]


def run(scene, modes, law, step):
    if scene == "bounce":
        raise NotImplementedError(ONE_E)
    rigid = scene in ("balls", "row")
    if law == "liu" and not rigid:
        raise NotImplementedError("its impulses at an instant leave bodies no time to vibrate")
    mass, stiffness, before, h = linear(scene, modes)
    window = 1.0001 * reference(scene)[1]
    steps = round(window / step) if law in ("hertz", "newton") else round(1.0 / step)
    e = 1.0 if rigid else 0.0  # that of rod and beam comes of their waves
    numbers = (*mass, *stiffness, *before, *h.ravel(), contact_of(scene))
    seconds, after = compiled.ask("siconos", law, steps, window, e, h.shape[1], h.shape[0], *map(float, numbers))
    if scene == "row":
        return -np.array(after) / SPEED[scene], seconds
    return restitution(scene, after[0]), seconds
