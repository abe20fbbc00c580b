# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the synthetic files of rigs in client/examples/measured, a kind of instrument each. Bodies fall and rise freely,
meet in instants (or, for fast instruments, in half a sine of force), and each reading has an error that is drawn. The
restitution that made a file stands in its first line. The same numbers each time.
usage: make_rigs.py FOLDER"""
import math
import random
import sys
from pathlib import Path

GRAVITY = 9.80665


def write(folder, name, truth, about, head, rows):
    lines = [f"# synthetic: restitution {truth}; {about}", head, *rows]
    (folder / f"synthetic-{name}.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


def heights(folder, draw):
    """Read off a rule, to 1 mm."""
    rows = []
    for drop in (0.2, 0.3, 0.4, 0.5, 0.6):
        seen = 0.72**2 * drop + draw.gauss(0, 1e-3)
        rows.append(f"{1e3 * (drop + draw.gauss(0, 5e-4)):.0f},{1e3 * seen:.0f}")
    write(folder, "heights", 0.72, "a ball that falls on a wall; heights read to 1 mm", "drop [mm],rebound [mm]", rows)


def touches(drop, e, count):
    """Instants of the touches of a ball that is let go at 0, and its speed after each."""
    time, speed, found = math.sqrt(2 * drop / GRAVITY), math.sqrt(2 * GRAVITY * drop), []
    for _ in range(count):
        speed *= e
        found.append((time, speed))
        time += 2 * speed / GRAVITY
    return found


def microphone(folder, draw):
    times = [time + draw.gauss(0, 2e-5) for time, _ in touches(0.3, 0.9, 8)]
    rows = [f"{1e3 * (time - times[0]):.2f},{'300' if i == 0 else ''}" for i, time in enumerate(times)]
    write(folder, "microphone", 0.9, "sounds of a ball on a wall, from the first one on, each to 0.02 ms",
          "bounce [ms],drop [mm]", rows)


def camera(folder, draw):
    """240 frames a second, 0.12 mm a pixel, upwards."""
    found, rows = touches(0.3, 0.8, 3), []
    for frame in range(330):
        time = frame / 240
        past = [(begin, speed) for begin, speed in found if begin <= time]
        begin, speed = past[-1] if past else (0, 0)
        height = (0 if past else 0.3) + speed * (time - begin) - GRAVITY / 2 * (time - begin) ** 2
        rows.append(f"{frame},{height / 0.12e-3 + 120 + draw.gauss(0, 0.5):.1f}")
    write(folder, "camera", 0.8, "a ball on a wall; 240 frames a second, 0.12 mm a pixel", "frame,y", rows)


def pulse(time, length):
    """The share of the jump that half a sine of force has made by then."""
    return 0.5 * (1 - math.cos(math.pi * min(max(time / length, 0), 1)))


def accelerometer(folder, draw):
    """On the ball: free fall is 0 to it, but for an offset."""
    length, jump = 3e-4, (1 + 0.66) * math.sqrt(2 * GRAVITY * 0.3)
    rows = []
    for i in range(1200):
        time = (i - 500) * 1e-5
        force = math.sin(math.pi * time / length) if 0 < time < length else 0
        reading = jump * math.pi / (2 * length) * force / GRAVITY
        rows.append(f"{time:.5f},{reading + 0.3 + draw.gauss(0, 2):.1f}")
    write(folder, "accelerometer", 0.66, "on a ball that falls on a wall; an offset of 0.3 g", "time,acceleration_a [g]", rows)
    write(folder, "accelerometers", 0.66, "the falls of the histories", "drop [mm],history", ["300,synthetic-accelerometer.csv"])


def target(folder, draw):
    """A vibrometer on the ball that is hit by one of its mass, which leaves with (1 + e)/2 of its speed."""
    rows = []
    for i in range(2000):
        time = (i - 800) * 4e-6
        rows.append(f"{time:.6f},{(1 + 0.85) / 2 * 0.4 * pulse(time, 2e-4) + draw.gauss(0, 1e-3):.5f}")
    write(folder, "target", 0.85, "a ball of steel, hit at 0.4 m/s by its like", "time,velocity_b", rows)
    write(folder, "targets", 0.85, "the speeds of the histories", "speed,history", ["0.4,synthetic-target.csv"])


def main():
    folder, draw = Path(sys.argv[1]), random.Random(1)
    for make in heights, microphone, camera, accelerometer, target:
        make(folder, draw)


main()
