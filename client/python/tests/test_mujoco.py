# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""examples/mujoco_pendulum.py and mujoco_spin.py: MuJoCo asks the daemon in DDS domain PERCUSS_DOMAIN at every impact."""

import contextlib
import io
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import percuss
from percuss.slowscale import Application, Contact, Report, SlowScale
from percuss.world import run

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "examples"))
import mujoco
from mujoco_pendulum import HINGED_BAR, Pair, Simulation, hinged_bar, simulate
from mujoco_spin import BALL
from mujoco_spin import main as print_throws
from mujoco_spin import throw

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


BOTH = [Pair("first", "bar"), Pair("second", "bar")]


def set_speeds(simulation: Simulation, columns: list[int], speed: float) -> Simulation:
    simulation.data.qvel[columns] = speed
    mujoco.mj_forward(simulation.model, simulation.data)
    return simulation


def kinetic_energy(simulation: Simulation) -> float:
    momentum = np.zeros(simulation.model.nv)
    mujoco.mj_mulM(simulation.model, simulation.data, momentum, simulation.data.qvel)
    return 0.5 * float(momentum @ simulation.data.qvel)


class Mujoco(unittest.TestCase):
    client: percuss.Client

    @classmethod
    def setUpClass(cls) -> None:
        cls.client = percuss.connect(int(os.environ["PERCUSS_DOMAIN"]), timeout=10.0)

    @classmethod
    def tearDownClass(cls) -> None:
        cls.client.close()

    def check_applied(self, report: Report, simulation: Simulation) -> None:
        """The reply used MuJoCo's matrix, and all of its impulses were applied."""
        reply = report.reply
        assert reply
        self.assertEqual(reply.delassus_source, percuss.DelassusSource.CLIENT)
        self.assertTrue(reply.complete)
        self.assertEqual(report.message, "")
        for ours, theirs in zip(report.restitution, reply.contacts):
            self.assertAlmostEqual(ours, theirs.restitution, delta=1e-9)
        # while the list was played, and since, the bar has turned: 1e-3 of the approach, as docs/integrating.md says
        after = report.gap_rate + report.delassus @ report.impulse
        np.testing.assert_allclose(simulation.gap_rates(simulation.contacts()), after, atol=2e-4)

    def test_forced_restitution(self) -> None:
        """Instants of impact with e = 0.4 throughout, found independently with another MuJoCo (2.2, C);
        bisection ends at 1e-15 s, and the listed digits end at 1e-9 s."""
        simulation, reports = hinged_bar(), list[Report]()
        with SlowScale(simulation.ids, simulation, None, restitution=0.4, report=reports.append) as slow:
            run(simulation, slow, 2.0, 1e-3)
        times = [report.time for report in reports]
        np.testing.assert_allclose(times, [0.354870653, 1.064243028, 1.773693210], atol=1e-8)
        for report in reports:
            self.assertAlmostEqual(report.delassus.item(), 10.186404, delta=1e-6)
            self.assertAlmostEqual(report.restitution.item(), 0.4, delta=1e-9)

    def test_hinged_bar(self) -> None:
        """client/examples/mujoco, which is in C and on MuJoCo 2.2, has these of the same catalogue and tolerance; it
        keeps six digits. What the second and third bring hangs on positions, tokens and their instants."""
        examples = Path(os.environ["PERCUSS_SOURCE"]) / "client" / "examples"
        with percuss.Local(examples / "mujoco" / "catalogue.yaml") as client:
            simulation = hinged_bar()
            simulation.ids = ["sphere", "bar"]
            reports = simulate(client, simulation, 2.0, tolerance=1e-4)
        found = [report.restitution.item() for report in reports]
        np.testing.assert_allclose(found, [0.716040, 0.365005, 1.861994], atol=3e-6)

    def test_the_daemon_is_asked_once_an_impact(self) -> None:
        simulation, reports = hinged_bar(), list[Report]()
        with SlowScale(simulation.ids, simulation, self.client, report=reports.append) as slow:
            run(simulation, slow, 2.0, 1e-3)
            self.assertEqual((slow.counts.impacts, slow.counts.requests, slow.counts.declared), (3, 3, 0))
        # near e of the free bar at 0.2 m/s, 0.739: W is 0.6 % smaller
        self.assertAlmostEqual(reports[0].restitution.item(), 0.72, delta=0.03)
        # the bar goes on ringing: there is more to have than the sphere brings
        second = reports[1]
        assert second.reply
        self.assertGreater(second.reply.energy.available, 0.5 * second.gap_rate.item() ** 2 / 10.186404)

    def test_bar_pinned_at_its_end(self) -> None:
        """Equality constraints are soft and not in M; projected, W is 3 % smaller than without."""
        simulation = Simulation(PINNED_BAR, [Pair("sphere", "bar")])
        simulation.data.qpos[7] = 0.02
        set_speeds(simulation, [6], -0.4)
        (report,) = simulate(self.client, simulation, 0.1)
        self.assertAlmostEqual(report.delassus.item(), 9.891843, delta=1e-6)

    def test_two_spheres(self) -> None:
        """Two contacts at one instant are one question."""
        simulation = set_speeds(Simulation(two_spheres(0.110976), BOTH), [6, 12], 0.2)
        (report,) = simulate(self.client, simulation, 0.02)
        listed = [[11.4627, 3.08821], [3.08821, 13.0538]]  # six digits
        np.testing.assert_allclose(report.delassus, listed, rtol=5e-6)
        self.check_applied(report, simulation)
        # impulses are opposite and equal: what came, 0.2 m/s of each sphere, is there
        momentum = simulation.data.qvel.reshape(3, 6)[:, :3].T @ [0.84823, 0.110976, 0.110976]
        np.testing.assert_allclose(momentum, [2 * 0.2 * 0.110976, 0.0, 0.0], atol=1e-12)
        self.assertTrue((simulation.gap_rates(simulation.contacts()) > 0).all())

    def test_whose_inertia(self) -> None:
        """With the catalogue's masses, MuJoCo and the service find the same W of free bodies by
        themselves; the inertia of the bar in the model has five digits."""
        mass = self.client.bodies()["steel-sphere"].mass
        simulation = set_speeds(Simulation(two_spheres(mass), BOTH), [6, 12], 0.2)
        simulation.step(1e-3)
        contacts = simulation.contacts()
        question = percuss.Request([simulation.motion(i) for i in range(3)], list(contacts))
        reply = self.client.solve(question).raise_for_status()
        self.assertEqual(reply.delassus_source, percuss.DelassusSource.SERVICE)
        ours = [contact.inverse_effective_mass for contact in reply.contacts]
        np.testing.assert_allclose(ours, np.diag(simulation.delassus(contacts)), rtol=1e-5)

    def test_spinning_ball(self) -> None:
        """Friction acts on both bodies of MuJoCo: what the ball gets the beam loses, its spin is that of the impulse's
        lever, and the energy is that of the service's books."""
        for spin in (-30.0, 0.0, 30.0):
            after, simulation = throw(self.client, spin)
            ball = self.client.bodies()["steel-sphere"]
            before = 0.4 * np.array([0.0, 0.5, -np.sqrt(0.75)])
            masses = simulation.model.body_mass[[2, 1]]
            gained = masses[0] * (after.velocity - before)
            np.testing.assert_allclose(masses[1] * simulation.motion(1).velocity, -gained, atol=1e-15)
            # the normal turns with the beam while the list is played, by some mrad
            np.testing.assert_allclose(gained, after.answer.impulse_vector, atol=3e-3 * after.answer.impulse)
            turned = ball.inertia[0] * (after.spin - spin)
            self.assertAlmostEqual(turned / (BALL * gained[1]), 1.0, delta=0.02)
            books = after.energy
            came = 0.5 * ball.mass * 0.4**2 + 0.5 * ball.inertia[0] * spin**2
            lost = (came - kinetic_energy(simulation)) / (books.available - books.rigid_after)
            self.assertAlmostEqual(lost, 1.0, delta=0.03)
            self.assertGreater(books.friction, 1e-4)
        # spin that rolls forward leaves flat, spin against it steep
        angles = [throw(self.client, spin)[0].angle for spin in (-60.0, 0.0, 60.0)]
        self.assertTrue(angles[0] > angles[1] > angles[2])

    def test_spinning_ball_prints(self) -> None:
        """As a user starts it; the rows are in the order of the spins."""
        text = io.StringIO()
        catalogue = Path(os.environ["PERCUSS_SOURCE"]) / "config" / "catalogue.yaml"
        with mock.patch.object(sys, "argv", ["", str(catalogue)]), contextlib.redirect_stdout(text):
            print_throws()
        rows = [line.split() for line in text.getvalue().splitlines()[1:]]
        self.assertEqual([float(row[0]) for row in rows], [-60.0, -30.0, 0.0, 30.0, 60.0])
        self.assertEqual({row[6] for row in rows}, {"slid", "reversed"})

    def test_friction_of_a_hinged_bar(self) -> None:
        """A free ball that slides along the hinged bar as it hits: MuJoCo's matrix of normal and tangents is that of
        the hinge in closed form, and so are the velocities after the impulse."""
        mu, mass, moment = 0.1, 0.110976, 9.98784e-6
        hinge = 0.0000424 + 0.84823 * 0.5**2
        simulation = Simulation(
            HINGED_BAR.replace("0 0 -9.81", "0 0 0").replace(
                'pos="-0.025 0 0"><joint type="hinge" axis="0 1 0" pos="0 0 0.5"/>', 'pos="-0.0252 0 -0.001"><freejoint/>'
            ),
            [Pair("sphere", "bar", friction=mu)],
        )
        simulation.data.qvel[[1, 3]] = 0.2, 1.0
        mujoco.mj_forward(simulation.model, simulation.data)
        # directions -x, y, -z; the bar's point turns about the hinge, 0.5 m above and 0.01 m beside it
        matrix = np.diag([1 / mass, *2 * [1 / mass + 0.015**2 / moment]])
        turning = np.array([0.5, 0.0, -0.01])
        matrix += np.outer(turning, turning) / hinge
        touch = Contact(0, 1, (-0.01, 0.0, 0.0), (-1.0, 0.0, 0.0), tangent=(0.0, 1.0, 0.0))
        simulation.data.qpos[[1, 3]] = -0.025, 0.0
        mujoco.mj_forward(simulation.model, simulation.data)
        np.testing.assert_allclose(simulation.oblique([touch]), matrix, rtol=1e-9, atol=1e-9)
        simulation.data.qpos[[1, 3]] = -0.0252, -0.001
        mujoco.mj_forward(simulation.model, simulation.data)
        reports = list[Report]()
        total = Application.TOTAL
        with SlowScale(simulation.ids, simulation, self.client, application=total, report=reports.append) as slow:
            run(simulation, slow, 0.002, 1e-3)
        (report,) = reports
        assert report.reply
        (contact,) = report.reply.contacts
        self.assertEqual(report.reply.delassus_source, percuss.DelassusSource.CLIENT)
        self.assertAlmostEqual(report.delassus.item(), matrix[0, 0], delta=1e-6)
        # 1 um of its way along the bar's roundness turns the normal by some 0.05 mrad
        expected = contact.impulse * np.array([-1.0, 0.0, -mu])
        np.testing.assert_allclose(contact.impulse_vector, expected, atol=1e-4 * contact.impulse)
        self.assertEqual(contact.friction_state.name, "SLID")
        speeds = simulation.data.qvel
        np.testing.assert_allclose(speeds[1:4], np.array([0.2, 0.0, 1.0]) + contact.impulse_vector / mass, atol=1e-9)
        self.assertAlmostEqual(speeds[0] * hinge / contact.impulse, -0.5 + 0.01 * mu, delta=1e-4)

    def test_exported_contact(self) -> None:
        """MuJoCo alone, with the contact that `percuss export` prints, by short steps and by its own: the restitution
        is the one that stands there, at every speed."""
        masses = [self.client.bodies()[name].mass for name in ("steel-sphere", "al-rod-1")]
        for step in ("1us", "1ms"):
            words = "export --local --for mujoco --a steel-sphere --b al-rod-1 --speed 0.1:0.4:3 --step".split()
            command = [os.environ["PERCUSS_BUILD"] + "/bin/percuss", *words, step]
            told = json.loads(subprocess.run([*command, "--json"], check=True, capture_output=True).stdout)
            contact = subprocess.run(command, check=True, capture_output=True, text=True).stdout
            spheres = "".join(
                f"""<body pos="0 0 {z}"><freejoint/>
                <geom name="{name}" type="sphere" size="0.5" mass="{mass}"/></body>"""
                for name, mass, z in (("A", masses[0], 1.0), ("B", masses[1], 0.0))
            )
            text = f'<mujoco><option gravity="0 0 0"/>{contact}<worldbody>{spheres}</worldbody></mujoco>'
            model = mujoco.MjModel.from_xml_string(text)
            self.assertEqual(model.opt.timestep, {"1us": 1e-6, "1ms": 1e-3}[step])
            for point in told["points"]:
                data = mujoco.MjData(model)
                data.qvel[2] = -point["speed"]
                for _ in range(2 * round(told["duration"] / model.opt.timestep)):
                    mujoco.mj_step(model, data)
                self.assertEqual(data.ncon, 0)
                # its steps are of first order: 50 in a contact leave some 0.007, 200 some 0.002
                found = (data.qvel[8] - data.qvel[2]) / -point["speed"]
                self.assertAlmostEqual(found, point["model"], delta=0.01 if step == "1ms" else 0.002)
                self.assertLessEqual(abs(point["model"] - point["restitution"]), told["worst"])


if __name__ == "__main__":
    unittest.main()
