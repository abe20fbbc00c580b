# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of results: what is drawn is what was found, and no legend covers it."""

import os
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

os.environ["MPLBACKEND"] = "Agg"

import numpy as np

import percuss
from percuss import measured

SOURCE = Path(os.environ["PERCUSS_SOURCE"])
CATALOGUE = SOURCE / "config" / "catalogue.yaml"
SETTINGS = Path(tempfile.mkdtemp()) / "percussd.yaml"
SETTINGS.write_text(f"catalogue: {CATALOGUE}\n")


class Plots(unittest.TestCase):
    local: percuss.Local

    @classmethod
    def setUpClass(cls) -> None:
        cls.local = percuss.Local(settings=SETTINGS)

    @classmethod
    def tearDownClass(cls) -> None:
        cls.local.close()

    def question(self) -> percuss.Request:
        bodies = self.local.bodies()
        return percuss.contact_pair(bodies["steel-sphere"], bodies["al-beam"], 0.2)

    def rendered(self, figure: Any) -> list[Any]:
        """The axes, after the picture was written; the legend lies beside all of them."""
        for name, begin in (("picture.png", b"\x89PNG"), ("picture.svg", b"<?xml")):
            figure.savefig(name)
            octets = Path(name).read_bytes()
            self.assertTrue(octets.startswith(begin) and len(octets) > 8000, name)
        for legend in figure.legends:
            there = legend.get_window_extent()
            self.assertFalse([axes for axes in figure.axes if there.overlaps(axes.get_window_extent())])
        return list(figure.axes)

    def drawn(self, axes: Any, values: Any) -> None:
        """One of its lines has these values."""
        lines = [line.get_ydata() for line in axes.get_lines()]
        self.assertTrue(any(np.array_equal(line, values) for line in lines), axes.get_ylabel())

    def test_trace(self) -> None:
        traced = percuss.trace(self.question(), self.local)
        figure = traced.plot()
        force, velocity, depth = self.rendered(figure)
        self.drawn(force, traced.contacts[0].force)
        self.drawn(velocity, traced.contacts[0].velocity_b)
        self.drawn(depth, 1e6 * traced.contacts[0].indentation)
        self.assertEqual(len(figure.legends), 1)
        refused = self.question()
        refused.bodies[0].id = "nobody"
        with self.assertRaisesRegex(ValueError, "UNKNOWN_BODY: .*no histories"):
            percuss.trace(refused, self.local).plot()

    def test_sweep(self) -> None:
        sweep = percuss.sweep("steel-sphere", ["al-rod", "al-beam"], [0.1, 0.2, 0.3], self.local)
        figure = sweep.plot()
        above, below = self.rendered(figure)
        for curve in sweep.curves:
            self.drawn(above, curve.restitution)
            self.drawn(below, curve.sub_impacts)
        self.assertEqual([text.get_text() for text in figure.legends[0].get_texts()], ["al-rod", "al-beam"])

    def test_ensemble(self) -> None:
        inputs = [percuss.Input("speed", percuss.Distribution.UNIFORM, 0.1, 0.4)]
        for listed in (False, True):
            reply = percuss.ensemble(percuss.Ensemble(self.question(), inputs, 80, list_samples=listed), self.local)
            axes = self.rendered(reply.plot())
            self.assertEqual(len(axes), 3 if listed else 2)
            self.drawn(axes[1], reply.restitution.curve_shares)
        assert reply.rows is not None
        self.drawn(axes[2], reply.rows[:, 1])
        self.assertEqual(axes[2].get_xlabel(), "speed")

    def test_comparison(self) -> None:
        file = SOURCE / "client" / "examples" / "measured" / "beam.csv"
        compared = measured.compare(file, "steel-sphere", "al-beam", self.local)
        above, middle, _ = self.rendered(compared.plot())
        self.drawn(above, compared.measured.restitution)
        self.drawn(above, compared.simulated.restitution)
        self.drawn(middle, compared.simulated.sub_impacts)
        # one impact has no deviation
        one = measured.compare({"speed": [0.2], "restitution": [0.7]}, "steel-sphere", "al-beam", self.local)
        self.rendered(one.plot())

    def test_into_a_figure(self) -> None:
        import matplotlib.pyplot

        before = len(matplotlib.pyplot.get_fignums())
        sweep = percuss.sweep("steel-sphere", "al-rod", [0.1, 0.2], self.local)
        own = matplotlib.pyplot.figure()
        self.assertIs(sweep.plot(own), own)
        sweep.plot()
        self.assertEqual(len(matplotlib.pyplot.get_fignums()), before + 1)
        matplotlib.pyplot.close(own)

    def test_without_matplotlib(self) -> None:
        with mock.patch.dict(sys.modules, {"matplotlib": None, "matplotlib.pyplot": None}):
            with self.assertRaisesRegex(ImportError, r"pip install 'percuss\[plot\]'"):
                percuss.trace(self.question(), self.local).plot()


if __name__ == "__main__":
    unittest.main()
