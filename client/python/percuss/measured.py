# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Measured impacts beside simulated ones, and parameters of bodies from them: libpercuss-measured.

    from percuss import measured

    compared = measured.compare("rig.csv", "steel-sphere", "al-beam", client)       # a Client or a Local
    print(compared.residual_mean, compared.energy_distance.p)
    found = measured.calibrate("rig.csv", "steel-sphere", "al-beam", client, fit=["young:al-beam"])
    print(found.parameters[0].value, found.parameters[0].low, found.parameters[0].high)

Measurements are a file as `percuss compare` reads it, or columns by their names: a mapping, a pandas.DataFrame or
Comparison.measured, with any of speed, restitution, impulse, sub_impacts, first_impulse, first_duration, second_start,
at, restitution_half_width. SI units; nan: not known.
"""

from __future__ import annotations

import ctypes
import itertools
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, fields
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _convert, _plots, _tables
from . import _measured_abi as abi
from . import server as announced
from .client import Client
from .errors import check
from .request import FloatArray, Options
from .server import Body
from .vocabulary import Parameter, Status

_library = abi.library


@dataclass(frozen=True)
class Distance:
    """Of two samples, and how likely one at least as large is if both are of one distribution."""

    value: float
    p: float


@dataclass(frozen=True)
class Impacts:
    """Arrays of one length."""

    speed: FloatArray
    """Of approach, m/s."""
    restitution: FloatArray
    impulse: FloatArray
    """Of all sub-impacts, N s."""
    sub_impacts: FloatArray
    """Counts."""
    first_impulse: FloatArray
    """Of the first sub-impact, N s."""
    first_duration: FloatArray
    """s."""
    second_start: FloatArray
    """Of the second sub-impact of at least 1 % of the impulse, after the start of the first, s."""
    at: FloatArray
    """Place along a beam, 0..1."""
    restitution_half_width: FloatArray
    """Of the 95 % interval of a restitution that was measured."""


_COLUMNS = tuple(one.name for one in fields(Impacts))


@dataclass(frozen=True)
class Comparison:
    """Measured impacts and their simulated twins; means and deviations are those of the restitution."""

    measured_mean: float
    measured_deviation: float
    simulated_mean: float
    simulated_deviation: float
    residual_mean: float
    """Simulated less measured."""
    residual_half_width: float
    """Of the 95 % interval of that mean."""
    residual_rms: float
    kolmogorov_smirnov: Distance
    energy_distance: Distance
    sub_impacts_known: int
    """Impacts whose number of sub-impacts was measured."""
    sub_impacts_equal: int
    """Of these, with as many in the twin."""
    warnings: tuple[str, ...]
    """Of the twins, each kind once."""
    notes: tuple[str, ...]
    """On the file: how it was understood, rows that were left out."""
    measured: Impacts = field(repr=False)
    """Completed by what follows from the masses."""
    simulated: Impacts = field(repr=False)
    status: tuple[Status, ...] = field(repr=False)
    a: str
    b: str

    @property
    def residual(self) -> FloatArray:
        """Of each restitution: simulated less measured."""
        return self.simulated.restitution - self.measured.restitution

    def to_dataframe(self) -> Any:
        """A row an impact, as percuss compare --csv writes it."""
        told = ("restitution", "impulse", "sub_impacts", "first_impulse", "first_duration", "second_start")
        columns = {name: getattr(self.measured, name) for name in ("speed", "at", *told)}
        columns.update({f"simulated_{name}": getattr(self.simulated, name) for name in told})
        intervals = {"restitution_half_width": self.measured.restitution_half_width}
        return _tables.frame({**columns, "residual": self.residual, **intervals})

    def plot(self, figure: Any = None) -> Any:
        """Draws every impact beside its twin, their numbers of sub-impacts, both distributions.

        Returns a matplotlib Figure of its own (`.savefig`, or a notebook's last line), or the given one drawn into."""
        return _plots.comparison(self, figure)

    def _repr_html_(self) -> str:
        rows = [
            ("measured restitution", self.measured_mean, self.measured_deviation, ""),
            ("simulated restitution", self.simulated_mean, self.simulated_deviation, ""),
            ("residual", self.residual_mean, "", f"mean within {self.residual_half_width:.3g} (95 %)"),
            ("Kolmogorov-Smirnov distance", self.kolmogorov_smirnov.value, "", f"p = {self.kolmogorov_smirnov.p:.3g}"),
            ("energy distance", self.energy_distance.value, "", f"p = {self.energy_distance.p:.3g}"),
        ]
        said = f"{self.a} on {self.b}, {len(self.status)} impacts"
        return _tables.html(said, ["", "mean or value", "standard deviation", ""], rows)


@dataclass(frozen=True)
class Fitted:
    """A parameter that was found."""

    parameter: Parameter
    body: str
    start: float
    value: float
    low: float
    """Of the 95 % interval."""
    high: float
    determined: bool
    """By these data; False: leave it at a known value."""


@dataclass(frozen=True)
class Readings:
    """What a parameter rests on."""

    quantity: str
    known: int
    used: int
    scatter: float
    """Relative standard deviation of what remains."""


@dataclass(frozen=True)
class Calibration:
    """Parameters with which the twins fit best."""

    parameters: tuple[Fitted, ...]
    correlation: FloatArray
    """[i, j] of parameters; near 1: they can stand in for each other."""
    readings: tuple[Readings, ...]
    impacts: int
    freedom: float
    """Degrees."""
    warnings: tuple[str, ...]
    notes: tuple[str, ...]
    """On the file: how it was understood, rows that were left out."""

    def to_dataframe(self) -> Any:
        """A row a parameter."""
        names = ("body", "start", "value", "low", "high", "determined")
        columns = {name: [getattr(one, name) for one in self.parameters] for name in names}
        return _tables.frame({"parameter": [one.parameter.text for one in self.parameters], **columns})

    def _repr_html_(self) -> str:
        rows = [
            (f"{one.parameter.text} of {one.body}", one.start, one.value, one.low, one.high, str(one.determined))
            for one in self.parameters
        ]
        heads = ["parameter", "start", "value", "95 % from", "to", "determined"]
        return _tables.html(f"fitted to {self.impacts} impacts", heads, rows)


Source = Union[str, "os.PathLike[str]", Mapping[str, ArrayLike], Impacts, Any]
"""A file, or columns by their names."""


def _check(code: int) -> None:
    check(code, _library, "percuss_measured_error_text")


def _columns(source: Any) -> Any:
    """The C structs of columns."""
    if isinstance(source, Impacts):
        source = vars(source)
    names = list(source)
    unknown = [name for name in names if name not in _COLUMNS]
    if unknown or not names:
        raise ValueError(f"columns: {', '.join(map(repr, unknown)) or 'none'}: of {', '.join(_COLUMNS)} some are allowed")
    arrays = {name: np.asarray(source[name], dtype=np.float64) for name in names}
    shapes = {array.shape for array in arrays.values()}
    if len(shapes) != 1 or len(next(iter(shapes))) != 1:
        raise ValueError(f"columns: shapes {sorted(shapes)}: lists of one length are allowed")
    table = np.full((len(next(iter(arrays.values()))), len(_COLUMNS)), np.nan)
    for name, array in arrays.items():
        table[:, _COLUMNS.index(name)] = array
    return (abi.Impact * len(table)).from_buffer_copy(table.tobytes()) if len(table) else (abi.Impact * 0)()


def _texts(named: Mapping[str, str | float]) -> Any:
    """NAME=VALUE of each, as the command line takes them."""
    texts = [f"{name}={value}".encode() for name, value in named.items()]
    return (ctypes.c_char_p * len(texts))(*texts)


@dataclass(frozen=True)
class _Said:
    """Of a file, besides its text; as percuss compare takes it."""

    columns: Mapping[str, str] | None = None
    uncertainty: Mapping[str, float | str] | None = None
    scale: float | str | None = None
    rate: float | str | None = None
    gravity: float | str | None = None

    def write(self, file: str | os.PathLike[str]) -> abi.File:
        columns, doubts = _texts(self.columns or {}), _texts(self.uncertainty or {})
        numbers = {
            name: _positive(name, value, quantity)
            for name, value, quantity in (
                ("scale", self.scale, "length"),
                ("rate", self.rate, "frequency"),
                ("gravity", self.gravity, "acceleration"),
            )
            if value is not None
        }
        return abi.File(os.fsencode(file), len(columns), columns, len(doubts), doubts, **numbers)

    def refuse(self) -> None:
        """Of measurements that are no file."""
        given = [one.name for one in fields(self) if getattr(self, one.name) not in (None, {})]
        if given:
            raise ValueError(f"{', '.join(given)}: for a file; these measurements have their names and are in SI units")


def _positive(name: str, value: float | str, quantity: str) -> float:
    taken = _convert.number(name, value, quantity)
    # the library takes 0 as not said
    if taken == 0:
        raise ValueError(f"{name}: {value!r}: a number > 0 is allowed")
    return taken


@contextmanager
def _taken(source: Source, said: _Said) -> Iterator[ctypes.c_void_p]:
    handle = ctypes.c_void_p()
    if isinstance(source, (str, os.PathLike)):
        _check(_library.percuss_measured_read_file(ctypes.byref(said.write(source)), ctypes.byref(handle)))
    else:
        said.refuse()
        impacts = _columns(source)
        _check(_library.percuss_measured_create(len(impacts), impacts, ctypes.byref(handle)))
    try:
        yield handle
    finally:
        _library.percuss_measured_free(handle)


def _notes(handle: ctypes.c_void_p) -> tuple[str, ...]:
    texts = (_library.percuss_measured_note(handle, index) for index in itertools.count())
    return tuple(text.decode(errors="replace") for text in itertools.takewhile(lambda text: text is not None, texts))


@dataclass(frozen=True)
class _Asked:
    """The C question, and what it points to."""

    question: Any
    a: Body
    b: Body
    kept: tuple[Any, ...]


def _ask(
    a: Body | str, b: Body | str, client: Client, options: Options | None, at: float | str | None, timeout: float
) -> _Asked:
    known = client.bodies(timeout) if isinstance(a, str) or isinstance(b, str) else {}
    first, second = announced.find("a", a, known), announced.find("b", b, known)
    bodies = announced.write_body(first), announced.write_body(second)
    question = _library.percuss_measured_question_default(client._open, *map(ctypes.byref, bodies))
    if at is not None:
        side, body = ("b", second) if announced.is_placed(second) else ("a", first)
        fraction, site = announced.place(body, at, "at")
        setattr(question.pair, f"at_{side}", fraction)
        if site is not None:
            setattr(question.pair, f"site_{side}", site.encode())
    _convert.fill(options or Options(), question.options, "options")
    question.timeout = timeout
    return _Asked(question, first, second, bodies)


def compare(
    source: Source,
    a: Body | str,
    b: Body | str,
    client: Client,
    *,
    options: Options | None = None,
    at: float | str | None = None,
    columns: Mapping[str, str] | None = None,
    uncertainty: Mapping[str, float | str] | None = None,
    scale: float | str | None = None,
    rate: float | str | None = None,
    gravity: float | str | None = None,
    permutations: int = 1999,
    seed: int = 1,
    timeout: float = 60.0,
) -> Comparison:
    """Puts measured impacts of a on b beside their twins. at: place where an impact has none, as of
    contact_pair. columns: what a file calls them, as {"speed": "v:mm/s"}. uncertainty: half of the 95 % interval of each
    number of a column, as {"rebound": "2 mm"}. scale: of a pixel, m; rate: frames or readings a second, Hz; gravity:
    m/s^2; or texts with units. permutations, seed: behind the p-value of the energy distance. timeout: s for 64 impacts.
    InvalidArgument names line or index, value and what is allowed, or what a twin was refused for."""
    asked = _ask(a, b, client, options, at, timeout)
    asked.question.permutations, asked.question.seed = permutations, seed
    answer = abi.Comparison()
    with _taken(source, _Said(columns, uncertainty, scale, rate, gravity)) as handle:
        notes = _notes(handle)
        code: int = _library.percuss_measured_compare(handle, ctypes.byref(asked.question), ctypes.byref(answer))
    client._settle()
    _check(code)
    try:
        twins = answer.impacts[: answer.impact_count]
        return _convert.read(
            answer,
            Comparison,
            warnings=_warnings(answer),
            notes=notes,
            measured=_impacts([twin.measured for twin in twins]),
            simulated=_impacts([twin.simulated for twin in twins]),
            status=tuple(Status(twin.status) for twin in twins),
            a=asked.a.id,
            b=asked.b.id,
        )
    finally:
        _library.percuss_comparison_free(ctypes.byref(answer))


def _impacts(list_: Sequence[Any]) -> Impacts:
    return Impacts(**{name: np.array([getattr(one, name) for one in list_]) for name in _COLUMNS})


def _warnings(answer: Any) -> tuple[str, ...]:
    return tuple(_convert.text(one) for one in answer.warnings[: answer.warning_count])


_READINGS = ("impulse of the first sub-impact", "duration of the first sub-impact", "start of the second sub-impact")


def calibrate(
    source: Source,
    a: Body | str,
    b: Body | str,
    client: Client,
    *,
    fit: Sequence[str | tuple[Parameter | str, str]] | Mapping[str, float | str | None],
    options: Options | None = None,
    at: float | str | None = None,
    columns: Mapping[str, str] | None = None,
    scale: float | str | None = None,
    rate: float | str | None = None,
    gravity: float | str | None = None,
    noise: float = 0.01,
    timeout: float = 60.0,
) -> Calibration:
    """Finds parameters of the bodies with which the twins fit the first sub-impact's impulse and duration and the start
    of the second. fit: up to eight as "young:al-beam", "young@al-beam" or (Parameter.YOUNG, "al-beam"); or a mapping of
    "young:al-beam" to where to start, a number or a text with a unit, None: at the catalogue's value. noise: relative
    standard deviation of the measured numbers to start with. Others as of compare; a tolerance of 0 is 1e-4 here."""
    asked = _ask(a, b, client, options, at, timeout)
    asked.question.noise = noise
    answer = _write_fit(fit)
    with _taken(source, _Said(columns, None, scale, rate, gravity)) as handle:
        notes = _notes(handle)
        code: int = _library.percuss_measured_calibrate(handle, ctypes.byref(asked.question), ctypes.byref(answer))
    client._settle()
    _check(code)
    try:
        n = answer.parameter_count
        return Calibration(
            tuple(_convert.read(one, Fitted) for one in answer.parameters[:n]),
            np.array(answer.correlation)[:n, :n].copy(),
            tuple(Readings(*one) for one in zip(_READINGS, answer.known, answer.used, answer.scatter)),
            answer.impacts,
            answer.freedom,
            _warnings(answer),
            notes,
        )
    finally:
        _library.percuss_calibration_free(ctypes.byref(answer))


def _write_fit(fit: Any) -> abi.Calibration:
    starts = dict(fit) if isinstance(fit, Mapping) else dict.fromkeys(fit)
    if len(starts) > abi.MAX_FITTED:
        raise ValueError(f"fit: {len(starts)} are too many; up to {abi.MAX_FITTED} are allowed")
    answer = abi.Calibration(parameter_count=len(starts))
    for i, (one, start) in enumerate(starts.items()):
        # an @ may stand for the colon, as on the command line
        pair = tuple(re.split("[:@]", one, maxsplit=1)) if isinstance(one, str) else one
        if len(pair) != 2:
            raise ValueError(f"fit: {one!r}: PARAMETER:ID is allowed, as young:al-beam")
        parameter, body = pair
        target = answer.parameters[i]
        target.parameter = Parameter.of(parameter)
        target.body = _convert._plain(f"fit[{i}]", body)
        target.start = np.nan if start is None else _convert.number(f"fit[{i}]", start, Parameter(target.parameter).quantity)
    return answer
