# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""First frequencies of decks of others, free, beside those of CalculiX for the same nodes, elements and materials.

A deck goes to percuss-reduce as it is. For CalculiX all is taken away but nodes, solids, masses, sets, elasticity (its
first row) and density; elements of reduced integration become those of full one. Materials without a density get 7800
kg/m^3 in both. Prints a line for each deck: what was refused, or the largest difference of the first frequencies.

usage: decks_of_others.py PERCUSS_REDUCE FOLDER      needs ccx (Debian: calculix-ccx); FOLDER holds *.inp
"""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

COUNT, RIGID = 6, 6
SECONDS = 60
KEPT = {"NODE", "NSET", "ELSET", "MATERIAL", "ELASTIC", "DENSITY", "SOLIDSECTION", "MASS", "ELEMENT", "INCLUDE"}


def cards(path):
    """Keyword, parameters, lines of data of all before the first *STEP."""
    lines = []
    for line in path.read_text(errors="replace").splitlines():
        if line.startswith("**") or not line.strip():
            continue
        if lines and lines[-1].startswith("*") and lines[-1].rstrip().endswith(",") and "=" in line:
            lines[-1] = lines[-1].rstrip() + line.strip()
        else:
            lines.append(line)
    card = None
    for line in lines:
        if not line.startswith("*"):
            if card:
                card[2].append(line)
            continue
        if card:
            yield card
        head, *parameters = line[1:].split(",")
        name = head.replace(" ", "").upper()
        pairs = [p.partition("=") for p in parameters]
        card = (name, {k.replace(" ", "").upper(): v.strip() for k, _, v in pairs}, [])
        if name == "STEP":
            return
        if name == "INCLUDE":
            yield from cards(path.parent / card[1]["INPUT"].strip('"'))
            card = None
    if card:
        yield card


def reduced(path, density):
    """What CalculiX is given; `density`: in units of the deck, for materials without one."""
    text, material = "", None

    def close():
        return f"*DENSITY\n{density:g}\n" if material and not material["dense"] else ""

    for name, parameters, data in cards(path):
        if name not in KEPT:
            continue
        if name in ("MATERIAL", "SOLIDSECTION", "ELEMENT", "NODE", "NSET", "ELSET", "MASS"):
            text += close()
            material = None
        if name == "MATERIAL":
            material = {"dense": False}
        if name == "DENSITY":
            material["dense"] = True
            data = [data[0].split(",")[0]]
        if name == "ELASTIC":
            data = [",".join(data[0].split(",")[:2])] if "TYPE" not in parameters or parameters["TYPE"].upper()[:3] == "ISO" else data
        if name == "SOLIDSECTION":
            parameters = {k: v for k, v in parameters.items() if k in ("ELSET", "MATERIAL")}
            data = []
        if name == "ELEMENT":
            kind = re.match(r"C3D(10|15|20)|MASS$", parameters["TYPE"].upper())
            if not kind:
                continue
            parameters["TYPE"] = kind.group(0)
        text += "*" + ", ".join([name.replace("SOLIDSECTION", "SOLID SECTION"),
                                 *(k + ("=" + v if v else "") for k, v in parameters.items())]) + "\n"
        text += "".join(line + "\n" for line in data)
    return text + close() + f"*STEP\n*FREQUENCY\n{COUNT + RIGID}\n*END STEP\n"


def of_calculix(text, folder):
    (folder / "d.inp").write_text(text)
    (folder / "d.dat").unlink(missing_ok=True)
    try:
        run = subprocess.run(["ccx", "d"], cwd=folder, capture_output=True, text=True, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return "takes too long"
    dat = (folder / "d.dat").read_text() if (folder / "d.dat").exists() else ""
    found = []
    for line in dat.splitlines():
        words = line.split()
        if len(words) == 5 and words[0].isdigit():
            found.append(float(words[3]))
        if "P A R T I C I P" in line:
            break
    error = re.search(r"\*ERROR[^\n]*\n?[^\n]*", run.stdout)
    return sorted(found)[RIGID:] if len(found) > RIGID else error.group(0) if error else "gives no frequencies"


def reduce(program, path, folder):
    """(report, unit, density in the deck's units), or what is said."""
    for unit, metres in (("mm", 1e-3), ("m", 1.0)):
        for density in ([], ["--density", "7800"]):
            try:
                run = subprocess.run([program, str(path), "--unit", unit, "-n", str(COUNT), "-o", str(folder / "o.h5"), "--json",
                                      *density], capture_output=True, text=True, timeout=SECONDS)
            except subprocess.TimeoutExpired:
                return "takes too long"
            if run.returncode == 0:
                return json.loads(run.stdout), unit, 7800 * metres**4
            words = run.stderr.strip().splitlines()[-1].replace("percuss-reduce: ", "").replace(str(path.parent) + "/", "")
            if "has no *DENSITY" not in words:
                break
        if "is the unit of length right" not in words and "waves of" not in words:
            break
    return words


def main():
    program, decks = sys.argv[1], sorted(Path(sys.argv[2]).glob("*.inp"))
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for path in decks:
            if not re.search(r"(?im)^\*element.*type *= *c3d(10|15|20)", path.read_text(errors="replace")):
                continue
            answer = reduce(program, path, folder)
            if isinstance(answer, str):
                print(f"{path.name}\trefused\t{answer[:160]}", flush=True)
                continue
            report, unit, density = answer
            other = of_calculix(reduced(path, density), folder)
            if isinstance(other, str):
                print(f"{path.name}\tccx\t{' '.join(other.split())[:160]}", flush=True)
                continue
            ours = sorted(report["frequencies"])[: len(other)]
            apart = max(abs(a / b - 1) for a, b in zip(ours, other))
            kinds = sorted({p["TYPE"].upper() for n, p, _ in cards(path) if n == "ELEMENT" and p["TYPE"].upper().startswith("C3D")})
            print(f"{path.name}\t{apart:.1e}\t{' '.join(kinds)}\t{unit}\t{ours[0]:.6g}\t{other[0]:.6g}", flush=True)


if __name__ == "__main__":
    main()
