# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""percuss.trace: of a daemon and in process, beside what the program writes."""

import dataclasses
import unittest

import numpy as np

import percuss

from beside import DOMAIN, Beside, program


class Beam(Beside):
    def question(self) -> percuss.Request:
        bodies = self.local.bodies()
        return percuss.contact_pair(bodies["steel-sphere"], bodies["al-beam"], 0.2)


class Traces(Beam):
    def test_as_the_program_writes_it(self) -> None:
        program("query", "--a", "steel-sphere", "--b", "al-beam", "--speed", "0.2", "--trace", "trace.csv")
        written = np.genfromtxt("trace.csv", delimiter=",", names=True)
        for client in (self.client, self.local):
            traced = percuss.trace(self.question(), client, timeout=60.0)
            (contact,) = traced.contacts
            self.assertEqual(traced.reply.contacts[0].impulse, client.solve(self.question()).contacts[0].impulse)
            for field in dataclasses.fields(contact):
                ours = getattr(contact, field.name)
                self.assertEqual((ours.shape, ours.dtype), (written.shape, np.dtype(float)), field.name)
                # the program writes nine digits
                np.testing.assert_allclose(ours, written[field.name], rtol=1e-8, atol=0.0, err_msg=field.name)

    def test_physics(self) -> None:
        """The force's integral is the impulse, and the bodies' motion is that of the reply."""
        traced = percuss.trace(self.question(), self.local)
        contact, said = traced.contacts[0], traced.reply.raise_for_status().contacts[0]
        self.assertGreater(np.diff(contact.time).min(), 0.0)
        impulse = float((0.5 * (contact.force[1:] + contact.force[:-1]) * np.diff(contact.time)).sum())
        self.assertAlmostEqual(impulse / said.impulse, 1.0, delta=1e-3)
        self.assertAlmostEqual(contact.force.max() / said.sub_impacts["peak_force"].max(), 1.0, delta=1e-3)
        self.assertAlmostEqual(contact.gap_rate[0], -0.2, delta=1e-12)

    def test_refusals(self) -> None:
        question = self.question()
        question.bodies[0].id = "nobody"
        for client in (self.client, self.local):
            traced = percuss.trace(question, client)
            self.assertEqual((traced.reply.status, traced.contacts), (percuss.Status.UNKNOWN_BODY, ()))
        with self.assertRaisesRegex(percuss.InvalidArgument, "timeout: -1"):
            percuss.trace(self.question(), self.client, timeout=-1.0)

    def test_own_delassus(self) -> None:
        question = self.question()
        question.delassus = [[9.0]]
        (contact,) = percuss.trace(question, self.local).contacts
        self.assertTrue(np.isnan(contact.velocity_a).all() and np.isfinite(contact.gap_rate).all())


class Names(Beam):
    def test_ids_are_text(self) -> None:
        reply = self.client.solve(self.question())
        (server,) = self.client.servers()
        self.assertEqual(str(reply.server), server.server.hex())
        self.assertEqual(f"{reply.client}, {reply.server!r}", f"{self.client.id.hex()}, Id('{server.server.hex()}')")
        self.assertEqual(percuss.Id(str(reply.server)), reply.server)
        # where an id is taken, its text does as well
        with percuss.connect(DOMAIN, 10.0, id="0A" * 16, server=reply.server) as other:
            self.assertEqual((other.id, str(other.id)), (b"\x0a" * 16, "0a" * 16))
            self.assertEqual(other.server, reply.server)
        for wrong in ("0a", "zz" * 16, b"short"):
            with self.subTest(wrong), self.assertRaisesRegex(ValueError, "16 octets, or 32 hexadecimal digits"):
                percuss.Id(wrong)

    def test_choices_print_their_names(self) -> None:
        status = self.client.solve(self.question()).status
        self.assertEqual((str(status), repr(status), f"{status:>4} {status:d}"), ("OK", "Status.OK", "  OK 0"))
        self.assertEqual(str(percuss.Status(4711)), "UNKNOWN_4711")
        for name in ("closed-form", "CLOSED_FORM"):
            self.assertIs(percuss.ContactModel.of(name), percuss.ContactModel.CLOSED_FORM)
        with self.assertRaisesRegex(ValueError, "ContactModel: 'soft': one of AUTO, HERTZ, .* is allowed"):
            percuss.ContactModel.of("soft")


if __name__ == "__main__":
    unittest.main()
