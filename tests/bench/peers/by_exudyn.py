# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Exudyn: a chain of lumped masses, its own contact of spheres with the exponent 1.5."""

import math
import time

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    MarkerNodePosition,
    NodePoint,
    ObjectConnectorSpringDamper,
    ObjectContactSphereSphere,
    ObjectMassPoint,
)
from scenes import ALUMINIUM, BAR, GAP, HALF, LENGTH, ONE_E, RADIUS, ROW, SPEED, STRIKER, contact_of, reference, restitution

VERSION = f"Exudyn {exu.__version__}"
CASES = [(cells, steps) for cells in (25, 50, 100) for steps in (100, 400, 1600)]


def run(scene, cells, steps):
    if scene == "beam":
        raise NotImplementedError("no beam is set up here")
    if scene == "bounce":
        raise NotImplementedError(ONE_E)
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
    return restitution(scene, after[0]), seconds
