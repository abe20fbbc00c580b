# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""A steel ball bounces ten times, 5 mm high, on a beam that goes on ringing between the bounces.

Prints the bounces, and what the ball and the beam's vibration have together: a sum that stays, to some 1e-3, however
they share it. Draws it into bounces.svg where matplotlib is installed (`pip install percuss[plot]`). Solves in this
process; the argument may be another catalogue.
"""

import math
import sys

import percuss
from percuss.slowscale import Body, Contact, Inertia, Report, SlowScale
from percuss.world import FreeBodies, run

GRAVITY = 9.81
BEAM, BALL = 0.010, 0.015  # radii, m


class Bouncing(FreeBodies):
    """The ball above the middle of the beam, which lies along x on two pins."""

    def __init__(self, mass: float, height: float) -> None:
        ball = percuss.BodyMotion("steel-sphere", position=(0.0, 0.0, BEAM + BALL + height))
        moment = 0.4 * mass * BALL**2
        inertias = [Inertia(mass, (moment, moment, moment)), Inertia(math.inf)]
        super().__init__([ball, percuss.BodyMotion("al-beam-pinned")], inertias, (0.0, 0.0, -GRAVITY))
        self.mass = mass

    def contacts(self) -> list[Contact]:
        gap = self.motion(0).position[2] - BALL - BEAM
        # halfway between the surfaces
        return [Contact(0, 1, (0.0, 0.0, BEAM + 0.5 * gap), (0.0, 0.0, 1.0), gap, -GRAVITY)]

    def balls_energy(self) -> float:
        """J, above the ball's lying on the beam."""
        return self.energy() - self.mass * GRAVITY * (BEAM + BALL)


Course = list[tuple[float, float, float]]


def bounce(
    client: percuss.Client, count: int = 10, height: float = 5e-3, step: float = 1e-3, fixed: bool = False
) -> tuple[list[Report], Course]:
    """The reports, and at first and after each bounce: time, the ball's energy, the beam's by vibration."""
    world = Bouncing(client.bodies()["steel-sphere"].mass, height)
    reports: list[Report] = []
    course = [(0.0, world.balls_energy(), 0.0)]
    bodies = [Body("steel-sphere"), Body("al-beam-pinned", fixed=True)]
    with SlowScale(bodies, world, client, options=percuss.Options(tolerance=1e-4), report=reports.append) as slow:
        seen = 0
        while seen < count:
            run(world, slow, world.now() + step, step, fixed)
            # between two bounces, when all impulses of the last one have been played
            if len(reports) > seen and math.isinf(slow.next()):
                seen = len(reports)
                reply = reports[-1].reply
                assert reply  # without fall_back there is always one
                vibration = sum(body.energy for body in reply.energy.vibration)
                course.append((world.now(), world.balls_energy(), vibration))
    return reports, course


def draw(course: Course, path: str) -> bool:
    try:
        from matplotlib.figure import Figure
    except ImportError:
        return False
    figure = Figure(figsize=(6, 3.5), layout="constrained")
    axes = figure.add_subplot(xlabel="time / s", ylabel="energy / mJ")
    times, ball, vibration = ([1e3**i * value for value in column] for i, column in zip((0, 1, 1), zip(*course)))
    axes.stackplot(times, ball, vibration, labels=["ball", "beam's vibration"], step="post")
    figure.legend(loc="outside upper center", ncols=2)
    figure.savefig(path)
    return True


def main() -> None:
    with percuss.Local(sys.argv[1] if len(sys.argv) > 1 else None) as client:
        reports, course = bounce(client)
    print("   time/s  speed/(m/s)        e  hits")
    for report in reports:
        assert report.reply
        hits = report.reply.contacts[0].sub_impact_count
        print(f"{report.time:9.5f}  {-report.gap_rate[0]:11.5f}  {report.restitution[0]:7.4f}  {hits:4}")
    print("   time/s  ball/mJ  vibration/mJ  sum/mJ")
    for time, ball, vibration in course:
        print(f"{time:9.5f}  {1e3 * ball:7.4f}  {1e3 * vibration:12.4f}  {1e3 * (ball + vibration):6.4f}")
    if draw(course, "bounces.svg"):
        print("energy drawn: bounces.svg")


if __name__ == "__main__":
    main()
