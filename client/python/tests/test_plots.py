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
CANTILEVER = """
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7800}
bodies:
  ball: {shape: sphere, material: steel, radius: 0.006}
  cantilever: {shape: beam, material: steel, section: {width: 0.02, height: 0.004}, length: 0.2, ends: [clamped, free]}
"""


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
        self.nothing_collides(figure)
        for legend in figure.legends:
            there = legend.get_window_extent()
            self.assertFalse([axes for axes in figure.axes if there.overlaps(axes.get_window_extent())])
        return list(figure.axes)

    def nothing_collides(self, figure: Any) -> None:
        """No two texts lie over each other or beyond the picture."""
        figure.draw_without_rendering()  # the last file had another resolution
        texts = [text for legend in figure.legends for text in legend.get_texts()]
        for axes in figure.axes:
            texts += [axes.title, axes._left_title, axes._right_title, axes.xaxis.label, axes.yaxis.label, *axes.texts]
            for axis in (axes.xaxis, axes.yaxis):
                low, high = sorted(axis.get_view_interval())
                places, labels = axis.get_majorticklocs(), axis.get_majorticklabels()
                texts += [label for place, label in zip(places, labels) if low <= place <= high]
        shown = [text for text in texts if text.get_visible() and text.get_text()]
        boxes = [text.get_window_extent() for text in shown]
        self.assertGreater(len(boxes), 10)
        for i, (text, box) in enumerate(zip(shown, boxes)):
            self.assertTrue(figure.bbox.contains(box.x0, box.y0) and figure.bbox.contains(box.x1, box.y1), text)
            over = [shown[k].get_text() for k in range(i) if box.overlaps(boxes[k])]
            self.assertFalse(over, text.get_text())

    def drawn(self, axes: Any, values: Any) -> None:
        """One of its lines has these values."""
        lines = [line.get_ydata() for line in axes.get_lines()]
        self.assertTrue(any(np.array_equal(line, values) for line in lines), axes.get_ylabel())

    def test_trace(self) -> None:
        traced = percuss.trace(self.question(), self.local)
        figure = traced.plot()
        displacement, velocity, force, depth = self.rendered(figure)
        (contact,), (result,) = traced.contacts, traced.reply.contacts
        # the contacts and a quarter of their time after them
        on = contact.time <= 1.25 * result.end_time
        self.drawn(displacement, 1e6 * contact.displacement_a[on])
        self.drawn(displacement, 1e6 * contact.displacement_b[on])
        self.drawn(velocity, contact.velocity_b[on])
        self.drawn(force, contact.force[on])
        self.drawn(depth, 1e6 * contact.indentation[on])
        self.assertEqual(displacement.get_title(), "steel-sphere on al-beam: e = 0.7394, 2 sub-impacts")
        names = [text.get_text() for text in figure.legends[0].get_texts()]
        self.assertEqual(names, ["steel-sphere", "al-beam", "gap rate of the rigid bodies"])
        self.assertEqual(len(figure.legends), 1)
        refused = self.question()
        refused.bodies[0].id = "nobody"
        with self.assertRaisesRegex(ValueError, "UNKNOWN_BODY: .*no histories"):
            percuss.trace(refused, self.local).plot()

    def test_trace_with_friction(self) -> None:
        question = self.question()
        question.bodies[0].velocity = np.asarray(question.bodies[0].velocity) + (0.1, 0.08, 0.0)
        question.contacts[0].friction = 0.3
        traced = percuss.trace(question, self.local)
        figure = traced.plot()
        axes = self.rendered(figure)
        self.assertEqual([one.get_ylabel() for one in axes[4:]], ["slip, m/s", "tangential force, N", "second tangent"])
        (contact,), (result,) = traced.contacts, traced.reply.contacts
        on = contact.time <= 1.25 * result.end_time
        self.drawn(axes[4], contact.slip_1[on])
        self.drawn(axes[4], contact.slip_2[on])
        self.drawn(axes[5], contact.force_tangential_1[on])
        self.drawn(axes[5], contact.force_tangential_2[on])
        # a line for each sub-impact within the circle, along both tangents at last on it
        self.assertEqual((len(axes[6].get_lines()), result.sub_impact_count), (2, 2))
        radius = np.concatenate([np.hypot(*line.get_data()) for line in axes[6].get_lines()])
        self.assertTrue(0.999 < radius.max() <= 1.0 + 1e-9)
        names = [text.get_text() for text in figure.legends[0].get_texts()]
        self.assertEqual(names[3:], ["along the first tangent", "along the second tangent", "within Coulomb's limit", "sub-impact 1", "sub-impact 2"])

    def test_time_fits_the_contacts(self) -> None:
        """A short touch is not a stroke at the edge of what its beam does afterwards."""
        file = Path(tempfile.mkdtemp()) / "cantilever.yaml"
        file.write_text(CANTILEVER)
        with percuss.Local(file) as local:
            for at, long in (("middle", 5.0), ("97%", 1.0)):
                struck = percuss.contact_pair("ball", "cantilever", "300mm/s", at=at, client=local)
                # five seconds of a processor that others may want, too
                traced = percuss.trace(struck, local, timeout=300.0)
                end, last = 1e3 * traced.reply.contacts[0].end_time, 1e3 * traced.contacts[0].time[-1]
                self.assertGreater(last, long * end)
                for axes in self.rendered(traced.plot()):
                    low, high = axes.get_xlim()
                    self.assertEqual(low, 0.0)
                    self.assertAlmostEqual(high, min(last, 1.25 * end), delta=1e-9)

    def test_two_contacts(self) -> None:
        """A body has one colour, wherever it touches."""
        bodies = self.local.bodies()
        both = percuss.contact_pair(bodies["steel-sphere"], bodies["al-beam"], 0.2, at_b=0.4)
        other = percuss.contact_pair(bodies["glass-sphere"], bodies["al-beam"], 0.2, at_b=0.7)
        both.bodies.append(other.bodies[0])
        both.contacts.append(other.contacts[0])
        both.contacts[1].a, both.contacts[1].b = 2, 1
        traced = percuss.trace(both, self.local)
        self.assertEqual(traced.names, (("steel-sphere", "al-beam"), ("glass-sphere", "al-beam")))
        figure = traced.plot()
        first, second = self.rendered(figure)[:2]
        colours = [{line.get_label(): line.get_color() for line in one.get_lines()} for one in (first, second)]
        self.assertEqual(colours[0]["al-beam"], colours[1]["al-beam"])
        self.assertNotEqual(colours[0]["steel-sphere"], colours[1]["glass-sphere"])

    def test_sweep(self) -> None:
        sweep = percuss.sweep("steel-sphere", ["al-rod", "al-beam"], [0.1, 0.2, 0.3], self.local)
        figure = sweep.plot()
        above, below = self.rendered(figure)
        for curve, bars in zip(sweep.curves, above.containers):
            self.drawn(above, curve.restitution)
            (segments,) = bars[2]
            ends = [segment[:, 1] for segment in segments.get_segments()]
            np.testing.assert_allclose([0.5 * (high - low) for low, high in ends], curve.error_total)
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
        file = SOURCE / "client" / "examples" / "measured" / "synthetic-beam.csv"
        compared = measured.compare(file, "steel-sphere", "al-beam", self.local)
        above, middle, _ = self.rendered(compared.plot())
        self.drawn(above, compared.measured.restitution)
        self.drawn(above, compared.simulated.restitution)
        self.drawn(middle, compared.simulated.sub_impacts)
        self.assertIn("A: 0.5 deviations", [text.get_text() for text in compared.plot().legends[0].get_texts()])
        # areas narrower than their letters
        close: dict[str, list[float]] = {"speed": [0.2, 0.2, 0.3], "restitution": [0.70, 0.70, 0.71]}
        self.rendered(measured.compare(close, "steel-sphere", "al-beam", self.local).plot())
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
