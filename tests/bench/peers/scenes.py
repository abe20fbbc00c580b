# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The impacts of peers.py: their numbers, the formulae that all programs are given, and the answers they are compared with."""

import functools
import json
import math
import os
import subprocess
from pathlib import Path

import numpy as np
import percuss
import plastic

STEEL, ALUMINIUM = (210e9, 0.30, 7800.0), (70e9, 0.33, 2700.0)
RADIUS, HALF, LENGTH = 0.015, 0.010, 1.0
STRIKER = 4.0 / 3.0 * math.pi * RADIUS**3 * STEEL[2]
BAR = math.pi * HALF**2 * LENGTH * ALUMINIUM[2]
ROW = 10
SPEED = {"rod": 0.3, "beam": 0.2, "balls": 1.0, "row": 1.0}
SCENES = (*SPEED, "bounce")
DROP, GRAVITY, END = 0.51, 9.81, 10.0  # of the ball that bounces: m, m/s^2, s; no blow is within 10 ms of the end
STRENGTH = 1e9  # Pa, yield stress of what it bounces on
BOUNCES = (0.15, 3.2)  # m/s: its speeds
ONE_E = "one restitution at all speeds, as MuJoCo's"
GAP = 1e-9  # m, where a program takes no two bodies that touch already


def hertz(a, b, curvature):
    """Stiffness of two round surfaces, N/m^1.5; of crossed ones by their mean curvature only where it is told."""
    modulus = 1.0 / ((1.0 - a[1] ** 2) / a[0] + (1.0 - b[1] ** 2) / b[0])
    return 4.0 / 3.0 * modulus / math.sqrt(curvature)


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


@functools.cache
def client():
    return percuss.Local(Path(__file__).with_name("catalogue.yaml"))


def partner(scene):
    return {"balls": "ball", "bounce": "anvil"}.get(scene, scene)


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
        asked = percuss.contact_pair(bodies["striker"], bodies[partner(scene)], speed=SPEED[scene])
    asked.options.tolerance = tolerance
    return asked


def answer(reply, scene):
    """e; of the row the speeds of all balls."""
    if scene != "row":
        return np.array([reply.contacts[0].restitution])
    return np.array([body.velocity[2] for body in reply.velocity_after]) / SPEED[scene]


def blow_options(tolerance):
    """Of a blow of the ball that bounces: a law that others can write, and each time a new place."""
    return percuss.Options(tolerance=tolerance, contact_model=percuss.ContactModel.CLOSED_FORM, dents=percuss.Dents.IGNORE)


@functools.cache
def anvil():
    """The contact of the ball that bounces."""
    return plastic.Contact(hertz(STEEL, STEEL, 1.0 / RADIUS), 0.5 * STEEL[0] / (1.0 - STEEL[1] ** 2), STEEL[1], STRENGTH, RADIUS)


@functools.cache
def height_left():
    """Of the ball that bounces, m, at the end: parabolas between blows, in which its weight acts too, from dents to the next."""
    bodies = client().bodies()
    speed = math.sqrt(2.0 * GRAVITY * DROP)
    now = speed / GRAVITY
    while now < END:
        blow = percuss.contact_pair(bodies["striker"], bodies["anvil"], speed=speed)
        blow.options = blow_options(1e-8)
        blow.contacts[0].gap_acceleration = -GRAVITY
        blow.delassus = [[1.0 / STRIKER]]  # what it bounces on does not move, as a block of 7.8 t would: by 1.4e-5
        contact = client().solve(blow).contacts[0]
        # e is that of the impulse, against which the weight has acted
        up = contact.restitution * speed - GRAVITY * contact.end_time
        speed = math.sqrt(up**2 - 2.0 * GRAVITY * anvil().dent(contact.sub_impacts[0]["max_indentation"]))
        now += contact.end_time + (up + speed) / GRAVITY
    return 0.5 * speed**2 / GRAVITY


@functools.cache
def reference(scene):
    """The answer, and the time that it takes, s; of the ball that bounces all answers are heights over the true one."""
    if scene == "bounce":
        return np.ones(1), END
    reply = client().solve(question(scene, 1e-8))
    return answer(reply, scene), reply.window


def exported(engine, scene, *more):
    """What percuss export says for an engine over 0.5 to 1.5 times the speed: its numbers, and the text that the engine reads."""
    program = Path(os.environ["PERCUSS_LIBRARY"]).parents[1] / "bin" / "percuss"
    command = [program, "export", "--for", engine, "--local", "--catalogue", Path(__file__).with_name("catalogue.yaml")]
    command += ["--a", "striker", "--b", partner(scene), *more]
    if scene == "bounce":
        command += ["--speed", "{}:{}".format(*BOUNCES), "--contact-model", "closed-form"]
    else:
        command += ["--speed", f"{0.5 * SPEED[scene]}:{1.5 * SPEED[scene]}:3"]
    told = json.loads(subprocess.run([*command, "--json"], check=True, capture_output=True).stdout)
    return told, subprocess.run(command, check=True, capture_output=True, text=True).stdout


def restitution(scene, striker):
    """e of two bodies by the striker's speed after."""
    other = BAR if scene in ("rod", "beam") else STRIKER
    return np.array([STRIKER * (SPEED[scene] - striker) * (1.0 / STRIKER + 1.0 / other) / SPEED[scene] - 1.0])
