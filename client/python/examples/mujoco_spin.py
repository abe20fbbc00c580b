# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""A spinning ball is thrown on a beam in MuJoCo: friction turns it, and its spin turns its way.

The ball and the beam are free bodies of MuJoCo, weightless; percuss answers their impact, and the whole impulse vector
acts at the point of contact (mujoco_pendulum.py has the engine). Solves in this process; the argument may be another
catalogue, or the DDS domain of a percussd. Prints rebounds by the spin that the ball comes with: its speed, spin and
angle from the normal, which friction gives where one coefficient of restitution cannot.
"""

import math
import sys
from dataclasses import dataclass

import mujoco
import numpy as np

import percuss
from mujoco_pendulum import Pair, Simulation, simulate
from percuss.request import FloatArray

BALL, BEAM = 0.015, 0.010  # radii, m
THROWN = 1e-3  # s before the touch

SCENE = """<mujoco><compiler angle="radian"/>
<option timestep="0.001" gravity="0 0 0"/>
<default><geom contype="0" conaffinity="0"/></default>
<worldbody>
  <body name="beam"><freejoint/>
    <inertial pos="0 0 0" mass="{0.mass}" diaginertia="{0.inertia[1]} {0.inertia[0]} {0.inertia[2]}"/>
    <geom name="beam" type="capsule" fromto="0 -0.5 0 0 0.5 0" size="{2}"/></body>
  <body name="ball"><freejoint/>
    <inertial pos="0 0 0" mass="{1.mass}" diaginertia="{1.inertia[0]} {1.inertia[1]} {1.inertia[2]}"/>
    <geom name="ball" type="sphere" size="{3}"/></body>
</worldbody></mujoco>"""
"""The beam lies along y, the ball comes from above; their inertia is the catalogue's, as friction needs it."""


@dataclass(frozen=True)
class Rebound:
    """The ball after all impulses, and the answer about it."""

    velocity: FloatArray
    spin: float
    """rad/s, about x; negative rolls along y."""
    answer: percuss.ContactResult
    energy: percuss.Energy

    @property
    def speed(self) -> float:
        return float(np.linalg.norm(self.velocity))

    @property
    def angle(self) -> float:
        """Degrees from the normal; negative: back where it came from."""
        return math.degrees(math.atan2(self.velocity[1], self.velocity[2]))


def throw(
    client: percuss.Client, spin: float, friction: float = 0.3, speed: float = 0.4, angle: float = 30.0
) -> tuple[Rebound, Simulation]:
    """The ball comes with `speed`, m/s, at `angle`, degrees from the normal, along the beam to its middle, and spins
    about x with `spin`, rad/s."""
    bodies = client.bodies()
    scene = SCENE.format(bodies["al-beam"], bodies["steel-sphere"], BEAM, BALL)
    simulation = Simulation(scene, [Pair("ball", "beam", friction=friction)])
    velocity = speed * np.array([0.0, math.sin(math.radians(angle)), -math.cos(math.radians(angle))])
    simulation.data.qpos[7:10] = np.array([0.0, 0.0, BALL + BEAM]) - THROWN * velocity
    simulation.data.qvel[6:12] = [*velocity, spin, 0.0, 0.0]
    mujoco.mj_forward(simulation.model, simulation.data)
    reports = simulate(client, simulation, 0.05)
    reply = reports[0].reply
    assert reply
    ball = simulation.motion(0)
    answer = reply.contacts[0]
    return Rebound(ball.velocity, float(ball.angular_velocity[0]), answer, reply.energy), simulation


def main() -> None:
    argument = sys.argv[1] if len(sys.argv) > 1 else None
    daemon = argument is not None and argument.isdigit()
    with percuss.connect(int(argument or 0)) if daemon else percuss.Local(argument) as client:
        print("spin/(rad/s)  rebound/(m/s)  spin/(rad/s)  angle/deg       e      e_t  contact   friction/uJ")
        for spin in (-60.0, -30.0, 0.0, 30.0, 60.0):
            after, _ = throw(client, spin)
            print(
                f"{spin:12.1f}  {after.speed:13.4f}  {after.spin:12.2f}  {after.angle:9.1f}  "
                f"{after.answer.restitution:6.3f}  {after.answer.tangential_restitution:7.3f}  "
                f"{after.answer.friction_state.name.lower():8}  {1e6 * after.energy.friction:12.1f}"
            )


if __name__ == "__main__":
    main()
