# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Samples of an ensemble solved by others: threads, processes, the workers of a cluster."""

from __future__ import annotations

import ctypes
import pickle
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Optional

from . import _convert, _ensemble_abi
from . import local as in_process
from .client import Client
from .ensemble_request import Ensemble, fill
from .errors import CallError, InvalidArgument, check
from .local import Local
from .vocabulary import Result


@dataclass(frozen=True)
class Progress:
    """How far it is; what it says of the restitution so far."""

    done: int
    samples: int
    mean: float
    standard_deviation: float
    half_width: float


Watch = Callable[[Progress], Optional[bool]]


class Watching:
    """The caller's function as one of C, which knows of no exceptions."""

    def __init__(self, progress: Watch | None, shared: bool) -> None:
        self._progress = progress
        self._refused = False
        self.problem: BaseException | None = None
        # who asks for no progress hears nothing but signals
        self.function = _ensemble_abi.PROGRESS(self._told) if progress or shared else _ensemble_abi.PROGRESS()

    def __enter__(self) -> "Watching":
        self._hook = sys.unraisablehook
        if threading.current_thread() is threading.main_thread():
            sys.unraisablehook = self._unraisable
        return self

    def __exit__(self, *_: Any) -> None:
        if sys.unraisablehook == self._unraisable:
            sys.unraisablehook = self._hook

    def _unraisable(self, what: Any) -> None:
        """A signal's handler has raised before the first line of _told, where nothing catches it. What _told then
        returns to C is by chance; the next time it ends the call."""
        if what.object == self._told:
            self.problem = self.problem or what.exc_value
        else:
            self._hook(what)

    def _told(self, _: Any, told: Any) -> bool:
        if self.problem is not None:
            return False
        try:
            self._refused = self._progress is not None and self._progress(_convert.read(told[0], Progress)) is False
        except BaseException as problem:
            self.problem = problem
        return not self._refused and self.problem is None

    def finish(self, code: int, library: ctypes.CDLL | None, client: Client) -> None:
        client._settle()
        if self.problem is not None:
            raise self.problem
        check(code, library) if library else check(code)


PATIENCE = 0.005
"""s between two looks at those who solve."""
ATTEMPTS = 5
"""A part that fails so often is not tried again."""
LARGEST_PART = 1024


def solve_shared(
    question: Ensemble,
    asked: _ensemble_abi.Request,
    client: Client,
    executor: Any,
    watch: Watching,
    answer: _ensemble_abi.Reply,
) -> None:
    if not isinstance(client, Local):
        raise InvalidArgument(Result.INVALID_ARGUMENT, "client: it asks a server: with an executor it must be a Local")
    library = _share_library()
    deal = _Deal(library, executor, pickle.dumps(question), client, watch)
    code = library.percuss_solve_ensemble_shared(
        client._open, ctypes.byref(asked), deal.function, watch.function, None, ctypes.byref(answer)
    )
    watch.finish(code, library, client)


def _share_library() -> ctypes.CDLL:
    library = in_process._load()
    if not hasattr(library, "_percuss_shares"):
        _ensemble_abi.declare(library, _ensemble_abi.SHARE_FUNCTIONS)
        setattr(library, "_percuss_shares", True)
    return library


class _Deal:
    """Hands out parts of ranges and takes them back."""

    def __init__(self, library: ctypes.CDLL, executor: Any, question: bytes, client: Local, watch: Watching) -> None:
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
        self.asked, self.kept = fill(pickle.loads(question))
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
