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

from __future__ import annotations

import ctypes
from typing import Any

from . import _abi, _ensemble_abi, ensemble_reply, ensemble_request
from .client import Client
from .ensemble_reply import (
    BetaFit,
    EnsembleCheck,
    EnsembleReply,
    InputPart,
    Sensitivity,
    SigmaInterval,
    Statistic,
)
from .ensemble_request import Correlation, Distribution, Ensemble, Input, Sampling
from .ensemble_share import Progress, Watch, Watching, solve_shared

__all__ = [
    "BetaFit",
    "Correlation",
    "Distribution",
    "Ensemble",
    "EnsembleCheck",
    "EnsembleReply",
    "Input",
    "InputPart",
    "Progress",
    "Sampling",
    "Sensitivity",
    "SigmaInterval",
    "Statistic",
    "Watch",
    "ensemble",
]


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
    asked, kept = ensemble_request.fill(question)
    answer = _ensemble_abi.Reply()
    try:
        with Watching(progress, executor is not None) as watch:
            if executor is None:
                code = _abi.library.percuss_solve_ensemble(
                    client._open, ctypes.byref(asked), timeout, watch.function, None, ctypes.byref(answer)
                )
                watch.finish(code, None, client)
            else:
                solve_shared(question, asked, client, executor, watch, answer)
        del kept
        return ensemble_reply.read(answer, question)
    finally:
        _abi.library.percuss_ensemble_reply_free(ctypes.byref(answer))
