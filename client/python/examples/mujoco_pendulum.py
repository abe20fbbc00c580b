# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""A MuJoCo simulation that asks percuss at every impact of a sphere.

MuJoCo stays on the slow time scale. Its own contact between the two bodies is switched off; instead the
instant of touch is located, the reply's impulse is applied to the joint velocities, the bodies are put where
its sub-impacts at their own times bring them, and the vibration goes on as a state token. Needs `pip install mujoco` and a percussd with the shipped catalogue; the DDS domain may
be the argument. Prints the impacts of a pendulum on a bar that hangs beside it.
"""

import math
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

import percuss
from percuss.request import FloatArray

# contype 0, conaffinity 0: the bodies pass through each other as far as MuJoCo is concerned
HINGED_BAR = """<mujoco><compiler angle="radian"/>
<option timestep="0.001" gravity="0 0 -9.81" integrator="RK4"/>
<default><geom contype="0" conaffinity="0"/></default>
<worldbody>
  <body name="bar"><joint type="hinge" axis="0 1 0" pos="0 0 0.5"/>
    <inertial pos="0 0 0" mass="0.84823" diaginertia="0.070707 0.0000424 0.070707"/>
    <geom name="bar" type="capsule" fromto="0 -0.5 0 0 0.5 0" size="0.010"/></body>
  <body name="sphere" pos="-0.025 0 0"><joint type="hinge" axis="0 1 0" pos="0 0 0.5"/>
    <inertial pos="0 0 0" mass="0.110976" diaginertia="9.98784e-6 9.98784e-6 9.98784e-6"/>
    <geom name="sphere" type="sphere" size="0.015"/></body>
</worldbody></mujoco>"""
"""Both hang on hinges 0.5 m above; the sphere just touches the bar when they hang at rest."""

TOUCH = 1e-9
"""m; contacts closer than this at the instant of an impact belong to it."""


@dataclass
class Pair:
    """A sphere and what it may hit: names of MuJoCo geoms and of bodies in the catalogue."""

    sphere: str
    other: str
    sphere_id: str = "steel-sphere"
    other_id: str = "al-beam"
    latched_until: float = -math.inf

    def watch(self, now: float, gap: float, gap_rate: float) -> bool:
        """Whether an impact begins. While the window of one lasts, whatever happens is in its answer."""
        return now >= self.latched_until and gap <= 0.0 and gap_rate < 0.0


@dataclass
class Impact:
    """What was asked and what was applied."""

    time: float
    request: percuss.Request
    gap_rate: FloatArray
    gap_rate_after: FloatArray
    reply: percuss.Reply | None


Answer = Callable[[percuss.Request], percuss.Reply]


class Simulation:
    """A MuJoCo model whose pairs collide by way of percuss."""

    def __init__(self, xml: str, pairs: Sequence[Pair], answer: Answer, fallback: float | None = None) -> None:
        """fallback: the restitution to go on with, and say so, when no answer comes. None: no answer is an
        error; results would otherwise depend on whether the server could be had in time."""
        self.model = mujoco.MjModel.from_xml_string(xml)
        self.data = mujoco.MjData(self.model)
        self.pairs = list(pairs)
        self.answer = answer
        self.fallback = fallback
        self.step_size = self.model.opt.timestep
        self.impacts: list[Impact] = []
        self._tokens: dict[str, tuple[str, float]] = {}

    # geometry

    def measure(self, pair: Pair) -> tuple[float, FloatArray, FloatArray]:
        """Gap, point of the other body's surface, and unit normal towards the sphere."""
        ids = [self.data.geom(name).id for name in (pair.sphere, pair.other)]
        segment = np.zeros(6)
        gap = mujoco.mj_geomDistance(self.model, self.data, *ids, 1.0, segment)
        # from the centre, not along the segment, which vanishes when they touch
        normal = self.data.geom(pair.sphere).xpos - segment[3:]
        return gap, segment[3:], normal / np.linalg.norm(normal)

    def direction(self, pair: Pair) -> FloatArray:
        """w: the gap rate is w . qvel."""
        _, point, normal = self.measure(pair)
        w = np.zeros(self.model.nv)
        for name, sign in ((pair.sphere, 1.0), (pair.other, -1.0)):
            jacobian = np.zeros((3, self.model.nv))
            body = self.model.geom(name).bodyid[0]
            mujoco.mj_jac(self.model, self.data, jacobian, None, point, body)
            w += sign * (normal @ jacobian)
        return w

    def inverse_mass_times(self, rows: FloatArray) -> FloatArray:
        """M^-1 of each row, without what equality constraints forbid: MuJoCo keeps those out of M."""
        result = np.zeros_like(rows)
        mujoco.mj_solveM(self.model, self.data, result, rows)
        if self.data.ne:
            constraints = self.data.efc_J.reshape(-1, self.model.nv)[: self.data.ne]
            compliance = np.zeros_like(constraints)
            mujoco.mj_solveM(self.model, self.data, compliance, constraints)
            # least squares: constraints may be redundant
            reaction = np.linalg.lstsq(constraints @ compliance.T, constraints @ result.T, rcond=1e-10)[0]
            result -= reaction.T @ compliance
        return result

    # time

    def step(self, size: float) -> None:
        self.model.opt.timestep = size
        mujoco.mj_step(self.model, self.data)
        mujoco.mj_forward(self.model, self.data)

    def run(self, end: float) -> None:
        """Steps until `end`, locating every impact on the way."""
        before = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)
        while self.data.time < end - 1e-12:
            mujoco.mj_copyData(before, self.model, self.data)
            size = min(self.step_size, end - self.data.time)
            self.step(size)
            hit = [pair for pair in self.pairs if pair.watch(self.data.time, *self._gap_and_rate(pair))]
            if hit:
                self._locate(before, size, hit)
                self._collide()

    def _gap_and_rate(self, pair: Pair) -> tuple[float, float]:
        return self.measure(pair)[0], float(self.direction(pair) @ self.data.qvel)

    def _locate(self, before: "mujoco.MjData", size: float, hit: list[Pair]) -> None:
        """Replays the step up to the first instant at which one of the pairs touches."""
        low, high = 0.0, size
        while high - low > 1e-15:
            middle = 0.5 * (low + high)
            if middle in (low, high):
                break
            mujoco.mj_copyData(self.data, self.model, before)
            self.step(middle)
            if min(self.measure(pair)[0] for pair in hit) <= 0.0:
                high = middle
            else:
                low = middle
        mujoco.mj_copyData(self.data, self.model, before)
        self.step(high)

    # the impact

    def motion(self, geom: str, id: str) -> percuss.BodyMotion:
        """Pose and velocity; a capsule is a rod or beam along its axis, which is z here and x there."""
        body = self.data.body(self.model.geom(geom).bodyid[0])
        rotation = self.data.geom(geom).xmat.reshape(3, 3)[:, [2, 0, 1]]
        orientation = np.zeros(4)
        mujoco.mju_mat2Quat(orientation, rotation.ravel())
        linear, angular = np.zeros((2, 3, self.model.nv))
        mujoco.mj_jacBodyCom(self.model, self.data, linear, angular, body.id)
        velocity, angular_velocity = linear @ self.data.qvel, angular @ self.data.qvel
        token, since = self._tokens.get(geom, ("", self.data.time))
        # another body may hit before the window is over: then this is the nearest state there is
        elapsed = max(0.0, self.data.time - since) if token else 0.0
        return percuss.BodyMotion(id, body.xipos, orientation, velocity, angular_velocity, token, elapsed)

    def request(self, touching: list[Pair]) -> tuple[percuss.Request, list[str], FloatArray]:
        """The question, the geoms in the order of its bodies, and w of each contact as rows."""
        geoms = list(dict.fromkeys(name for pair in touching for name in (pair.sphere, pair.other)))
        ids = {pair.sphere: pair.sphere_id for pair in touching} | {pair.other: pair.other_id for pair in touching}
        w = np.array([self.direction(pair) for pair in touching])
        accelerations = self._gap_accelerations(touching, w @ self.data.qvel)
        request = percuss.Request([self.motion(name, ids[name]) for name in geoms])
        for pair, acceleration in zip(touching, accelerations):
            gap, point, normal = self.measure(pair)
            a, b = geoms.index(pair.sphere), geoms.index(pair.other)
            request.contacts.append(percuss.Contact(a, b, point, normal, gap, acceleration))
        delassus = w @ self.inverse_mass_times(w).T
        request.delassus = 0.5 * (delassus + delassus.T)
        return request, geoms, w

    def _gap_accelerations(self, touching: list[Pair], gap_rates: FloatArray) -> list[float]:
        """By stepping ahead a little, so that turning normals and joints are all in it."""
        ahead = 1e-6
        now = mujoco.MjData(self.model)
        mujoco.mj_copyData(now, self.model, self.data)
        self.step(ahead)
        later = [self._gap_and_rate(pair)[1] for pair in touching]
        mujoco.mj_copyData(self.data, self.model, now)
        return [float(after - before) / ahead for after, before in zip(later, gap_rates)]

    def _collide(self) -> None:
        """Asks about all contacts of this instant as one group, and applies the impulses at once."""
        touching = [pair for pair in self.pairs if self.measure(pair)[0] <= TOUCH]
        request, geoms, w = self.request(touching)
        gap_rate = w @ self.data.qvel
        try:
            reply: percuss.Reply | None = self.answer(request).raise_for_status()
        except percuss.PercussError as problem:
            if self.fallback is None:
                raise
            print(f"{self.data.time:.6f} s: e = {self.fallback} assumed: {problem}", file=sys.stderr)
            reply = None
        impulses = self._impulses(reply, request, gap_rate)
        window = reply.window if reply else 0.0
        response = self.inverse_mass_times(w)
        self.data.qvel += impulses @ response
        mujoco.mj_integratePos(self.model, self.data.qpos, self._lateness(reply, impulses) @ response, 1.0)
        mujoco.mj_forward(self.model, self.data)
        for pair in touching:
            pair.latched_until = self.data.time + window
        for i, geom in enumerate(geoms):
            # the state is that at the end of the window
            self._tokens[geom] = (reply.states_after[i].state if reply else "", self.data.time + window)
        self.impacts.append(Impact(self.data.time, request, gap_rate, w @ self.data.qvel, reply))

    def _impulses(self, reply: percuss.Reply | None, request: percuss.Request, gap_rate: FloatArray) -> FloatArray:
        if reply:
            return np.array([contact.impulse for contact in reply.contacts])
        # compression by Gauss-Seidel, 0 <= W p + g perpendicular to p >= 0; expansion in proportion
        delassus, compression = np.asarray(request.delassus), np.zeros(len(gap_rate))
        for _ in range(100):
            for i, row in enumerate(delassus):
                compression[i] = max(0.0, compression[i] - (row @ compression + gap_rate[i]) / row[i])
        return (1.0 + (self.fallback or 0.0)) * compression

    @staticmethod
    def _lateness(reply: percuss.Reply | None, impulses: FloatArray) -> FloatArray:
        """Each impulse times how late it is applied, N s^2: all are applied now, each belongs to the centre of
        its force. Velocities alone would make energy where gravity presses or swings the bodies."""
        if not reply:
            return np.zeros(len(impulses))
        subs = [contact.sub_impacts for contact in reply.contacts]
        return np.array([-(percuss.force_centres(one) @ one["impulse"]) for one in subs])


def hinged_bar(answer: Answer, speed: float = 0.2) -> Simulation:
    """The sphere is let go so high that it meets the bar, at rest, at `speed` (m/s)."""
    simulation = Simulation(HINGED_BAR, [Pair("sphere", "bar")], answer)
    simulation.data.qpos[1] = math.acos(1.0 - speed**2 / (2 * 9.81) / 0.5)
    return simulation


def main() -> None:
    with percuss.connect(int(sys.argv[1]) if len(sys.argv) > 1 else None) as client:
        simulation = hinged_bar(client.solve)
        simulation.run(3.0)
    print("    time/s  speed/(m/s)        e  sub-impacts  impulse/(N s)  vibration left/uJ")
    for impact in simulation.impacts:
        if not impact.reply:
            continue
        contact = impact.reply.contacts[0]
        vibration = sum(body.energy for body in impact.reply.energy.vibration)
        print(
            f"{impact.time:10.6f}  {-impact.gap_rate[0]:11.6f}  {contact.restitution:7.4f}  "
            f"{contact.sub_impact_count:11}  {contact.impulse:13.7f}  {1e6 * vibration:17.3f}"
        )


if __name__ == "__main__":
    main()
