# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Two steel spheres hit a free aluminium beam at one instant: one question with two contacts, a group.

What each would do alone is printed beside it. Solves in this process; the argument may be another catalogue.
"""

import sys
from collections.abc import Sequence

import numpy as np

import percuss
from percuss.request import FloatArray
from percuss.slowscale import Contact, Inertia, Report, SlowScale
from percuss.world import FreeBodies, run

BEAM, BALL = 0.010, 0.015  # radii, m


class Spheres(FreeBodies):
    """A free beam along x, and spheres above it that come down on it; `at`: where, m from its middle."""

    def __init__(self, bodies: dict[str, percuss.Body], at: Sequence[float], speed: float, height: float) -> None:
        ids = ["al-beam"] + ["steel-sphere"] * len(at)
        motions = [percuss.BodyMotion(ids[0])]
        for x in at:
            place = (x, 0.0, BEAM + BALL + height)
            motions.append(percuss.BodyMotion(ids[1], position=place, velocity=(0.0, 0.0, -speed)))
        inertias = [Inertia(bodies[id].mass, tuple(bodies[id].inertia.tolist())) for id in ids]
        super().__init__(motions, inertias)
        self.masses = [inertia.mass for inertia in inertias]

    def contacts(self) -> list[Contact]:
        """The beam hardly turns before the impact is over: its surface is taken as flat."""
        beam = self.motion(0)
        normal = np.array([np.sin(self.tilt(beam)), 0.0, np.cos(self.tilt(beam))])
        found = []
        for i in range(1, len(self.masses)):
            centre = self.motion(i).position
            gap = float(normal @ (centre - beam.position)) - BEAM - BALL
            found.append(Contact(i, 0, centre - (BALL + 0.5 * gap) * normal, normal, gap))
        return found

    @staticmethod
    def tilt(beam: percuss.BodyMotion) -> float:
        return float(2.0 * np.arctan2(beam.orientation[2], beam.orientation[0]))


def hit(client: percuss.Client, at: Sequence[float], speed: float = 0.2) -> tuple[list[Report], Spheres]:
    """The reports, and the bodies after all impulses."""
    world = Spheres(client.bodies(), at, speed, 2e-4)
    reports: list[Report] = []
    names = ["al-beam"] + ["steel-sphere"] * len(at)
    with SlowScale(names, world, client, report=reports.append) as slow:
        run(world, slow, 0.05, 1e-3)
    return reports, world


def main() -> None:
    at = (0.3, 0.45)
    with percuss.Local(sys.argv[1] if len(sys.argv) > 1 else None) as client:
        together, _ = hit(client, at)
        alone = [hit(client, (x,))[0] for x in at]
    print("   time/s    x/m    impulse/(N s)        e        alone")
    for report in together:
        for contact, impulse, restitution in zip(report.contacts, report.impulse, report.restitution):
            x = float(contact.point[0])
            other = min(alone, key=lambda one: abs(one[0].contacts[0].point[0] - x))[0].restitution[0]
            print(f"{report.time:9.6f}  {x:5.2f}  {impulse:15.7f}  {restitution:7.4f}  {other:11.4f}")


if __name__ == "__main__":
    main()
