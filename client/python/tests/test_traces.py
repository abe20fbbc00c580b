# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""percuss.trace: of a daemon and in process, beside what the program writes."""

import dataclasses
import html
import json
import pickle
import unittest
from pathlib import Path
from typing import Any

import numpy as np

import percuss

from beside import DOMAIN, SETTINGS, Beside, program


class Beam(Beside):
    def question(self) -> percuss.Request:
        bodies = self.local.bodies()
        return percuss.contact_pair(bodies["steel-sphere"], bodies["al-beam"], 0.2)


class Traces(Beam):
    def test_as_the_program_writes_it(self) -> None:
        program("query", "--a", "steel-sphere", "--b", "al-beam", "--speed", "0.2", "--trace", "trace.csv")
        written = np.genfromtxt("trace.csv", delimiter=",", names=True)
        names = written.dtype.names or ()
        for client in (self.client, self.local):
            traced = percuss.trace(self.question(), client, timeout=60.0)
            (contact,) = traced.contacts
            self.assertEqual(traced.reply.contacts[0].impulse, client.solve(self.question()).contacts[0].impulse)
            for field in dataclasses.fields(contact):
                if field.name not in names:
                    self.assertEqual(getattr(contact, field.name).shape, (0,), field.name)
                    continue
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

    def test_page(self) -> None:
        """The page has what the program's has: request, reply, bodies, histories; the same but for who asked and when."""

        def data(page: str) -> Any:
            return json.loads(page.split('id="data">')[1].split("</script>")[0])

        program("query", "--a", "steel-sphere", "--b", "al-beam", "--speed", "0.2", "--html", "impact.html")
        written = Path("impact.html").read_text(encoding="utf-8")
        for client in (self.client, self.local):
            ours = percuss.trace(self.question(), client, timeout=60.0).to_html(client, title="</script>")
            self.assertEqual(ours.count("</script>"), written.count("</script>"))
            found, expected = data(ours), data(written)
            self.assertEqual(found["title"], "</script>")
            # 17 digits of the one, seven of the other
            for one in (found, expected):
                for name in ("client", "sequence", "server", "timing", "states_after"):
                    del one["reply"][name]
                one["trace"][0].pop("contact", None)
            for name in ("request", "bodies", "trace", "reply"):
                self.assertEqual(found[name], expected[name], name)
        # by the client that was asked; a notebook shows it in a frame, and of a copy elsewhere the tables
        traced = percuss.trace(self.question(), self.local)
        page = traced.to_html()
        frame = page._repr_html_()
        self.assertEqual(html.unescape(frame.split('srcdoc="')[1].split('"')[0]), page)
        self.assertTrue(traced._repr_html_().endswith(frame) and frame.startswith('<iframe sandbox="allow-scripts"'))
        copied = pickle.loads(pickle.dumps(traced))
        self.assertEqual([body is None for body in data(copied.to_html())["bodies"]], [True, True])
        with percuss.Local(settings=SETTINGS) as closed:
            left = percuss.trace(self.question(), closed)
        self.assertIn("histories", left._repr_html_())
        self.assertNotIn("iframe", left._repr_html_())
        refused = percuss.trace(percuss.Request(), self.local)
        self.assertNotIn("iframe", refused._repr_html_())
        with self.assertRaisesRegex(ValueError, "BAD_REQUEST"):
            refused.to_html(self.local)

    def test_friction(self) -> None:
        """The tangential force and the slip of a ball that comes down at 30 degrees: the second blow slides backward."""
        command = ("query", "--a", "steel-sphere", "--b", "al-beam", "--speed", "0.3", "--angle", "30", "--friction", "0.3")
        program(*command, "--trace", "friction.csv")
        written = np.genfromtxt("friction.csv", delimiter=",", names=True)
        question = self.question()
        question.bodies[0].velocity = 0.3 / 0.2 * np.cos(np.pi / 6.0) * np.asarray(question.bodies[0].velocity)
        # the beam's axis
        question.bodies[0].velocity = question.bodies[0].velocity + 0.15 * self.axis(question)
        question.contacts[0].friction = 0.3
        question.contacts[0].tangent = self.axis(question)
        for client in (self.client, self.local):
            traced = percuss.trace(question, client, timeout=60.0)
            contact, said = traced.contacts[0], traced.reply.raise_for_status().contacts[0]
            for name in written.dtype.names or ():
                if name == "contact":
                    continue
                scale = float(np.abs(written[name]).max())
                np.testing.assert_allclose(getattr(contact, name), written[name], rtol=1e-8, atol=1e-9 * scale, err_msg=name)
            force = contact.force_tangential_1
            shown = np.concatenate(([0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(contact.time))))
            first = shown[np.searchsorted(contact.time, 1e-3)]
            self.assertAlmostEqual(first / said.sub_impacts["impulse_tangential"][0][0], 1.0, delta=2e-3)
            self.assertAlmostEqual(shown[-1] / said.impulse_tangential[0], 1.0, delta=2e-3)
            self.assertTrue(first < -7e-3 and shown[-1] - first > 2e-3)
            size = np.hypot(force, contact.force_tangential_2)
            self.assertTrue((size <= 0.3 * contact.force * (1.0 + 1e-12)).all())
            self.assertAlmostEqual(contact.slip_1[0], 0.15, delta=1e-12)
        try:
            import pandas  # noqa: F401
        except ImportError:
            return
        self.assertEqual(list(traced.to_dataframe().columns)[-4:], list(written.dtype.names or ())[-4:])
        self.assertNotIn("slip_1", percuss.trace(self.question(), self.local).to_dataframe())

    def axis(self, question: percuss.Request) -> np.ndarray[Any, Any]:
        """The first tangent of the surface: the axis of the beam, in the world."""
        w, x, y, z = question.bodies[1].orientation
        return np.array([1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)])

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
