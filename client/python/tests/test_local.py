# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""percuss.Local beside the daemon that the environment names: the same answers, without it."""

import dataclasses
import os
import tempfile
import threading
import unittest
from pathlib import Path
from typing import Any

import percuss

CATALOGUE = Path(os.environ["PERCUSS_SOURCE"]) / "config" / "catalogue.yaml"
# the tests' daemon has no contact tables: nor has who answers like it
SETTINGS = Path(tempfile.mkdtemp()) / "percussd.yaml"
SETTINGS.write_text(f"catalogue: {CATALOGUE}\n")
# what differs from one asking to the next, and from one who answers to another
VOLATILE = ("client", "server", "sequence", "timing")


def plain(value: Any) -> Any:
    if dataclasses.is_dataclass(value):
        return {f.name: plain(getattr(value, f.name)) for f in dataclasses.fields(value) if f.name not in VOLATILE}
    if hasattr(value, "tobytes"):
        return value.tobytes()
    if isinstance(value, (tuple, list)):
        return [plain(one) for one in value]
    return repr(value)


def questions(bodies: dict[str, percuss.Body]) -> list[percuss.Request]:
    asked = []
    for body in ("al-rod", "al-rod-1", "al-beam", "steel-wall"):
        for speed in (0.1, 0.3, 3.0):
            asked.append(percuss.contact_pair(bodies["steel-sphere"], bodies[body], speed=speed))
            asked[-1].options.tolerance = 1e-5
    asked.append(percuss.contact_pair(bodies["steel-sphere"], bodies["al-rod"], speed=1.0))
    asked[-1].options.tolerance = 7.0  # which nobody allows
    return asked


class Local(unittest.TestCase):
    def test_materials(self) -> None:
        """What the catalogue states of materials and of their contacts."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "laws.yaml"
            path.write_text(
                "materials:\n"
                "  steel: {young: 210e9, poisson: 0.3, density: 7800, yield: 5e8, rate: {reference: 40, exponent: 5}}\n"
                "  foam: {young: 1e7, poisson: 0.3, density: 100, relaxation: [{share: 0.2, time: 1 ms}]}\n"
                "  gum: {young: 1e7, poisson: 0.49, density: 1000, loss_factor: 0.2, loss_frequency: 2 kHz}\n"
                "bodies: {ball: {shape: sphere, material: steel, radius: 0.01}, pad: {shape: half-space, material: foam},\n"
                "         mat: {shape: half-space, material: gum}}\n"
                "friction: [{between: [steel, steel], coefficient: 0.2, deviation: 0.05}]\n"
                "laws: {buffer: {between: [steel, foam], stiffness: 2e6, hysteresis: 0.36}}\n"
            )
            with percuss.Local(path) as local:
                bodies = local.bodies()
                self.assertEqual(bodies.catalogue_revision, local.servers()[0].catalogue_revision)
        foam, steel = bodies.pairs
        assert foam.law is not None
        self.assertEqual((foam.material_a, foam.material_b, foam.law.name, foam.law.kind), ("foam", "steel", "buffer", "hysteresis"))
        self.assertEqual((foam.law.stiffness, foam.law.exponent, foam.law.hysteresis), (2e6, 1.5, 0.36))
        self.assertEqual((steel.friction, steel.friction_deviation, steel.law), (0.2, 0.05, None))
        self.assertEqual(bodies["pad"].relaxation, (percuss.RelaxationTerm(0.2, 1e-3),))
        self.assertEqual((bodies["mat"].loss_factor, bodies["mat"].loss_frequency), (0.2, 2000.0))
        self.assertEqual((bodies["ball"].rate_reference, bodies["ball"].rate_exponent), (40.0, 5.0))
        percuss.contact_pair(bodies["ball"], bodies["pad"], 0.3)

    def test_same_answers(self) -> None:
        with percuss.connect(int(os.environ["PERCUSS_DOMAIN"]), timeout=10.0) as client, percuss.Local(
            settings=SETTINGS
        ) as local:
            bodies = local.bodies()
            self.assertEqual(plain(list(bodies.values())), plain(list(client.bodies().values())))
            asked = questions(bodies)
            for one in asked:
                self.assertEqual(plain(local.solve(one)), plain(client.solve(one)))
            self.assertEqual(plain(local.solve_batch(asked)), plain(client.solve_batch(asked)))

    def test_later(self) -> None:
        """Submitted questions are answered by whoever waits; states go on by their tokens."""
        with percuss.Local(CATALOGUE, id=b"\7" * 16) as local:
            self.assertEqual(local.id, b"\7" * 16)
            bodies = local.bodies()
            first = percuss.contact_pair(bodies["steel-sphere"], bodies["al-beam"], speed=0.3)
            sequence = local.submit(first)
            reply = local.wait(sequence).raise_for_status()
            first.bodies[1].state = reply.states_after[1].state
            first.bodies[1].elapsed = 1e-3
            again = local.solve(first).raise_for_status()
            self.assertNotEqual(reply.contacts[0].impulse, again.contacts[0].impulse)
            self.assertEqual(local.servers()[0].server, local.server)

    def test_losses(self) -> None:
        """What materials lose of themselves is said in replies and ensembles."""
        with tempfile.TemporaryDirectory() as folder:
            catalogue = Path(folder) / "catalogue.yaml"
            catalogue.write_text(
                "materials:\n"
                "  steel: {young: 210e9, poisson: 0.3, density: 7800}\n"
                "  nylon: {young: 3e9, poisson: 0.4, density: 1140, loss_factor: 0.06}\n"
                "  rubber: {young: 5e6, poisson: 0.49, density: 1100}\n"
                "bodies:\n"
                "  ball: {shape: sphere, material: steel, radius: 0.015}\n"
                "  wall: {shape: half-space, material: steel}\n"
                "  stop: {shape: half-space, material: nylon}\n"
                "  mat: {shape: half-space, material: rubber}\n"
            )
            with percuss.Local(catalogue) as local:
                bodies = local.bodies()
                said = {}
                for wall in ("wall", "stop", "mat"):
                    question = percuss.contact_pair(bodies["ball"], bodies[wall], speed=0.3)
                    question.options.contact_model = percuss.ContactModel.HERTZ
                    said[wall] = " ".join(local.solve(question).raise_for_status().warnings)
                self.assertNotIn("of itself", said["wall"] + said["mat"])
                self.assertIn("what stop loses of itself in the contact (loss_factor 0.06)", said["stop"])
                self.assertIn("as soft as that of mat", said["mat"])
                question = percuss.contact_pair(bodies["ball"], bodies["stop"], speed=0.3)
                lossy = local.solve(question).raise_for_status()
                self.assertEqual(lossy.model.contact_model, percuss.ContactModel.VISCOELASTIC)
                self.assertLess(lossy.contacts[0].restitution, 0.95)
                question.options.contact_model = percuss.ContactModel.HERTZ
                speed = percuss.Input("speed", percuss.Distribution.UNIFORM, 0.2, 0.4)
                report = percuss.ensemble(percuss.Ensemble(question, [speed], samples=50), local)
                self.assertTrue(any("of 50, first 0: contacts[0]: what stop loses" in one for one in report.warnings))

    def test_threads(self) -> None:
        """Several threads ask one client, and others theirs."""
        expected: list[float] = []
        with percuss.Local(CATALOGUE) as shared:
            bodies = shared.bodies()
            asked = questions(bodies)[:-1]
            expected = [shared.solve(one).contacts[0].impulse for one in asked]
            found: dict[int, list[float]] = {}

            def ask(number: int) -> None:
                own = percuss.Local(CATALOGUE) if number % 2 else shared
                found[number] = [own.solve(one).contacts[0].impulse for one in asked]
                if own is not shared:
                    own.close()

            threads = [threading.Thread(target=ask, args=(number,)) for number in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
        self.assertEqual(found, {number: expected for number in range(4)})

    def test_refusals(self) -> None:
        with self.assertRaisesRegex(percuss.InvalidArgument, "none.yaml"):
            percuss.Local("/none.yaml")
        with self.assertRaisesRegex(ValueError, "id"):
            percuss.Local(CATALOGUE, id=b"short")
        with self.assertRaisesRegex(percuss.InvalidArgument, "first_sequence"):
            percuss.Local(CATALOGUE, first_sequence=0)


if __name__ == "__main__":
    unittest.main()
