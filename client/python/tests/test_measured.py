# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""percuss.measured beside `percuss compare` and `percuss calibrate`: the same numbers to the last bit."""

import csv
import json
import math
import unittest
from pathlib import Path
from typing import Any

import numpy as np
import pandas

import percuss
from percuss import measured

from beside import SOURCE, Beside, program

DATA = SOURCE / "client" / "examples" / "measured"
PAIR = ("--a", "steel-sphere", "--b", "al-beam")
TOLD = ("restitution", "impulse", "sub_impacts", "first_impulse", "first_duration", "second_start")


def told(*arguments: str, pair: tuple[str, ...] = PAIR) -> Any:
    return json.loads(program(*arguments, *pair, "--json", check=False))


def known(number: float) -> float | None:
    """As in JSON."""
    return number if math.isfinite(number) else None


class Compare(Beside):
    def assert_as(self, ours: measured.Comparison, expected: Any) -> None:
        for name in ("measured", "simulated"):
            moments = {"mean": getattr(ours, f"{name}_mean"), "standard_deviation": getattr(ours, f"{name}_deviation")}
            self.assertEqual(moments, expected[name])
        residual = {"mean": ours.residual_mean, "half_width": ours.residual_half_width}
        self.assertEqual({**residual, "root_mean_square": ours.residual_rms}, expected["residual"])
        for name in ("kolmogorov_smirnov", "energy_distance"):
            distance = getattr(ours, name)
            self.assertEqual({"value": distance.value, "p": distance.p}, expected[name])
        counts = (expected["sub_impacts_known"], expected["sub_impacts_equal"])
        self.assertEqual((ours.sub_impacts_known, ours.sub_impacts_equal), counts)
        self.assertEqual(list(ours.warnings), expected["warnings"])
        self.assertEqual(len(ours.status), len(expected["impacts"]))
        for i, impact in enumerate(expected["impacts"]):
            self.assertEqual(known(ours.measured.speed[i]), impact["speed"])
            self.assertEqual(known(ours.measured.at[i]), impact["at"])
            self.assertEqual(known(ours.measured.restitution_half_width[i]), impact["restitution_half_width"])
            for side in ("measured", "simulated"):
                row = {name: known(getattr(getattr(ours, side), name)[i]) for name in TOLD}
                self.assertEqual(row, impact[side])
            self.assertEqual((ours.residual[i], ours.status[i].name), (impact["residual"], impact["status"]))

    def test_as_the_program(self) -> None:
        for file in ("synthetic-beam.csv", "synthetic-histories.csv"):
            expected = told("compare", str(DATA / file), "--seed", "7", "--permutations", "999")
            for client in (self.client, self.local):
                ours = measured.compare(
                    DATA / file, "steel-sphere", "al-beam", client, permutations=999, seed=7, timeout=60.0
                )
                self.assert_as(ours, expected)

    def test_rigs_as_the_program(self) -> None:
        """Heights with their uncertainties; pixels and frames, and gravity: as texts and as numbers."""
        ball, wall = "steel-sphere", "steel-wall"
        pair = ("--a", ball, "--b", wall)
        heights = DATA / "synthetic-heights.csv"
        doubts = ("--uncertainty", "drop=1mm", "--uncertainty", "rebound=2mm")
        expected = told("compare", str(heights), *doubts, "--gravity", "9.81", pair=pair)
        for uncertainty in ({"drop": "1mm", "rebound": "2 mm"}, {"drop": 1e-3, "rebound": np.float64(2e-3)}):
            ours = measured.compare(heights, ball, wall, self.local, uncertainty=uncertainty, gravity=9.81)
            self.assert_as(ours, expected)
        self.assertTrue(all(0.0 < half < 0.02 for half in ours.measured.restitution_half_width))
        # they come back with the impacts
        again = measured.compare(ours.measured, ball, wall, self.local)
        np.testing.assert_allclose(
            again.measured.restitution_half_width, ours.measured.restitution_half_width, rtol=1e-12
        )
        self.assertEqual(
            ours.to_dataframe()["restitution_half_width"].tolist(), ours.measured.restitution_half_width.tolist()
        )
        camera = DATA / "synthetic-camera.csv"
        columns = {"time": "frame:frame", "displacement_a": "y:px"}
        options = [f"--column={name}={heading}" for name, heading in columns.items()]
        expected = told("compare", str(camera), *options, "--scale=0.12mm", "--rate=240", "--gravity=1g", pair=pair)
        for scale, rate, gravity in (("0.12 mm", "240 Hz", "1 g"), (0.12e-3, 240, 9.80665)):
            self.assert_as(
                measured.compare(
                    camera, ball, wall, self.local, columns=columns, scale=scale, rate=rate, gravity=gravity
                ),
                expected,
            )

    def test_what_is_said_of_files(self) -> None:
        camera = DATA / "synthetic-camera.csv"
        plain = {"speed": [0.2], "restitution": [0.5]}
        cases: list[tuple[Any, dict[str, Any], type[Exception], str]] = [
            (camera, {"scale": "3 s"}, percuss.InvalidArgument, "scale: .*3 s"),
            (camera, {"rate": 0}, ValueError, "rate: 0: a number > 0 is allowed"),
            (camera, {"gravity": -9.81}, percuss.InvalidArgument, r"gravity: -9.81: m/s\^2 > 0"),
            (camera, {"uncertainty": {"colour": 1}}, percuss.InvalidArgument, r"uncertainties\[0\]: 'colour=1'"),
            (plain, {"scale": 1, "uncertainty": {"speed": 1}}, ValueError, "uncertainty, scale: for a file"),
            (plain, {"rate": 0}, ValueError, "rate: for a file"),
        ]
        for source, said, kind, message in cases:
            with self.subTest(message), self.assertRaisesRegex(kind, message):
                measured.compare(source, *self.pair(), self.local, **said)

    def test_columns(self) -> None:
        """What a file says, as arrays and as a frame."""
        lines = [line for line in (DATA / "synthetic-beam.csv").read_text().splitlines() if not line.startswith("#")]
        rows = list(csv.DictReader(lines))
        columns = {name: [float(row[name] or "nan") for row in rows] for name in rows[0]}
        expected = told("compare", str(DATA / "synthetic-beam.csv"), "--tolerance", "1e-4")
        bodies = self.local.bodies()
        options = percuss.Options(tolerance=1e-4)
        for source in (columns, pandas.DataFrame(columns)):
            ours = measured.compare(source, bodies["steel-sphere"], bodies["al-beam"], self.local, options=options)
            self.assert_as(ours, expected)
        frame = ours.to_dataframe()
        self.assertEqual(frame["residual"].tolist(), ours.residual.tolist())
        self.assertIn("steel-sphere on al-beam, 53 impacts", ours._repr_html_())

    def test_places(self) -> None:
        """One place for all is that of a column, and of --at."""
        columns = {"speed": [0.2, 0.3], "restitution": [0.5, 0.5]}
        ours = measured.compare(columns, "steel-sphere", "al-beam", self.local, at=0.3)
        for at in ("300mm", "30%"):
            typed = measured.compare(columns, "steel-sphere", "al-beam", self.local, at=at)
            self.assertEqual(typed.simulated.restitution.tolist(), ours.simulated.restitution.tolist())
        with self.assertRaisesRegex(ValueError, "at: '2m': a fraction"):
            measured.compare(columns, "steel-sphere", "al-beam", self.local, at="2m")
        same = measured.compare({**columns, "at": [0.3, 0.3]}, "steel-sphere", "al-beam", self.local)
        self.assertEqual(ours.simulated.restitution.tolist(), same.simulated.restitution.tolist())
        Path("two.csv").write_text("speed,restitution\n0.2,0.5\n0.3,0.5\n")
        self.assert_as(ours, told("compare", "two.csv", "--at", "0.3"))

    def test_a_file_of_a_rig(self) -> None:
        """Another separator, names and units of its own, a row without a reading; all that is wrong at once."""
        Path("rig.csv").write_text("Nr;v;COR\n1;200,0;0,5\n2;300,0;0,5\n3;250,0;\n")
        columns = {"speed": "v:mm/s", "restitution": "COR"}
        ours = measured.compare("rig.csv", "steel-sphere", "al-beam", self.local, columns=columns)
        plain = {"speed": [0.2, 0.3], "restitution": [0.5, 0.5]}
        same = measured.compare(plain, "steel-sphere", "al-beam", self.local)
        self.assertEqual(ours.simulated.restitution.tolist(), same.simulated.restitution.tolist())
        self.assertTrue(any("line 4" in note or ":4" in note for note in ours.notes), ours.notes)
        self.assertEqual(same.notes, ())
        Path("bad.csv").write_text("speed,restitution\n-1,0.5\n0.2,7\n")
        with self.assertRaisesRegex(percuss.InvalidArgument, "bad.csv:2: speed: -1(.|\n)*bad.csv:3: restitution: 7"):
            measured.compare("bad.csv", "steel-sphere", "al-beam", self.local)
        with self.assertRaisesRegex(percuss.InvalidArgument, r"columns\[0\]: .*colour"):
            measured.compare("rig.csv", "steel-sphere", "al-beam", self.local, columns={"colour": "v"})
        with self.assertRaisesRegex(ValueError, "columns: for a file; these measurements"):
            measured.compare(plain, "steel-sphere", "al-beam", self.local, columns=columns)

    def test_mistakes(self) -> None:
        good = {"speed": [0.2], "restitution": [0.5]}
        cases: list[tuple[Any, type[Exception], str]] = [
            ({**good, "colour": [1]}, ValueError, "columns: 'colour': of speed, .* some are allowed"),
            ({}, ValueError, "columns: none: of speed"),
            ({"speed": [0.2, 0.3], "restitution": [0.5]}, ValueError, r"columns: shapes \[\(1,\), \(2,\)\]: lists of one"),
            ({"speed": [], "restitution": []}, percuss.InvalidArgument, "impacts: none: at least one"),
            ({**good, "speed": [-1.0]}, percuss.InvalidArgument, r"impacts\[0\].speed: -1: m/s > 0 or NAN is allowed"),
            ({**good, "speed": [np.nan]}, percuss.InvalidArgument, r"impacts\[0\].speed: unknown"),
            ({"speed": [0.2]}, percuss.InvalidArgument, r"impacts\[0\].restitution: unknown"),
            ({**good, "restitution": [np.inf]}, percuss.InvalidArgument, r"impacts\[0\].restitution: inf: a number -1..2"),
            ("/none.csv", percuss.InvalidArgument, "none.csv"),
        ]
        for source, kind, message in cases:
            with self.subTest(message), self.assertRaisesRegex(kind, message):
                measured.compare(source, "steel-sphere", "al-beam", self.local)
        with self.assertRaisesRegex(ValueError, "b: 'al-bean': not in the catalogue"):
            measured.compare(good, "steel-sphere", "al-bean", self.local)
        with self.assertRaisesRegex(percuss.InvalidArgument, "permutations: 0: 1..1000000"):
            measured.compare(good, "steel-sphere", "al-beam", self.local, permutations=0)
        # what the client does not take, and what a twin is refused for
        for client in (self.client, self.local):
            with self.assertRaisesRegex(percuss.InvalidArgument, "timeout: -1"):
                measured.compare(good, *self.pair(), client, timeout=-1.0)
            with self.assertRaisesRegex(percuss.InvalidArgument, "impact 1: BAD_REQUEST: .*tolerance"):
                measured.compare(good, *self.pair(), client, options=percuss.Options(tolerance=7.0))
        # a beam that swings does not tell its impulse by its velocity
        with self.assertRaisesRegex(percuss.InvalidArgument, "a history of al-beam does not tell the impulse"):
            measured.compare(DATA / "synthetic-histories.csv", "al-beam", "steel-sphere", self.local)

    def pair(self) -> tuple[percuss.Body, percuss.Body]:
        bodies = self.local.bodies()
        return bodies["steel-sphere"], bodies["al-beam"]


class Calibrate(Beside):
    def assert_as(self, ours: measured.Calibration, expected: Any) -> None:
        for one, there in zip(ours.parameters, expected["parameters"], strict=True):
            row = {name: getattr(one, name) for name in ("body", "start", "value", "low", "high", "determined")}
            self.assertEqual({"parameter": one.parameter.text, **row}, there)
        self.assertEqual(ours.correlation.tolist(), expected["correlation"])
        readings = [
            {"quantity": one.quantity, "known": one.known, "used": one.used, "scatter": known(one.scatter)}
            for one in ours.readings
        ]
        self.assertEqual(readings, expected["quantities"])
        self.assertEqual((ours.impacts, ours.freedom), (expected["impacts"], expected["freedom"]))
        self.assertEqual(list(ours.warnings), expected["warnings"])

    def test_as_the_program(self) -> None:
        file = str(DATA / "synthetic-beam.csv")
        expected = told("calibrate", file, "--fit", "young:al-beam")
        for client in (self.client, self.local):
            ours = measured.calibrate(file, "steel-sphere", "al-beam", client, fit=["young@al-beam"])
            self.assert_as(ours, expected)
        # the shipped measurements were made with 72.5 GPa
        (young,) = ours.parameters
        self.assertTrue(young.low < 72.5e9 < young.high and young.determined)
        self.assertEqual(ours.to_dataframe()["parameter"].tolist(), ["young"])
        self.assertIn("young of al-beam", ours._repr_html_())

    def test_several_and_starts(self) -> None:
        file = str(DATA / "synthetic-beam.csv")
        expected = told("calibrate", file, "--fit", "young:al-beam=71e9", "--fit", "damping:al-beam", "--noise", "0.02")
        fit: dict[str, Any] = {"young:al-beam": "71 GPa", "damping:al-beam": None}
        self.assert_as(measured.calibrate(file, "steel-sphere", "al-beam", self.local, fit=fit, noise=0.02), expected)

    def test_mistakes(self) -> None:
        file = str(DATA / "synthetic-beam.csv")
        cases: list[tuple[Any, type[Exception], str]] = [
            (["young"], ValueError, "fit: 'young': PARAMETER:ID is allowed"),
            (["stiffness:al-beam"], ValueError, "Parameter: 'stiffness': one of YOUNG, .* is allowed"),
            ([], percuss.InvalidArgument, "parameters: 0: 1..8 are allowed"),
            ([(one, "al-beam") for one in range(9)], ValueError, "fit: 9 are too many"),
            (["young:al-rod"], percuss.InvalidArgument, r"parameters\[0\].body: 'al-rod': steel-sphere or al-beam"),
            (["young:al-beam", ("young", "al-beam")], percuss.InvalidArgument, r"parameters\[1\]: .* is parameters\[0\]"),
            (["yield:al-beam"], percuss.InvalidArgument, r"parameters\[0\].start: the catalogue has no yield of al-beam"),
        ]
        for fit, kind, message in cases:
            with self.subTest(message), self.assertRaisesRegex(kind, message):
                measured.calibrate(file, "steel-sphere", "al-beam", self.local, fit=fit)
        with self.assertRaisesRegex(percuss.InvalidArgument, "noise: 2: a number between 0 and 1"):
            measured.calibrate(file, "steel-sphere", "al-beam", self.local, fit=["young:al-beam"], noise=2.0)
        few = {"speed": [0.2], "restitution": [0.7]}
        with self.assertRaisesRegex(percuss.InvalidArgument, "0 usable numbers of 0 do not suffice for 1 parameters"):
            measured.calibrate(few, "steel-sphere", "al-beam", self.local, fit=["young:al-beam"])


if __name__ == "__main__":
    unittest.main()
