# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Impacts of bodies in three dimensions: seconds of one core against the error of e, by modes (the paper's model C), by complete
finite elements (its model A), and by CalculiX.

The truth is what finite elements converge to, and no error is less than its own:
    rod-solid    the sphere on the rod, 0.3 m/s: complete_fe --cells 24 --scene rod --speed 0.3, its limit
    balls-solid  two steel spheres, 1 m/s: solid_pair balls solve 24, and what its meshes still change
    beam-solid   the sphere on the beam, 0.2 m/s: a mesh of the beam, reduced to its modes (docs/lab/mesh.md); beam_3d's finest mesh
                 has 0.7339 +- 0.005
    plate        a steel ball of 5 mm on 240 x 240 x 8 mm of glass, 1 m/s: a mesh of half that size, reduced to its modes
                 (docs/lab/accuracy.md: e has no length of its own); CalculiX's finest mesh here has 0.7784
What is left of an error as steps become small is the mesh's, or the theory's.

usage: solids.py PERCUSS-BUILD OUTPUT.csv      PERCUSS_LIBRARY, and PYTHONPATH with client/python; adds lines of
    scene,program,settings,error,seconds,why
"""

import csv
import functools
import math
import subprocess
import sys
import time
from pathlib import Path

import calculix
import numpy as np
import percuss
from peers import repeated
from scenes import ALUMINIUM, BAR, HALF, LENGTH, RADIUS, STEEL, STRIKER, crossed, hertz

BUILD = Path(sys.argv[1])
TRUTH = {"rod-solid": (0.633605, 1.2e-4), "balls-solid": (0.99999, 1e-5), "beam-solid": (0.7397, 5e-3), "plate": (0.778, 5e-4)}
SPEED = {"rod-solid": 0.3, "balls-solid": 1.0, "beam-solid": 0.2, "plate": 1.0}
GLASS = (70e9, 0.22, 2500.0)
MARBLE = 0.005
SIDE, THICKNESS = 0.24, 0.008
BALL = 4.0 / 3.0 * math.pi * MARBLE**3 * STEEL[2]
PLATE = SIDE**2 * THICKNESS * GLASS[2]
DISC = 0.12  # m, radius of the axisymmetric plate: no wave comes back from its rim during the contact


def restitution_of(impulse, mass, other, speed):
    return impulse * (1.0 / mass + 1.0 / other) / speed - 1.0


# ---- percuss ----


def pair(scene, what, number):
    """What solid_pair prints: of a solution e and the seconds."""
    program = BUILD / "tests" / "bench" / "solid_pair"
    return subprocess.run([program, scene, what, str(number)], check=True, capture_output=True, text=True).stdout


def by_solver(scene, tolerance):
    value, seconds = map(float, pair(scene.removesuffix("-solid"), "modal", tolerance).split())
    return value, seconds


@functools.cache
def client():
    return percuss.Local(Path(__file__).with_name("solids.yaml"))


def by_percuss(scene, tolerance):
    bodies = client().bodies()
    a, b = ("marble", "plate") if scene == "plate" else ("ball", "ball")
    asked = percuss.contact_pair(bodies[a], bodies[b], speed=SPEED[scene])
    asked.options.tolerance = tolerance
    client().solve(asked)  # once for the plate's modes
    repeats = 20
    began = time.process_time()
    for _ in range(repeats):
        reply = client().solve(asked)
    return reply.contacts[0].restitution, (time.process_time() - began) / repeats


def by_first(scene, tolerance):
    """A body that was never asked of: its modes too."""
    fresh = percuss.Local(Path(__file__).with_name("solids.yaml"))
    bodies = fresh.bodies()
    asked = percuss.contact_pair(bodies["marble"], bodies["plate"], speed=SPEED[scene])
    asked.options.tolerance = tolerance
    began = time.process_time()
    reply = fresh.solve(asked)
    return reply.contacts[0].restitution, time.process_time() - began


def by_complete(scene, cells, *rest):
    if scene == "beam-solid":
        bricks, across, levels, step = cells, *rest
        program = BUILD / "tests" / "bench" / "beam_3d"
        words = ["--bricks", bricks, "--across", across, "--levels", levels, "--contact-step", step, "--no-header"]
        run = subprocess.run([program, *map(str, words)], check=True, capture_output=True, text=True)
        found = run.stdout.split(",")
        return float(found[9]), float(found[13]) + float(found[14])
    value, seconds = map(float, pair(scene.removesuffix("-solid"), "solve", cells).split())
    return value, seconds


# ---- CalculiX ----


def meshes(scene, cells):
    """Speed, contact radius, and of each body nodes, quads and surface."""
    words = iter(pair(scene.removesuffix("-solid"), "mesh", cells).split())
    speed, patch = float(next(words)), float(next(words))
    found = []
    for count in words:
        nodes, quads, surface = int(count), int(next(words)), int(next(words))
        places = np.array([float(next(words)) for _ in range(2 * nodes)]).reshape(nodes, 2)
        corners = np.array([int(next(words)) for _ in range(4 * quads)]).reshape(quads, 4)
        found.append((places, corners, [int(next(words)) for _ in range(surface)]))
    return speed, patch, found


def graded(fine, reach, growth, coarse, end):
    """Coordinates from 0: steps of `fine` as far as `reach`, then growing up to `coarse`, until `end`."""
    line, step = [0.0], fine
    while line[-1] < end:
        line.append(line[-1] + step)
        if line[-1] > reach:
            step = min(step * growth, coarse)
    return np.array(line) * end / line[-1]


def disc(patch, cells):
    """A grid in the frame of solid_pair, graded towards the contact."""
    r = graded(patch / cells, 1.5 * patch, 1.3, 0.002, DISC)
    z = graded(patch / cells, 1.5 * patch, 1.3, 0.002, THICKNESS)
    places = np.array([(x, -y) for y in z for x in r])
    n = len(r)
    first = (np.arange(len(z) - 1)[:, None] * n + np.arange(n - 1)).ravel()
    return places, np.stack([first, first + n, first + n + 1, first + 1], axis=1), list(range(n))


def by_calculix(scene, cells, step, stiffness):
    """Solids; stiffness: of the contact, in Young's moduli over the length of an element."""
    speed, patch, both = meshes(scene, cells)
    material, mass, other, window = {
        "rod-solid": (ALUMINIUM, STRIKER, BAR, 2.2e-4),
        "balls-solid": (STEEL, STRIKER, STRIKER, 1e-4),
        "plate": (GLASS, BALL, PLATE, 7.5e-5),
    }[scene]
    both = [disc(patch, cells), *both] if scene == "plate" else both
    per_length = stiffness * 70e9 * cells / patch
    impulse, seconds = calculix.solids(both, (material, STEEL), speed, patch, per_length, step, window)
    return restitution_of(impulse * speed * mass, mass, other, speed), seconds


def by_spring(scene, cells, step):
    """Its beams or shells, a mass, and Hertz's spring."""
    speed = SPEED[scene]
    if scene == "beam-solid":
        body = calculix.half_beam(cells, HALF, LENGTH, ALUMINIUM)
        mass, other, k, share, window = STRIKER, BAR, crossed(STEEL, ALUMINIUM), 0.5, 5.8e-3
    else:
        line = graded(0.5 * SIDE / cells, 0.0, 1.0, 1.0, 0.5 * SIDE)
        body = calculix.quarter_plate(line, THICKNESS, GLASS)
        mass, other, k, share, window = BALL, PLATE, hertz(STEEL, GLASS, 1.0 / MARBLE), 0.25, 7.5e-5
    after, seconds = calculix.struck(body, share * mass, share * k, -speed, 3, "0, 0, 0.03", step, window)
    return restitution_of(mass * (speed + after), mass, other, speed), seconds


# ---- scipy: Zener's equation of a plate without end (C. Zener, Phys. Rev. 59, 1941) ----


def by_zener(scene, method, tolerance):
    """A thin plate gives way with the velocity of the force over 8 sqrt(bending stiffness x mass of its area)."""
    from scipy.integrate import solve_ivp

    speed, k = SPEED[scene], hertz(STEEL, GLASS, 1.0 / MARBLE)
    bending = GLASS[0] * THICKNESS**3 / 12.0 / (1.0 - GLASS[1] ** 2)
    mobility = 0.125 / math.sqrt(bending * GLASS[2] * THICKNESS)

    def motion(_, y):
        force = k * y[0] * math.sqrt(y[0]) if y[0] > 0.0 else 0.0
        return [y[1] - mobility * force, -force / BALL]

    began = time.process_time()
    solved = solve_ivp(motion, (0.0, 1e-4), [0.0, speed], method=method, rtol=tolerance, atol=[1e-6 * tolerance, tolerance])
    seconds = time.process_time() - began
    return restitution_of(BALL * (speed - solved.y[1, -1]), BALL, PLATE, speed), seconds


# ---- the run ----

VERSIONS = {
    "solver": "percuss, model C: the solver itself",
    "percuss": "percuss, model C, from Python",
    "first": "the same, the plate's modes too",
    "complete": "percuss, model A: complete finite elements",
    "calculix-solids": "CalculiX 2.20, solids",
    "calculix-springs": "CalculiX 2.20, beams or shells and Hertz's spring",
    "zener": "scipy 1.17.1, Zener's equation",
}
TOLERANCES = [(0.1,), (1e-2,), (1e-3,), (1e-4,)]
CASES = {
    "rod-solid": {
        "solver": (by_solver, TOLERANCES),
        "complete": (by_complete, [(4,), (6,), (8,), (12,)]),
        "calculix-solids": (
            by_calculix,
            [(2, 5e-6, 5), (2, 5e-6, 500), (3, 5e-6, 100), (4, 5e-6, 50), (4, 2e-6, 50), (8, 5e-6, 200)],
        ),
    },
    "beam-solid": {
        "solver": (by_solver, TOLERANCES),
        "complete": (by_complete, [(60, 1, 5, 4e-6)]),
        "calculix-springs": (by_spring, [(40, 2e-5), (80, 1e-5), (160, 1e-5), (320, 1e-5)]),
    },
    "balls-solid": {
        "percuss": (by_percuss, TOLERANCES),
        "complete": (by_complete, [(4,), (8,), (12,)]),
        "calculix-solids": (by_calculix, [(2, 2e-6, 500), (4, 4e-6, 500), (4, 2e-6, 500)]),
    },
    "plate": {
        "percuss": (by_percuss, TOLERANCES),
        "first": (by_first, [(1e-2,)]),
        "calculix-solids": (by_calculix, [(2, 2e-6, 500), (2, 1e-6, 500), (4, 1e-6, 200), (8, 1e-6, 200)]),
        "calculix-springs": (by_spring, [(10, 2e-6), (10, 1e-6), (20, 1e-6)]),
        "zener": (by_zener, [(method, tolerance) for method in ("RK45", "DOP853", "LSODA") for tolerance in (1e-2, 1e-4, 1e-6)]),
    },
}


def lines():
    for program, version in VERSIONS.items():
        yield "version", program, version, "", "", ""
    for scene, programs in CASES.items():
        for program, (run, cases) in programs.items():
            for settings in cases:
                shown = " ".join(map(str, settings))
                try:
                    value, seconds = repeated(run, scene, settings)
                    truth, doubt = TRUTH[scene]
                    yield scene, program, shown, f"{max(abs(value - truth), doubt):.3g}", f"{seconds:.3g}", ""
                except NotImplementedError as why:
                    yield scene, program, "", "", "", why
                    break
                except RuntimeError as why:
                    yield scene, program, shown, "", "", why


def main():
    with open(sys.argv[2], "a", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        for line in lines():
            table.writerow(line)
            file.flush()


if __name__ == "__main__":
    main()
