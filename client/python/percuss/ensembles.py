# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Many impacts with uncertain inputs: the restitution as a distribution.

    question = percuss.Ensemble(
        percuss.contact_pair(bodies["steel-sphere"], bodies["al-beam"], speed=0.25),
        [percuss.Input("speed", percuss.Distribution.UNIFORM, 0.1, 0.4)],
        samples=10000,
    )
    reply = percuss.ensemble(question, client)                 # a Client or a Local
    reply = percuss.ensemble(question, local, executor=pool)   # a Local, and whoever solves the samples

SI units; undefined numbers are nan.
"""

import ctypes
import math
import pickle
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _abi, _convert, _ensemble_abi, request
from . import local as in_process
from .client import Client
from .errors import CallError, InvalidArgument, check
from .local import Local
from .request import FloatArray, Request
from .reply import Timing
from .vocabulary import Choice, Result, Status


class Distribution(Choice):
    """What an input's numbers say."""

    CONSTANT = 0
    UNIFORM = 1
    NORMAL = 2
    LOG_NORMAL = 3
    LIST = 4


class Sampling(Choice):
    """How samples are drawn."""

    PLAIN = 0
    LATIN_HYPERCUBE = 1
    SOBOL = 2


@dataclass
class Input:
    """One uncertain input."""

    name: str
    """speed, direction, model-force, model-compliance, model-yield of the contact; site, young, poisson, density,
    radius, yield, damping of a body."""
    distribution: Distribution = Distribution.CONSTANT
    first: float = 0.0
    """Constant: the value; uniform: the lowest; others: the mean."""
    second: float = 0.0
    """Uniform: the highest; others: the deviation."""
    lower: float = math.nan
    upper: float = math.nan
    """Where it is cut off; nan: nowhere."""
    body: str = ""
    """Its id; empty: of the contact."""
    values: ArrayLike | None = None
    """Of a list."""


@dataclass
class Correlation:
    """Of two inputs, by a Gaussian copula."""

    first: int
    second: int
    """Indices of the inputs."""
    coefficient: float


@dataclass
class Ensemble:
    """What is asked."""

    scene: Request
    inputs: Sequence[Input]
    samples: int = 1000
    """At most; 0: the values of the lists side by side, each once."""
    seed: int = 1
    sampling: Sampling = Sampling.PLAIN
    correlations: Sequence[Correlation] = ()
    half_width: float = 0.0
    """Stop when the mean's 95 % interval is within; 0: never."""
    quantile_half_width: float = 0.0
    quantiles: Sequence[float] = ()
    """Their probabilities; empty: a default set."""
    bins: int = 0
    contact: int = 0
    """The one that is looked at."""
    list_samples: bool = False
    """Also hand over every sample: EnsembleReply.rows."""
    sequence: int = 0


@dataclass(frozen=True)
class Statistic:
    """One quantity of the impacts, with 95 % intervals."""

    quantity: str
    count: int
    mean: float
    mean_low: float
    mean_high: float
    standard_deviation: float
    standard_deviation_low: float
    standard_deviation_high: float
    skewness: float
    lowest: float
    highest: float
    probabilities: FloatArray
    quantiles: FloatArray
    quantiles_low: FloatArray
    quantiles_high: FloatArray
    bin_edges: FloatArray
    bin_counts: Any
    curve_values: FloatArray
    """The distribution function."""
    curve_shares: FloatArray


@dataclass(frozen=True)
class InputPart:
    """The restitution along one part of the range of an input."""

    low: float
    high: float
    count: int
    mean: float
    standard_deviation: float
    local: float
    chaotic: bool


@dataclass(frozen=True)
class Sensitivity:
    """What one input does to the restitution."""

    input: str
    body: str
    first_order: float
    first_order_low: float
    first_order_high: float
    noise: float
    total: float
    total_low: float
    total_high: float
    mean: float
    standard_deviation: float
    lowest: float
    highest: float
    resolution: float
    parts: tuple[InputPart, ...]


@dataclass(frozen=True)
class SigmaInterval:
    """Mean and so many deviations on either side, and what they enclose."""

    sigmas: float
    low: float
    high: float
    covered: float
    unphysical: float
    quantile_low: float
    quantile_high: float


@dataclass(frozen=True)
class BetaFit:
    """alpha nan: none fits."""

    low: float
    high: float
    alpha: float
    beta: float
    distance: float
    p_value: float


@dataclass(frozen=True)
class EnsembleCheck:
    """Some samples solved again by the full accuracy search: ensemble - search."""

    count: int
    within: float
    largest: float
    mean_shift: float
    mean_shift_half_width: float
    standard_deviation_shift: float
    quantile_shift: float
    within_low: float
    within_high: float
    unmet: int


@dataclass(frozen=True)
class EnsembleReply:
    """What an ensemble says."""

    status: Status
    message: str
    complete: bool
    """False: cancelled, or a deadline cut it short."""
    samples: int
    requested: int
    refused: int
    truncated: int
    catalogue_revision: str
    version: str
    statistics: dict[str, Statistic]
    """By quantity: restitution, impulse, end_time, peak_force."""
    sub_impact_counts: Any
    """[k]: samples with k sub-impacts."""
    significant_counts: Any
    possible_low: float
    possible_high: float
    """Of the restitution."""
    intervals: tuple[SigmaInterval, ...]
    beta: BetaFit
    sensitivities: tuple[Sensitivity, ...]
    check: EnsembleCheck
    cut: float
    """Hz: modes up to this frequency take part in all samples."""
    step_accuracy: float
    pilots: int
    agreeing: int
    warnings: tuple[str, ...]
    timing: Timing
    rows: FloatArray | None = field(repr=False)
    """A row a sample: inputs, restitution, impulse, end_time, peak_force, sub_impacts, significant, status."""

    @property
    def restitution(self) -> Statistic:
        """That of the restitution."""
        return self.statistics["restitution"]


@dataclass(frozen=True)
class Progress:
    """How far it is; what it says of the restitution so far."""

    done: int
    samples: int
    mean: float
    standard_deviation: float
    half_width: float


Watch = Callable[[Progress], bool | None]


def ensemble(
    question: Ensemble,
    client: Client,
    *,
    executor: Any = None,
    progress: Watch | None = None,
    timeout: float = 60.0,
) -> EnsembleReply:
    """Asks for an ensemble. progress: told a few times a second; returning False cancels, and the reply says what was
    found so far. timeout: s without any progress.

    executor: whoever solves the samples: a dask.distributed.Client, a concurrent.futures.ProcessPoolExecutor or the
    like. `client` is a Local then, and each worker opens one of its own by the same files, which it must see under
    the same names. The reply is the same to the last bit whoever solves them; samples that are lost with a worker
    are solved again, where the executor goes on without him. It waits for workers as long as it takes: `timeout`
    is not looked at."""
    asked, kept = _fill(question)
    answer = _ensemble_abi.Reply()
    watch = _Watching(progress)
    if executor is None:
        code = _abi.library.percuss_solve_ensemble(
            client._open, ctypes.byref(asked), timeout, watch.function, None, ctypes.byref(answer)
        )
        watch.finish(code, None)
    else:
        _solve_shared(question, asked, client, executor, watch, answer)
    del kept
    try:
        return _read(answer)
    finally:
        _abi.library.percuss_ensemble_reply_free(ctypes.byref(answer))


class _Watching:
    """The caller's function as one of C, which knows of no exceptions."""

    def __init__(self, progress: Watch | None) -> None:
        self._progress = progress
        self.problem: BaseException | None = None
        self.function = _ensemble_abi.PROGRESS(self._told)

    def _told(self, _: Any, told: Any) -> bool:
        if self.problem is not None:
            return False
        if self._progress is None:
            return True
        try:
            return self._progress(_convert.read(told[0], Progress)) is not False
        except BaseException as problem:
            self.problem = problem
            return False

    def finish(self, code: int, library: ctypes.CDLL | None) -> None:
        if self.problem is not None:
            raise self.problem
        check(code, library) if library else check(code)


def _fill(question: Ensemble) -> tuple[_ensemble_abi.Request, list[Any]]:
    """The C struct, and what it points to."""
    asked = _ensemble_abi.Request()
    kept: list[Any] = [request.fill(question.scene, asked.scene)]
    for name, given, most in (
        ("inputs", question.inputs, _ensemble_abi.MAX_INPUTS),
        ("correlations", question.correlations, _ensemble_abi.MAX_CORRELATIONS),
        ("quantiles", question.quantiles, _ensemble_abi.MAX_QUANTILES),
    ):
        if len(given) > most:
            raise ValueError(f"{name}: {len(given)} are too many; up to {most} are allowed")
    asked.input_count = len(question.inputs)
    for i, one in enumerate(question.inputs):
        kept.append(_fill_input(one, asked.inputs[i], f"inputs[{i}]"))
    asked.correlation_count = len(question.correlations)
    for i, pair in enumerate(question.correlations):
        asked.correlations[i] = _ensemble_abi.Correlation(pair.first, pair.second, pair.coefficient)
    asked.quantile_count = len(question.quantiles)
    for i, probability in enumerate(question.quantiles):
        asked.quantiles[i] = probability
    for name in ("sampling", "samples", "seed", "half_width", "quantile_half_width", "bins", "contact"):
        setattr(asked, name, getattr(question, name))
    asked.list_samples, asked.sequence = question.list_samples, question.sequence
    return asked, kept


def _fill_input(one: Input, target: _ensemble_abi.Input, path: str) -> Any:
    target.name = _convert._plain(f"{path}.name", one.name)
    target.body = _convert._plain(f"{path}.body", one.body)
    target.distribution, target.first, target.second = one.distribution, one.first, one.second
    target.lower, target.upper = one.lower, one.upper
    if one.values is None:
        return None
    values = np.ascontiguousarray(one.values, dtype=np.float64)
    target.values, target.value_count = values.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), values.size
    return values


def _statistic(one: _ensemble_abi.Statistic) -> Statistic:
    lists = {
        name: _convert.array(getattr(one, name), count)
        for names, count in (
            (("probabilities", "quantiles", "quantiles_low", "quantiles_high"), one.quantile_count),
            (("bin_edges",), one.bin_count + 1 if one.bin_count else 0),
            (("bin_counts",), one.bin_count),
            (("curve_values", "curve_shares"), one.curve_count),
        )
        for name in names
    }
    return _convert.read(one, Statistic, **lists)


def _read(answer: _ensemble_abi.Reply) -> EnsembleReply:
    statistics = [_statistic(one) for one in answer.statistics[: answer.statistic_count]]
    columns = answer.column_count
    rows = _convert.array(answer.rows, answer.samples * columns).reshape(-1, columns) if answer.rows else None
    return _convert.read(
        answer,
        EnsembleReply,
        statistics={one.quantity: one for one in statistics},
        sub_impact_counts=_convert.array(answer.sub_impact_counts, answer.count_length),
        significant_counts=_convert.array(answer.significant_counts, answer.count_length),
        warnings=tuple(_convert.text(one) for one in answer.warnings[: answer.warning_count]),
        rows=rows,
    )


# samples solved by others


PATIENCE = 0.005
"""s between two looks at those who solve."""
ATTEMPTS = 5
"""A part that fails so often is not tried again."""
LARGEST_PART = 1024


def _solve_shared(
    question: Ensemble,
    asked: _ensemble_abi.Request,
    client: Client,
    executor: Any,
    watch: _Watching,
    answer: _ensemble_abi.Reply,
) -> None:
    if not isinstance(client, Local):
        raise InvalidArgument(Result.INVALID_ARGUMENT, "client: it asks a server: with an executor it must be a Local")
    library = _share_library()
    deal = _Deal(library, executor, pickle.dumps(question), client, watch)
    code = library.percuss_solve_ensemble_shared(
        client._open, ctypes.byref(asked), deal.function, watch.function, None, ctypes.byref(answer)
    )
    watch.finish(code, library)


def _share_library() -> ctypes.CDLL:
    library = in_process._load()
    if not hasattr(library, "_percuss_shares"):
        _ensemble_abi.declare(library, _ensemble_abi.SHARE_FUNCTIONS)
        setattr(library, "_percuss_shares", True)
    return library


class _Deal:
    """Hands out parts of ranges and takes them back."""

    def __init__(self, library: ctypes.CDLL, executor: Any, question: bytes, client: Local, watch: _Watching) -> None:
        self._library, self._executor, self._question, self._watch = library, executor, question, watch
        self._files = (client.settings_file, client.catalogue_file)
        self.function = _ensemble_abi.SHARE(self._share)

    def _share(self, _: Any, sharing: Any, asked: Any) -> None:
        try:
            self._hand_out(sharing, asked[0])
        except BaseException as problem:
            self._watch.problem = self._watch.problem or problem

    def _submit(self, piece: tuple[int, int, bool, int]) -> Any:
        # what dask would otherwise take for a pure function of its arguments, it may still remember
        options = {"pure": False} if hasattr(self._executor, "scheduler_info") else {}
        return self._executor.submit(solve_part, self._files, self._question, piece, **options)

    def _hand_out(self, sharing: Any, asked: _ensemble_abi.Range) -> None:
        size = max(1, min(LARGEST_PART, asked.count // 64))
        end = asked.first + asked.count
        waiting = {}
        for first in range(asked.first, end, size):
            piece = (first, min(size, end - first), bool(asked.extras), asked.done)
            waiting[self._submit(piece)] = (piece, 1)
        while waiting:
            done = [future for future in waiting if future.done()]
            for future in done:
                piece, attempt = waiting.pop(future)
                part = self._part_of(future, attempt)
                if part is None:
                    waiting[self._submit(piece)] = (piece, attempt + 1)
                elif not self._take(sharing, part):
                    for left in waiting:
                        left.cancel()
                    return
            if not done:
                time.sleep(PATIENCE)

    @staticmethod
    def _part_of(future: Any, attempt: int) -> bytes | None:
        """What was solved; None: it was lost with whoever solved it, and is to be solved again."""
        try:
            part: bytes = future.result()
            return part
        except CallError:
            raise
        except Exception:
            if attempt >= ATTEMPTS:
                raise
            return None

    def _take(self, sharing: Any, part: bytes) -> bool:
        code: int = self._library.percuss_ensemble_take(sharing, part, len(part))
        if code == Result.PENDING:
            return False
        check(code, self._library)
        return True


class _Worker:
    """Of one thread of a process that solves parts of one ensemble."""

    def __init__(self, files: tuple[str | None, str | None], question: bytes) -> None:
        self.library = _share_library()
        self.client = Local(settings=files[0], catalogue=files[1])
        self.asked, self.kept = _fill(pickle.loads(question))
        self.handle = ctypes.c_void_p()
        check(
            self.library.percuss_ensemble_worker_create(
                self.client._open, ctypes.byref(self.asked), ctypes.byref(self.handle)
            ),
            self.library,
        )

    def close(self) -> None:
        handle, self.handle = self.handle, ctypes.c_void_p()
        self.library.percuss_ensemble_worker_free(handle)
        self.client.close()

    def __del__(self) -> None:
        # its thread has ended; nothing was created where the ensemble was refused
        if getattr(self, "handle", None):
            self.close()


_mine = threading.local()


def solve_part(files: tuple[str | None, str | None], question: bytes, piece: tuple[int, int, bool, int]) -> bytes:
    """What an executor's worker runs: solves a piece (first, count, extras, done) of a pickled Ensemble, and returns
    its octets. Settings and catalogue are files that the worker sees; what it has prepared it keeps for the next."""
    key = (files, question)
    if getattr(_mine, "key", None) != key:
        if hasattr(_mine, "worker"):
            _mine.worker.close()
            del _mine.worker
        _mine.worker, _mine.key = _Worker(files, question), key
    worker: _Worker = _mine.worker
    wanted = _ensemble_abi.Range(*piece)
    part = ctypes.create_string_buffer(worker.library.percuss_ensemble_part_size(ctypes.byref(wanted)))
    check(
        worker.library.percuss_ensemble_worker_solve(worker.handle, ctypes.byref(wanted), part), worker.library
    )
    return part.raw
