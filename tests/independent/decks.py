# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Decks as other people write them, right and damaged: what percuss-reduce says of each, against mass, inertia and
frequencies of an assembly of its own. Its shape functions are the polynomials that interpolate an element's nodes, its
quadrature is Gauss's of five points a direction in collapsed coordinates: both share nothing with the solver's. All
elements are straight, so that integrals are exact. Exit code 1 where one differs."""

import itertools
import json
import os
import subprocess
import sys
import tempfile

import numpy as np
from scipy.linalg import eigh

REDUCE = os.path.join(os.path.dirname(os.environ["PERCUSS_LIBRARY"]), "..", "bin", "percuss-reduce")
STEEL = (210e9, 0.3, 7800.0)
LIGHT = (70e9, 0.33, 2700.0)
FREQUENCIES = 4
# rounding of two assemblies and two solvers (the conditions of these matrices are about 1e8)
WITHIN = 1e-7
failed = []

# ---- elements, nodes in the order of Abaqus' manual ----

EDGES = {
    "C3D10": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
    "C3D15": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
    "C3D20": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)],
}
CORNERS = {
    "C3D10": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    "C3D15": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)],
    "C3D20": [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
}
POWERS = {
    "C3D10": [p for p in itertools.product(range(3), repeat=3) if sum(p) <= 2],
    "C3D15": [p for p in itertools.product(range(3), repeat=3) if p[0] + p[1] <= (1 if p[2] == 2 else 2)],
    "C3D20": [p for p in itertools.product(range(3), repeat=3) if p.count(2) <= 1],
}


def with_middles(kind, corners):
    corners = [np.array(c, float) for c in corners]
    return corners + [(corners[a] + corners[b]) / 2 for a, b in EDGES[kind]]


def points_of(kind):
    """Places and weights in natural coordinates from 0 to 1."""
    x, w = np.polynomial.legendre.leggauss(5)
    x, w = (x + 1) / 2, w / 2
    for (a, wa), (b, wb), (c, wc) in itertools.product(zip(x, w), repeat=3):
        if kind == "C3D20":
            yield (a, b, c), wa * wb * wc
        elif kind == "C3D15":
            yield (a, b * (1 - a), c), wa * wb * wc * (1 - a)
        else:
            yield (a, b * (1 - a), c * (1 - a) * (1 - b)), wa * wb * wc * (1 - a) ** 2 * (1 - b)


def monomials(kind, at):
    value = np.array([np.prod([x**p for x, p in zip(at, ps)]) for ps in POWERS[kind]])
    slope = np.zeros((len(value), 3))
    for i, ps in enumerate(POWERS[kind]):
        for k in range(3):
            if ps[k]:
                slope[i, k] = ps[k] * np.prod([x ** (p - (j == k)) for j, (x, p) in enumerate(zip(at, ps))])
    return value, slope


def element(kind, places, material):
    """Stiffness, mass as scalars between nodes."""
    natural = with_middles(kind, CORNERS[kind])
    inverse = np.linalg.inv(np.array([monomials(kind, at)[0] for at in natural]))
    young, poisson, density = material
    shear = young / (2 + 2 * poisson)
    lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    n = len(places)
    stiffness, mass = np.zeros((n, 3, n, 3)), np.zeros((n, n))
    for at, weight in points_of(kind):
        value, slope = monomials(kind, at)
        shape, slope = inverse.T @ value, inverse.T @ slope
        jacobian = places.T @ slope
        gradient = slope @ np.linalg.inv(jacobian)
        volume = weight * np.linalg.det(jacobian)
        assert volume > 0
        mass += density * volume * np.outer(shape, shape)
        inner = gradient @ gradient.T
        for i, j in itertools.product(range(3), repeat=2):
            stiffness[:, i, :, j] += volume * (
                lame * np.outer(gradient[:, i], gradient[:, j])
                + shear * np.outer(gradient[:, j], gradient[:, i])
                + (shear * inner if i == j else 0)
            )
    return stiffness.reshape(3 * n, 3 * n), mass


class Body:
    """Elements (kind, corners, material) with straight edges, in millimetres. Numbers its nodes."""

    def __init__(self, elements):
        self.number, self.elements = {}, []
        for kind, corners, material in elements:
            places = with_middles(kind, corners)
            self.elements.append((kind, [self.node(p) for p in places], material))
        self.points = np.array(list(self.number)) * 1e-3

    def node(self, place):
        return self.number.setdefault(tuple(np.round(place, 9)), len(self.number) + 1)

    def plane(self, axis, value):
        return [n for p, n in self.number.items() if abs(p[axis] - value) < 1e-9]

    def solve(self, held=(), masses=()):
        """Held nodes; masses on nodes as (node, kg)."""
        n = len(self.points)
        stiffness, mass = np.zeros((3 * n, 3 * n)), np.zeros((n, n))
        for kind, nodes, material in self.elements:
            at = np.array(nodes) - 1
            k, m = element(kind, self.points[at], material)
            rows = (3 * at[:, None] + np.arange(3)).ravel()
            stiffness[np.ix_(rows, rows)] += k
            mass[np.ix_(at, at)] += m
        for node, kilograms in masses:
            mass[node - 1, node - 1] += kilograms
        total = mass.sum()
        centre = mass.sum(axis=1) @ self.points / total
        arm = self.points - centre
        second = arm.T @ mass @ arm
        free = [i for i in range(3 * n) if i // 3 + 1 not in set(held)]
        omega = eigh(stiffness[np.ix_(free, free)], np.kron(mass, np.eye(3))[np.ix_(free, free)], eigvals_only=True)
        omega = omega[0 if held else 6 :][:FREQUENCIES]
        return {"mass": total, "centre": centre, "inertia": np.trace(second) * np.eye(3) - second,
                "frequencies": np.sqrt(omega) / (2 * np.pi)}

    # its statements

    def nodes(self, first=1, last=10**9):
        lines = [f"{n}, {p[0]:.12g}, {p[1]:.12g}, {p[2]:.12g}" for p, n in self.number.items() if first <= n <= last]
        return "\n".join(lines) + "\n"

    def lines(self, change=lambda kind, nodes: nodes):
        text = ""
        for number, (kind, nodes, _) in enumerate(self.elements, 1):
            numbers = [str(n) for n in [number] + change(kind, nodes)]
            text += ", ".join(numbers[:10]) + (",\n" + ", ".join(numbers[10:]) if len(numbers) > 10 else "") + "\n"
        return text


def brick(x, long=10.0):
    return [(x + long * c[0], 10.0 * c[1], 10.0 * c[2]) for c in CORNERS["C3D20"]]


def cut(kind, x):
    """A brick as two wedges, or as six tetrahedra about its diagonal."""
    b = brick(x)
    if kind == "C3D15":
        return [[b[i] for i in (0, 1, 2, 4, 5, 6)], [b[i] for i in (0, 2, 3, 4, 6, 7)]]
    around = [1, 2, 3, 7, 4, 5, 1]
    return [[b[0], b[p], b[q], b[6]] for p, q in zip(around, around[1:])]


def bar(material=STEEL, second=None):
    return Body([("C3D20", brick(0.0), material), ("C3D20", brick(10.0), second or material)])


def collapsed(kind, nodes):
    """The brick of Abaqus' order that is a wedge or a tetrahedron."""
    n = nodes
    if kind == "C3D15":
        return [n[0], n[1], n[2], n[2], n[3], n[4], n[5], n[5], n[6], n[7], n[2], n[8], n[9], n[10], n[5], n[11],
                n[12], n[13], n[14], n[14]]
    return [n[0], n[1], n[2], n[2], n[3], n[3], n[3], n[3], n[4], n[5], n[2], n[6], n[3], n[3], n[3], n[3],
            n[7], n[8], n[9], n[9]]


# ---- decks ----

BAR = bar()
MATERIAL = "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.8E-9\n"
SECTION = "*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n"
MESH = f"*NODE\n{BAR.nodes()}*ELEMENT, TYPE=C3D20, ELSET=ALL\n{BAR.lines()}"
PLAIN = MESH + MATERIAL + SECTION
LOW, HIGH = BAR.plane(0, 0.0), BAR.plane(0, 20.0)


def numbers(nodes):
    return ", ".join(map(str, nodes)) + "\n"


def assembly(where="", further="", own=HIGH, other=LOW):
    return (f"*Part, name=B\n{MESH}*Nset, nset=Set-1\n{numbers(own)}{SECTION}*End Part\n*Assembly, name=A\n"
            f"*Instance, name=B-1, part=B\n{where}*End Instance\n{further}"
            f"*Nset, nset=Set-1, instance=B-1\n{numbers(other)}*End Assembly\n{MATERIAL}")


def linear(kind, nodes):
    """The corners alone: its mid nodes are in no element."""
    return nodes[:len(CORNERS[kind])]


def linear_collapsed(kind, nodes):
    n = nodes
    return [n[0], n[1], n[2], n[2], *([n[3], n[4], n[5], n[5]] if kind == "C3D15" else [n[3]] * 4)]


def of(kind, change=None, name=None):
    body = Body([(kind, c, STEEL) for x in (0.0, 10.0) for c in cut(kind, x)])
    lines = body.lines(change) if change else body.lines()
    return body, f"*NODE\n{body.nodes()}*ELEMENT, TYPE={name or kind}, ELSET=ALL\n{lines}{MATERIAL}{SECTION}"


def turned(right=None):
    """The bar moved by (5, 0, 0) and turned by 90 degrees about z."""
    right = right or BAR.solve()
    turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    return dict(right, centre=turn @ (right["centre"] + [5e-3, 0, 0]), inertia=turn @ right["inertia"] @ turn.T)


def right_cases():
    """Name, files (the first is the deck), arguments, what is right, words of a warning."""
    free, low, high = BAR.solve(), BAR.solve(LOW), BAR.solve(HIGH)
    wedges, wedge_deck = of("C3D15")
    tets, tet_deck = of("C3D10")
    two = bar(STEEL, LIGHT)
    half = BAR.nodes(1, 7)
    rest = BAR.nodes(8)
    elements = f"*ELEMENT, TYPE=C3D20, ELSET=ALL\n{BAR.lines()}"
    place = "5, 0, 0\n0, 0, 0, 0, 0, 1, 90.\n"
    second = "*Instance, name=B-2, part=B\n0, 0, 50\n*End Instance\n"
    hold = "*NSET, NSET=FOOT\n" + numbers(LOW)
    other = "*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, OGDEN\n1, 2, 3\n"
    part = lambda where="", further="": {"a.inp": assembly(where, further)}
    yield "plain", {"a.inp": PLAIN}, "", free, None
    yield "lower case, ends of lines of Windows", {"a.inp": PLAIN.lower().replace("\n", "\r\n")}, "", free, None
    yield "no blank in a keyword", {"a.inp": PLAIN.replace("SOLID SECTION", "SOLIDSECTION")}, "", free, None
    yield "blanks in keywords", {"a.inp": PLAIN.replace("*ELEM", "* ELEM").replace("=ALL", " = ALL")}, "", free, None
    yield "exponents of Fortran", {"a.inp": PLAIN.replace("7.8E-9", "7.8D-9")}, "", free, None
    yield "names in quotes", {"a.inp": PLAIN.replace("=ALL", '="my, set"')}, "", free, None
    yield "a keyword in two lines", {"a.inp": PLAIN.replace("C3D20, ", "C3D20,\n")}, "", free, None
    yield "a comma before lines of data", {"a.inp": (PLAIN + hold).replace("ELSET=ALL\n1", "ELSET=ALL,\n1").replace(
        "FOOT\n", "FOOT,\n")}, "--fixed FOOT", low, None
    yield "the section first", {"a.inp": SECTION + PLAIN.replace(SECTION, "")}, "", free, None
    yield "nodes twice in one place", {"a.inp": MESH + f"*NODE\n{half}" + MATERIAL + SECTION}, "", free, None
    yield "a law that is not the body's", {"a.inp": PLAIN + other}, "", free, None
    yield "named .msh", {"a.msh": "** a comment\n" + PLAIN}, "", free, None
    yield "a file within the nodes", {"a.inp": f"*NODE\n{half}*INCLUDE, INPUT=\"my nodes\"\n{elements}{MATERIAL}{SECTION}",
                                      "my nodes": rest}, "", free, None
    yield "lines of data in a file", {"a.inp": f"*NODE, INPUT=n.txt\n{elements}{MATERIAL}{SECTION}",
                                      "n.txt": BAR.nodes()}, "", free, None
    yield "files beside the deck", {"a.inp": "*INCLUDE, INPUT=sub/mesh.inp\n" + MATERIAL + SECTION,
                                    "sub/mesh.inp": "*INCLUDE, INPUT=n.inp\n" + elements,
                                    "n.inp": "*NODE\n" + BAR.nodes(), "sub/n.inp": "*NODE\n1, 9, 9, 9\n"}, "", free, None
    yield "a table over the temperature", {"a.inp": PLAIN.replace("0.3\n", "0.3, 20.\n1., .1, 500.\n")}, "", free, "its rows at 20"
    yield "without a density", {"a.inp": PLAIN.replace("*DENSITY\n7.8E-9\n", "")}, "--density 7800", free, None
    yield "without an elasticity", {"a.inp": PLAIN.replace("*ELASTIC\n210000., 0.3\n", "")}, "--young 210GPa --poisson .3", free, None
    yield "two materials", {"a.inp": PLAIN.replace(SECTION, "*ELSET, ELSET=L\n1\n*ELSET, ELSET=R\n2\n"
                            "*MATERIAL, NAME=AL\n*ELASTIC\n70000, .33\n*DENSITY\n2.7e-9\n*SOLID SECTION, ELSET=L, MATERIAL=steel\n"
                            "*SOLID SECTION, ELSET=R, MATERIAL=al\n")}, "", two.solve(), None
    yield "tetrahedra", {"a.inp": tet_deck}, "", tets.solve(), None
    yield "wedges", {"a.inp": wedge_deck}, "", wedges.solve(), None
    yield "bricks that are wedges", {"a.inp": of("C3D15", collapsed, "C3D20R")[1]}, "", wedges.solve(), None
    yield "bricks that are tetrahedra", {"a.inp": of("C3D10", collapsed, "C3D20")[1]}, "", tets.solve(), None
    raised = "linear elements were raised"
    corners = lambda kind, name: {"a.inp": of(kind, linear, name)[1]}
    foot = "*NSET, NSET=FOOT\n" + numbers(n for n in LOW if n in [m for e in BAR.elements for m in e[1][:8]])
    bricks = MESH.replace(BAR.lines(), BAR.lines(linear)).replace("C3D20", "C3D8I") + MATERIAL + SECTION
    yield "linear bricks", {"a.inp": bricks + foot}, "--raise --fixed FOOT", low, raised
    yield "linear bricks, held by a surface", {"a.inp": bricks + "*SURFACE, NAME=F\n1, S6\n"}, "--raise --fixed F", low, raised
    yield "linear tetrahedra", corners("C3D10", "C3D4"), "--raise", tets.solve(), raised
    yield "linear wedges", corners("C3D15", "C3D6"), "--raise", wedges.solve(), raised
    yield "linear bricks that are wedges", {"a.inp": of("C3D15", linear_collapsed, "C3D8R")[1]}, "--raise", wedges.solve(), raised
    yield "linear bricks that are tetrahedra", {"a.inp": of("C3D10", linear_collapsed, "C3D8")[1]}, "--raise", tets.solve(), raised
    yield "an instance in its own frame", part(), "", free, None
    yield "an instance moved and turned", part(place), "", turned(), None
    yield "one of two instances", part(place, second), "--instance B-1", turned(), None
    yield "held by a part's set", part(), "--fixed B.Set-1", high, None
    yield "held by an instance's set", part(), "--fixed b-1.set-1", high, None
    yield "held by the assembly's set", part(), "--fixed A.Set-1", low, None
    yield "held by two sets alike", {"a.inp": assembly(own=LOW)}, "--fixed Set-1", low, None
    yield "a set before what it names", {"a.inp": "*NSET, NSET=F\nFOOT\n" + PLAIN + hold}, "--fixed F", low, None
    yield "a set that leads down", {"a.inp": PLAIN + hold.replace("\n", ", GENERATE\n", 1).replace(numbers(LOW), "".join(
        f"{n}, {n}, -1\n" for n in LOW))}, "--fixed foot", low, None
    yield "the nodes of elements", {"a.inp": PLAIN + "*ELEMENT, TYPE=S8, ELSET=SH\n9, " + numbers(LOW[:8]) +
                                    "*NSET, NSET=F, ELSET=SH\n"}, "--fixed F", low, None
    yield "a surface", {"a.inp": PLAIN + "*SURFACE, NAME=F\n1, S6\n"}, "--fixed F", low, None
    yield "a support", {"a.inp": PLAIN + hold + "*STEP\n*STATIC\n*BOUNDARY\nFOOT, 1, 3\n*END STEP\n"}, "", free, "--fixed FOOT holds it"
    yield "a support of symmetry", {"a.inp": PLAIN + hold + "*BOUNDARY\nFOOT, XSYMM\n"}, "", free, "in direction 1 alone it cannot be"
    yield "a set with nodes that are not there", {"a.inp": PLAIN + hold + "7000, 7001\n"}, "--fixed FOOT", low, "2 of the nodes"
    # tonnes; the bar has 0.0156 kg
    point, told = "*ELEMENT, TYPE=MASS, ELSET=M\n9, 7\n", "masses on nodes (1, of 0.01 kg in all) are part of the body"
    massive, mass = BAR.solve(masses=[(7, 0.01)]), "*MASS, ELSET=M\n1e-5\n"
    yield "a mass", {"a.inp": PLAIN + point + mass}, "", massive, told
    yield "a mass before its element, named by another set", {"a.inp": mass.replace("=M", "=N") + PLAIN + point.replace(
        ", ELSET=M", "") + "*ELSET, ELSET=M\n9\n*ELSET, ELSET=N\nM\n"}, "", massive, told
    yield "masses, held", {"a.inp": PLAIN + hold + point + "10, 7\n11, 20\n" + mass}, "--fixed FOOT", BAR.solve(
        LOW, [(7, 0.02), (20, 0.01)]), "masses on nodes (2, of 0.03 kg in all)"
    yield "a mass on a node of nothing", {"a.inp": PLAIN + "*NODE\n999, 0, 0, 99\n" + point.replace(", 7", ", 999") + mass}, "", free, (
        "(node 999 first) are left out: the body here is lighter by 0.01 kg")
    yield "a mass of a part", {"a.inp": assembly(place).replace("*End Part", point + mass + "*End Part")}, "", turned(massive), told
    yield "a mass of the assembly", part(place, point.replace(" 7", " B-1.7") + mass), "", turned(massive), told
    yield "a mass of another instance", part(place, second + point.replace(" 7", " B-2.7") + mass), "--instance B-1", turned(), None
    yield "a mass of an assembly's own node", part(place, "*Node\n7, 0, 0, 99\n" + point + mass), "", turned(), "is lighter by it"
    yield "a mass without an element", {"a.inp": PLAIN + mass}, "", free, "has no element TYPE=MASS: left out"
    yield "an element without its mass", {"a.inp": PLAIN + point}, "", free, "TYPE=MASS without a *MASS"


def damaged_cases():
    """Name, deck, arguments, words of the refusal."""
    last = numbers(BAR.elements[1][1][-1:])
    yield "a set of several scopes", assembly(), "--fixed Set-1", "B.Set-1 (nodes), 8 nodes; A.Set-1 (nodes), 8 nodes"
    yield "two bodies", assembly(further="*Instance, name=B-2, part=B\n9\n*End Instance\n"), "", "2 bodies (B-1, B-2)"
    yield "no such file", "*INCLUDE, INPUT=none.inp\n" + PLAIN, "", "a.inp:1: *INCLUDE: INPUT=none.inp: No such file"
    yield "no density", PLAIN.replace("*DENSITY\n7.8E-9\n", ""), "", "NAME=STEEL has no *DENSITY"
    yield "the density of the fluid in its pores alone", PLAIN.replace("*DENSITY", "*DENSITY, PORE FLUID"), "", "NAME=STEEL has no *DENSITY"
    yield "no such material", PLAIN.replace("NAME=STEEL", "NAME=IRON"), "", "there is no *MATERIAL, NAME=STEEL"
    yield "two materials of one name", PLAIN + MATERIAL.replace("7.8E", "2.7E"), "", "with other values: must be there once"
    yield "two sections of one set", PLAIN + SECTION.replace("STEEL", "AL"), "", "in the solid sections of ALL and ALL"
    yield "no such set", PLAIN.replace("ELSET=ALL, M", "ELSET=NONE, M"), "", "NONE: must be the name of a set of elements"
    yield "linear elements", PLAIN.replace("C3D20", "C3D8"), "", "must be of second order"
    yield "linear bricks that are pyramids", PLAIN.replace(BAR.lines(), BAR.lines(lambda kind, n: n[:4] + [n[4]] * 4)).replace(
        "C3D20", "C3D8"), "--raise", "neither a wedge nor a tetrahedron"
    yield "two places of a node", MESH + "*NODE\n1, 0, 0, 5\n" + MATERIAL + SECTION, "", "node 1: is there twice, at"
    yield "two elements of a number", PLAIN + MESH[MESH.index("*ELEMENT"):], "", "element 1: is there twice"
    yield "a node that is not there", PLAIN.replace(" " + last, " 999\n", 1), "", "node 999: must be one of the file's nodes"
    yield "a node too few", PLAIN.replace(", " + last, "\n", 1), "", "has 19 nodes: must have more"
    mixed = Body([("C3D20", brick(0.0), STEEL)] + [("C3D10", c, STEEL) for c in cut("C3D10", 10.0)])
    kinds = mixed.lines().split("\n", 2)
    yield "tetrahedra that meet a brick", (
        f"*NODE\n{mixed.nodes()}*ELEMENT, TYPE=C3D20, ELSET=ALL\n{kinds[0]}\n{kinds[1]}\n*ELEMENT, TYPE=C3D10, ELSET=ALL\n"
        f"{kinds[2]}{MATERIAL}{SECTION}"), "", "meet with a triangle on a quadrilateral: the body is cut there"
    small = [[(10 + 5 * c[0], 5 * (j + c[1]), 5 * (k + c[2])) for c in CORNERS["C3D20"]] for j in (0, 1) for k in (0, 1)]
    halved = Body([("C3D20", brick(0.0), STEEL)] + [("C3D20", c, STEEL) for c in small])
    yield "bricks that meet a larger one", (
        f"*NODE\n{halved.nodes()}*ELEMENT, TYPE=C3D20, ELSET=ALL\n{halved.lines()}{MATERIAL}{SECTION}"), "", (
        "is a mid node of element 1 and a corner of element")
    yield "a mass below zero", PLAIN + "*MASS, ELSET=M\n-1.\n", "", "*MASS: -1: must be a finite number >= 0"
    yield "a mass on two nodes", PLAIN + "*ELEMENT, TYPE=MASS, ELSET=M\n9, 1, 2\n", "", "TYPE=MASS: must have 1 node"
    yield "nodes to be made", PLAIN + "*NGEN\n1, 9\n", "", "*NGEN: is not read"
    yield "another law", PLAIN.replace("*ELASTIC", "*HYPERELASTIC"), "", "*HYPERELASTIC: is not read: must be *ELASTIC"
    yield "a density in kg/m^3", PLAIN.replace("7.8E-9", "7800"), "", "is the unit of length right?"
    yield "a set that names itself", PLAIN + "*NSET, NSET=P\nQ\n*NSET, NSET=Q\nP\n", "", "must not name itself"
    yield "no deck", "a letter\n" + PLAIN, "", "a.inp:1: must begin with a keyword"


def run(files, arguments):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            os.makedirs(os.path.dirname(os.path.join(folder, name)), exist_ok=True)
            with open(os.path.join(folder, name), "w", newline="") as file:
                file.write(text)
        command = [REDUCE, next(iter(files)), "--unit", "mm", "-n", str(FREQUENCIES), "-o", "o.h5", "--json"]
        return subprocess.run(command + arguments.split(), cwd=folder, capture_output=True, text=True, timeout=60)


def differences(answer, right):
    got = json.loads(answer)
    for key in ("mass", "centre", "inertia", "frequencies"):
        expected = np.ravel(right[key])
        values = np.array(got[key]).ravel()[: len(expected)]
        error = np.max(np.abs(values - expected)) / np.max(np.abs(expected))
        if not error < WITHIN:
            yield f"{key} {values} is not {expected} ({error:.1e})"


def parts_in(answer):
    """What the report says of each part."""
    return [f"{p['name']} {p['material']} {p['young']:.6g} {p['density']:.6g} {p['elements']} {p['volume']:.6g} {p['mass']:.6g}"
            for p in json.loads(answer)["part_list"]]


def judge(name, wrong):
    print(f"{'MISSED ' if wrong else ''}{name}{': ' if wrong else ''}{'; '.join(wrong)}", flush=True)
    if wrong:
        failed.append(name)


def bar_with_end_mass():
    """A held bar of four cubes without lateral contraction, with its own mass at the end: kL tan kL = 1, k = omega sqrt(rho/E).
    A triangle's uniform load is a third of it at each mid node, so that the end mass moves as one; elements of second order
    have k too high by about (k h)^4/1440 = 1.5e-6."""
    young, density, length = 210e9, 7800.0, 0.04
    body = Body([("C3D10", c, (young, 0.0, density)) for x in (0.0, 10.0, 20.0, 30.0) for c in cut("C3D10", x)])
    share, end = {}, set(body.plane(0, 40.0))
    for _, nodes, _ in body.elements:
        middles = [n for n, (a, b) in zip(nodes[4:], EDGES["C3D10"]) if nodes[a] in end and nodes[b] in end]
        for n in middles if len(middles) == 3 else []:
            share[n] = share.get(n, 0.0) + density * length * 1e-4 / 6
    deck = f"*NODE\n{body.nodes()}*ELEMENT, TYPE=C3D10, ELSET=ALL\n{body.lines()}{MATERIAL}{SECTION}".replace(", 0.3", ", 0.")
    deck += "*NSET, NSET=FOOT\n" + numbers(body.plane(0, 0.0))
    for n, kilograms in share.items():
        deck += f"*ELEMENT, TYPE=MASS, ELSET=M{n}\n{1000 + n}, {n}\n*MASS, ELSET=M{n}\n{kilograms * 1e-3:.16g}\n"
    done = run({"a.inp": deck}, "--fixed FOOT -n 12")
    if done.returncode:
        return [done.stderr.strip()]
    got = json.loads(done.stdout)
    right = 0.8603335890193798 / length * np.sqrt(young / density) / (2 * np.pi)
    apart = np.abs(np.array(got["frequencies"]) / right - 1)
    wrong = [] if apart.min() < 3e-6 else [f"no frequency of {got['frequencies']} is {right} ({apart.min():.1e})"]
    masses = (got["mass_on_nodes"], got["mass"] - got["mass_on_nodes"])
    return wrong + ([] if np.allclose(masses, density * length * 1e-4, rtol=1e-12, atol=0) else [f"masses {masses}"])


count = 1
judge("a bar with an end mass", bar_with_end_mass())
for name, files, arguments, right, warning in right_cases():
    done = run(files, arguments)
    wrong = [done.stderr.strip()] if done.returncode else list(differences(done.stdout, right))
    told = [] if done.returncode else json.loads(done.stdout)["warnings"]
    if name == "two materials":
        # cubes of 10 mm
        listed = [f"L STEEL 2.1e+11 7800 1 1e-06 {7800 * 1e-6:.6g}", f"R AL 7e+10 2700 1 1e-06 {2700 * 1e-6:.6g}"]
        wrong += [] if parts_in(done.stdout) == listed else [f"parts {parts_in(done.stdout)}"]
    if not wrong and (not any(warning in line for line in told) if warning else told):
        wrong = [f"tells {told}, should tell {warning}"]
    judge(name, wrong)
    count += 1
for name, deck, arguments, words in damaged_cases():
    done = run({"a.inp": deck}, arguments)
    judge(name, [] if done.returncode == 1 and words in done.stderr else [f"{done.returncode}: {done.stderr.strip()}"])
    count += 1
print(f"{count} decks, {len(failed)} missed")
sys.exit(1 if failed else 0)
