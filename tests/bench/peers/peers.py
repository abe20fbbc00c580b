# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The same impacts in other programs: seconds of one core against the error of e, each by its best settings.

A steel sphere on the paper's rod (0.3 m/s) and beam (0.2 m/s), two steel spheres, and the first of ten in a row (1 m/s). All solve
the same equations: rigid balls, Hertz's contact of half-spaces, elementary rod, Euler and Bernoulli's beam. A sphere that bounces for
10 s on hardened steel, which yields; there the error is that of the height that is left, relative. The reference is percuss at
1e-8, which another way has to confirm: solve_ivp with the most modes and the smallest tolerance.

A program is a module by_PROGRAM.py: VERSION names it, CASES are its settings, run(scene, *settings) gives the answer and its seconds, and raises
NotImplementedError with the reason where it has no such scene. Each program has a process of its own.

usage: peers.py PROGRAM OUTPUT.csv      PERCUSS_LIBRARY, and PYTHONPATH with client/python; adds lines of
    scene,program,settings,error,seconds,why      why: a reason instead of the numbers
"""

import csv
import importlib
import sys

import numpy as np
from scenes import SCENES, reference

TIMES = 3  # of which the least counts
LONG = 1.0  # s: what takes longer is run once


def repeated(run, scene, settings):
    """The answer, and the least of the seconds."""
    results = [run(scene, *settings)]
    while len(results) < TIMES and results[0][1] < LONG:
        results.append(run(scene, *settings))
    return results[0][0], min(result[1] for result in results)


def lines(name):
    program = importlib.import_module(f"by_{name}")
    yield "version", name, program.VERSION, "", "", ""
    for scene in SCENES:
        true = reference(scene)[0]
        done = set()
        for settings in program.CASES:
            # rigid bodies have neither modes nor cells
            key = settings[1:] if scene in ("balls", "row", "bounce") and len(settings) > 1 else settings
            if key in done:
                continue
            done.add(key)
            shown = " ".join(map(str, key))
            try:
                values, seconds = repeated(program.run, scene, settings)
                error = float(np.max(np.abs(values - true)))
                if not np.isfinite(error):
                    raise ValueError("its numbers are not finite")
                yield scene, name, shown, f"{error:.3g}", f"{seconds:.3g}", ""
            except NotImplementedError as why:
                yield scene, name, "", "", "", why
                break
            except (ValueError, RuntimeError) as why:
                yield scene, name, shown, "", "", str(why).splitlines()[0]


def main():
    with open(sys.argv[2], "a", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        for line in lines(sys.argv[1]):
            table.writerow(line)
            file.flush()


if __name__ == "__main__":
    main()
