# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The tables of docs/lab/peers.md, out of peers.csv: of each scene and program the least seconds for an error.

usage: table.py PEERS.csv PAGE.md      writes between the page's marks
"""

import csv
import sys
from pathlib import Path

SCENES = {
    "rod": "A sphere on a rod, 0.3 m/s",
    "beam": "A sphere on a beam, 0.2 m/s",
    "balls": "Two balls, 1 m/s",
    "row": "Ten balls in a row, the first at 1 m/s; the worst ball",
    "bounce": "A ball that bounces for 10 s; the height that it has left",
}
ERRORS = (1e-2, 1e-3, 1e-4, 1e-6)
BEGIN, END = "<!-- tables begin -->\n", "<!-- tables end -->\n"


def ratio(value):
    return f"{value:.2g}" if value < 10.0 else f"{float(f'{value:.2g}'):,.0f}"


def power(value):
    return f"{value:.1e}".replace(".0e", "e").replace("e-0", "e-") if 0.0 < value < 0.1 else f"{value:.2g}"


def cells(points, unit):
    """Of each error the least seconds in that unit, and the least error of all."""
    for error in ERRORS:
        seconds = [s for e, s in points if e <= error]
        yield ratio(min(seconds) / unit) if seconds else ""
    yield power(min(e for e, _ in points))


def table(scene, rows, versions):
    """A line for each program, with the reasons where it has no numbers."""
    of_program = {}
    for row in rows:
        if row["scene"] == scene:
            of_program.setdefault(row["program"], []).append(row)
    points = {p: [(float(r["error"]), float(r["seconds"])) for r in found if r["error"]] for p, found in of_program.items()}
    unit = min(seconds for _, seconds in points["percuss"])
    yield f"**{SCENES[scene]}**; 1 is {ratio(1e3 * unit)} ms\n\n"
    yield "| least time for an error of | " + " | ".join(map(power, ERRORS)) + " | least error |\n"
    yield "|---" * (len(ERRORS) + 2) + "|\n"
    for program, found in of_program.items():
        reasons = [""] * len(ERRORS) + ["; ".join(dict.fromkeys(row["why"] for row in found))]
        line = cells(points[program], unit) if points[program] else reasons
        yield f"| {versions[program]} | " + " | ".join(line) + " |\n"
    yield "\n"


def main():
    with open(sys.argv[1], newline="") as file:
        rows = list(csv.DictReader(file))
    versions = {row["program"]: row["settings"] for row in rows if row["scene"] == "version"}
    text = "".join(line for scene in SCENES for line in table(scene, rows, versions))
    page = Path(sys.argv[2])
    before, rest = page.read_text().split(BEGIN)
    page.write_text(before + BEGIN + text + END + rest.split(END)[1])


if __name__ == "__main__":
    main()
