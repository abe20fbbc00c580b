# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Whether the shipped settings name every key, and show what the table says where they show a default.
usage: shipped.py SETTINGS.md PERCUSSD.YAML"""
import re
import sys


def shown(file):
    """The keys of the file with their values, in comments or not, those of sections by their whole names."""
    for line in file:
        found = re.match(r"(?:# )?([a-z_]+): (\S.*)$", line)
        if not found:
            continue
        section = re.match(r"\{(.*)\}$", found[2])
        if not section:
            yield found[1], found[2]
            continue
        for part in section[1].split(", "):
            key, value = part.split(": ")
            yield f"{found[1]}.{key}", value


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = [line.split(" | ") for line in file if line.startswith("| `")]
    with open(sys.argv[2], encoding="utf-8") as file:
        values = dict(shown(file))
    bad = 0
    for name, _, default, _ in rows:
        key = name.strip("| `")
        if key not in values:
            bad += 1
            print(f"{sys.argv[2]}: {key} is not in it", file=sys.stderr)
        elif not default.startswith("none") and default != "one for every processor" and values[key] != default:
            bad += 1
            print(f"{sys.argv[2]}: {key}: {values[key]}: the default is {default}", file=sys.stderr)
    return bad > 0 or not rows


sys.exit(main())
