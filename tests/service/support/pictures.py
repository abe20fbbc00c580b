# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""What the pictures of a story must keep to.

pictures.py words FILE.pdf NAME...: every name stands in it, and no two words lie over each other or
    beyond the page
pictures.py data FOLDER: of what percuss --plot-data wrote there the legends stand outside of the panels,
    and every point lies within the axes of its panel
"""
import csv
import re
import subprocess
import sys


def words_of(file):
    text = subprocess.run(["pdftotext", "-bbox", file, "-"], check=True, capture_output=True, text=True).stdout
    page = re.search(r'<page width="([\d.]+)" height="([\d.]+)"', text)
    pattern = r'<word xMin="([-\d.]+)" yMin="([-\d.]+)" xMax="([-\d.]+)" yMax="([-\d.]+)">(.*?)</word>'
    found = [tuple(map(float, match[:4])) + (match[4],) for match in re.findall(pattern, text)]
    return float(page[1]), float(page[2]), found


def share_covered(a, b):
    """Of the smaller of two boxes, what both have."""
    wide = min(a[2], b[2]) - max(a[0], b[0])
    high = min(a[3], b[3]) - max(a[1], b[1])
    smaller = min((box[2] - box[0]) * (box[3] - box[1]) for box in (a, b))
    return wide * high / smaller if wide > 0 and high > 0 else 0.0


def check_words(file, names):
    width, height, words = words_of(file)
    text = " ".join(word[4] for word in words)
    wrong = [f"'{name}' is not there" for name in names if name not in text]
    for i, word in enumerate(words):
        if word[0] < 0 or word[1] < 0 or word[2] > width or word[3] > height:
            wrong.append(f"'{word[4]}' leaves the page")
        # boxes have room above and below their letters: a quarter is no collision yet
        wrong += [f"'{word[4]}' and '{other[4]}' collide" for other in words[:i] if share_covered(word, other) > 0.25]
    return wrong + ([] if len(words) > 10 else ["hardly any words"])


def value_of(expression, number, row):
    """Of "3", "($3*1e6)" and the like, where $0 is the row's number; None: of another kind."""
    if re.fullmatch(r"\d+", expression):
        return float(row[int(expression) - 1])
    if not re.fullmatch(r"\([-+*.$\de]+\)", expression):
        return None
    cells = [str(number), *row]
    return eval(re.sub(r"\$(\d+)", lambda match: f"({cells[int(match[1])]})", expression), {"nan": float("nan")})


def is_within(value, bounds):
    return value is None or value != value or bounds[0] <= value <= bounds[1]


def check_curve(folder, name, using, rest, ranges):
    with open(f"{folder}/{name}.csv", encoding="utf-8") as file:
        head, *rows = list(csv.reader(file))
    columns = re.findall(r"\([^)]*\)+|[^:]+", using)
    if not head[0].isidentifier():
        return [f"{name}.csv: no names of columns"]
    if "smooth" in rest:  # y is made of them
        columns[1] = "-"
    for number, row in enumerate(rows):
        for axis, column in zip("xy", columns):
            if not is_within(value_of(column, number, row), ranges[axis]):
                return [f"{name}.csv: {column}: {row} is not within the {axis}range {ranges[axis]}"]
    return []


def check_data(folder):
    with open(f"{folder}/plot.gp", encoding="utf-8") as file:
        lines = file.read().splitlines()
    wrong, ranges, curves = [], {}, 0
    for line in lines:
        bounds = re.fullmatch(r"set ([xy])range \[([-+.e\d]+):([-+.e\d]+)\]", line)
        if bounds:
            ranges[bounds[1]] = (float(bounds[2]), float(bounds[3]))
        if line.startswith("set key") and "outside" not in line:
            wrong.append(f"a legend among the data: {line}")
        if not line.startswith("plot "):
            continue
        name = None
        for found in re.finditer(r"(?:@(\w+)|'') using (\S+) ([^@]*?)(?=, @|, ''|$)", line):
            name = found[1] or name
            wrong += check_curve(folder, name, found[2], found[3], ranges)
            curves += 1
    keys = sum(line.startswith("set key") for line in lines)
    return wrong + ([] if curves and keys else ["no curves or no legend"])


if __name__ == "__main__":
    kind, subject, *more = sys.argv[1:]
    faults = check_words(subject, more) if kind == "words" else check_data(subject)
    print("\n".join(faults))
    sys.exit(bool(faults))
