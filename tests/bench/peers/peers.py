# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The same impacts in other programs: seconds of one core against the error of e, each by its best settings.

A steel sphere on the paper's rod (0.3 m/s) and beam (0.2 m/s), two steel spheres, and the first of ten in a row (1 m/s). All solve
the same equations: rigid balls, Hertz's contact of half-spaces, elementary rod, Euler and Bernoulli's beam. The reference is
percuss at 1e-8, which another way has to confirm: solve_ivp with the most modes and the smallest tolerance.

usage: peers.py OUTPUT.csv      PERCUSS_LIBRARY, and PYTHONPATH with client/python; programs that are missing are left out
"""

import csv
import functools
import math
import sys
import time
from pathlib import Path

import numpy as np
import percuss

STEEL, ALUMINIUM = (210e9, 0.30, 7800.0), (70e9, 0.33, 2700.0)
RADIUS, HALF, LENGTH = 0.015, 0.010, 1.0
STRIKER = 4.0 / 3.0 * math.pi * RADIUS**3 * STEEL[2]
BAR = math.pi * HALF**2 * LENGTH * ALUMINIUM[2]
ROW = 10
SPEED = {"rod": 0.3, "beam": 0.2, "balls": 1.0, "row": 1.0}
GAP = 1e-9  # m, where a program takes no two bodies that touch already
TIMES = 3  # of which the least counts


def hertz(a, b, curvature):
    """Stiffness of two round surfaces, N/m^1.5; of crossed ones by their mean curvature only where it is told."""
    modulus = 1.0 / ((1.0 - a[1] ** 2) / a[0] + (1.0 - b[1] ** 2) / b[0])
    return 4.0 / 3.0 * modulus / math.sqrt(curvature)


# ---- percuss ----


@functools.cache
def client():
    return percuss.Local(Path(__file__).with_name("catalogue.yaml"))


def question(scene, tolerance):
    bodies = client().bodies()
    if scene == "row":
        asked = percuss.Request()
        for i in range(ROW):
            speed = SPEED[scene] if i == 0 else 0.0
            asked.bodies.append(percuss.BodyMotion("ball", position=(0, 0, -2.0 * RADIUS * i), velocity=(0, 0, -speed)))
        for i in range(ROW - 1):
            asked.contacts.append(percuss.Contact(i, i + 1, point=(0, 0, -RADIUS * (2 * i + 1)), normal=(0, 0, 1)))
    else:
        asked = percuss.contact_pair(
            bodies["striker"], bodies["ball" if scene == "balls" else scene], speed=SPEED[scene]
        )
    asked.options.tolerance = tolerance
    return asked


def answer(reply, scene):
    """e; of the row the speeds of all balls."""
    if scene != "row":
        return np.array([reply.contacts[0].restitution])
    return np.array([body.velocity[2] for body in reply.velocity_after]) / SPEED[scene]


def by_percuss(scene, tolerance):
    asked = question(scene, tolerance)
    client().solve(asked)  # the bodies' modes, once
    repeats = 20
    began = time.process_time()
    for _ in range(repeats):
        reply = client().solve(asked)
    return answer(reply, scene), (time.process_time() - began) / repeats


@functools.cache
def reference(scene):
    reply = client().solve(question(scene, 1e-8))
    return answer(reply, scene), reply.window


# ---- scipy: the modal equations as everyone writes them ----


def bar_modes(scene, count):
    """Angular frequencies, and the displacements at the blow, per unit of modal mass; the first are the rigid ones."""
    if scene == "rod":
        k = np.arange(count)
        omega = k * math.pi / LENGTH * math.sqrt(ALUMINIUM[0] / ALUMINIUM[2])
        phi = np.sqrt(np.where(k == 0, 1.0, 2.0) / BAR)
        return omega, phi
    # symmetric modes of the free beam: tan(b/2) + tanh(b/2) = 0
    b = np.array([(2.0 * j + 1.5) * math.pi for j in range(count - 1)])
    for _ in range(30):
        t, h = np.tan(0.5 * b), np.tanh(0.5 * b)
        b -= (t + h) / (0.5 * (1.0 + t * t) + 0.5 * (1.0 - h * h))
    # shape cos(b x)/cos(b/2) + cosh(b x)/cosh(b/2), of the norm 2, in the middle
    phi = (1.0 / np.cos(0.5 * b) + 1.0 / np.cosh(0.5 * b)) / math.sqrt(BAR)
    omega = (b / LENGTH) ** 2 * math.sqrt(ALUMINIUM[0] * 0.25 * HALF**2 / ALUMINIUM[2])
    return np.concatenate([[0.0], omega]), np.concatenate([[1.0 / math.sqrt(BAR)], phi])


def contact_of(scene):
    if scene == "rod":
        return hertz(STEEL, ALUMINIUM, 1.0 / RADIUS)
    if scene == "beam":
        # crossed: Hertz's ellipse, by the complete elliptic integrals
        return crossed(STEEL, ALUMINIUM)
    return hertz(STEEL, STEEL, 2.0 / RADIUS)


def crossed(a, b):
    """A sphere on a round bar (K. L. Johnson, Contact Mechanics, section 4.2)."""
    from scipy.optimize import brentq
    from scipy.special import ellipe, ellipk

    large, small = 0.5 * (1.0 / RADIUS + 1.0 / HALF), 0.5 / RADIUS  # B, A

    def off(ratio):  # b/a of the ellipse's half-axes
        m = 1.0 - ratio**2
        return (ellipe(m) / ratio**2 - ellipk(m)) / (ellipk(m) - ellipe(m)) - large / small

    ratio = brentq(off, 0.05, 0.9999)
    m = 1.0 - ratio**2
    # d = p0 b K / E*, B = p0 (E/r^2... ) in terms of the major half-axis a
    modulus = 1.0 / ((1.0 - a[1] ** 2) / a[0] + (1.0 - b[1] ** 2) / b[0])
    # A = F 3/(2 pi a^3 E*) (K - E)/(1 - r^2) ; d = 3 F K / (2 pi a E*)
    per_force = 3.0 / (2.0 * math.pi * modulus)
    size = per_force * (ellipk(m) - ellipe(m)) / m / small  # a^3 / F
    return (per_force * ellipk(m)) ** -1.5 * math.sqrt(size)


def by_scipy(scene, modes, method, tolerance):
    from scipy.integrate import solve_ivp

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
    other = BAR if scene in ("rod", "beam") else STRIKER
    impulse = STRIKER * (speed - y[1])
    return np.array([impulse * (1.0 / STRIKER + 1.0 / other) / speed - 1.0]), seconds


# ---- Exudyn: a chain of lumped masses, its own contact of spheres with the exponent 1.5 ----


def by_exudyn(scene, cells, steps):
    if scene == "beam":
        raise NotImplementedError("no beam is set up here")
    import exudyn as exu
    from exudyn.itemInterface import (
        MarkerNodePosition,
        NodePoint,
        ObjectConnectorSpringDamper,
        ObjectContactSphereSphere,
        ObjectMassPoint,
    )

    speed, window, k = SPEED[scene], reference(scene)[1], contact_of(scene)
    system = exu.SystemContainer().AddSystem()

    def point(place, mass, velocity=0.0):
        node = system.AddNode(NodePoint(referenceCoordinates=[place, 0, 0], initialVelocities=[velocity, 0, 0]))
        system.AddObject(ObjectMassPoint(physicsMass=mass, nodeNumber=node))
        return node, system.AddMarker(MarkerNodePosition(nodeNumber=node))

    def touch(a, b):
        data = system.AddNode(exu.itemInterface.NodeGenericData(initialCoordinates=[0, 0, 0, 0], numberOfDataCoordinates=4))
        system.AddObject(
            ObjectContactSphereSphere(
                markerNumbers=[a, b],
                nodeNumber=data,
                spheresRadii=[RADIUS, RADIUS],
                contactStiffness=k,
                contactStiffnessExponent=1.5,
            )
        )

    if scene in ("balls", "row"):
        points = [point((2.0 * RADIUS + GAP) * i, STRIKER, speed if i == 0 else 0.0) for i in range(2 if scene == "balls" else ROW)]
        for a, b in zip(points, points[1:]):
            touch(a[1], b[1])
    else:
        cell = LENGTH / cells
        points = [point(-2.0 * RADIUS - GAP, STRIKER, speed)]
        points += [point(cell * i, BAR / cells * (0.5 if i in (0, cells) else 1.0)) for i in range(cells + 1)]
        spring = ALUMINIUM[0] * math.pi * HALF**2 / cell
        for a, b in zip(points[1:], points[2:]):
            system.AddObject(
                ObjectConnectorSpringDamper(markerNumbers=[a[1], b[1]], stiffness=spring, referenceLength=cell)
            )
        touch(points[0][1], points[1][1])
    system.Assemble()
    settings = exu.SimulationSettings()
    settings.solutionSettings.writeSolutionToFile = False
    settings.timeIntegration.endTime = 1.0001 * window
    settings.timeIntegration.numberOfSteps = steps
    settings.timeIntegration.discontinuous.ignoreMaxIterations = True
    settings.timeIntegration.verboseMode = 0
    settings.timeIntegration.explicitIntegration.computeMassMatrixInversePerBody = True
    began = time.process_time()
    system.SolveDynamic(settings, solverType=exu.DynamicSolverType.RK44, storeSolver=False, showHints=False)
    seconds = time.process_time() - began
    after = [system.GetNodeOutput(p[0], exu.OutputVariableType.Velocity)[0] for p in points]
    if scene == "row":
        return -np.array(after) / speed, seconds
    other = STRIKER if scene == "balls" else BAR
    return np.array([STRIKER * (speed - after[0]) * (1.0 / STRIKER + 1.0 / other) / speed - 1.0]), seconds


# ---- MuJoCo: rigid bodies with its contact, by what percuss export says ----


def by_mujoco(scene, step):
    import json
    import os
    import subprocess

    import mujoco

    if scene == "row":
        raise NotImplementedError("its contacts are fitted pair by pair")
    program = Path(os.environ["PERCUSS_LIBRARY"]).parents[1] / "bin" / "percuss"
    command = [program, "export", "--for", "mujoco", "--local", "--catalogue", Path(__file__).with_name("catalogue.yaml")]
    command += ["--a", "striker", "--b", "ball" if scene == "balls" else scene]
    command += ["--speed", f"{0.5 * SPEED[scene]}:{1.5 * SPEED[scene]}:3"]
    told = json.loads(subprocess.run([*command, "--json"], check=True, capture_output=True).stdout)
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    masses = (STRIKER, STRIKER if scene == "balls" else BAR)
    bodies = "".join(
        f'<body pos="0 0 {z}"><freejoint/><geom name="{name}" type="sphere" size="0.5" mass="{mass}"/></body>'
        for name, mass, z in zip("AB", masses, (1.0, 0.0))
    )
    model = mujoco.MjModel.from_xml_string(f'<mujoco><option gravity="0 0 0"/>{text}<worldbody>{bodies}</worldbody></mujoco>')
    model.opt.timestep = told["step"] * step
    data = mujoco.MjData(model)
    data.qvel[2] = -SPEED[scene]
    steps = math.ceil(2.0 * told["duration"] / model.opt.timestep)
    began = time.process_time()
    mujoco.mj_step(model, data, steps)
    seconds = time.process_time() - began
    return np.array([(data.qvel[8] * -1.0 + data.qvel[2]) / SPEED[scene]]), seconds


# ---- the run ----

CASES = {
    "percuss": [(by_percuss, (10.0**-i,)) for i in range(1, 8)],
    "scipy": [
        (by_scipy, (modes, method, tolerance))
        for modes in (10, 20, 40, 80, 160)
        # LSODA's matrices take minutes of more modes
        for method in (("RK45", "DOP853", "LSODA") if modes < 40 else ("RK45", "DOP853"))
        for tolerance in (1e-3, 1e-5, 1e-7)
    ],
    "exudyn": [(by_exudyn, (cells, steps)) for cells in (25, 50, 100) for steps in (100, 400, 1600)],
    "mujoco": [(by_mujoco, (step,)) for step in (1.0, 0.5, 0.2)],
}
LONG = 1.0  # s: what takes longer is run once


def main():
    with open(sys.argv[1], "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["scene", "program", "settings", "error", "seconds"])
        for scene in SPEED:
            true = reference(scene)[0]
            for program, cases in CASES.items():
                done = set()
                for run, settings in cases:
                    # rigid balls have neither modes nor cells
                    key = settings[1:] if scene in ("balls", "row") and len(settings) > 1 else settings
                    if key in done:
                        continue
                    done.add(key)
                    try:
                        results = [run(scene, *settings)]
                        while len(results) < TIMES and results[0][1] < LONG:
                            results.append(run(scene, *settings))
                    except (ImportError, NotImplementedError) as why:
                        print(f"{scene} {program}: {why}", file=sys.stderr)
                        break
                    except (ValueError, RuntimeError) as why:
                        print(f"{scene} {program} {key}: {why}", file=sys.stderr)
                        continue
                    error = float(np.max(np.abs(results[0][0] - true)))
                    seconds = min(result[1] for result in results)
                    table.writerow([scene, program, " ".join(map(str, key)), f"{error:.3g}", f"{seconds:.3g}"])
                    file.flush()
                    print(f"{scene} {program} {key}: error {error:.2g}, {seconds:.3g} s", file=sys.stderr)


if __name__ == "__main__":
    main()
