# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""percuss.Client beside a daemon with the shipped catalogue, in DDS domain PERCUSS_DOMAIN."""

import dataclasses
import json
import math
import os
import pickle
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np

import percuss
from percuss import _library

DOMAIN = int(os.environ["PERCUSS_DOMAIN"])
PROGRAM = Path(os.environ["PERCUSS_BUILD"]) / "bin" / "percuss"


class Beside(unittest.TestCase):
    """Tests with a connected client and the catalogue."""

    client: percuss.Client
    bodies: dict[str, percuss.Body]

    @classmethod
    def setUpClass(cls) -> None:
        cls.client = percuss.connect(DOMAIN, timeout=10.0)
        cls.bodies = cls.client.bodies()

    @classmethod
    def tearDownClass(cls) -> None:
        cls.client.close()

    def question(self, speed: float = 0.2, b: str = "al-beam", at: float = 0.5) -> percuss.Request:
        return percuss.contact_pair(self.bodies["steel-sphere"], self.bodies[b], speed, at_b=at)


def plain(value: Any) -> Any:
    """A reply as the objects of its JSON form: nan is None, octets are hexadecimal."""
    if dataclasses.is_dataclass(value):
        return {field.name: plain(getattr(value, field.name)) for field in dataclasses.fields(value)}
    if isinstance(value, (tuple, list)):
        return [plain(element) for element in value]
    if isinstance(value, np.ndarray) and value.dtype.names:
        return [{name: plain(element[name].tolist()) for name in value.dtype.names} for element in value]
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, bytes):
        return value.hex()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


class Solving(Beside):
    def test_same_as_the_program(self) -> None:
        """Every member that `percuss query --json` prints, to the last bit; names of choices aside."""
        question = self.question(0.276)
        question.options.conditioning = True
        reply = self.client.solve(question)
        request = {
            "bodies": [
                {name: plain(getattr(body, name)) for name in ("id", "position", "orientation", "velocity")}
                for body in question.bodies
            ],
            "contacts": [{"a": 0, "b": 1, "point": [0, 0, 0.01], "normal": [0, 0, 1]}],
            "options": {"conditioning": True},
        }
        command = [str(PROGRAM), "query", "--request", "-", "--json", "--domain", str(DOMAIN)]
        asked = subprocess.run(command, input=json.dumps(request), capture_output=True, text=True, check=True)
        expected, ours = json.loads(asked.stdout), plain(reply)
        for choice in ("status", "end_reason", "delassus_source"):
            self.assertEqual(getattr(reply, choice).name.lower(), expected.pop(choice).lower())
            del ours[choice]
        for choice in ("contact_model", "compliance", "method"):
            self.assertEqual(getattr(reply.model, choice).name.lower().replace("_", "-"), expected["model"].pop(choice))
            del ours["model"][choice]
        for one, its in zip(ours["contacts"], expected["contacts"]):
            for mine, other in zip([one, *one["sub_impacts"]], [its, *its["sub_impacts"]]):
                state = percuss.FrictionState(mine.pop("friction_state"))
                self.assertEqual(state.text, other.pop("friction_state"))
        for differing in ("client", "sequence", "timing"):
            del expected[differing], ours[differing]
        self.assertEqual(ours, expected)

    def test_numbers_fit_together(self) -> None:
        reply = self.client.solve(self.question()).raise_for_status()
        contact = reply.contacts[0]
        self.assertEqual(contact.sub_impact_count, len(contact.sub_impacts))
        self.assertAlmostEqual(contact.sub_impacts["impulse"].sum(), contact.impulse, delta=1e-15)
        np.testing.assert_allclose(contact.impulse_vector, [0, 0, contact.impulse], rtol=1e-15)
        # restitution by its definition, and from the velocities after the impact
        self.assertAlmostEqual(contact.restitution, contact.impulse / contact.impulse_compression - 1, delta=1e-15)
        after = reply.velocity_after
        self.assertAlmostEqual((after[0].velocity - after[1].velocity)[2] / 0.2, contact.restitution, delta=1e-12)
        self.assertEqual(reply.client, self.client.id)

    def test_delassus_of_the_caller(self) -> None:
        # a body held elsewhere is heavier to move: the impulse follows W in the dynamics
        question = self.question()
        question.delassus = [[9.0]]
        reply = self.client.solve(question).raise_for_status()
        self.assertEqual(reply.delassus_source, percuss.DelassusSource.CLIENT)
        self.assertEqual(reply.contacts[0].inverse_effective_mass, 9.0)
        self.assertAlmostEqual(reply.contacts[0].impulse_compression, 0.2 / 9.0, delta=1e-16)
        self.assertTrue(any("delassus" in warning for warning in reply.warnings), reply.warnings)

    def test_delassus_with_tangents(self) -> None:
        question = self.question()
        sphere, beam = question.bodies
        sphere.velocity = [0.1, 0.05, sphere.velocity[2]]
        question.contacts[0].friction = 0.2
        question.contacts[0].tangent = [1.0, 0.0, 0.0]
        own = self.client.solve(question).raise_for_status().contacts[0]
        # the shipped ball on the middle of the shipped beam: 7/2 of the ball's 1/m; the beam's shifts, and its turn
        # about its axis by a force along y or about y by one along x
        m, w = 7800.0 * 4.0 / 3.0 * np.pi * 0.015**3, own.inverse_effective_mass
        m_beam = 2700.0 * np.pi * 0.010**2
        self.assertAlmostEqual(w, 1.0 / m + 1.0 / m_beam, delta=1e-9 * w)
        along = 3.5 / m + 1.0 / m_beam + 0.010**2 / (m_beam * (0.010**2 / 4.0 + 1.0 / 12.0))
        across = 3.5 / m + 1.0 / m_beam + 2.0 / m_beam
        matrix = np.diag([w, along, across])
        for shape in (matrix, matrix.reshape(-1), matrix.tolist(), matrix.reshape(-1).tolist()):
            question.delassus = shape
            reply = self.client.solve(question).raise_for_status()
            self.assertEqual(reply.delassus_source, percuss.DelassusSource.CLIENT)
            self.assertFalse(any("delassus" in warning for warning in reply.warnings), reply.warnings)
            np.testing.assert_allclose(
                reply.contacts[0].impulse_tangential, own.impulse_tangential, rtol=0, atol=1e-9 * own.impulse
            )
            self.assertAlmostEqual(reply.contacts[0].impulse, own.impulse, delta=1e-9 * own.impulse)
        question.delassus = np.diag([w, 1.05 * along, across])
        reply = self.client.solve(question).raise_for_status()
        self.assertTrue(any("delassus: differs" in warning for warning in reply.warnings), reply.warnings)
        # friction needs the tangents' rows
        question.delassus = [[w]]
        reply = self.client.solve(question)
        self.assertEqual(reply.status, percuss.Status.BAD_REQUEST)
        self.assertIn("delassus: 1 x 1 numbers: where a contact has friction it must be 3 x 3", reply.message)
        question.options.friction = percuss.Friction.NONE
        self.client.solve(question).raise_for_status()

    def test_state_token(self) -> None:
        question = self.question()
        first = self.client.solve(question).raise_for_status()
        question.bodies[1].state = first.states_after[1].state
        question.bodies[1].elapsed = 0.01
        ringing = self.client.solve(question).raise_for_status()
        self.assertNotEqual(ringing.contacts[0].impulse, first.contacts[0].impulse)
        self.assertNotEqual(ringing.time_shift, 0.0)
        # immutable: the same again
        self.assertEqual(self.client.solve(question).contacts[0].impulse, ringing.contacts[0].impulse)
        question.bodies[1].state = "0" * 32
        self.assertEqual(self.client.solve(question).status, percuss.Status.UNKNOWN_STATE)

    def test_batch(self) -> None:
        speeds = np.linspace(0.1, 0.4, 50)
        questions = [self.question(speed) for speed in speeds]
        questions[7].bodies[0].id = "nobody"
        questions[9].delassus = np.array([[10.0]])
        replies = self.client.solve_batch(questions, timeout=60.0)
        self.assertEqual([reply.status for reply in replies].index(percuss.Status.UNKNOWN_BODY), 7)
        for question, reply in zip(questions, replies):
            alone = self.client.solve(question)
            self.assertEqual(reply.message, alone.message)
            for one, other in zip(reply.contacts, alone.contacts):
                self.assertEqual(one.impulse, other.impulse)
                np.testing.assert_array_equal(one.sub_impacts, other.sub_impacts[:16])

    def test_outstanding(self) -> None:
        sequences = [self.client.submit(self.question(speed)) for speed in (0.1, 0.2, 0.3)]
        self.client.cancel(sequences[0])
        second = self.client.wait(sequences[1])
        self.assertEqual(second.sequence, sequences[1])
        self.assertEqual(self.client.wait().sequence, sequences[2])
        with self.assertRaises(percuss.UnknownSequence):
            self.client.poll(sequences[0])

    def test_repeated_sequence(self) -> None:
        question = self.question()
        question.sequence = 1_000_000
        first, second = self.client.solve(question), self.client.solve(question)
        # the stored reply comes again, states included
        self.assertEqual(plain(dataclasses.replace(first, timing=second.timing)), plain(second))

    def test_threads(self) -> None:
        impulses: dict[float, float] = {}

        def ask(speed: float) -> None:
            impulses[speed] = self.client.solve(self.question(speed), timeout=60.0).contacts[0].impulse

        threads = [threading.Thread(target=ask, args=(0.1 + 0.01 * i,)) for i in range(16)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(60)
        for speed, impulse in impulses.items():
            self.assertEqual(impulse, self.client.solve(self.question(speed)).contacts[0].impulse)
        self.assertEqual(len(impulses), 16)


class Announced(Beside):
    def test_bodies(self) -> None:
        beam, wall, rod = (self.bodies[name] for name in ("al-beam", "steel-wall", "al-rod"))
        np.testing.assert_allclose(beam.half_extents, [0.5, 0.01, 0.01])
        self.assertAlmostEqual(beam.mass, math.pi * 0.01**2 * 2700, delta=1e-12)
        self.assertEqual(beam.supports, (percuss.Support.FREE, percuss.Support.FREE))
        self.assertEqual((wall.shape, wall.mass, rod.tip_radius), ("half-space", math.inf, math.inf))
        self.assertEqual(list(self.bodies), sorted(self.bodies))

    def test_bodies_by_name(self) -> None:
        bodies = self.client.bodies()
        by_object = percuss.contact_pair(bodies["steel-sphere"], bodies["al-beam"], 0.3)
        for known in ({"client": self.client}, {"bodies": bodies}, {"bodies": dict(bodies)}):
            with self.subTest(known):
                by_name = percuss.contact_pair("steel-sphere", "al-beam", speed="300mm/s", **known)
                self.assertEqual(repr(by_name), repr(by_object))
        mixed = percuss.contact_pair(bodies["steel-sphere"], "al-beam", 0.3, client=self.client)
        self.assertEqual(repr(mixed), repr(by_object))

    def test_names_that_are_not_there(self) -> None:
        bodies = self.client.bodies()
        listed = "which has al-beam, .*; did you mean 'al-beam'\\?$"
        for call in (
            lambda: bodies["al-bean"],
            lambda: percuss.contact_pair("steel-sphere", "al-bean", 0.3, client=self.client),
            lambda: percuss.contact_pair("steel-sphere", "al-bean", 0.3, bodies=bodies),
            lambda: percuss.sweep("steel-sphere", "al-bean", "300mm/s", self.client),
        ):
            for kind in (KeyError, ValueError, percuss.UnknownName):
                with self.assertRaisesRegex(kind, f"^(body|b): 'al-bean': not in the catalogue, {listed}"):
                    call()
        with self.assertRaisesRegex(KeyError, "^specimen: 'rig-1': not kept by the server, which has none$"):
            self.client.specimens()["rig-1"]
        with self.assertRaisesRegex(ValueError, "^a: 'steel-sphere', b: 'al-beam': a name needs `client` or `bodies`"):
            percuss.contact_pair("steel-sphere", "al-beam", 0.3)
        self.assertEqual(bodies.get("al-bean", None), None)
        self.assertEqual(pickle.loads(pickle.dumps(bodies)).keys(), bodies.keys())

    def test_places(self) -> None:
        """As the command line has them."""
        bodies = self.client.bodies()
        beam = dataclasses.replace(bodies["al-beam"], supports=(percuss.Support.CLAMPED, percuss.Support.FREE))
        meshed = dataclasses.replace(
            bodies["al-beam"], shape="mesh", sites=(percuss.Site("nose", np.zeros(3), np.array([0.0, 0.0, 1.0])),)
        )

        def hit(at: Any, body: percuss.Body = beam, **more: Any) -> Any:
            pair = percuss.contact_pair(bodies["steel-sphere"], body, 0.3, at=at, **more)
            return round(pair.contacts[0].point[0] - pair.bodies[1].position[0], 12)

        for at, x in ((0.25, -0.25), ("0.25", -0.25), ("25%", -0.25), ("250mm", -0.25), ("0.25 m", -0.25),
                      ("1m", 0.5), ("middle", 0.0), ("tip", 0.5), ("root", -0.5)):
            with self.subTest(at):
                self.assertEqual(hit(at), x)
                pair = percuss.contact_pair(bodies["steel-sphere"], beam, 0.3, at_b=at)
                self.assertEqual(round(pair.contacts[0].point[0], 12), x)
        self.assertEqual(hit("nose", meshed), 0.0)
        # a flight that leans, with a spin
        pair = percuss.contact_pair(bodies["steel-sphere"], beam, 0.3, angle=np.pi / 6, spin=2.0, friction=0.25)
        np.testing.assert_allclose(pair.bodies[0].velocity, [0.15, 0.0, -0.3 * np.sqrt(0.75)], atol=1e-15)
        np.testing.assert_allclose(pair.bodies[0].angular_velocity, [0.0, -2.0, 0.0], atol=1e-15)
        self.assertEqual((pair.contacts[0].friction, pair.contacts[0].tangent.tolist()), (0.25, [1.0, 0.0, 0.0]))
        # the beam may be the body that moves
        pair = percuss.contact_pair(beam, bodies["steel-wall"], 0.3, at="tip")
        self.assertEqual(round(abs(pair.bodies[0].position[0]), 12), 0.5)
        for at, body, text in (
            ("2m", beam, "at: '2m': a fraction .* 0..1, .* up to 1 m, middle, tip or root is allowed"),
            ("101%", beam, "at: '101%': a fraction"),
            ("-0.1", beam, "at: '-0.1': a fraction"),
            ("tipp", beam, "at: 'tipp': a fraction"),
            ("tip", bodies["al-beam"], "at: 'tip': the ends of al-beam are free and free"),
            ("noze", meshed, "at: 'noze': not a site of al-beam, which has nose; did you mean 'nose'"),
        ):
            with self.subTest(at), self.assertRaisesRegex(ValueError, text):
                hit(at, body)
        with self.assertRaisesRegex(ValueError, "at_a: 'tip': steel-sphere .sphere. has no sites"):
            percuss.contact_pair(bodies["steel-sphere"], beam, 0.3, at_a="tip")
        with self.assertWarnsRegex(UserWarning, "at has no effect: neither body"):
            percuss.contact_pair(bodies["steel-sphere"], bodies["al-rod"], 0.3, at=0.3)

    def test_numbers_with_units(self) -> None:
        """By the table of the command line."""
        options = percuss.Options(contact_model="closed-form", method="CVODE")
        self.assertIs(options.contact_model, percuss.ContactModel.CLOSED_FORM)
        self.assertIs(options.method, percuss.Method.CVODE)
        with self.assertRaisesRegex(ValueError, "ContactModel: 'steel': one of AUTO, HERTZ, "):
            options.contact_model = "steel"
        options = percuss.Options(horizon="30ms", deadline="2 s")
        self.assertEqual((options.horizon, options.deadline), (0.03, 2.0))
        self.assertEqual(percuss.Contact(0, 1, gap="8 um").gap, 8e-6)
        self.assertEqual(repr(dataclasses.replace(percuss.Options(), horizon="1min").horizon), "60.0")
        with self.assertRaisesRegex(percuss.InvalidArgument, "horizon: '3 m': a time is needed, .*; m is no time"):
            options.horizon = "3 m"
        bodies = self.client.bodies()
        for speed, text in (("3kg", "kg is no speed"), ("fast", "a speed is needed"), ("-1 m/s", "speed: -1")):
            with self.subTest(speed), self.assertRaisesRegex(ValueError, text):
                percuss.contact_pair(bodies["steel-sphere"], bodies["al-rod"], speed)
        (curve,) = percuss.sweep("steel-sphere", "al-rod", ["100mm/s", 0.2], self.client).curves
        self.assertEqual(curve.speed.tolist(), [0.1, 0.2])
        scene = percuss.contact_pair("steel-sphere", "al-rod", 0.2, client=self.client)
        kind = percuss.Distribution.UNIFORM
        plain, typed = (
            percuss.ensemble(percuss.Ensemble(scene, [percuss.Input("speed", kind, *ends)], 20), self.client)
            for ends in ((0.1, 0.4), ("100mm/s", "400 mm/s"))
        )
        self.assertEqual(plain.restitution.mean, typed.restitution.mean)
        with self.assertRaisesRegex(ValueError, r"inputs\[0\].first: '70 mm': a stress is needed"):
            percuss.ensemble(percuss.Ensemble(scene, [percuss.Input("young", kind, "70 mm", body="al-rod")]), self.client)

    def test_server(self) -> None:
        self.assertGreater(self.client.ping(5.0), 0.0)
        (server,) = self.client.servers()
        reply = self.client.solve(self.question())
        self.assertEqual((server.server, server.state), (reply.server, "ready"))
        self.assertEqual((server.bodies, server.catalogue_revision), (len(self.bodies), reply.catalogue_revision))

    def test_no_identity_no_warning(self) -> None:
        self.assertIsNone(self.client.warning)

    def test_no_specimens(self) -> None:
        self.assertEqual(self.client.specimens(), {})
        with self.assertRaisesRegex(percuss.InvalidArgument, "bar-1"):
            self.client.clear_specimen("bar-1")


class Mistakes(Beside):
    def test_refusal(self) -> None:
        question = self.question()
        question.bodies[0].id = "nobody"
        reply = self.client.solve(question)
        self.assertEqual((reply.status, reply.contacts), (percuss.Status.UNKNOWN_BODY, ()))
        with self.assertRaisesRegex(percuss.Refused, r"UNKNOWN_BODY: bodies\[0\].id: 'nobody'"):
            reply.raise_for_status()

    def test_fields(self) -> None:
        """What cannot be sent is named with its value and what is allowed."""
        question = self.question()
        with self.assertRaisesRegex(ValueError, r"normal: shape \(2,\): 3 numbers"):
            question.contacts[0].normal = [0, 1]
        cases: list[tuple[Any, str, Any, str]] = [
            (question.bodies[1], "id", "x" * 64, r"bodies\[1\].id: .*63 bytes"),
            (question.bodies[1], "state", "a\0b", r"bodies\[1\].state: .*63 bytes"),
            (question.contacts[0], "a", -1, r"contacts\[0\].a: -1: 0..63"),
            (question, "sequence", 2**64, "sequence: "),
            (question, "delassus", np.eye(2), r"delassus: shape \(2, 2\): \(1, 1\), .*, or \(3, 3\)"),
            (question, "delassus", np.ones(4), r"delassus: shape \(4,\): \(1, 1\)"),
            (question, "bodies", [question.bodies[0]] * 65, "bodies: 65 are too many; up to 64"),
            (question, "contacts", [question.contacts[0]] * 65, "contacts: 65 are too many; up to 64"),
        ]
        for target, name, value, message in cases:
            good = getattr(target, name)
            setattr(target, name, value)
            with self.subTest(name), self.assertRaisesRegex(ValueError, message):
                self.client.submit(question)
            setattr(target, name, good)
        self.client.solve(question).raise_for_status()
        question.contacts = [question.contacts[0]] * 22
        question.delassus = np.eye(66)
        with self.assertRaisesRegex(ValueError, r"delassus: shape \(66, 66\): .* up to 21 contacts are allowed, not 22"):
            self.client.submit(question)

    def test_calls(self) -> None:
        with self.assertRaisesRegex(percuss.InvalidArgument, "timeout: -1"):
            self.client.solve(self.question(), timeout=-1)
        with self.assertRaisesRegex(percuss.InvalidArgument, "count: 0: 1..256"):
            self.client.solve_batch([])
        with self.assertRaisesRegex(percuss.InvalidArgument, "speed: -1"):
            self.question(-1.0)
        slow = self.question()
        slow.options.method = percuss.Method.CVODE  # some 0.4 s
        with self.assertRaises(percuss.AnswerTimeout):
            self.client.solve(slow, timeout=0.0)
        ids = ({"id": b"short"}, {"id": bytes(16)})
        for config in ({"domain": 231}, {"window": 2**32 + 1}, {"first_sequence": 0}, *ids):
            with self.subTest(config), self.assertRaises(ValueError):
                percuss.Client(**config)

    def test_window(self) -> None:
        with percuss.Client(DOMAIN, window=1) as client:
            client.connect(10.0)
            client.submit(self.question())
            with self.assertRaises(percuss.WindowFull):
                client.submit(self.question())

    def test_not_connected(self) -> None:
        with percuss.Client(DOMAIN, id=bytes(range(16))) as client:
            self.assertEqual(client.id, bytes(range(16)))
            with self.assertRaises(percuss.NoServer):
                client.solve(self.question())
        client.close()
        with self.assertRaisesRegex(ValueError, "closed"):
            client.ping()

    def test_named_server(self) -> None:
        (server,) = self.client.servers()
        self.assertEqual(self.client.server, server.server)
        for name in (server.server.hex(), server.server.hex()[:6].upper()):
            with percuss.connect(DOMAIN, 10.0, server=name) as client:
                self.assertEqual(client.server, server.server)
        other = "0" if server.server[0] >= 16 else "f"
        with self.assertRaisesRegex(percuss.NoServer, f"id that begins with {other}; there is percussd"):
            percuss.connect(DOMAIN, 0.5, server=other)
        for name in ("xyz", "0" * 33):
            with self.subTest(name), self.assertRaises(ValueError):
                percuss.Client(DOMAIN, server=name)
        self.assertIsNone(percuss.Client(DOMAIN).server)

    def test_server_by_its_load_and_of_the_environment(self) -> None:
        (server,) = self.client.servers()
        with percuss.connect(DOMAIN, 10.0, server="least-loaded") as client:
            self.assertEqual(client.server, server.server)
        other = "0" if server.server[0] >= 16 else "f"
        with mock.patch.dict(os.environ, PERCUSS_SERVER=other):
            with self.assertRaisesRegex(percuss.NoServer, f"id that begins with {other}"):
                percuss.connect(DOMAIN, 0.5)
            with percuss.connect(DOMAIN, 10.0, server="") as client:
                self.assertEqual(client.server, server.server)

    def test_partition(self) -> None:
        nobody = f"no percussd in partition nuts of DDS domain {DOMAIN}; one is in no partition"
        with self.assertRaisesRegex(percuss.NoServer, nobody):
            percuss.connect(DOMAIN, 1.0, partition="nuts")
        with self.assertRaisesRegex(percuss.InvalidArgument, r"partition: 'n\*': 1 to 63 letters"):
            percuss.Client(DOMAIN, partition="n*")
        with mock.patch.dict(os.environ, PERCUSS_PARTITION="nuts"):
            with self.assertRaisesRegex(percuss.NoServer, nobody):
                percuss.connect(DOMAIN, 1.0)
            with percuss.connect(DOMAIN, 10.0, partition="") as client:
                self.assertEqual(client.server, self.client.server)

    def test_domain_of_the_environment(self) -> None:
        # that of this test's daemon
        with percuss.connect(timeout=10.0) as client:
            self.assertEqual(client.server, self.client.server)
        for text in ("231", "-1", "one"):
            with self.subTest(text), mock.patch.dict(os.environ, PERCUSS_DOMAIN=text):
                with self.assertRaisesRegex(percuss.InvalidArgument, f"PERCUSS_DOMAIN: '{text}' is not"):
                    percuss.Client()
                percuss.Client(DOMAIN).close()

    def test_no_server(self) -> None:
        # no story's domain: tests/service/support/lib.sh keeps below 100
        with self.assertRaises(ConnectionError):
            percuss.connect(domain=229, timeout=0.2)

    def test_library_is_looked_for(self) -> None:
        environment = {**os.environ, "PERCUSS_LIBRARY": "/nowhere/libpercuss.so.1"}
        command = [sys.executable, "-c", "import percuss"]
        failed = subprocess.run(command, env=environment, capture_output=True, text=True)
        self.assertIn("set PERCUSS_LIBRARY", failed.stderr)
        self.assertIn("/nowhere/libpercuss.so.1", failed.stderr)
        # the build tree beside the source, without any help
        environment = {**os.environ, "PYTHONPATH": os.environ["PERCUSS_SOURCE"] + "/client/python"}
        del environment["PERCUSS_LIBRARY"]
        subprocess.run(command, env=environment, check=True)

    def test_build_comes_before_others(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            for build in ("build-address", "build", "build-thread"):
                library = Path(folder, build, "client", "libx.so.1")
                library.parent.mkdir(parents=True)
                library.touch()
            here = Path(folder, "client", "python", "percuss", "_library.py")
            with mock.patch.dict(os.environ), mock.patch.object(_library, "__file__", str(here)):
                del os.environ["PERCUSS_LIBRARY"]
                found = _library._candidates("libx.so.1")
        builds = [Path(one).parts[-3] for one in found[1:]]
        self.assertEqual((found[0], builds), ("libx.so.1", ["build", "build-address", "build-thread"]))


if __name__ == "__main__":
    unittest.main()
