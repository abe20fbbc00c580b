# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""percuss itself, asked from Python in the same process; the ball that bounces by a simulator in Python and the slow scale."""

import math
import time

import numpy as np
import percuss
from percuss.slowscale import Body, Contact, Inertia, SlowScale
from percuss.world import FreeBodies
from percuss.world import run as run_world
from scenes import DROP, END, GRAVITY, RADIUS, STRIKER, answer, blow_options, client, height_left, question

VERSION = f"percuss {percuss.__version__}"
STEP = 1e-2  # s, of the simulator, which is never taken back
CASES = [(10.0**-i,) for i in range(1, 8)]


class Bouncing(FreeBodies):
    def __init__(self):
        ball = percuss.BodyMotion("striker", position=(0.0, 0.0, RADIUS + DROP))
        anvil = percuss.BodyMotion("anvil", position=(0.0, 0.0, -0.5))
        super().__init__([ball, anvil], [Inertia(STRIKER), Inertia(math.inf)], (0.0, 0.0, -GRAVITY))

    def contacts(self):
        gap = self._bodies[0].position[2] - RADIUS
        return [Contact(0, 1, (0.0, 0.0, 0.5 * gap), (0.0, 0.0, 1.0), gap, -GRAVITY)]


def bounce(tolerance):
    world = Bouncing()
    began = time.process_time()
    with SlowScale(["striker", Body("anvil", fixed=True)], world, client(), options=blow_options(tolerance)) as slow:
        run_world(world, slow, END, STEP, fixed=True)
    seconds = time.process_time() - began
    ball = world.motion(0)
    return np.array([(ball.position[2] - RADIUS + 0.5 * ball.velocity[2] ** 2 / GRAVITY) / height_left()]), seconds


def run(scene, tolerance):
    if scene == "bounce":
        return bounce(tolerance)
    asked = question(scene, tolerance)
    client().solve(asked)  # the bodies' modes, once
    repeats = 20
    began = time.process_time()
    for _ in range(repeats):
        reply = client().solve(asked)
    return answer(reply, scene), (time.process_time() - began) / repeats
