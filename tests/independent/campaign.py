# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Random blows on blocks, cylinders and beams: percuss in process against references of its own (README.md).

campaign.py [--class WORD] [--seed N] [--count N] [--first N] [--jobs N]    blows of each class; the table
campaign.py --record FILE ...    also writes the references
campaign.py --data FILE ...      judges by those that are recorded, in a minute and without scipy
--list                           tells of every blow, not only of those outside the error

Exit code 1: less than 95 % of a class are covered, an answer is met and wrong, or one was refused."""

import argparse
import csv
import multiprocessing
import os
import statistics
import sys
import tempfile
import time
import warnings
from pathlib import Path

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(name, "1")

import percuss  # noqa: E402
import scenes  # noqa: E402


def body_text(scene):
    beam = scene.kind.startswith(("beam", "strip"))
    if scene.shape == "cylinder":
        return f"shape: {'beam' if beam else 'cylinder'}, radius: {scene.size[0]!r}, length: {scene.size[1]!r}"
    if beam:
        return f"shape: beam, length: {scene.size[0]!r}, section: {{width: {scene.size[1]!r}, height: {scene.size[2]!r}}}"
    return f"shape: block, size: [{', '.join(map(repr, scene.size))}]"


def material_text(one):
    return f"{{young: {one['young']!r}, poisson: {one['poisson']!r}, density: {one['density']!r}, yield: none}}"


def catalogue(blows):
    lines = ["materials:"]
    for s in blows:
        lines += [f"  m-{s.name}: {material_text(s.material)}", f"  n-{s.name}: {material_text(s.ball)}"]
    lines.append("bodies:")
    for s in blows:
        lines += [
            f"  b-{s.name}: {{{body_text(s)}, material: m-{s.name}}}",
            f"  s-{s.name}: {{shape: sphere, material: n-{s.name}, radius: {s.radius!r}}}",
        ]
    return "\n".join(lines) + "\n"


def ask(blows):
    """Replies, in process."""
    replies = []
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        file = Path(folder) / "catalogue.yaml"
        file.write_text(catalogue(blows))
        with percuss.Local(file) as local:
            for s in blows:
                centre = [a + s.radius * n for a, n in zip(s.at, s.normal)]
                motion = percuss.BodyMotion(f"s-{s.name}", position=centre, velocity=[-s.speed * n for n in s.normal])
                request = percuss.Request([motion, percuss.BodyMotion(f"b-{s.name}")], [percuss.Contact(0, 1, s.at, s.normal)])
                request.options.tolerance = s.tolerance
                replies.append(local.solve(request))
    return replies


def references(blows):
    """Of the blows on one body: (restitution, error, sub-impacts); None: it is not known."""
    import impact
    import reference

    first, found = blows[0], []
    budget = 1800 if first.kind in ("strip", "block-8") else 1000
    body = reference.body_of(first.shape, first.size, first.material["poisson"], budget)
    for s in blows:
        try:
            found.append(reference.restitution(body, s.at, s.normal, s.material, s.ball, s.radius, s.speed))
        except impact.Unsettled:
            found.append(None)
    return found


def judge(task):
    """A body: a row for each blow."""
    seed, kind, number, count, recorded = task
    blows = scenes.draw(seed, kind, number)[:count]
    right = references(blows) if recorded is None else [recorded.get(s.name) for s in blows]
    begin = time.time()
    replies = ask(blows)
    asked = (time.time() - begin) / len(blows)
    rows = []
    for s, reply, known in zip(blows, replies, right):
        row = {"scene": s, "right": known, "asked": asked, "status": reply.status.name, "e": None}
        rows.append(row)
        contact = reply.contacts[0] if len(reply.contacts) else None
        if contact is None or contact.restitution != contact.restitution:
            continue
        error = reply.error
        row.update(e=contact.restitution, total=error.restitution_total, met=error.total_met, model=error.restitution_model,
                   modes=error.restitution_modes, hits=contact.sub_impact_count)
        row["difference"] = abs(row["e"] - known[0]) if known else None
    return rows


def verdict(row):
    """A reference that is less sure than the answer judges nothing."""
    if row["e"] is None:
        return "refused"
    tolerance = row["scene"].tolerance
    if row["right"] is None or row["right"][1] > max(tolerance, row["total"], row["difference"]) / 3:
        return "unknown"
    error = row["right"][1]
    if row["met"] and row["difference"] > tolerance + error:
        return "wrong"
    return "outside" if row["difference"] > row["total"] + error else "covered"


def tell(row):
    s, m, b = row["scene"], row["scene"].material, row["scene"].ball
    if row["e"] is None:
        return f"refused  {s.name} {row['status']}"
    right = f"{row['right'][0]:.6f} +- {row['right'][1]:.6f}, {row['right'][2]} hits" if row["right"] else "unknown"
    size = " x ".join(f"{1e3 * v:.4g}" for v in s.size)
    at = ", ".join(f"{1e3 * v:.4g}" for v in s.at)
    return (
        f"{verdict(row):8} {s.name} {row['e']:.6f} +- {row['total']:.2g} (model {row['model']:.2g}, modes {row['modes']:.2g}), "
        f"{row['hits']} hits, {'met' if row['met'] else 'not met'} at {s.tolerance:g}; right {right}; {size} mm at {at}; "
        f"{m['young'] / 1e9:.3g} GPa {m['poisson']:.3f} {m['density']:.0f}; "
        f"ball {1e3 * s.radius:.4g} mm {b['young'] / 1e9:.3g} GPa {b['poisson']:.3f} {b['density']:.0f}; {s.speed:.4g} m/s"
    )


def table(rows):
    """Prints it; whether it is as it should be."""
    print("| scenes | drawn | judged | covered | met | met and wrong | median error stated | median difference | largest |\n|---|---|---|---|---|---|---|---|---|")
    good = True
    for kind, text in scenes.CLASSES.items():
        of = [r for r in rows if r["scene"].kind == kind]
        judged = [r for r in of if verdict(r) not in ("refused", "unknown")]
        if not of:
            continue
        good &= len(judged) > 0 and all(verdict(r) != "refused" for r in of)
        if not judged:
            print(f"| {text} | {len(of)} | 0 | | | | | | |")
            continue
        covered = sum(r["difference"] <= r["total"] + r["right"][1] for r in judged)
        wrong = sum(verdict(r) == "wrong" for r in judged)
        print(
            f"| {text} | {len(of)} | {len(judged)} | {100 * covered / len(judged):.3g} % | {sum(r['met'] for r in judged)} | {wrong} | "
            f"{statistics.median(r['total'] for r in judged):.1g} | {statistics.median(r['difference'] for r in judged):.1g} | "
            f"{max(r['difference'] for r in judged):.2g} |"
        )
        good &= wrong == 0 and covered >= 0.95 * len(judged)
    verdicts = [verdict(r) for r in rows]
    print(f"{len(rows)} blows, {verdicts.count('unknown')} not judged, {verdicts.count('refused')} refused; "
          f"{statistics.mean(r['asked'] for r in rows):.3f} s each in percuss")
    return good


def read_recorded(path):
    with open(path, newline="") as file:
        lines = [line for line in csv.reader(file) if line and not line[0].startswith("#")]
    return {name: (float(e), float(error), int(hits)) if e else None for name, e, error, hits in lines[1:]}


def record(path, rows):
    with open(path, "a", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if file.tell() == 0:
            file.write("# campaign.py --record: class-seed-body-blow of scenes.py; empty: the reference does not know it\n")
            writer.writerow(["scene", "restitution", "error", "sub_impacts"])
        for r in rows:
            right = r["right"]
            writer.writerow([r["scene"].name, *((f"{right[0]:.6f}", f"{right[1]:.6f}", right[2]) if right else ("", "", 0))])


def tasks_of(given):
    """(seed, class, body, blows, references or None)"""
    kinds = given.kind or list(scenes.CLASSES)
    if not given.data:
        bodies = -(-given.count // scenes.BLOWS)
        blows = -(-given.count // bodies)
        return [(given.seed, kind, given.first + n, blows, None) for kind in kinds for n in range(bodies)]
    recorded = read_recorded(given.data)
    of = {}
    for name in recorded:
        kind, seed, number, _ = name.rsplit("-", 3)
        of.setdefault((int(seed), kind, int(number)), {})[name] = recorded[name]
    return [(*key, len(known), known) for key, known in of.items() if key[1] in kinds]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--class", dest="kind", choices=scenes.CLASSES, action="append")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=20, help="blows of a class")
    parser.add_argument("--first", type=int, default=0, help="body")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--record")
    parser.add_argument("--data")
    given = parser.parse_args()
    rows = []
    with multiprocessing.Pool(given.jobs, maxtasksperchild=8) as pool:
        for found in pool.imap(judge, tasks_of(given)):
            rows += found
            for row in found:
                if given.list or verdict(row) in ("refused", "outside", "wrong"):
                    print(tell(row), flush=True)
    if given.record:
        record(given.record, rows)
    return 0 if table(rows) else 1


if __name__ == "__main__":
    sys.exit(main())
