#!/usr/bin/env python3
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The table of docs/reference/engines.md: pairs at five speeds, and what other simulators make of them.
usage: pairs.py [PERCUSS], the program (default: the one on the PATH)"""
import json
import subprocess
import sys
from pathlib import Path

PAIRS = [
    ("ball", "steel-anvil"),
    ("ball", "al-anvil"),
    ("ball", "glass-anvil"),
    ("glass-ball", "steel-anvil"),
    ("glass-ball", "glass-anvil"),
    ("ball", "al-bar"),
    ("acrylic-ball", "steel-anvil"),
    ("rubber-ball", "steel-anvil"),
    ("rubber-ball", "al-bar"),
]


def exported(program, a, b):
    """What percuss prints for that program."""
    words = f"export --local --for {program} --a {a} --b {b} --speed 0.1:2:5 --json".split()
    percuss = sys.argv[1] if len(sys.argv) > 1 else "percuss"
    catalogue = Path(__file__).with_name("pairs.yaml")
    answer = subprocess.run([percuss, *words, "--catalogue", catalogue], check=True, capture_output=True)
    return json.loads(answer.stdout)


print("| pair | e at 0.1, 0.21, 0.45, 0.95 and 2 m/s | contact / us | one e, off by | Hunt and Crossley / (s/m), off by |")
print("|---|---|---|---|---|")
for a, b in PAIRS:
    constant, falling = exported("mujoco", a, b), exported("drake", a, b)
    curve = ", ".join(f"{point['restitution']:.2f}" for point in constant["points"])
    print(
        f"| {a} on {b} | {curve} | {1e6 * constant['duration']:.0f} | {constant['restitution']:.2f}, "
        f"{constant['worst']:.2f} | {falling['dissipation']:.2f}, {falling['worst']:.2f} |"
    )
