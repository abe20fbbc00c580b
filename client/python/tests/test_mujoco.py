# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""examples/mujoco_pendulum.py: MuJoCo asks the daemon in DDS domain PERCUSS_DOMAIN at every impact."""

import os
import sys
import unittest
from collections.abc import Callable
from pathlib import Path

import numpy as np

import percuss

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "examples"))
from mujoco_pendulum import HINGED_BAR, Impact, Pair, Simulation, hinged_bar

# the bar is free but for its end, which two soft connects hold: five equations of rank, six rows
PINNED_BAR = (
    HINGED_BAR.replace('<joint type="hinge" axis="0 1 0" pos="0 0 0.5"/>', "<freejoint/>", 1)
    .replace("0 0 -9.81", "0 0 0")
    .replace(
        "</worldbody>",
        """</worldbody><equality><connect body1="bar" anchor="0 -0.5 0"/>
        <connect solref="0.002 1" solimp="0.999 0.9999 0.001" body1="bar" anchor="0 -0.5 0.1"/></equality>""",
    )
)

SPHERE = """<body name="{0}" pos="-0.0252 {1} 0"><freejoint/>
  <inertial pos="0 0 0" mass="{2}" diaginertia="9.98784e-6 9.98784e-6 9.98784e-6"/>
  <geom name="{0}" type="sphere" size="0.015"/></body>"""


def two_spheres(mass: float) -> str:
    """A free bar and two free spheres, each 0.2 mm away from it."""
    start, rest = HINGED_BAR.replace("0 0 -9.81", "0 0 0").split('<body name="bar">')
    bar = '<body name="bar"><freejoint/>' + rest.split("/>", 1)[1].split('<body name="sphere"')[0]
    spheres = SPHERE.format("first", 0.3, mass) + SPHERE.format("second", 0.45, mass)
    return start + bar + spheres + "</worldbody></mujoco>"


def unanswered(request: percuss.Request) -> percuss.Reply:
    raise percuss.NoServer(percuss.Result.NO_SERVER, "nobody there")


class Counting:
    """Passes requests on and counts them."""

    def __init__(self, solve: Callable[[percuss.Request], percuss.Reply]) -> None:
        self.solve = solve
        self.count = 0

    def __call__(self, request: percuss.Request) -> percuss.Reply:
        self.count += 1
        return self.solve(request)


class Mujoco(unittest.TestCase):
    client: percuss.Client

    @classmethod
    def setUpClass(cls) -> None:
        cls.client = percuss.connect(int(os.environ["PERCUSS_DOMAIN"]), timeout=10.0)

    @classmethod
    def tearDownClass(cls) -> None:
        cls.client.close()

    def check_applied(self, impact: Impact) -> None:
        """The gap rates before and after, as MuJoCo has them, agree with the reply."""
        reply = impact.reply
        assert reply
        self.assertEqual(reply.delassus_source, percuss.DelassusSource.CLIENT)
        self.assertTrue(reply.complete)
        jump = np.asarray(impact.request.delassus) @ [contact.impulse for contact in reply.contacts]
        np.testing.assert_allclose(impact.gap_rate_after - impact.gap_rate, jump, atol=1e-12)
        if len(reply.contacts) == 1:
            applied = -impact.gap_rate_after[0] / impact.gap_rate[0]
            self.assertAlmostEqual(applied, reply.contacts[0].restitution, delta=1e-9)

    def test_forced_restitution(self) -> None:
        """Instants of impact with e = 0.4 throughout, found independently with another MuJoCo (2.2, C);
        bisection ends at 1e-15 s, and the listed digits end at 1e-9 s."""
        simulation = hinged_bar(unanswered)
        simulation.fallback = 0.4
        simulation.run(2.0)
        times = [impact.time for impact in simulation.impacts]
        np.testing.assert_allclose(times, [0.354870653, 1.064243028, 1.773693210], atol=1e-8)
        for impact in simulation.impacts:
            self.assertAlmostEqual(np.asarray(impact.request.delassus).item(), 10.186404, delta=1e-6)
            self.assertAlmostEqual(-impact.gap_rate_after[0] / impact.gap_rate[0], 0.4, delta=1e-9)

    def test_no_answer_is_an_error(self) -> None:
        """unless a restitution to fall back to was given; the velocities are then still those before."""
        simulation = hinged_bar(unanswered)
        with self.assertRaises(percuss.NoServer):
            simulation.run(2.0)
        self.assertEqual(simulation.impacts, [])
        self.assertAlmostEqual(simulation.data.time, 0.354870653, delta=1e-8)

    def test_hinged_bar(self) -> None:
        answer = Counting(self.client.solve)
        simulation = hinged_bar(answer)
        simulation.run(2.0)
        self.assertEqual(len(simulation.impacts), 3)
        self.assertEqual(answer.count, 3)
        for impact in simulation.impacts:
            self.check_applied(impact)
        first, second = simulation.impacts[:2]
        # near e of the free bar at 0.2 m/s, 0.739: W is 0.6 % smaller, the spheres differ by 0.6 %
        assert first.reply and second.reply
        self.assertAlmostEqual(first.reply.contacts[0].restitution, 0.72, delta=0.03)
        # by MuJoCo's own steps in C, each sub-impact at its own time: 0.7153, 0.3749, 1.8612 (examples/mujoco);
        # on a ringing bar the pendulum's curved path, moved in straight lines, makes some 1e-2
        restitutions = [impact.reply.contacts[0].restitution for impact in simulation.impacts if impact.reply]
        np.testing.assert_allclose(restitutions, [0.7153, 0.3749, 1.8612], rtol=2e-2)
        # the bar goes on ringing
        self.assertEqual(second.request.bodies[1].state, first.reply.states_after[1].state)
        # the token is that of the end of the window
        elapsed = second.time - first.time - first.reply.window
        self.assertAlmostEqual(second.request.bodies[1].elapsed, elapsed, delta=1e-12)
        self.assertGreater(second.reply.energy.available, 0.5 * second.gap_rate[0] ** 2 / 10.186404)

    def test_bar_pinned_at_its_end(self) -> None:
        """Equality constraints are soft and not in M; projected, W is 3 % smaller than without."""
        simulation = Simulation(PINNED_BAR, [Pair("sphere", "bar")], self.client.solve)
        simulation.data.qpos[7], simulation.data.qvel[6] = 0.02, -0.4
        simulation.run(0.1)
        (impact,) = simulation.impacts
        self.assertAlmostEqual(np.asarray(impact.request.delassus).item(), 9.891843, delta=1e-6)
        self.check_applied(impact)

    def test_two_spheres(self) -> None:
        """Two contacts at one instant are one question."""
        answer = Counting(self.client.solve)
        simulation = Simulation(two_spheres(0.110976), [Pair("first", "bar"), Pair("second", "bar")], answer)
        simulation.data.qvel[[6, 12]] = 0.2
        simulation.run(0.01)
        (impact,) = simulation.impacts
        self.assertEqual(answer.count, 1)
        listed = [[11.4627, 3.08821], [3.08821, 13.0538]]  # six digits
        np.testing.assert_allclose(np.asarray(impact.request.delassus), listed, rtol=5e-6)
        self.check_applied(impact)
        self.assertTrue((impact.gap_rate_after > 0).all())

    def test_whose_inertia(self) -> None:
        """With the catalogue's masses, MuJoCo and the service find the same W of free bodies by
        themselves; the inertia of the bar in the model has five digits."""
        mass = self.client.bodies()["steel-sphere"].mass
        simulation = Simulation(two_spheres(mass), [Pair("first", "bar"), Pair("second", "bar")], self.client.solve)
        simulation.data.qvel[[6, 12]] = 0.2
        simulation.run(0.01)
        question = simulation.impacts[0].request
        theirs = np.diag(np.asarray(question.delassus))
        question.delassus = None
        reply = self.client.solve(question).raise_for_status()
        self.assertEqual(reply.delassus_source, percuss.DelassusSource.SERVICE)
        ours = [contact.inverse_effective_mass for contact in reply.contacts]
        np.testing.assert_allclose(ours, theirs, rtol=1e-5)


if __name__ == "__main__":
    unittest.main()
