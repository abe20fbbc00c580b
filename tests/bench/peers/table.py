# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The tables of docs/lab/peers.md, out of peers.csv or solids.csv: of each scene and program the least seconds for an error.

usage: table.py RESULTS.csv PAGE.md [tables|solids]      writes between the page's marks of that name
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
SOLIDS = {
    "rod-solid": "A sphere on a rod, 0.3 m/s",
    "beam-solid": "A sphere on a beam, 0.2 m/s",
    "balls-solid": "Two balls, 1 m/s",
    "plate": "A ball on a plate of glass, 1 m/s",
}
SETS = {"tables": (SCENES, (1e-2, 1e-3, 1e-4, 1e-6)), "solids": (SOLIDS, (1e-2, 3e-3, 1e-3))}


def ratio(value):
    return f"{value:.2g}" if value < 10.0 else f"{float(f'{value:.2g}'):,.0f}"


def power(value):
    return f"{value:.1e}".replace(".0e", "e").replace("e-0", "e-") if 0.0 < value < 0.1 else f"{value:.2g}"


def time(seconds):
    return f"{ratio(1e3 * seconds)} ms" if seconds > 1e-4 else f"{ratio(1e6 * seconds)} µs"


def cells(points, unit, errors):
    """Of each error the least seconds in that unit, and the least error of all."""
    for error in errors:
        seconds = [s for e, s in points if e <= error]
        yield ratio(min(seconds) / unit) if seconds else ""
    yield power(min(e for e, _ in points))


def table(scene, title, errors, rows, versions):
    """A line for each program, with the reasons where it has no numbers; the first one's least time is the unit."""
    of_program = {}
    for row in rows:
        if row["scene"] == scene:
            of_program.setdefault(row["program"], []).append(row)
    points = {p: [(float(r["error"]), float(r["seconds"])) for r in found if r["error"]] for p, found in of_program.items()}
    unit = min(seconds for _, seconds in next(iter(points.values())))
    yield f"**{title}**; 1 is {time(unit)}\n\n"
    yield "| least time for an error of | " + " | ".join(map(power, errors)) + " | least error |\n"
    yield "|---" * (len(errors) + 2) + "|\n"
    for program, found in of_program.items():
        reasons = [""] * len(errors) + ["; ".join(dict.fromkeys(row["why"] for row in found))]
        line = cells(points[program], unit, errors) if points[program] else reasons
        yield f"| {versions[program]} | " + " | ".join(line) + " |\n"
    yield "\n"


def main():
    with open(sys.argv[1], newline="") as file:
        rows = list(csv.DictReader(file))
    versions = {row["program"]: row["settings"] for row in rows if row["scene"] == "version"}
    name = sys.argv[3] if len(sys.argv) > 3 else "tables"
    scenes, errors = SETS[name]
    text = "".join(line for scene, title in scenes.items() for line in table(scene, title, errors, rows, versions))
    begin, end = f"<!-- {name} begin -->\n", f"<!-- {name} end -->\n"
    page = Path(sys.argv[2])
    before, rest = page.read_text().split(begin)
    page.write_text(before + begin + text + end + rest.split(end)[1])


if __name__ == "__main__":
    main()
