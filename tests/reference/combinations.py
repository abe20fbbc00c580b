# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Catalogues with the combinations of keys that one of them may not bear beside another, right and wrong ones.
usage: combinations.py FOLDER    (which is made)"""
import itertools
import sys
from pathlib import Path

LAW = ("stiffness: 2e6", "points: press.csv", "exponent: 2", "hysteresis: 0.3", "dissipation: 0.1", "unloading: release.csv")
YIELD = ("", "yield: none", "yield: 200 MPa")
BESIDE_YIELD = (
    "tangent: 0",
    "tangent: 0.0 GPa",
    "tangent: 1 GPa",
    "rate: {reference: 40, exponent: 5}",
    "rate: {reference: 1, coefficient: 0.01}",
    "rate: {reference: 40}",
    "rate: {reference: 40, exponent: 5, coefficient: 0.01}",
    "tangent: 1e9, rate: {reference: 40, exponent: 5}",
)
LOSS = ("loss_factor: 0.1", "loss_frequency: 2 kHz", "relaxation: [{share: 0.2, time: 1 ms}]")


def subsets(keys, most):
    return [part for size in range(most + 1) for part in itertools.combinations(keys, size)]


def write(folder, number, material, law):
    keys = ", ".join(["young: 70 GPa", "poisson: 0.3", "density: 2700", *filter(None, material)])
    text = f"materials: {{metal: {{{keys}}}}}\nbodies: {{ball: {{shape: sphere, material: metal, radius: 1 cm}}}}\n"
    if law is not None:
        text += "laws: {pad: {" + ", ".join(["between: [metal, metal]", *law]) + "}}\n"
    (folder / f"{number:03}.yaml").write_text(text)


def main():
    folder = Path(sys.argv[1])
    folder.mkdir()
    (folder / "press.csv").write_text("0,0\n1e-3,10\n2e-3,40\n")
    (folder / "release.csv").write_text("2e-3,40\n1.5e-3,15\n0.5e-3,0\n")
    cases = [((), law) for law in subsets(LAW, 3)]
    cases += [(material, None) for material in itertools.product(YIELD, BESIDE_YIELD)]
    cases += [(material, None) for material in subsets(LOSS, 3)]
    for number, (material, law) in enumerate(cases):
        write(folder, number, material, law)


main()
