# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""What is asked of an ensemble."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _convert, _ensemble_abi, request
from .request import Request
from .vocabulary import Choice, quantity_of


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
    """speed, direction, model-force, model-compliance, model-yield, model-friction, friction of the contact; site,
    young, poisson, density, radius, yield, damping of a body."""
    distribution: Distribution = Distribution.CONSTANT
    first: Union[float, str] = 0.0
    """Constant: the value; uniform: the lowest; others: the mean. SI units, or a text with a unit: "70GPa"."""
    second: Union[float, str] = 0.0
    """Uniform: the highest; others: the deviation."""
    lower: Union[float, str] = math.nan
    upper: Union[float, str] = math.nan
    """Where it is cut off; nan: nowhere."""
    body: str = ""
    """Its id; empty: of the contact."""
    values: Optional[ArrayLike] = None
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


def fill(question: Ensemble) -> tuple[_ensemble_abi.Request, list[Any]]:
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
    target.distribution = one.distribution
    for member in ("first", "second", "lower", "upper"):
        value = _convert.number(f"{path}.{member}", getattr(one, member), quantity_of(one.name))
        setattr(target, member, value)
    if one.values is None:
        return None
    values = np.ascontiguousarray(one.values, dtype=np.float64)
    target.values, target.value_count = values.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), values.size
    return values
