# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Random scenes for the solver's harness, some sixty a second in an ordinary build: many more than libFuzzer has
time for under sanitizers. Scenes of any_scene.h by number, with changes of orders of magnitude that matter.

usage: scenes.py HARNESS SECONDS [SEED]   found ones are left in the folder it names; exit code 1
"""

import random
import shutil
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

AT_ONCE = 150
PLAIN = (0.5, 2, 0.1, 10, -1, 1.01, 0.99, 1e-3, 1e3, 0, 1e-9, 1e-6, 1e6, 1e9, 1e-12)
ASKED_TWICE = 3  # length modulo 8, see solve.c


def value(chance):
    kind = chance.random()
    if kind < 0.35:
        return chance.choice(PLAIN)
    if kind < 0.6:
        return 10 ** chance.uniform(-12, 9) * chance.choice((1, 1, -1))
    if kind < 0.9:
        return chance.uniform(-2, 2)
    return struct.unpack("<d", chance.randbytes(8))[0]


def scene(chance):
    text = struct.pack("<H", chance.randrange(65536))
    for _ in range(chance.choice((0, 1, 1, 2, 3, 5))):
        change = chance.randrange(8), chance.randrange(6), chance.randrange(32), chance.randrange(3)
        text += bytes(change) + struct.pack("<d", value(chance))
    if chance.random() < 0.3:
        text += bytes((ASKED_TWICE - len(text)) % 8)
    return text


def give(harness, folder):
    """Those that were given, whether the last one ended the harness, and how many had no answer."""
    done = subprocess.run([harness, folder], capture_output=True, text=True, errors="replace", check=False)
    lines = done.stderr.splitlines()
    paths = [Path(line) for line in lines if line.startswith(str(folder))]
    if done.returncode and paths:
        print(f"found: {paths[-1].name}: {lines[-1][:300]}", flush=True)
    unanswered = [f"{above}: {line}" for above, line in zip(lines, lines[1:]) if line.startswith("unanswered")]
    print("\n".join(unanswered), end="\n" if unanswered else "", flush=True)
    return paths, done.returncode != 0, len(unanswered)


def main():
    harness, end = sys.argv[1], time.time() + float(sys.argv[2])
    chance = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    found, count = Path(tempfile.mkdtemp(prefix="fuzz-found-")), 0
    without = 0
    while time.time() < end:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for i in range(AT_ONCE):
                (folder / f"{count + i:07d}").write_bytes(scene(chance))
            count += AT_ONCE
            while any(folder.iterdir()):
                paths, ended, unanswered = give(harness, folder)
                without += unanswered
                if ended and paths:
                    shutil.copy(paths[-1], found)
                for path in paths:
                    path.unlink()
    bad = len(list(found.iterdir()))
    print(f"{count} scenes, {without} unanswered, {bad} found" + (f", in {found}" if bad else ""))
    sys.exit(bad > 0)


main()
