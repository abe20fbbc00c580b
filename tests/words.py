# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Prints how large and how plain the sources are: modules, includes, and two groups of words in comments, which STYLE
limits. usage: words.py SOURCE_DIR [--folders]    --folders: the words of each folder, too"""
import re
import statistics
import sys
from pathlib import Path

TOKEN = re.compile(r"/\*.*?\*/|//[^\n]*|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'", re.DOTALL)
INCLUDE = re.compile(r'^ *# *include *"([^"]*)"', re.MULTILINE)
# a number with a name of its own in a file that estimates or bounds errors
TUNED = re.compile(r"^static const (?:double|int|unsigned|size_t) [A-Z]\w* = [^;]*;|^ *[A-Z]\w* = -?[0-9.][^,}]*",
                   re.MULTILINE)


def read(folders):
    return {path: path.read_text() for folder in folders for path in sorted(folder.rglob("*.[ch]"))}


def words(sources):
    """The words of all comments, how many are "what", and how many "who" and its kin."""
    found = [word.lower() for text in sources.values() for comment in TOKEN.findall(text) if comment[0] == "/"
             for word in re.findall(r"[A-Za-z][A-Za-z']*", comment)]
    return len(found), found.count("what"), sum(word in ("who", "whoever", "whose", "nobody") for word in found)


def show_words(name, sources):
    count, what, who = words(sources)
    scale = 1e4 / max(count, 1)
    print(f'{name}: {count} words of comment; of 10,000 are "what" {what * scale:.0f}, "who, whoever, whose, nobody" '
          f"{who * scale:.0f}")


def resolved(root, sources):
    """For each file the files that it includes by name."""
    return {path: {target for name in INCLUDE.findall(text)
                   for target in (*(root / "service" / door / name for door in ("core", "", "tools")), path.parent / name)
                   if target in sources}
            for path, text in sources.items()}


def depth(path, includes, known):
    if path not in known:
        known[path] = 0  # of a round, which layers.sh refuses
        known[path] = 1 + max((depth(target, includes, known) for target in includes[path]), default=0)
    return known[path]


def main():
    root = Path(sys.argv[1]).resolve()
    service = read([root / "service"])
    includes = resolved(root, service)
    lengths = [text.count("\n") for text in service.values()]
    modules = {path.with_suffix("") for path in service}
    headers = [path for path in service if path.suffix == ".h"]
    outside = {header: {path.with_suffix("") for path in service if header in includes[path]} - {header.with_suffix("")}
               for header in headers}
    alone = [header for header in headers if len(outside[header]) == 1]
    known = {}
    deepest = max(depth(path, includes, known) for path in service)
    error_control = [path for path in service if path.parent.name == "error"]
    tuned = sum(len(TUNED.findall(service[path])) for path in error_control)
    print(f"service: {len(service)} files, {sum(lengths)} lines, median {statistics.median(lengths):.0f}")
    print(f"service: {len(modules)} modules; {len(alone)} of {len(headers)} headers have one outside includer; "
          f"include depth {deepest}")
    print(f"error control: {tuned} numbers at file scope in {len(error_control)} files")
    for name in ("service", "client"):
        show_words(name, read([root / name]))
    if "--folders" in sys.argv:
        for folder in sorted({path.parent for path in read([root / "service", root / "client"])}):
            show_words(folder.relative_to(root), {path: path.read_text() for path in sorted(folder.glob("*.[ch]"))})


main()
