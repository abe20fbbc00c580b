# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""CalculiX's decks of impacts: two solids in contact, or a bar or plate that Hertz's spring and a mass strike.

What does not work in version 2.20: automatic steps stall when the contact closes (increments of 2e-14 s), explicit steps give
nothing within a minute and their massless contact takes no axisymmetric elements, contact of nodes to surfaces diverges, and
initial velocities of axisymmetric elements, which it makes solids of, are lost. So steps are direct (HHT, alpha -0.05), contact is
surface to surface with a linear pressure, and gravity over two microseconds launches the sphere.
"""

import math
import os
import resource
import subprocess
import tempfile
from pathlib import Path

import numpy as np

LIMIT = 240  # s of one run
CONTROL = "*DYNAMIC, DIRECT, ALPHA={alpha}"
FLIGHT = 2e-6  # s in which gravity launches a solid
POINTS = 50  # of the spring's table


def numbered(rows, first=1):
    """A line of each row behind its number. CalculiX cuts a number after 20 characters, also in its exponent."""
    return [f"{i}, " + ", ".join(map(str, row)) for i, row in enumerate(rows, first)]


def solved(lines):
    """What CalculiX prints of the nodes, by time and by node: an array of three each; and the seconds of the processor."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "deck.inp").write_text("\n".join(lines) + "\n")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        try:
            run = subprocess.run(
                ["ccx", "-i", "deck"], cwd=folder, env=dict(os.environ, OMP_NUM_THREADS="1"), stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL, timeout=LIMIT,
            )
        except FileNotFoundError:
            raise NotImplementedError("ccx is not installed") from None
        except subprocess.TimeoutExpired:
            raise RuntimeError(f"not done in {LIMIT} s") from None
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if run.returncode:
            raise RuntimeError("it stops with an error")
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return printed(Path(folder, "deck.dat").read_text()), seconds


def printed(text):
    found = {}
    for line in text.splitlines():
        words = line.split()
        if "time" in line:
            values = found.setdefault(float(words[-1]), {})
        elif len(words) == 4 and words[0].isdigit():
            values[int(words[0])] = [float(word) for word in words[1:]]
    return found


# ---- two axisymmetric solids ----


def masses(nodes, quads, density):
    """Of each node, kg: its share of the linear elements around it."""
    mass, gauss = np.zeros(len(nodes)), 1.0 / math.sqrt(3.0)
    at = nodes[quads]
    for a, b in ((-gauss, -gauss), (gauss, -gauss), (gauss, gauss), (-gauss, gauss)):
        shape = 0.25 * np.array([(1 - a) * (1 - b), (1 + a) * (1 - b), (1 + a) * (1 + b), (1 - a) * (1 + b)])
        by_a = np.einsum("i,eij->ej", 0.25 * np.array([b - 1, 1 - b, 1 + b, -1 - b]), at)
        by_b = np.einsum("i,eij->ej", 0.25 * np.array([a - 1, -1 - a, 1 + a, 1 - a]), at)
        area = by_a[:, 0] * by_b[:, 1] - by_a[:, 1] * by_b[:, 0]
        volume = 2.0 * math.pi * (at[:, :, 0] @ shape) * area
        for i in range(4):
            np.add.at(mass, quads[:, i], density * volume * shape[i])
    return mass


def solid(index, mesh, material, first, patch):
    """Nodes, elements, contact surface and material of one body; the second lies above the first, a flight's way from it."""
    nodes, quads, surface, speed = mesh
    above = index == 1
    z = -nodes[:, 1] + 0.5 * speed * FLIGHT if above else nodes[:, 1]
    quads = quads[:, ::-1] if above else quads
    yield f"*NODE, NSET=N{index}"
    yield from numbered(((f"{r:.12e}", f"{h:.12e}", 0) for r, h in zip(nodes[:, 0], z)), first[0])
    yield f"*ELEMENT, TYPE=CAX4, ELSET=E{index}"
    yield from numbered(quads + first[0], first[1])
    face = {frozenset((q[k], q[(k + 1) % 4])): (e, k + 1) for e, q in enumerate(quads.tolist()) for k in range(4)}
    yield f"*SURFACE, NAME=S{index}, TYPE=ELEMENT"
    for a, b in zip(surface, surface[1:]):
        if nodes[b, 0] > 1.6 * patch:
            break
        element, side = face[frozenset((a, b))]
        yield f"{first[1] + element}, S{side}"
    yield f"*MATERIAL, NAME=M{index}\n*ELASTIC\n{material[0]}, {material[1]}\n*DENSITY\n{material[2]}"
    yield f"*SOLID SECTION, ELSET=E{index}, MATERIAL=M{index}\n*BOUNDARY"
    yield from (f"{first[0] + i}, 1" for i in np.flatnonzero(nodes[:, 0] < 1e-12))


def solids(meshes, materials, speed, patch, stiffness, step, window):
    """Impulse over the sphere's mass and speed, and the seconds. meshes: nodes (r, z), quads and surface, in the frames of
    solid_pair, of the struck body and of the sphere; stiffness: of the contact, Pa/m; window: until the bodies have parted."""
    lines, first = [], [1, 1]
    for index, (mesh, material) in enumerate(zip(meshes, materials)):
        lines += solid(index, (*mesh, speed), material, tuple(first), patch)
        first = [first[0] + len(mesh[0]), first[1] + len(mesh[1])]
    lines += ["*SURFACE INTERACTION, NAME=C", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{stiffness:.6e}, 1e3"]
    lines += ["*CONTACT PAIR, INTERACTION=C, TYPE=SURFACE TO SURFACE", "S0, S1"]
    # launched; printed after the impact and once more: what has moved between
    lines += ["*STEP", CONTROL.format(alpha=0), f"{0.5 * FLIGHT}, {FLIGHT}", "*DLOAD", f"E1, GRAV, {speed / FLIGHT:.9g}, 0, -1, 0"]
    lines += ["*END STEP", "*STEP, INC=100000", CONTROL.format(alpha=-0.05), f"{step:.9g}, {window:.9g}", "*DLOAD, OP=NEW"]
    lines += [f"*NODE PRINT, NSET=N{i}, FREQUENCY=100000\nU" for i in range(2)]
    lines += ["*END STEP", "*STEP, INC=100000", CONTROL.format(alpha=-0.05), f"{step:.9g}, 1e-5", "*END STEP"]
    found, seconds = solved(lines)
    (before, moved), (after, farther) = sorted(found.items())[-2:]
    rate = (np.array([farther[i] for i in range(1, first[0])]) - [moved[i] for i in range(1, first[0])])[:, 1] / (after - before)
    mass = [masses(mesh[0], mesh[1], material[2]) for mesh, material in zip(meshes, materials)]
    momentum = [mass[0] @ rate[: len(mass[0])], mass[1] @ rate[len(mass[0]) :]]
    # all the momentum is the sphere's before
    launched = -(momentum[0] + momentum[1]) / mass[1].sum()
    if abs(launched / speed - 1.0) > 1e-4:
        raise RuntimeError(f"the momentum is that of {launched:.6g} m/s")
    return -momentum[0] / mass[1].sum() / launched, seconds


# ---- masses, bars and plates, and Hertz's springs between them ----


def spring(name, stiffness, deepest):
    """Force of a SPRINGA that only pushes, N over m, by points that are dense where it is soft."""
    depth = deepest * (np.arange(POINTS, 0, -1) / POINTS) ** 2
    yield f"*SPRING, ELSET={name}, NONLINEAR"
    yield from (f"{-stiffness * d**1.5:.9e}, {-d:.9e}" for d in depth)
    yield from ("0., 0.", "0., 1.")


def deepest(mass, speed, stiffness):
    """More than the indentation that the mass reaches on a rigid body, m."""
    return 1.1 * (1.25 * mass * speed**2 / stiffness) ** 0.4


def row(count, mass, stiffness, speed, step, window):
    """Speeds of equal masses after the first has struck, and the seconds."""
    lines = ["*NODE, NSET=ALL", *numbered((0.1 * i, 0, 0) for i in range(count))]
    lines += ["*ELEMENT, TYPE=MASS, ELSET=M", *numbered((i + 1,) for i in range(count)), "*MASS, ELSET=M", f"{mass:.12g}"]
    lines += ["*ELEMENT, TYPE=SPRINGA, ELSET=S", *numbered(((i + 1, i + 2) for i in range(count - 1)), count + 1)]
    lines += [*spring("S", stiffness, deepest(mass, speed, stiffness)), "*BOUNDARY", "ALL, 2, 3"]
    lines += ["*INITIAL CONDITIONS, TYPE=VELOCITY", f"1, 1, {speed:.9g}", "*STEP, NLGEOM, INC=100000", CONTROL.format(alpha=0)]
    lines += [f"{step:.9g}, {window:.9g}", "*NODE PRINT, NSET=ALL, FREQUENCY=100000", "V", "*END STEP"]
    found, seconds = solved(lines)
    after = found[max(found)]
    return np.array([after[i + 1][0] for i in range(count)]), seconds


def struck(body, mass, stiffness, speed, along, start, step, window):
    """Speed of a mass after it has struck node 1 of a body, and the seconds. body: lines of its nodes (set B, node 1 first),
    elements, section and supports, and how many nodes and elements; along: axis of the blow, 1 to 3; start: where the mass is."""
    lines, nodes, elements = body
    sphere = nodes + 1
    lines = [*lines, "*NODE, NSET=N", f"{sphere}, {start}", "*ELEMENT, TYPE=MASS, ELSET=M", f"{elements + 1}, {sphere}"]
    lines += ["*ELEMENT, TYPE=SPRINGA, ELSET=S", f"{elements + 2}, {sphere}, 1", "*MASS, ELSET=M", f"{mass:.12g}"]
    lines += [*spring("S", stiffness, deepest(mass, speed, stiffness)), "*BOUNDARY"]
    lines += [f"N, {axis}" for axis in (1, 2, 3) if axis != along]
    lines += ["*INITIAL CONDITIONS, TYPE=VELOCITY", f"N, {along}, {speed}", "*STEP, INC=100000", CONTROL.format(alpha=-0.05)]
    lines += [f"{step:.9g}, {window:.9g}", "*NODE PRINT, NSET=N, FREQUENCY=100000", "V", "*END STEP"]
    found, seconds = solved(lines)
    return found[max(found)][sphere][along - 1], seconds


def elastic(material, poisson=None):
    """poisson: of the elements, where it is not the material's."""
    ratio = material[1] if poisson is None else poisson
    return ["*MATERIAL, NAME=A", "*ELASTIC", f"{material[0]}, {ratio}", "*DENSITY", f"{material[2]}"]


def truss_rod(cells, radius, length, material):
    """A rod of linear trusses along x without lateral inertia. CalculiX makes solids of them, whose pushed end dishes where they
    are shorter than the rod is broad."""
    lines = ["*NODE, NSET=B", *numbered((f"{length * i / cells:.12g}", 0, 0) for i in range(cells + 1))]
    lines += ["*ELEMENT, TYPE=T3D2, ELSET=E", *numbered((i + 1, i + 2) for i in range(cells)), *elastic(material, 0.0)]
    lines += ["*SOLID SECTION, ELSET=E, MATERIAL=A", f"{math.pi * radius**2:.12g}", "*BOUNDARY", "B, 2, 3"]
    return lines, cells + 1, cells


def half_beam(cells, radius, length, material, poisson=None):
    """Half a beam of linear elements along x from its middle, struck along z. CalculiX takes only quadratic elements of round
    section, which are soft where a node is pushed: the section is the rectangle of the same area and stiffness."""
    high = math.sqrt(3.0) * radius
    lines = ["*NODE, NSET=B", *numbered((f"{0.5 * length * i / cells:.12g}", 0, 0) for i in range(cells + 1))]
    lines += ["*ELEMENT, TYPE=B31, ELSET=E", *numbered((i + 1, i + 2) for i in range(cells)), *elastic(material, poisson)]
    lines += ["*BEAM SECTION, ELSET=E, MATERIAL=A, SECTION=RECT", f"{high:.12g}, {math.pi * radius**2 / high:.12g}", "0, 0, 1"]
    lines += ["*BOUNDARY", "B, 2", "1, 1", "1, 5"]
    return lines, cells + 1, cells


def quarter_plate(coordinates, thickness, material):
    """A quarter of a square plate of quadratic shells, struck in its middle along z; coordinates: of corner nodes along a side."""
    line = np.insert(coordinates[1:], np.arange(len(coordinates) - 1), 0.5 * (coordinates[1:] + coordinates[:-1]))
    line = np.concatenate([coordinates[:1], line])
    count = len(line)
    number, places = {}, []
    for j in range(count):
        for i in range(count):
            if i % 2 == 0 or j % 2 == 0:  # no node inside an element
                places.append((f"{line[i]:.12g}", f"{line[j]:.12g}", 0))
                number[i, j] = len(places)
    around = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
    shells = [[number[i + a, j + b] for a, b in around] for j in range(0, count - 1, 2) for i in range(0, count - 1, 2)]
    lines = ["*NODE, NSET=B", *numbered(places), "*ELEMENT, TYPE=S8R, ELSET=E", *numbered(shells), *elastic(material)]
    lines += ["*SHELL SECTION, ELSET=E, MATERIAL=A", f"{thickness}", "*BOUNDARY"]
    for (i, j), n in number.items():
        lines += [f"{n}, 1", f"{n}, 5"] if i == 0 else []
        lines += [f"{n}, 2", f"{n}, 4"] if j == 0 else []
    return lines, len(places), len(shells)
