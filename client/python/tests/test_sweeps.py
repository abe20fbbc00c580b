# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""percuss.sweep beside the program's, and results as tables."""

import csv
import io
import json
import sys
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
import pandas

import percuss

from beside import DOMAIN, Beside, program

SPEEDS = np.linspace(0.1, 0.4, 7)
TEXTS, COUNTS = ("b", "contact_model", "status"), ("sub_impacts", "significant")


def written(text: str) -> Any:
    """What the program wrote, to the last digit: pandas does not read them all in every version."""
    rows = list(csv.DictReader(io.StringIO(text)))
    kinds = {name: str if name in TEXTS else int if name in COUNTS else float for name in rows[0]}
    return pandas.DataFrame({name: [kind(row[name]) for row in rows] for name, kind in kinds.items()})


def data(page: str) -> Any:
    """What a page shows."""
    return json.loads(page.split('id="data">')[1].split("</script>")[0])


class Sweeps(Beside):
    def test_as_the_program(self) -> None:
        """Every number of every curve, to the last bit."""
        command = ("sweep", "--a", "steel-sphere", "--b", "al-rod-1", "--b", "al-beam", "--speed", "0.1:0.4:7", "--csv")
        expected = written(program(*command, "--contact-model", "hertz", "--contact-model", "closed-form"))
        bodies = self.client.bodies()
        models: list[percuss.ContactModel | str] = [percuss.ContactModel.HERTZ, "closed-form"]
        for client in (self.client, self.local):
            for b in (["al-rod-1", "al-beam"], [bodies["al-rod-1"], bodies["al-beam"]]):
                # the speeds as the program divides them
                speeds = [0.1 + (0.4 - 0.1) * i / 6 for i in range(7)]
                sweep = percuss.sweep("steel-sphere", b, speeds, client, contact_model=models, timeout=60.0)
                pandas.testing.assert_frame_equal(sweep.to_dataframe(), expected, check_exact=True)

    def test_page(self) -> None:
        """The page has the program's columns, to the last bit, and the request of the first point."""
        flags = ("--a", "steel-sphere", "--b", "al-rod-1", "--b", "al-beam", "--speed", "0.1:0.4:2")
        program("sweep", *flags, "--html", "sweep.html")
        expected = data(Path("sweep.html").read_text(encoding="utf-8"))
        swept = percuss.sweep("steel-sphere", ["al-rod-1", "al-beam"], [0.1, 0.4], self.local)
        found = data(swept.to_html())
        for name in ("kind", "a", "title", "by_angle", "logarithmic", "measured", "request", "version", "curves"):
            if name == "curves":
                for one in expected[name]:
                    del one["angle"]  # the page draws it over the angle alone
            self.assertEqual(found[name], expected[name], name)
        self.assertEqual(len(found["warnings"]), len(expected["warnings"]))
        self.assertRegex(found["warnings"][0], r"^2 of 4 points, first on al-rod-1 at 0\.1 m/s: .*closed form")
        self.assertIn("<iframe", swept.to_html()._repr_html_())
        self.assertTrue(data(swept.to_html("A </script>", logarithmic=True))["logarithmic"])

    def test_more_than_a_window(self) -> None:
        """One of two outstanding questions is the caller's own; it is answered besides."""
        with percuss.Client(DOMAIN, window=2) as narrow:
            narrow.connect(10.0)
            bodies = narrow.bodies()
            own = narrow.submit(percuss.contact_pair(bodies["steel-sphere"], bodies["al-rod"], 0.2))
            (curve,) = percuss.sweep("steel-sphere", "al-rod", SPEEDS, narrow, timeout=60.0).curves
            self.assertEqual(curve.speed.tolist(), SPEEDS.tolist())
            self.assertEqual([reply.status for reply in curve.replies], [percuss.Status.OK] * len(SPEEDS))
            narrow.wait(own, 60.0)

    def test_options_and_sites(self) -> None:
        options = percuss.Options(tolerance=1e-5)
        for at in (0.3, 0.5):
            (curve,) = percuss.sweep("steel-sphere", "al-beam", 0.2, self.local, options=options, at_b=at).curves
            bodies = self.local.bodies()
            question = percuss.contact_pair(bodies["steel-sphere"], bodies["al-beam"], 0.2, at_b=at)
            question.options = options
            self.assertEqual(curve.restitution.tolist(), [self.local.solve(question).contacts[0].restitution])
        self.assertEqual(options, percuss.Options(tolerance=1e-5))

    def test_mistakes(self) -> None:
        with self.assertRaisesRegex(ValueError, "b: 'al-bean': not in the catalogue, which has al-beam, "):
            percuss.sweep("steel-sphere", "al-bean", SPEEDS, self.local)
        for speeds in ([0.1, -0.1], [np.nan], [[0.1]]):
            with self.subTest(speeds), self.assertRaisesRegex(ValueError, "speeds: .* a list of numbers > 0"):
                percuss.sweep("steel-sphere", "al-rod", speeds, self.local)
        with self.assertRaisesRegex(ValueError, "ContactModel: 'soft'"):
            percuss.sweep("steel-sphere", "al-rod", SPEEDS, self.local, contact_model="soft")

    def test_refused_points(self) -> None:
        options = percuss.Options(tolerance=7.0)
        sweep = percuss.sweep("steel-sphere", "al-rod", [0.1, 0.2], self.client, options=options)
        self.assertTrue(np.isnan(sweep.curves[0].restitution).all())
        self.assertEqual(sweep.to_dataframe()["status"].tolist(), ["BAD_REQUEST"] * 2)
        with self.assertRaisesRegex(percuss.Refused, "tolerance"):
            sweep.raise_for_status()

    def test_failing_leaves_nothing_behind(self) -> None:
        """What was still outstanding is no longer."""
        with self.assertRaises(percuss.AnswerTimeout):
            options = percuss.Options(method=percuss.Method.CVODE, tolerance=1e-7)
            percuss.sweep("steel-sphere", "al-beam", SPEEDS, self.client, options=options, timeout=0.0)
        with self.assertRaises(percuss.UnknownSequence):
            self.client.wait(0, 0.0)


PAIRS = ("impulse_tangential", "slip_before", "slip_after")


class Tables(Beside):
    def question(self, speed: float = 0.2) -> percuss.Request:
        bodies = self.local.bodies()
        return percuss.contact_pair(bodies["steel-sphere"], bodies["al-beam"], speed)

    def test_replies(self) -> None:
        reply = self.local.solve(self.question())
        subs = reply.to_dataframe()
        self.assertEqual(subs["impulse"].tolist(), reply.contacts[0].sub_impacts["impulse"].tolist())
        names = [name for name in percuss.SUB_IMPACT.names or () if name not in PAIRS]
        self.assertEqual(set(subs.columns), {"contact", *names, *(f"{name}_{k}" for name in PAIRS for k in (1, 2))})
        self.assertEqual(subs["slip_before_2"].tolist(), reply.contacts[0].sub_impacts["slip_before"][:, 1].tolist())
        refused = self.question()
        refused.bodies[0].id = "nobody"
        replies = self.local.solve_batch([self.question(0.1), refused, self.question(0.2)])
        table = percuss.to_dataframe(replies)
        self.assertEqual(table["reply"].tolist(), [0, 1, 2])
        self.assertEqual(table["status"].tolist(), ["OK", "UNKNOWN_BODY", "OK"])
        self.assertEqual(table["restitution"][2], reply.contacts[0].restitution)
        self.assertTrue(np.isnan(table["restitution"][1]))
        self.assertEqual(len(replies[1].to_dataframe()), 0)

    def test_traces(self) -> None:
        traced = percuss.trace(self.question(), self.local)
        table = traced.to_dataframe()
        self.assertEqual(table["force"].tolist(), traced.contacts[0].force.tolist())
        self.assertEqual(set(table["contact"]), {0})

    def test_ensembles(self) -> None:
        """As the program writes the samples."""
        inputs = ("--speed", "uniform:0.1:0.4", "--input", "young@al-beam=normal:70e9:1e9", "--samples", "40")
        program("ensemble", "--a", "steel-sphere", "--b", "al-beam", *inputs, "--csv", "e.csv")
        expected = written(Path("e.csv").read_text())
        question = percuss.Ensemble(
            self.question(1.0),
            [
                percuss.Input("speed", percuss.Distribution.UNIFORM, 0.1, 0.4),
                percuss.Input("young", percuss.Distribution.NORMAL, 70e9, 1e9, body="al-beam"),
            ],
            samples=40,
            list_samples=True,
        )
        reply = percuss.ensemble(question, self.client)
        pandas.testing.assert_frame_equal(reply.to_dataframe(), expected, check_exact=True)
        self.assertIn("young@al-beam", reply._repr_html_())
        # the page has the program's: the reply, and its samples
        program("ensemble", "--a", "steel-sphere", "--b", "al-beam", *inputs, "--html", "e.html")
        shown, page = data(Path("e.html").read_text(encoding="utf-8")), data(reply.to_html())
        self.assertEqual((page["columns"], page["samples"]), (shown["columns"], shown["samples"]))
        for name in page["reply"]:
            if name != "timing":
                self.assertEqual(page["reply"][name], shown["reply"][name], name)
        nobody = percuss.Ensemble(percuss.Request(), question.inputs)
        with self.assertRaisesRegex(ValueError, "an ensemble without an answer"):
            percuss.ensemble(nobody, self.local).to_html()
        question.list_samples = False
        with self.assertRaisesRegex(ValueError, "list_samples: False"):
            percuss.ensemble(question, self.local).to_dataframe()

    def test_in_a_notebook(self) -> None:
        """Tables with what is in them; words of others are text."""
        reply = self.local.solve(self.question())
        text = reply._repr_html_()
        self.assertIn(f"{reply.contacts[0].restitution:.6g}", text)
        self.assertEqual(text.count("<table"), 2)
        refused = self.question()
        refused.bodies[0].id = "<b>"
        self.assertIn("&lt;b&gt;", self.local.solve(refused)._repr_html_())
        self.assertNotIn("<b>", self.local.solve(refused)._repr_html_())
        many = percuss.sweep("steel-sphere", "al-rod", np.linspace(0.1, 0.4, 60), self.local)
        self.assertIn("36 more", many._repr_html_())
        self.assertIn("histories", percuss.trace(self.question(), self.local)._repr_html_())

    def test_without_pandas(self) -> None:
        with mock.patch.dict(sys.modules, pandas=None):
            with self.assertRaisesRegex(ImportError, r"pip install 'percuss\[pandas\]'"):
                percuss.trace(self.question(), self.local).to_dataframe()


if __name__ == "__main__":
    unittest.main()
