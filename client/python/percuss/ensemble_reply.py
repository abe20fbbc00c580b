# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""What an ensemble says."""

from __future__ import annotations

import copy
from dataclasses import dataclass, field
from typing import Any, Optional

import numpy as np

from . import _convert, _ensemble_abi, _page, _plots, _tables
from .ensemble_request import Ensemble
from .request import FloatArray
from .reply import Timing
from .vocabulary import Status


_RESULTS = ("restitution", "impulse", "end_time", "peak_force", "sub_impacts", "significant", "status")
# of contacts with friction
_TANGENTIAL = ("impulse_tangential_1", "impulse_tangential_2", "tangential_restitution", "restitution_kinematic")


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
    """What one input does to the restitution, or to a tangential impulse."""

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
    quantity: str
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
    """By quantity: restitution, impulse, end_time, peak_force; with friction also impulse_tangential_1 and _2 (on A,
    along the tangents that a reply has), tangential_restitution, restitution_kinematic."""
    sub_impact_counts: Any
    """[k]: samples with k sub-impacts."""
    significant_counts: Any
    possible_low: float
    possible_high: float
    """Of the restitution."""
    intervals: tuple[SigmaInterval, ...]
    beta: BetaFit
    sensitivities: tuple[Sensitivity, ...]
    tangential_sensitivities: tuple[Sensitivity, ...]
    """With friction: of each tangential impulse that varies."""
    check: EnsembleCheck
    cut: float
    """Hz: modes up to this frequency take part in all samples."""
    step_accuracy: float
    pilots: int
    agreeing: int
    warnings: tuple[str, ...]
    timing: Timing
    rows: Optional[FloatArray] = field(repr=False)
    """A row a sample: inputs, restitution, impulse, end_time, peak_force, sub_impacts, significant, status; with
    friction also the other quantities of the statistics."""
    columns: tuple[str, ...] = field(repr=False)
    """Of the rows; an input of a body is called young@al-beam."""
    question: Optional[Ensemble] = field(default=None, repr=False, compare=False)
    """What was asked."""

    @property
    def restitution(self) -> Statistic:
        """That of the restitution."""
        return self.statistics["restitution"]

    def to_dataframe(self) -> Any:
        """A row a sample: the inputs, restitution, impulse, end_time, peak_force, sub_impacts, significant, status."""
        if self.rows is None:
            raise ValueError("list_samples: False: with True in the question the samples are handed over")
        columns: dict[str, Any] = dict(zip(self.columns, self.rows.T))
        for name in ("sub_impacts", "significant"):
            columns[name] = columns[name].astype(np.int64)
        columns["status"] = [Status(int(number)).name for number in columns["status"]]
        return _tables.frame(columns)

    def plot(self, figure: Any = None) -> Any:
        """Draws the distribution of the restitution; with list_samples its samples over the first input, too.

        Returns a matplotlib Figure of its own (`.savefig`, or a notebook's last line), or the given one drawn into."""
        return _plots.ensemble(self, figure)

    def to_html(self, title: str = "") -> _page.Page:
        """The page that `percuss ensemble --html` writes: the distribution of the restitution, what causes its spread, with
        list_samples the first 4000 samples; needs no network. A str, which a notebook shows.

        ValueError of a refusal, which has no numbers."""
        if self.question is None or not self.statistics:
            raise ValueError(f"to_html: an ensemble without an answer ({self.status}) has no page")
        scene = self.question.scene
        contact = scene.contacts[self.question.contact]
        return _page.ensemble(self, title or f"{scene.bodies[contact.a].id} on {scene.bodies[contact.b].id}")

    def _repr_html_(self) -> str:
        rows = [
            (name, one.mean, one.mean_low, one.mean_high, one.standard_deviation, one.lowest, one.highest)
            for name, one in self.statistics.items()
        ]
        said = f"{self.status}: {self.message}" if self.message else f"{self.status}, {self.samples} samples"
        heads = ["quantity", "mean", "95 % from", "to", "standard deviation", "lowest", "highest"]
        text = _tables.html(said, heads, rows)
        if self.sensitivities:
            text += _tables.html(
                "shares of the restitution's variance",
                ["input", "alone", "with others"],
                [(_name(one.input, one.body), one.first_order, one.total) for one in self.sensitivities],
            )
        return text


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


def _name(name: str, body: str) -> str:
    return f"{name}@{body}" if body else name


def read(answer: _ensemble_abi.Reply, question: Ensemble) -> EnsembleReply:
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
        question=copy.deepcopy(question),
        columns=(*(_name(one.name, one.body) for one in question.inputs), *_RESULTS, *_TANGENTIAL)[:columns],
    )
