# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""One ensemble by 1 to 16 workers of each kind, questions to 1 to 16 daemons, and a simulation of 1,000 workers, whose
numbers are measured here: tables for docs/lab/workers.md on standard output.

usage: workers.py SOURCE BUILD FOLDER      PERCUSS_LIBRARY, and PYTHONPATH with client/python
"""

from __future__ import annotations

import concurrent.futures
import heapq
import os
import random
import re
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, Callable

import percuss
from percuss import ensemble_share

SOURCE, BUILD, FOLDER = (Path(word) for word in sys.argv[1:4])
CORES = os.cpu_count() or 1
WORKERS = (1, 2, 4, 8, 16)
TIMES = 3  # of which the fastest counts
LIGHT = "speed alone"
HEAVY = "five inputs"
SAMPLES = {LIGHT: 100_000, HEAVY: 10_000}
INPUTS = (
    ("young@al-beam", "normal:70e9:1e9"),
    ("radius@steel-sphere", "normal:0.015:0.00005"),
    ("site@al-beam", "normal:0.5:0.001"),
    ("damping@al-beam", "log-normal:0.002:0.001"),
)


def say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def settings(workers: int) -> Path:
    file = FOLDER / f"settings-{workers}.yaml"
    file.write_text(f"catalogue: {SOURCE}/config/catalogue.yaml\nworkers: {workers}\n")
    return file


# ---- one ensemble ----


def words(load: str, samples: int) -> list[str]:
    asked = ["--a", "steel-sphere", "--b", "al-beam", "--speed", "uniform:0.089:0.411", "--samples", str(samples)]
    if load == HEAVY:
        asked += [f"--input={name}={value}" for name, value in INPUTS]
    return asked


def question(load: str, local: percuss.Local, samples: int) -> percuss.Ensemble:
    bodies, distribution = local.bodies(), percuss.Distribution
    inputs = [percuss.Input("speed", distribution.UNIFORM, 0.089, 0.411)]
    if load == HEAVY:
        kinds = {"normal": distribution.NORMAL, "log-normal": distribution.LOG_NORMAL}
        for name, value in INPUTS:
            kind, mean, deviation = value.split(":")
            quantity, body = name.split("@")
            inputs.append(percuss.Input(quantity, kinds[kind], float(mean), float(deviation), body=body))
    return percuss.Ensemble(
        percuss.contact_pair(bodies["steel-sphere"], bodies["al-beam"], speed=0.25), inputs, samples=samples
    )


def by_command(command: list[str]) -> float:
    """s that it says its samples took."""
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    found = re.search(r"samples +\d+ in ([0-9.e+-]+) s", text)
    assert found, text
    return float(found[1])


def by_threads(load: str, workers: int) -> float:
    program = [str(BUILD / "bin/percuss"), "ensemble", "--local", "--config", str(settings(workers))]
    return by_command(program + words(load, SAMPLES[load]))


def by_mpi(load: str, workers: int) -> float:
    program = ["mpirun", "--oversubscribe", "-n", str(workers), str(BUILD / "bin/percuss-ensemble")]
    return by_command(program + ["--config", str(settings(1))] + words(load, SAMPLES[load]))


def by_dask(load: str, workers: int) -> float:
    import distributed

    cluster: Any = distributed.LocalCluster
    with percuss.Local(settings=settings(1)) as local, cluster(
        n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=None
    ) as all_workers, distributed.Client(all_workers) as client:  # type: ignore[no-untyped-call]
        asked = question(load, local, SAMPLES[load])
        # prepares the workers, as a program's first ensemble would
        percuss.ensemble(question(load, local, 64 * workers), local, executor=client)
        began = time.monotonic()
        percuss.ensemble(asked, local, executor=client)
        return time.monotonic() - began


def by_daemons(_: str, workers: int) -> float:
    """s for SAMPLES[LIGHT] questions: each daemon with one client of its own, which has 64 of them out."""
    each = SAMPLES[LIGHT] // 4 // workers
    command = [str(BUILD / "tests/bench/round_trip"), "--throughput", "--csv", "--scene", "beam-1e-3"]
    command += ["--clients", "1", "--trips", str(each), "--config", str(settings(1))]
    running = [
        subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) for _ in range(workers)
    ]
    rate = 0.0
    for process in running:
        out = process.communicate(timeout=120)[0]
        rate += sum(float(line.split(",")[4]) for line in out.splitlines() if ",pipeline," in line)
        assert process.returncode == 0
    return SAMPLES[LIGHT] / rate


WAYS: list[tuple[str, str, Callable[[str, int], float]]] = [
    ("threads of one process", LIGHT, by_threads),
    ("MPI", LIGHT, by_mpi),
    ("Dask", LIGHT, by_dask),
    ("daemons, single questions", LIGHT, by_daemons),
    ("threads of one process", HEAVY, by_threads),
    ("MPI", HEAVY, by_mpi),
    ("Dask", HEAVY, by_dask),
]


def measured() -> None:
    print(f"| samples, or answers, a second ({CORES} cores) | " + " | ".join(map(str, WORKERS)) + " workers |")
    print("|---|" + "---|" * len(WORKERS))
    for name, load, run in WAYS:
        rates = []
        for workers in WORKERS:
            rates.append(SAMPLES[load] / min(run(load, workers) for _ in range(TIMES)))
            say(f"workers: {name}, {load}, {workers}: {rates[-1]:.0f} a second")
        shares = [rate / rates[0] / min(workers, CORES) for workers, rate in zip(WORKERS, rates)]
        cells = [f"{rate:,.0f} ({100 * share:.0f} %)".replace(",", " ") for rate, share in zip(rates, shares)]
        what = name if name.startswith("daemons") else f"{name}, {load}"
        print(f"| {what} | " + " | ".join(cells) + " |")


# ---- a thousand ----


class Inline:
    """An executor that solves at once, and notes the processor time of each part: (items, extras or not, s)."""

    def __init__(self) -> None:
        self.parts: list[tuple[int, bool, float]] = []

    def submit(self, function: Any, files: Any, asked: Any, piece: Any) -> "concurrent.futures.Future[bytes]":
        began = time.thread_time()
        future: "concurrent.futures.Future[bytes]" = concurrent.futures.Future()
        future.set_result(function(files, asked, piece))
        self.parts.append((piece[1], piece[2], time.thread_time() - began))
        return future


class Run:
    """An ensemble of `samples` solved in this thread: processor time of its parts, of taking them, and of all else."""

    def __init__(self, load: str, samples: int) -> None:
        self.takes = 0.0
        library = ensemble_share._share_library()
        plain = library.percuss_ensemble_take

        def timed(*arguments: Any) -> int:
            began = time.thread_time()
            code: int = plain(*arguments)
            self.takes += time.thread_time() - began
            return code

        with percuss.Local(settings=settings(1)) as local:
            asked, inline = question(load, local, samples), Inline()
            library.percuss_ensemble_take = timed
            began = time.thread_time()
            percuss.ensemble(asked, local, executor=inline)
            whole = time.thread_time() - began
            library.percuss_ensemble_take = plain
        # the first part of all makes the worker
        self.start = inline.parts[0][2]
        self.samples = [part for part in inline.parts[1:] if not part[1]]
        self.extras = [part for part in inline.parts if part[1]]
        self.alone = whole - self.takes - sum(part[2] for part in inline.parts)


def mean(parts: list[tuple[int, bool, float]]) -> float:
    return sum(part[2] for part in parts) / max(1, sum(part[0] for part in parts))


class Measured:
    """What one ensemble of a load costs, s: all that does not grow with the samples is `fixed`, what the first process
    alone does for one of them is `alone`: the least of some runs each, as it is a small part of all."""

    def __init__(self, load: str) -> None:
        few = min((Run(load, SAMPLES[load] // 4) for _ in range(TIMES)), key=lambda run: run.alone)
        many = min((Run(load, SAMPLES[load]) for _ in range(TIMES)), key=lambda run: run.alone)
        self.sample = mean(many.samples)
        self.extras, self.extra = sum(part[0] for part in many.extras), mean(many.extras)
        self.take = many.takes / sum(part[0] for part in many.samples + many.extras)
        self.alone = max(0.0, (many.alone - few.alone) / (SAMPLES[load] - SAMPLES[load] // 4))
        self.fixed = max(0.0, many.alone - self.alone * SAMPLES[load])
        # of a sample, from the parts'
        parts = [part for part in many.samples if part[0] == many.samples[0][0]]
        spread = sum((part[2] / part[0] - self.sample) ** 2 for part in parts) / len(parts)
        self.deviation = (spread * parts[0][0]) ** 0.5


OCTETS = 128  # of a sample in a part
NETWORK = 1e9  # octets/s, and
MESSAGE = 20e-6  # s a message: what the first process does for one, assumed
LARGEST, EACH, AHEAD = 1024, 16, 2  # client/mpi/main.c
MILLION = 1_000_000


def spread_range(count: int, each: float, deviation: float, take: float, workers: int, chance: random.Random) -> float:
    """s for a range: `workers` processes beside the first, which hands out parts and takes them one after the other.
    Each has two at a time, so that it waits only where the first process is behind."""
    size = min(LARGEST, 1 + count // (EACH * (workers + 1)))
    left, first, ended = count, 0.0, [0.0] * workers
    coming: list[tuple[float, int, int]] = []  # when a part is ready, whose, how large

    def give(worker: int, now: float) -> None:
        nonlocal left
        n = min(size, left)
        left -= n
        if n:
            took = max(chance.gauss(n * each, n**0.5 * deviation), 0.1 * n * each)
            ended[worker] = max(ended[worker], now) + took
            heapq.heappush(coming, (ended[worker], worker, n))

    for _ in range(AHEAD):
        for worker in range(workers):
            first += MESSAGE
            give(worker, first)
    while coming:
        ready, worker, n = heapq.heappop(coming)
        first = max(first, ready) + 2.0 * MESSAGE + n * (take + OCTETS / NETWORK)
        give(worker, first)
    return first


def simulated(load: str, cost: Measured) -> list[str]:
    work = MILLION * (cost.sample + cost.alone + cost.take) + cost.extras * cost.extra + cost.fixed
    row = []
    for workers in (2, 16, 64, 256, 1000):
        chance = random.Random(workers)
        # each process makes a worker of its own, as the first does, at the same time
        whole = cost.fixed + cost.alone * MILLION
        whole += spread_range(MILLION, cost.sample, cost.deviation, cost.take, workers, chance)
        whole += spread_range(cost.extras, cost.extra, cost.extra, cost.take, workers, chance)
        row.append(f"{whole:{'.0f' if whole >= 10 else '.2g'}} s ({100 * work / whole / workers:.0f} %)")
    return row


def thousand() -> None:
    print(
        "\n| measured for the simulation, µs | a sample | its deviation | an extra solution (how many) "
        "| taking a sample | reporting it | all else |"
    )
    print("|---|---|---|---|---|---|---|")
    costs = {load: Measured(load) for load in SAMPLES}
    for load, cost in costs.items():
        cells = (cost.sample, cost.deviation, cost.extra, cost.take, cost.alone, cost.fixed)
        sample, deviation, extra, take, alone, fixed = (1e6 * cell for cell in cells)
        print(
            f"| {load} | {sample:.1f} | {deviation:.1f} | {extra:.0f} ({cost.extras}) | {take:.2f} | {alone:.2f} "
            f"| {fixed:.0f} |"
        )
    print("\n| simulated: a million samples by MPI, workers | 2 | 16 | 64 | 256 | 1000 |")
    print("|---|---|---|---|---|---|")
    for load, cost in costs.items():
        print(f"| {load} | " + " | ".join(simulated(load, cost)) + " |")


if __name__ == "__main__":
    measured()
    thousand()
