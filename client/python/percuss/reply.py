# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""A reply: impulses, restitution, sub-impacts, and how they were computed.

SI units; undefined numbers are nan.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from . import _abi, _json, _tables
from .errors import Refused
from .request import FloatArray
from .vocabulary import Compliance, ContactModel, DelassusSource, EndReason, FrictionState, Id, Method, Status

SUB_IMPACT: "np.dtype[np.void]" = np.dtype(cast(Any, _abi.SubImpact))
"""A sub-impact: an interval in which the bodies are pressed together.

start, compression_end, end: s from the stated instant. impulse, compression_impulse (up to the largest
indentation): N s. peak_force: N. max_indentation: m. gap_rate_before, gap_rate_after: m/s. negligible:
below 1 % of the contact's impulse. impulse_tangential: N s, on body a along the contact's two tangents.
slip_before, slip_after: m/s, of a's point against b's along both; zero without friction. friction_state: the
number of a FrictionState.
"""


def force_centres(sub_impacts: NDArray[np.void]) -> FloatArray:
    """The centre in time of each sub-impact's force, s from the stated instant: an impulse applied then leaves
    the positions that the force would. As percuss_slow_force_centre of libpercuss-slowscale."""
    start, peak, end = (sub_impacts[name] for name in ("start", "compression_end", "end"))
    impulse, compression = sub_impacts["impulse"], sub_impacts["compression_impulse"]
    force = sub_impacts["peak_force"]

    def half_moment(part: FloatArray, length: FloatArray) -> FloatArray:
        most = force * length
        mean = np.clip(np.divide(part, most, out=np.zeros(len(part)), where=most > 0.0), 0.5436, 1.0)
        moment: FloatArray = part * length * mean * (0.5 + 0.195 * (1.0 - mean))
        return moment

    moment = half_moment(impulse - compression, end - peak) - half_moment(compression, peak - start)
    shift = np.divide(moment, impulse, out=np.zeros(len(impulse)), where=impulse > 0.0)
    centres: FloatArray = np.clip(peak + shift, start, end)
    return centres


def _columns(sub_impacts: NDArray[np.void]) -> dict[str, NDArray[Any]]:
    """The members of sub-impacts, of pairs one after the other."""
    columns: dict[str, NDArray[Any]] = {}
    for name in sub_impacts.dtype.names or ():
        values = sub_impacts[name]
        if values.ndim == 1:
            columns[name] = values
        else:
            columns.update({f"{name}_{k + 1}": values[:, k] for k in range(values.shape[1])})
    return columns


@dataclass(frozen=True)
class ContactResult:
    """What happened at one contact."""

    impulse: float
    """Of all sub-impacts, N s."""
    impulse_vector: FloatArray
    """On body a, world, N s."""
    impulse_compression: float
    """That stops the rigid approach, N s."""
    restitution: float
    """impulse / impulse_compression - 1."""
    inverse_effective_mass: float
    """1/kg."""
    end_time: float
    """End of the last sub-impact, s."""
    sub_impact_count: int
    """Exact, however many are listed."""
    sub_impacts: NDArray[np.void]
    """Those listed (at most 256; 16 in a batch), of dtype SUB_IMPACT: sub_impacts["impulse"] is an array."""
    impulse_error: float
    """Of the impulse, by time, modes and models together, N s."""
    friction: float
    """Coefficient that was used; 0: none."""
    tangent: FloatArray
    """The first one, world; the second is normal x tangent. Zero without friction."""
    impulse_tangential: FloatArray
    """On body a along both, N s; part of impulse_vector."""
    impulse_tangential_error: float
    """Of it, by time, modes and models together, N s."""
    slip_before: FloatArray
    """Of a's point against b's along both, vibration not included, m/s; zero without friction."""
    slip_after: FloatArray
    """The same after the impact."""
    tangential_restitution: float
    """-slip_after.slip_before / slip_before.slip_before; nan without slip or friction."""
    restitution_kinematic: float
    """-gap rate after / before; nan where there are more contacts."""
    restitution_energetic: float
    """Stronge's: root of the normal force's work in release over that in compression; nan likewise."""
    friction_state: FrictionState

    @property
    def significant(self) -> int:
        """How many of those listed are not negligible."""
        return int(np.count_nonzero(~self.sub_impacts["negligible"]))


@dataclass(frozen=True)
class BodyVelocity:
    """Velocity of a body after the impact."""

    id: str
    velocity: FloatArray
    """Of the centre of mass, world, m/s."""
    angular_velocity: FloatArray
    """World, rad/s."""
    velocity_error: float
    """Of the velocity, by time, modes and models together, m/s."""
    angular_velocity_error: float
    """Of the angular velocity, rad/s."""


@dataclass(frozen=True)
class BodyState:
    """The token that names a body's vibration and dents after the impact; never changes its meaning."""

    id: str
    state: str


@dataclass(frozen=True)
class BodyEnergy:
    """The vibration energy of a body, J."""

    id: str
    energy: float


@dataclass(frozen=True)
class Energy:
    """The energy balance, J."""

    available: float
    rigid_after: float
    vibration: tuple[BodyEnergy, ...]
    damping: float
    plastic: float
    stored: float
    closure: float
    """available less all the others: a check of the solution."""
    friction: float
    """Lost by sliding in the contacts."""


@dataclass(frozen=True)
class ErrorEstimate:
    """Estimated errors."""

    restitution_time: float
    """Of the restitution, by the time steps."""
    restitution_modes: float
    """Of the restitution, by the modes left out."""
    impulse_time: float
    """N s."""
    impulse_modes: float
    """N s."""
    restitution_by_speed: float
    """d(restitution)/d(speed), s/m; nan unless Options.conditioning asked for it."""
    tolerance_met: bool
    """By time and modes."""
    restitution_model: float
    """Of the restitution, by the models of contact and bodies themselves."""
    restitution_total: float
    """All three."""
    total_met: bool
    """The tolerance, by that total."""
    restitution_yield: float
    """Of restitution_total, what metals whose yield is not stated add: without it they are elastic."""
    impulse_tangential_by_speed: FloatArray
    """d(impulse_tangential)/d(speed) of the contact with the largest impulse, kg; nan unless Options.conditioning asked
    for it, or without friction."""

    @property
    def restitution(self) -> float:
        """Of the restitution, by time steps and modes: what the tolerance is asked of."""
        return abs(self.restitution_time) + abs(self.restitution_modes)

    @property
    def total(self) -> float:
        """restitution_total where the server knows it; nan of one of 0.1.0, which knows no error of the models."""
        known = self.restitution_total >= self.restitution or self.restitution_model > 0.0
        return self.restitution_total if known else float("nan")


@dataclass(frozen=True)
class BodyModel:
    """How a body was modelled."""

    id: str
    modes: int
    rigid: bool
    theory: str
    """rigid, rod, rayleigh-love, timoshenko, euler-bernoulli."""
    shear_factor: float
    """nan where there is none."""


@dataclass(frozen=True)
class Model:
    """How the impact was modelled."""

    bodies: tuple[BodyModel, ...]
    contact_model: ContactModel
    compliance: Compliance
    method: Method
    reason: str
    """Why this model."""
    omitted_error: float
    """Estimated effect on the restitution of what was left out."""


@dataclass(frozen=True)
class Timing:
    """Where the server's time went, s."""

    queue: float
    solve: float


@dataclass(frozen=True)
class Reply:
    """The server's answer. A refusal is an answer too: see status and message."""

    client: Id
    sequence: int
    server: Id
    catalogue_revision: str
    version: str
    status: Status
    message: str
    """Names the field, its value and what is allowed; empty for OK."""
    complete: bool
    """False: the restitution is not the final one."""
    end_reason: EndReason
    window: float
    """s; from then on vibration cannot cause a contact."""
    contacts: tuple[ContactResult, ...]
    """In the order of the request; empty when it was refused."""
    delassus_source: DelassusSource
    velocity_after: tuple[BodyVelocity, ...]
    """Empty unless the server's own inverse mass matrix was used."""
    states_after: tuple[BodyState, ...]
    energy: Energy
    error: ErrorEstimate
    model: Model
    time_shift: float
    """The touch of a ringing body was found so long after the stated instant (negative: before), s."""
    warnings: tuple[str, ...]
    timing: Timing

    def raise_for_status(self) -> "Reply":
        """Returns the reply if it holds contacts (OK, TRUNCATED); raises Refused otherwise."""
        if self.status not in (Status.OK, Status.TRUNCATED):
            raise Refused(self.status, self.message)
        return self

    def to_json(self) -> dict[str, Any]:
        """The object that `percuss query --json` prints, which json.dumps makes a text of: to the last digit the same
        numbers, undefined ones None."""
        members: dict[str, Any] = _json.write(self)
        return members

    def to_dataframe(self) -> Any:
        """A row a sub-impact that is listed: contact, and the members of SUB_IMPACT, of pairs as NAME_1, NAME_2."""
        parts = [
            {"contact": np.full(len(one.sub_impacts), i), **_columns(one.sub_impacts)}
            for i, one in enumerate(self.contacts)
        ]
        return _tables.stack(parts, ("contact", *_columns(np.zeros(0, SUB_IMPACT))))

    def _repr_html_(self) -> str:
        said = f"{self.status}: {self.message}" if self.message else f"{self.status}, {self.end_reason}"
        contacts = [
            (i, one.restitution, self.error.restitution, one.impulse, one.sub_impact_count, 1e3 * one.end_time)
            for i, one in enumerate(self.contacts)
        ]
        subs = [
            (i, 1e3 * sub["start"], 1e6 * (sub["end"] - sub["start"]), sub["impulse"], sub["peak_force"])
            for i, one in enumerate(self.contacts)
            for sub in one.sub_impacts[~one.sub_impacts["negligible"]]
        ]
        heads = ["contact", "restitution", "error", "impulse/(N s)", "sub-impacts", "end/ms"]
        text = _tables.html(said, heads, contacts)
        if subs:
            heads = ["contact", "start/ms", "length/us", "impulse/(N s)", "peak/N"]
            text += _tables.html("sub-impacts that are not negligible", heads, [(i, *map(float, r)) for i, *r in subs])
        return text


def to_dataframe(replies: Sequence[Reply]) -> Any:
    """Many replies, as of a batch: a row a contact with reply and contact (indices), restitution, error, impulse,
    impulse_compression, sub_impacts, significant, end_time and status; a refusal has one row without numbers."""
    rows = []
    for i, reply in enumerate(replies):
        status = reply.status.name
        if not reply.contacts:
            rows.append((i, 0, *[np.nan] * 4, 0, 0, np.nan, status))
        for k, one in enumerate(reply.contacts):
            numbers = (one.restitution, reply.error.restitution, one.impulse, one.impulse_compression)
            rows.append((i, k, *numbers, one.sub_impact_count, one.significant, one.end_time, status))
    names = ["reply", "contact", "restitution", "error", "impulse", "impulse_compression"]
    names += ["sub_impacts", "significant", "end_time", "status"]
    return _tables.frame({name: [row[i] for row in rows] for i, name in enumerate(names)})
