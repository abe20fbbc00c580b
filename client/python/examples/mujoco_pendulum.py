# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""A MuJoCo simulation that asks percuss at every impact of a sphere.

MuJoCo stays on the slow time scale. Its own contact between the two bodies is switched off; `percuss.slowscale` finds
out when an impact is due, asks about it, and plays each sub-impact at its time. Needs `pip install mujoco` and a
percussd with the shipped catalogue; the DDS domain may be the argument, or a catalogue, to solve in this process.
Prints the impacts of a pendulum on a bar that hangs beside it.
"""

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

import percuss
from percuss.request import FloatArray
from percuss.slowscale import Contact, Report, SlowScale
from percuss.world import World, run

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

LOOK_AHEAD = 1e-4
"""s; the free motion in which gap accelerations are seen, turning normals and joints included."""


@dataclass(frozen=True)
class Pair:
    """A sphere and what it may hit: names of MuJoCo geoms and of bodies in the catalogue."""

    sphere: str
    other: str
    sphere_id: str = "steel-sphere"
    other_id: str = "al-beam"
    friction: float = 0.0
    """Coefficient; 0: the catalogue's, if any."""


class Simulation(World):
    """A MuJoCo model whose pairs collide by way of percuss."""

    def __init__(self, xml: str, pairs: Sequence[Pair]) -> None:
        self.model = mujoco.MjModel.from_xml_string(xml)
        self.data = mujoco.MjData(self.model)
        self.pairs = list(pairs)
        ids = {name: id for pair in pairs for name, id in ((pair.sphere, pair.sphere_id), (pair.other, pair.other_id))}
        self.geoms, self.ids = list(ids), list(ids.values())
        """A body of the slow scale is an index into these."""
        mujoco.mj_forward(self.model, self.data)

    # time

    def now(self) -> float:
        return float(self.data.time)

    def step(self, size: float) -> None:
        self.model.opt.timestep = size
        if size > 0.0:
            mujoco.mj_step(self.model, self.data)
        mujoco.mj_forward(self.model, self.data)

    def save(self) -> FloatArray:
        state = np.zeros(mujoco.mj_stateSize(self.model, mujoco.mjtState.mjSTATE_INTEGRATION))
        mujoco.mj_getState(self.model, self.data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
        return state

    def restore(self, saved: FloatArray) -> None:
        mujoco.mj_setState(self.model, self.data, saved, mujoco.mjtState.mjSTATE_INTEGRATION)
        mujoco.mj_forward(self.model, self.data)

    # geometry

    def contacts(self) -> list[Contact]:
        found, start = [self._measure(pair) for pair in self.pairs], self.save()
        before = self.gap_rates(found)
        self.step(LOOK_AHEAD)
        after = self.gap_rates([self._measure(pair) for pair in self.pairs])
        self.restore(start)
        for contact, acceleration in zip(found, (after - before) / LOOK_AHEAD):
            contact.gap_acceleration = float(acceleration)
        return found

    def _measure(self, pair: Pair) -> Contact:
        ids = [self.data.geom(name).id for name in (pair.sphere, pair.other)]
        segment = np.zeros(6)
        gap = mujoco.mj_geomDistance(self.model, self.data, *ids, 1.0, segment)
        # from the centre, not along the segment, which vanishes when they touch
        normal = self.data.geom(pair.sphere).xpos - segment[3:]
        normal /= np.linalg.norm(normal)
        indices = self.geoms.index(pair.sphere), self.geoms.index(pair.other)
        return Contact(*indices, segment[3:], normal, gap, friction=pair.friction)

    def motion(self, body: int) -> percuss.BodyMotion:
        """A capsule is a rod or beam along its axis, which is z here and x there."""
        name = self.geoms[body]
        part = self.data.body(self.model.geom(name).bodyid[0])
        rotation = self.data.geom(name).xmat.reshape(3, 3)[:, [2, 0, 1]]
        orientation = np.zeros(4)
        mujoco.mju_mat2Quat(orientation, rotation.ravel())
        linear, angular = np.zeros((2, 3, self.model.nv))
        mujoco.mj_jacBodyCom(self.model, self.data, linear, angular, part.id)
        velocity, angular_velocity = linear @ self.data.qvel, angular @ self.data.qvel
        return percuss.BodyMotion(self.ids[body], part.xipos, orientation, velocity, angular_velocity)

    # mechanics

    def relative(self, contact: Contact) -> FloatArray:
        """Three rows J: the velocity of the point of a against that of b is J qvel."""
        rows = np.zeros((3, self.model.nv))
        for index, sign in ((contact.a, 1.0), (contact.b, -1.0)):
            jacobian = np.zeros_like(rows)
            body = self.model.geom(self.geoms[index]).bodyid[0]
            mujoco.mj_jac(self.model, self.data, jacobian, None, contact.point, body)
            rows += sign * jacobian
        return rows

    def directions(self, contacts: Sequence[Contact]) -> FloatArray:
        """w of each contact as rows: the gap rate is w . qvel."""
        w = np.zeros((len(contacts), self.model.nv))
        for row, contact in zip(w, contacts):
            row += contact.normal @ self.relative(contact)
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

    def gap_rates(self, contacts: Sequence[Contact]) -> FloatArray:
        rates: FloatArray = self.directions(contacts) @ self.data.qvel
        return rates

    def delassus(self, contacts: Sequence[Contact]) -> FloatArray:
        w = self.directions(contacts)
        matrix = w @ self.inverse_mass_times(w).T
        symmetric: FloatArray = 0.5 * (matrix + matrix.T)
        return symmetric

    def oblique(self, contacts: Sequence[Contact]) -> FloatArray:
        """The same with both tangents of each contact, along which friction pushes."""
        w = np.zeros((3 * len(contacts), self.model.nv))
        for i, contact in enumerate(contacts):
            directions = contact.normal, contact.tangent, np.cross(contact.normal, contact.tangent)
            w[3 * i : 3 * i + 3] = np.array(directions) @ self.relative(contact)
        matrix = w @ self.inverse_mass_times(w).T
        symmetric: FloatArray = 0.5 * (matrix + matrix.T)
        return symmetric

    def apply_vector(self, contact: Contact, impulse: FloatArray) -> None:
        """M^-1 (w_n P_n + w_t P_t): the impulse by all three rows of the Jacobian."""
        self.data.qvel += self.inverse_mass_times((impulse @ self.relative(contact))[np.newaxis])[0]
        mujoco.mj_forward(self.model, self.data)

    def apply(self, contact: Contact, impulse: float) -> None:
        self.apply_vector(contact, impulse * contact.normal)

    def move_vector(self, contact: Contact, moment: FloatArray) -> None:
        response = self.inverse_mass_times((moment @ self.relative(contact))[np.newaxis])[0]
        mujoco.mj_integratePos(self.model, self.data.qpos, response, 1.0)
        mujoco.mj_forward(self.model, self.data)

    def move(self, contact: Contact, moment: float) -> None:
        self.move_vector(contact, moment * contact.normal)


def hinged_bar(speed: float = 0.2) -> Simulation:
    """The sphere is let go so high that it meets the bar, at rest, at `speed` (m/s)."""
    simulation = Simulation(HINGED_BAR, [Pair("sphere", "bar")])
    simulation.data.qpos[1] = math.acos(1.0 - speed**2 / (2 * 9.81) / 0.5)
    mujoco.mj_forward(simulation.model, simulation.data)
    return simulation


def simulate(client: percuss.Client, simulation: Simulation, end: float, tolerance: float = 1e-3) -> list[Report]:
    """The impacts up to `end`, s, with e to the tolerance."""
    reports: list[Report] = []
    options = percuss.Options(tolerance=tolerance)
    with SlowScale(simulation.ids, simulation, client, options=options, report=reports.append) as slow:
        run(simulation, slow, end, 1e-3)
    return reports


def main() -> None:
    argument = sys.argv[1] if len(sys.argv) > 1 else ""
    local = argument and not argument.isdigit()
    with percuss.Local(argument) if local else percuss.connect(int(argument) if argument else None) as client:
        reports = simulate(client, hinged_bar(), 3.0)
    print("    time/s  speed/(m/s)        e  sub-impacts  impulse/(N s)  vibration left/uJ")
    for report in reports:
        assert report.reply
        contact = report.reply.contacts[0]
        vibration = sum(body.energy for body in report.reply.energy.vibration)
        print(
            f"{report.time:10.6f}  {-report.gap_rate[0]:11.6f}  {contact.restitution:7.4f}  "
            f"{contact.sub_impact_count:11}  {contact.impulse:13.7f}  {1e6 * vibration:17.3f}"
        )


if __name__ == "__main__":
    main()
