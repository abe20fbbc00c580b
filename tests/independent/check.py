# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The reference against closed forms and against values of others; exit code 1 where one is missed."""

import sys
import time

import numpy as np

import ball
import reference
from box import Box
from cylinder import Cylinder

STEEL = {"young": 210e9, "poisson": 0.3, "density": 7800.0}
ALUMINIUM = {"young": 70e9, "poisson": 0.33, "density": 2700.0}
failed = []


def check(name, value, right, within):
    good = abs(value - right) <= within
    print(f"{'' if good else 'MISSED '}{name}: {value:.6g}, {right:.6g} within {within:.2g}", flush=True)
    if not good:
        failed.append(name)


def closed_forms():
    shear = np.sqrt(1 / 2.6)
    lame = np.pi * np.sqrt(2) * shear
    cube = Box((1, 1, 1), 0.3, (10, 10, 10))
    check("Lame's modes of a cube", min(cube.frequencies(), key=lambda o: abs(o - lame)), lame, 1e-6 * lame)
    bar = Box((1, 0.02, 0.02), 0.3, (40, 5, 5))
    euler = 4.730041**2 * 0.02 / np.sqrt(12)
    check("a slender free bar bends", bar.frequencies()[0], euler, 4e-3 * euler)
    rod = Cylinder(0.01, 1.0, 0.3, (24, 5, 3))
    check("a slender free rod, waves along it", min(rod.frequencies(), key=lambda o: abs(o - np.pi)), np.pi, 1e-3)
    check("a round bar twists", min(rod.frequencies(), key=lambda o: abs(o - 2 * np.pi)), 2 * np.pi, 1e-2)
    slope = np.polyfit(np.log([0.01, 0.02]), [ball.regular(0.0, a) for a in (0.01, 0.02)], 1)[0]
    check("a sphere's logarithm of the contact", slope, -1 / (2 * np.pi), 2e-3)
    # a compact cylinder's own flexibility is that of its end
    end = Cylinder(1 / 40, 1.0, 0.3, (60, 7, 1)).flexibility((0.5, 0, 0), (1, 0, 0)) - 1 / (3 * np.pi / 1600)
    check("a rod's end beyond its length", end / 40, -0.5987, 0.002)


def values():
    """Steel balls: those of meshes (docs/lab/accuracy.md)."""
    for name, shape, size, material, at, normal, radius, speed, right, within in (
        ("bar 8 x 8 x 80", "box", (0.08, 0.008, 0.008), ALUMINIUM, (0, 0, 0.004), (0, 0, 1), 0.008, 0.05, 0.7484, 1e-3),
        ("the same, 0.5 m/s", "box", (0.08, 0.008, 0.008), ALUMINIUM, (0, 0, 0.004), (0, 0, 1), 0.008, 0.5, 0.8147, 1e-3),
        ("block 50 x 50 x 5", "box", (0.05, 0.05, 0.005), STEEL, (0, 0, 0.0025), (0, 0, 1), 0.01, 0.5, 0.8422, 2e-3),
        ("disc 60 x 5", "cylinder", (0.03, 0.005), STEEL, (0.0025, 0, 0), (1, 0, 0), 0.01, 0.2, 0.9496, 1e-3),
        ("the same, 15.6 mm beside", "cylinder", (0.03, 0.005), STEEL, (0.0025, 0.0156, 0), (1, 0, 0), 0.01, 0.2, 0.8620, 1e-3),
        ("cylinder r 5, L 80", "cylinder", (0.005, 0.08), ALUMINIUM, (0, 0, 0.005), (0, 0, 1), 0.008, 0.05, 0.7639, 1e-3),
        ("the same, 20 mm beside", "cylinder", (0.005, 0.08), ALUMINIUM, (0.02, 0, 0.005), (0, 0, 1), 0.008, 0.05, 0.9888, 1e-3),
    ):
        begin = time.time()
        body = reference.body_of(shape, size, material["poisson"])
        made = time.time()
        e, error, blows = reference.restitution(body, at, normal, material, STEEL, radius, speed)
        check(f"{name} +- {error:.5f} ({blows} sub-impacts; {made - begin:.1f} s and {time.time() - made:.1f} s)", e, right, within + error)


closed_forms()
values()
sys.exit(1 if failed else 0)
