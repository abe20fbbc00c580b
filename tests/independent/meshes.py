# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""One sheared block in every format that percuss-reduce reads, as programs write it and damaged: mass, centre, inertia and
the first frequencies, free and held, against an assembly that shares nothing with ours; damaged files are refused with
words.

The reference: shape functions by the inverse of the monomials' matrix at the nodes, Gauss's rule of four points a direction
(collapsed for tetrahedra and wedges), dense eigenvalues. Elements are sheared but straight, so that both assemblies are exact; nodes
lie on eighths of a millimetre, so that eight columns hold them.

usage: meshes.py PERCUSS_REDUCE [FOLDER]     FOLDER keeps the files
"""

import json
import math
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.linalg import eigh

YOUNG, POISSON, DENSITY = 210e9, 0.3, 7800.0
MODES = 4

# ---------------------------------------------------------------- the block, with nodes in an order of our own

EDGES = {4: [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
         6: [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
         8: [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]}
FACES = [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
# corners of a cell as steps along x, y, z
CUBE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
SIDES = {4: [(0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)],
         6: [(0, 1, 2), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
         8: FACES}
KUHN = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
WEDGES = [(0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)]


class Block:
    """Cells of unequal size, sheared; elements of `kind` (tet10, wedge15, hex20, hex27). The face x = 0 is to be held."""

    def __init__(self, kind):
        self.kind, self.index, self.points, self.elements = kind, {}, [], []
        for i in range(2):
            corners = [(i + a, b, c) for a, b, c in CUBE]
            for cell in {"tet10": KUHN, "wedge15": WEDGES}.get(kind, [range(8)]):
                self.add([corners[c] for c in cell])
        self.points = np.array(self.points)
        self.foot = [n for n, key in enumerate(self.index) if key[0] == 0]

    def add(self, corners):
        def middle(which):
            return tuple(sum(corners[c][k] for c in which) / len(which) for k in range(3))
        keys = corners + [middle(e) for e in EDGES[len(corners)]]
        if self.kind == "hex27":
            keys += [middle(f) for f in FACES] + [middle(range(8))]
        self.elements.append([self.node(tuple(float(k) for k in key)) for key in keys])

    def node(self, key):
        if key not in self.index:
            self.index[key] = len(self.points)
            x, y, z = (np.interp(key[0], [0, 1, 2], [0, 8, 20]), 6 * key[1], 8 * key[2])
            self.points.append([x + y / 4 + z / 8, y - z / 4, z])
        return self.index[key]

    def corners(self):
        return {"tet10": 4, "wedge15": 6}.get(self.kind, 8)

    def foot_faces(self):
        """Triangles or quadrangles, corners and mid nodes, of the face x = 0."""
        sides, edges, held = SIDES[self.corners()], EDGES[self.corners()], set(self.foot)
        for element in self.elements:
            for side in sides:
                if not all(element[c] in held for c in side):
                    continue
                ring = [(side[k], side[(k + 1) % len(side)]) for k in range(len(side))]
                mids = [next(i for i, e in enumerate(edges) if set(e) == set(r)) for r in ring]
                yield [element[c] for c in side] + [element[self.corners() + m] for m in mids]


# ---------------------------------------------------------------- the reference

def natural(kind):
    """Natural coordinates of the nodes, and exponents of the monomials."""
    if kind == "tet10":
        at = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        powers = [(a, b, c) for a in range(3) for b in range(3) for c in range(3) if a + b + c <= 2]
    elif kind == "wedge15":  # once squared along the third direction, no more than linear in the others
        at = [(0, 0, -1), (1, 0, -1), (0, 1, -1), (0, 0, 1), (1, 0, 1), (0, 1, 1)]
        powers = [(a, b, c) for a in range(3) for b in range(3) for c in range(3) if a + b <= (1 if c == 2 else 2)]
    else:
        at = [tuple(2 * k - 1 for k in corner) for corner in CUBE]
        powers = [(a, b, c) for a in range(3) for b in range(3) for c in range(3)]
    corners = list(at)
    at += [tuple((p + q) / 2 for p, q in zip(corners[a], corners[b])) for a, b in EDGES[len(corners)]]
    if kind == "hex27":
        at += [tuple(sum(corners[c][k] for c in f) / 4 for k in range(3)) for f in FACES] + [(0, 0, 0)]
    if kind == "hex20":  # serendipity: one direction is squared at most
        powers = [p for p in powers if sum(k == 2 for k in p) <= 1]
    return np.array(at, float), powers


def rule(kind):
    x, w = np.polynomial.legendre.leggauss(4)
    if kind == "wedge15":
        y, v = (x + 1) / 2, w / 2
        return [((a, b * (1 - a), c), u * s * t * (1 - a)) for a, u in zip(y, v) for b, s in zip(y, v) for c, t in zip(x, w)]
    if kind != "tet10":
        return [((a, b, c), u * v * t) for a, u in zip(x, w) for b, v in zip(x, w) for c, t in zip(x, w)]
    x, w = (x + 1) / 2, w / 2
    return [((a, b * (1 - a), c * (1 - a) * (1 - b)), u * v * t * (1 - a) ** 2 * (1 - b))
            for a, u in zip(x, w) for b, v in zip(x, w) for c, t in zip(x, w)]


def monomials(powers, at, by=None):
    result = []
    for p in powers:
        value = 1.0
        for k in range(3):
            value *= (p[k] * at[k] ** (p[k] - 1) if p[k] else 0.0) if k == by else at[k] ** p[k]
        result.append(value)
    return np.array(result)


def assemble(block):
    """K, M, mass, centre, inertia about it, in SI."""
    at, powers = natural(block.kind)
    inverse = np.linalg.inv(np.array([monomials(powers, a) for a in at]))
    lame, shear = YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON), YOUNG / 2 / (1 + POISSON)
    law = np.diag([2 * shear] * 3 + [shear] * 3)
    law[:3, :3] += lame
    points, n = 1e-3 * block.points, 3 * len(block.points)
    K, M = np.zeros((n, n)), np.zeros((n, n))
    mass, first, second = 0.0, np.zeros(3), np.zeros((3, 3))
    values = [(monomials(powers, g) @ inverse, np.array([monomials(powers, g, k) @ inverse for k in range(3)]), w)
              for g, w in rule(block.kind)]
    for element in block.elements:
        nodes = points[element]
        which = np.array([3 * e + k for e in element for k in range(3)])
        for shape, slope, weight in values:
            jacobian = slope @ nodes
            volume = weight * np.linalg.det(jacobian)
            assert volume > 0
            gradient = np.linalg.solve(jacobian, slope)
            B = np.zeros((6, 3 * len(element)))
            for k in range(3):
                B[k, k::3] = gradient[k]
                a, b = (k + 1) % 3, (k + 2) % 3
                B[3 + k, a::3], B[3 + k, b::3] = gradient[b], gradient[a]
            K[np.ix_(which, which)] += volume * B.T @ law @ B
            N = np.kron(shape, np.eye(3))
            M[np.ix_(which, which)] += DENSITY * volume * N.T @ N
            place = shape @ nodes
            mass += DENSITY * volume
            first += DENSITY * volume * place
            second += DENSITY * volume * np.outer(place, place)
    centre = first / mass
    second -= mass * np.outer(centre, centre)
    return K, M, mass, centre, np.trace(second) * np.eye(3) - second


# a mass of 0.02 kg on a node; the block has 7.5e-3
MASSIVE = 5
POINT = 0.02


def add_mass(block, M, mass, centre, inertia):
    place = 1e-3 * block.points[MASSIVE]
    M[3 * MASSIVE:3 * MASSIVE + 3, 3 * MASSIVE:3 * MASSIVE + 3] += POINT * np.eye(3)
    arm = place - centre
    inertia = inertia + mass * POINT / (mass + POINT) * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return mass + POINT, (mass * centre + POINT * place) / (mass + POINT), inertia


class Reference:
    def __init__(self, kind, massive=False):
        self.block = Block(kind)
        K, M, self.mass, self.centre, self.inertia = assemble(self.block)
        if massive:
            self.mass, self.centre, self.inertia = add_mass(self.block, M, self.mass, self.centre, self.inertia)
        self.free = np.sqrt(eigh(K, M, eigvals_only=True)[6:6 + MODES]) / 2 / math.pi
        held = {3 * n + k for n in self.block.foot for k in range(3)}
        rest = [i for i in range(len(K)) if i not in held]
        self.held = np.sqrt(eigh(K[np.ix_(rest, rest)], M[np.ix_(rest, rest)], eigvals_only=True)[:MODES]) / 2 / math.pi


# ---------------------------------------------------------------- writers

# our node of each node of a format; our own order is VTK's, but for the faces of 27 nodes: ours are bottom, top, front,
# right, back, left
VTK = {"tet10": range(10), "wedge15": range(15), "hex20": range(20), "hex27": list(range(20)) + [25, 23, 22, 24, 20, 21, 26]}
ABAQUS = {"tet10": range(10), "wedge15": range(15), "hex20": range(20)}
NASTRAN = {"tet10": range(10), "wedge15": [*range(9), 12, 13, 14, 9, 10, 11], "hex20": [*range(12), 16, 17, 18, 19, 12, 13, 14, 15]}
UNV = {"tet10": [0, 4, 1, 5, 2, 6, 7, 8, 9, 3],
       "wedge15": [0, 6, 1, 7, 2, 8, 12, 13, 14, 3, 9, 4, 10, 5, 11],
       "hex20": [0, 8, 1, 9, 2, 10, 3, 11, 16, 17, 18, 19, 4, 12, 5, 13, 6, 14, 7, 15]}
GMSH = {"tet10": [0, 1, 2, 3, 4, 5, 6, 7, 9, 8],
        "wedge15": [0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10],
        "hex20": [*range(8), 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14],
        "hex27": [*range(8), 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14, 20, 22, 25, 23, 24, 21, 26]}


def number(value):
    return f"{value:.3f}".rstrip("0")


def bdf_card(fields, style):
    """A card in one of the styles of Nastran: blank, plus, marks, free, large."""
    name, data = fields[0], [str(f) for f in fields[1:]]
    if style == "free":
        lines = [data[i:i + 8] for i in range(0, len(data), 8)]
        return "".join((name if i == 0 else "+") + "," + ",".join(line) + (",+" if i < len(lines) - 1 else "") + "\n"
                       for i, line in enumerate(lines))
    wide = style == "large"
    per, width = (4, 16) if wide else (8, 8)
    lines = [data[i:i + per] for i in range(0, len(data), per)]
    text = ""
    for i, line in enumerate(lines):
        mark = {"blank": ["", ""], "plus": ["+", "+"], "large": ["*", "*"],
                "marks": [f"+C{i - 1}", f"+C{i}"]}[style]
        front = (name + ("*" if wide else "")) if i == 0 else mark[0]
        body = "".join(f"{d:>{width}}" for d in line)
        if i < len(lines) - 1:
            body = f"{body:<{per * width}}" + mark[1]
        text += f"{front:<8}{body}\n"
    return text


def bdf(block, style, *, place=None, grid=(), mesh_only=False, corners=None, head="", spc=True):
    """`place` turns points into the coordinates that GRIDs have; `grid` gives their CP."""
    text = "" if mesh_only else "SOL 103\nCEND\nTITLE = a block\nBEGIN BULK\n"
    text += head
    if not mesh_only:
        text += "PSOLID,3,5\nMAT1,5,210.+3,,.3,7.8-9\n"
    for i, point in enumerate(block.points):
        x = place(point) if place else point
        wide = place is not None
        cells = [f"{v:.11G}" if "." in f"{v:.11G}" else f"{v:.11G}." for v in x] if wide else [number(v) for v in x]
        text += bdf_card(["GRID", i + 1, *(grid or [""]), *cells], "large" if wide else style)
    name = {"tet10": "CTETRA", "wedge15": "CPENTA"}.get(block.kind, "CHEXA")
    for e, element in enumerate(block.elements):
        nodes = [element[i] + 1 for i in NASTRAN[block.kind]][:corners]
        text += bdf_card([name, e + 1, 3, *nodes], style)
    if spc:
        text += bdf_card(["SPC1", 1, 123, *[n + 1 for n in block.foot]], "free" if style == "large" else style)
    return text + ("" if mesh_only else "ENDDATA\n")


# a wedge whose first triangle is seen from the other side, as VTK's manual has it
OVER = [0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13]


def vtk(block, version, binary, corners=None, over=False):
    order = OVER if over else VTK[block.kind]
    cells = [[e[i] for i in order][:corners] for e in block.elements]
    faces = list(block.foot_faces())
    code = {4: 10, 6: 13, 8: 12, 10: 24, 15: 26, 20: 25, 27: 29}[len(cells[0])]
    flat = 5 if len(faces[0]) == 6 else 9
    rows = cells + [f[:3 if flat == 5 else 4] for f in faces]
    if corners is None:
        flat = 22 if flat == 5 else 23
        rows = cells + faces
    out = [f"# vtk DataFile Version {version}\nblock\n{'BINARY' if binary else 'ASCII'}\nDATASET UNSTRUCTURED_GRID\n"
           .encode()]

    def put(values, code):
        values = list(values)
        out.append(struct.pack(f">{len(values)}{code}", *values) if binary
                   else (" ".join(repr(v) for v in values)).encode())
        out.append(b"\n")

    out.append(f"POINTS {len(block.points)} double\n".encode())
    put([float(v) for p in block.points for v in p], "d")
    total = sum(map(len, rows))
    if version >= 5:
        out.append(f"CELLS {len(rows) + 1} {total}\nOFFSETS vtktypeint64\n".encode())
        put(np.cumsum([0] + [len(r) for r in rows]).tolist(), "q")
        out.append(b"CONNECTIVITY vtktypeint64\n")
        put([n for r in rows for n in r], "q")
    else:
        out.append(f"CELLS {len(rows)} {total + len(rows)}\n".encode())
        put([n for r in rows for n in [len(r), *r]], "i")
    out.append(f"CELL_TYPES {len(rows)}\n".encode())
    put([code] * len(cells) + [flat] * len(faces), "i")
    out.append(f"CELL_DATA {len(rows)}\nSCALARS group int 1\nLOOKUP_TABLE default\n".encode())
    put([1] * len(cells) + [7] * len(faces), "i")
    return b"".join(out)


def unv(block, nodes_in=2411, elements_in=2412, groups_in=2467, corners=None):
    text = f"    -1\n{nodes_in:6}\n"
    for i, (x, y, z) in enumerate(block.points):
        text += f"{i + 1:10}{1:10}{1:10}{11:10}\n" + "".join(f"{v:25.16E}" for v in (x, y, z)).replace("E", "D") + "\n"
    text += f"    -1\n    -1\n{elements_in:6}\n"

    def add(label, kind, nodes):
        head = [label, kind, 3, 1, 7, len(nodes)] if elements_in == 2412 else [label, kind, 1, 3, 1, 1, 7, len(nodes)]
        lines = [nodes[i:i + 8] for i in range(0, len(nodes), 8)]
        return "".join("".join(f"{v:10}" for v in row) + "\n" for row in [head, *lines])

    solid = {4: 111, 6: 112, 8: 115, 10: 118, 15: 113, 20: 116}[corners or len(block.elements[0])]
    for e, element in enumerate(block.elements):
        order = UNV[block.kind] if not corners else range(corners)
        text += add(e + 1, solid, [element[i] + 1 for i in order])
    faces = list(block.foot_faces())
    for f, face in enumerate(faces):
        size = len(face) // 2
        ring = face[:size] if corners else [n for pair in zip(face[:size], face[size:]) for n in pair]
        text += add(1000 + f, {3: 91, 4: 94, 6: 92, 8: 95}[len(ring)], [n + 1 for n in ring])
    text += f"    -1\n    -1\n{groups_in:6}\n"
    more = [0, 0] if groups_in in (2435, 2452, 2467, 2477) else []
    entities = [v for f in range(len(faces)) for v in [8, 1000 + f, *more]]
    text += "".join(f"{v:10}" for v in [1, 0, 0, 0, 0, 0, 0, len(faces)]) + "\nfoot\n"
    for i in range(0, len(entities), 8):
        text += "".join(f"{v:10}" for v in entities[i:i + 8]) + "\n"
    return text + "    -1\n"


def msh41(block, binary=False, corners=None, tag=1, partitions=0, mirrored=False):
    """Volume 1 in the group "block", surface 1 in the group "foot"; `tag` -1 turns both over."""
    order = GMSH[block.kind]
    cells = [[e[i] + 1 for i in order][:corners] for e in block.elements]
    if mirrored:  # corners 2 and 3 change places, and their edges
        cells = [[c[i] for i in [0, 2, 1, 3, 6, 5, 4, 7, 9, 8]] for c in cells]
    faces = [[n + 1 for n in (f[:len(f) // 2] if corners else f)] for f in block.foot_faces()]
    solid = {4: 4, 6: 6, 8: 5, 10: 11, 15: 18, 20: 17, 27: 12}[len(cells[0])]
    flat = {3: 2, 4: 3, 6: 9, 8: 16}[len(faces[0])]
    out = [f"$MeshFormat\n4.1 {int(binary)} 8\n".encode()]

    def put(layout, *values):
        out.append(struct.pack("=" + layout, *values) if binary else
                   (" ".join(repr(v) for v in values) + "\n").encode())

    if binary:
        put("i", 1)
    end = b"\n" if binary else b""
    out.append(end + b'$EndMeshFormat\n$PhysicalNames\n2\n2 5 "foot"\n3 6 "block"\n$EndPhysicalNames\n$Entities\n')
    put("QQQQ", 0, 0, 1, 1)
    box = [float(v) for v in [*block.points.min(0), *block.points.max(0)]]
    put("i6dQiQ", 1, *box, 1, tag * 5, 0)
    put("i6dQiQ", 1, *box, 1, tag * 6, 0)
    out.append(end + b"$EndEntities\n")
    volumes = [(1, cells)]
    if partitions:
        half = len(cells) // 2
        volumes = [(11, cells[:half]), (12, cells[half:])][:partitions]
        out.append(b"$PartitionedEntities\n")
        put("QQ", 2, 0)
        put("QQQQ", 0, 0, 1, len(volumes))
        put("iiiQi6dQiQ", 1, 2, 1, 1, 1, *box, 1, 5, 0)
        for k, (entity, _) in enumerate(volumes):
            put("iiiQi6dQiQ", entity, 3, 1, 1, k + 1, *box, 1, 6, 0)
        out.append(end + b"$EndPartitionedEntities\n")
    out.append(b"$Nodes\n")
    n = len(block.points)
    put("QQQQ", 1, n, 1, n)
    put("iiiQ", 3, volumes[0][0], 0, n)
    for i in range(n):
        put("Q", i + 1)
    for p in block.points:
        put("ddd", *[float(v) for v in p])
    out.append(end + b"$EndNodes\n$Elements\n")
    count = len(cells) + len(faces)
    put("QQQQ", 1 + len(volumes), count, 1, count)
    put("iiiQ", 2, 1, flat, len(faces))
    label = 1
    for face in faces:
        put(f"Q{len(face)}Q", label, *face)
        label += 1
    for entity, some in volumes:
        put("iiiQ", 3, entity, solid, len(some))
        for cell in some:
            put(f"Q{len(cell)}Q", label, *cell)
            label += 1
    out.append(end + b"$EndElements\n")
    return b"".join(out)


def msh22(block):
    order, faces = GMSH[block.kind], list(block.foot_faces())
    text = '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 5 "foot"\n3 6 "block"\n$EndPhysicalNames\n$Nodes\n'
    text += f"{len(block.points)}\n" + "".join(f"{i + 1} {x} {y} {z}\n" for i, (x, y, z) in enumerate(block.points))
    solid, flat = (11, 9) if block.kind == "tet10" else (17, 16)
    text += f"$EndNodes\n$Elements\n{len(faces) + len(block.elements)}\n"
    rows = [(flat, 5, f) for f in faces] + [(solid, 6, [e[i] for i in order]) for e in block.elements]
    for label, (kind, group, nodes) in enumerate(rows):
        text += f"{label + 1} {kind} 2 {group} 1 " + " ".join(str(n + 1) for n in nodes) + "\n"
    return text + "$EndElements\n"


def inp(block):
    text = "*HEADING\na block\n*NODE\n" + "".join(f"{i + 1}, {x}, {y}, {z}\n" for i, (x, y, z) in enumerate(block.points))
    text += f"*ELEMENT, TYPE={ {'tet10': 'C3D10', 'wedge15': 'C3D15'}.get(block.kind, 'C3D20')}, ELSET=block\n"
    for e, element in enumerate(block.elements):
        nodes = [element[i] + 1 for i in ABAQUS[block.kind]]
        text += f"{e + 1}, " + ", ".join(map(str, nodes[:15])) + (",\n" + ", ".join(map(str, nodes[15:])) if nodes[15:] else "") + "\n"
    text += "*NSET, NSET=foot\n" + "".join(f"{n + 1},\n" for n in block.foot)
    text += "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., .3\n*DENSITY\n7.8e-9\n*SOLID SECTION, ELSET=block, MATERIAL=STEEL\n"
    return text


# ---------------------------------------------------------------- the corpus

def turned(p):
    """In a system at (1, 2, 3) whose x is y, y is z and z is x."""
    return p[1] - 2, p[2] - 3, p[0] - 1


def in_cylinder(p):
    """In cylindrical coordinates about the same axes."""
    x, y, z = turned(p)
    return math.hypot(x, y), math.degrees(math.atan2(y, x)), z


# 8 stands in 7, whose origin is moved alone
CHAIN = ("CORD2R,7,,1.,0.,0.,1.,0.,1.\n,2.,0.,0.\n"
         "CORD2{},8,7,0.,2.,3.,1.,2.,3.\n,0.,3.,3.\n")


# a table of a colour, texts and their METADATA in bytes
BEFORE_GROUPS = (b"LOOKUP_TABLE t 1\n\x01\x0a\x03\x04\nFIELD f 1\nnames 1 2 string\n\xc1a\xc1b\n"
                 b"METADATA\nCOMPONENT_NAMES\nX%20Y\n\n")


def right_files(tet, hexa, full, wedge, massive):
    """(name, contents, reference, arguments, set that is held)"""
    given = ["--young", "210GPa", "--poisson", ".3", "--density", "7800"]
    t, h, f, w = tet.block, hexa.block, full.block, wedge.block
    spc, foot, seven = "SPC 1", "foot", "group 7"
    yield "blank.bdf", bdf(h, "blank"), hexa, [], spc
    yield "plus.bdf", bdf(t, "plus"), tet, [], spc
    yield "marks.bdf", bdf(h, "marks"), hexa, [], spc
    yield "commas.nas", bdf(t, "free"), tet, [], spc
    yield "wide.bdf", bdf(h, "large"), hexa, [], spc
    yield "alone.bdf", bdf(t, "blank", mesh_only=True), tet, given, spc
    yield "alone.dat", bdf(h, "marks", mesh_only=True), hexa, given, spc
    yield "chain.bdf", bdf(t, "plus", place=turned, grid=[8], head=CHAIN.format("R")), tet, [], spc
    yield "cylinder.bdf", bdf(h, "blank", place=in_cylinder, grid=[8], head=CHAIN.format("C")), hexa, [], spc
    yield "grdset.bdf", bdf(t, "blank", place=turned, head=CHAIN.format("R") + "GRDSET,,8,,,,8\n"), tet, [], spc
    yield "parts.bdf", bdf(t, "plus", head="INCLUDE 'empty.inc'\n"), tet, [], spc
    yield "linear.bdf", bdf(h, "blank", corners=8), hexa, ["--raise"], None
    yield "weights.bdf", bdf(t, "plus").replace("TITLE", "  param,wtmass,.5\n        TITLE").replace("7.8-9", "1.56-8"), tet, [], spc
    yield "head.bdf", "INCLUDE 'head.inc'\n" + bdf(h, "blank").partition("BEGIN BULK\n")[2], hexa, [], spc
    yield "two.vtk", vtk(h, 2.0, False), hexa, given, seven
    yield "three.vtk", vtk(t, 3.0, True), tet, given, seven
    yield "five.vtk", vtk(f, 5.1, False), full, given, None
    yield "bytes.vtk", vtk(h, 5.1, True), hexa, given, seven
    yield "behind.vtk", vtk(h, 5.1, True).replace(b"SCALARS", BEFORE_GROUPS + b"SCALARS"), hexa, given, seven
    yield "linear.vtk", vtk(t, 5.1, True, corners=4), tet, [*given, "--raise"], seven
    yield "salome.unv", unv(t), tet, given, foot
    yield "older.unv", unv(h, 781, 780, 2435), hexa, given, foot
    yield "oldest.unv", unv(h, 781, 2412, 2432), hexa, given, foot
    rest, mark, groups = unv(t).rpartition("    -1\n  2467\n")
    yield "first.unv", mark + groups + rest, tet, given, foot
    yield "linear.unv", unv(h, corners=8), hexa, [*given, "--raise"], foot
    yield "text.msh", msh41(t), tet, given, foot
    yield "bytes.msh", msh41(f, binary=True), full, given, None
    yield "turned.msh", msh41(h, tag=-1), hexa, given, foot
    yield "cut.msh", msh41(t, partitions=2), tet, given, foot
    yield "cutbytes.msh", msh41(h, binary=True, partitions=2), hexa, given, foot
    yield "mirrored.msh", msh41(t, mirrored=True), tet, given, foot
    yield "linear.msh", msh41(t, corners=4), tet, [*given, "--raise"], foot
    yield "tets.inp", inp(t), tet, [], foot
    yield "bricks.msh", inp(h), hexa, [], foot  # a deck, whatever its name
    point = f"CONM2,900,{MASSIVE + 1},,1.-5\nCONM2,901,{MASSIVE + 1},0,3.-5,0.,0.\n"
    yield "masses.bdf", bdf(h, "free", head="PARAM,WTMASS,.5\n" + point).replace("7.8-9", "1.56-8"), massive, [], spc
    offset = "CONM2,902,1,,9.,1.\nCONM2,903,1,-1,9.,,,,,+\n+,9.\nGRID,9999,,0.,0.,9.\nCONM2,904,9999,,9.\n"
    yield "apart.bdf", bdf(h, "free", head=offset), hexa, [], spc
    yield "wedges.bdf", bdf(w, "blank"), wedge, [], spc
    yield "linearwedges.bdf", bdf(w, "plus", corners=6), wedge, ["--raise"], None
    yield "wedges.vtk", vtk(w, 2.0, False), wedge, given, seven
    yield "overwedges.vtk", vtk(w, 5.1, True, over=True), wedge, given, seven
    yield "linearwedges.vtk", vtk(w, 3.0, True, corners=6), wedge, [*given, "--raise"], seven
    yield "wedges.unv", unv(w), wedge, given, foot
    yield "linearwedges.unv", unv(w, corners=6), wedge, [*given, "--raise"], foot
    yield "wedges.msh", msh41(w, binary=True), wedge, given, foot
    yield "linearwedges.msh", msh41(w, corners=6), wedge, [*given, "--raise"], foot
    yield "wedges.inp", inp(w), wedge, [], foot
    if shutil.which("gmsh"):
        yield "older.msh", msh22(t), tet, given, foot


def damaged_files(tet, hexa):
    """(name, contents, words of the refusal)"""
    t, h = tet.block, hexa.block
    good = bdf(h, "marks")
    yield "mark.bdf", good.replace("+C0 ", "+X0 ", 1), "the continuation +X0 must follow the line that ends with this mark"
    yield "system.bdf", bdf(t, "plus", grid=[9]), "GRID 1: coordinate system 9: must be one of the file's"
    yield "linear4.bdf", bdf(t, "blank", corners=4), "CTETRA: 1: has 4 nodes: must be of second order"
    yield "middle.bdf", bdf(h, "blank", corners=19), "CHEXA: 1: has 11 of 12 mid nodes"
    yield "shells.bdf", "BEGIN BULK\nGRID,1\nCQUAD4,1,1,1,1,1,1\n", "1 shells (CQUAD4, CTRIA3, ...) and no solid"
    yield "twice.bdf", good.replace("MAT1", "MAT1,5,7.+4,,.3,2.7-9\nMAT1", 1), ":7: MAT1 5: differs from that of "
    yield "waves.bdf", good.replace("7.8-9", "7.8-12"), "waves of 164083 m/s: must be at most 20000"
    yield "cells.vtk", vtk(h, 5.1, True).replace(b"CELL_DATA ", b"CELL_DATA 1"), ": must be of all "
    yield "gone.bdf", "BEGIN BULK\nINCLUDE 'gone.inc'\n", "gone.inc: No such file"
    yield "short.vtk", vtk(h, 5.1, True)[:-700], "the file ends before: it must be whole"
    yield "linear8.vtk", vtk(h, 5.1, False, corners=8), "cell 0: hexahedron of 8 nodes (type 12): must be of second"
    yield "short.unv", unv(t)[:-8], "is the file whole?"
    yield "linear4.unv", unv(t, corners=4), "element 1: linear tetrahedron (111): must be parabolic"
    yield "half.msh", msh41(t, partitions=1), "holds 1 of 2 partitions: must be whole"
    yield "short.msh", msh41(h, binary=True)[:-300], "byte "
    yield "salome.med", b"\x89HDF\r\n\x1a\n", "Export, UNV file"
    yield "ansys.cdb", "/COM,ANSYS RELEASE 2021 R1\n/PREP7\n", "is an archive of ANSYS"
    yield "dyna.k", "*KEYWORD\n*NODE\n", "is a keyword file of LS-DYNA"


def write(path, contents):
    path.write_bytes(contents if isinstance(contents, bytes) else contents.encode())


def reduce(program, path, arguments):
    command = [program, str(path), "-o", str(path.parent / "body.h5"), "--unit", "mm", "--modes", str(MODES), "--json"]
    return subprocess.run(command + arguments, capture_output=True, text=True, timeout=60)


def close(name, what, found, expected, scale, relative=1e-8):
    error = np.abs(np.asarray(found) - np.asarray(expected)).max() / scale
    if not error <= relative:
        print(f"{name}: {what}: {found}: must be {expected} (off by {error:.2g})")
        return False
    return True


def check(program, path, reference, arguments, held):
    """Held where the file names the nodes. Cylindrical coordinates of eleven digits are good to 1e-9 of the block."""
    run = reduce(program, path, arguments + (["--fixed", held] if held else []))
    if run.returncode:
        print(f"{path.name}: {run.stderr.strip()}")
        return False
    report, name = json.loads(run.stdout), path.name
    frequencies = reference.held if held else reference.free
    inertia = np.reshape(report["inertia"], (3, 3))
    # a reader that turned nothing over says nothing of it
    if "wedges" in name and any("wrong way round" in line for line in report["warnings"]):
        print(f"{name}: {report['warnings']}")
        return False
    return (close(name, "mass", report["mass"], reference.mass, reference.mass)
            & close(name, "centre", report["centre"], reference.centre, 0.02)
            & close(name, "inertia", inertia, reference.inertia, reference.inertia.max(), 1e-7)
            & close(name, "frequencies", report["frequencies"][:MODES], frequencies, frequencies[0], 1e-7))


# a sheared block of prisms
PRISMS = """SetFactory("OpenCASCADE");
Point(1) = {0,0,0}; Point(2) = {20,0,0}; Point(3) = {22,7,0}; Point(4) = {1,9,0};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Extrude {2,1,10} { Surface{1}; Layers{2}; Recombine; }
"""


def prisms_of_gmsh(program, folder):
    """One mesh of 15-node prisms as Gmsh itself writes it in each format: how many differ from its deck of C3D15."""
    write(folder / "prisms.geo", PRISMS)
    given, reports = ["--young", "210GPa", "--poisson", ".3", "--density", "7800"], {}
    for kind in ("inp", "msh", "vtk", "unv", "bdf"):
        path = folder / f"prisms.{kind}"
        subprocess.run(["gmsh", "-3", "-order", "2", "-clmax", "8", "-setnumber", "Mesh.SecondOrderIncomplete", "1",
                        "-setnumber", "Mesh.SaveAll", "1", str(folder / "prisms.geo"), "-format", kind, "-o", str(path)],
                       capture_output=True, check=True, timeout=60)
        run = reduce(program, path, given)
        reports[kind] = json.loads(run.stdout) if run.returncode == 0 else print(f"{path.name}: {run.stderr.strip()}")
    right, failed = reports.pop("inp"), 0
    for kind, report in reports.items():
        # coordinates of bulk data have eight columns
        within = 1e-6 if kind == "bdf" else 1e-10
        failed += not (report and close(f"prisms.{kind}", "mass", report["mass"], 0.012909, 0.012909, within)
                       & close(f"prisms.{kind}", "frequencies", report["frequencies"], right["frequencies"],
                               right["frequencies"][0], within))
    return failed


def main():
    program = sys.argv[1]
    keep = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    references = [Reference(kind) for kind in ("tet10", "hex20", "hex27", "wedge15")] + [Reference("hex20", True)]
    # the block in closed form: base times height, sheared
    for reference in references[:-1]:
        assert abs(reference.mass / (DENSITY * 20 * 6 * 8e-9) - 1) < 1e-12
    count = failed = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = keep or Path(temporary)
        folder.mkdir(exist_ok=True)
        write(folder / "empty.inc", "$ nothing\n")
        write(folder / "head.inc", "SOL 103\nCEND\nSPC = 1\nBEGIN BULK\n")
        for name, contents, reference, arguments, held in right_files(*references):
            write(folder / name, contents)
            count += 1
            failed += not check(program, folder / name, reference, arguments, held)
        for name, contents, words in damaged_files(*references[:2]):
            write(folder / name, contents)
            run = reduce(program, folder / name, ["--young", "210GPa", "--poisson", ".3", "--density", "7800"])
            count += 1
            if run.returncode == 0 or words not in run.stderr:
                print(f"{name}: must be refused with \"{words}\": {run.returncode} {run.stderr.strip()}")
                failed += 1
        if shutil.which("gmsh"):
            count += 4
            failed += prisms_of_gmsh(program, folder)
    print(f"{count} files, {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
