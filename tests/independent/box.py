# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""A free elastic box by Ritz's method: products of Legendre polynomials, eight classes of symmetry.

Lengths, density and Young's modulus are those of the arguments; the origin is the centre. The static displacement under
a point load is Boussinesq's of the half-space and a smooth rest (halfspace.py), so that the rest converges."""

import itertools

import numpy as np
import scipy.linalg

import halfspace


def legendre(count, side, at):
    """Orthonormal Legendre polynomials on (-side/2, side/2) at the places: (len(at), count)."""
    values = np.polynomial.legendre.legvander(2.0 * np.asarray(at) / side, count - 1)
    return values * np.sqrt((2.0 * np.arange(count) + 1.0) / side)


def derivatives(count, side):
    """D[i, j] = integral of p_i p_j', S[i, j] = integral of p_i' p_j'."""
    norm = np.sqrt((2.0 * np.arange(count) + 1.0) / side)
    d = np.zeros((count, count))
    for j in range(count):
        # P_j' = sum (2 i + 1) P_i over i = j - 1, j - 3, ...
        for i in range(j - 1, -1, -2):
            d[i, j] = 2.0 / side * norm[j] * (2 * i + 1) / norm[i]
    return d, d.T @ d


class Group:
    """One class of symmetry: which polynomials each component has, frequencies and vectors."""

    def __init__(self, box, parity):
        self.index = []  # per component: the orders along x, y, z
        for component in range(3):
            orders = []
            for axis in range(3):
                odd = parity[axis] ^ (axis == component)
                orders.append(np.arange(odd, box.counts[axis], 2))
            self.index.append(orders)
        self.shapes = [tuple(len(o) for o in orders) for orders in self.index]
        sizes = [int(np.prod(s)) for s in self.shapes]
        self.start = np.concatenate([[0], np.cumsum(sizes)])

    def assemble(self, box):
        n = self.start[-1]
        k = np.zeros((n, n))
        lam, mu = box.lame
        for a, b in itertools.combinations_with_replacement(range(3), 2):
            block = np.zeros((self.start[a + 1] - self.start[a], self.start[b + 1] - self.start[b]))
            if a == b:
                for axis in range(3):
                    factors = [np.eye(len(self.index[a][i])) for i in range(3)]
                    orders = self.index[a][axis]
                    factors[axis] = box.stiff[axis][np.ix_(orders, orders)]
                    block += (lam + 2 * mu if axis == a else mu) * np.kron(np.kron(*factors[:2]), factors[2])
            else:
                for weight, first, second in ((lam, a, b), (mu, b, a)):
                    # weight * integral of d_first u_a d_second u_b
                    factors = []
                    for axis in range(3):
                        rows, columns = self.index[a][axis], self.index[b][axis]
                        d = box.first[axis]
                        if axis == first:
                            factors.append(d.T[np.ix_(rows, columns)])
                        elif axis == second:
                            factors.append(d[np.ix_(rows, columns)])
                        else:
                            factors.append(np.eye(box.counts[axis])[np.ix_(rows, columns)])
                    block += weight * np.kron(np.kron(*factors[:2]), factors[2])
            k[self.start[a] : self.start[a + 1], self.start[b] : self.start[b + 1]] = block
            if a != b:
                k[self.start[b] : self.start[b + 1], self.start[a] : self.start[a + 1]] = block.T
        return k

    def point(self, box, at, direction):
        """The basis' displacement along the direction."""
        row = np.zeros(self.start[-1])
        for c in range(3):
            if direction[c] != 0.0:
                p = [legendre(box.counts[i], box.sides[i], [at[i]])[0][self.index[c][i]] for i in range(3)]
                row[self.start[c] : self.start[c + 1]] = direction[c] * np.einsum("i,j,k->ijk", *p).ravel()
        return row


class Box:
    def __init__(self, sides, poisson, counts, static=None, young=1.0, density=1.0):
        """counts: polynomials along x, y, z for the modes; static: (more of them) for the static displacement."""
        self.sides = np.array(sides, float)
        self.young, self.poisson, self.density = young, poisson, density
        self.lame = (young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson)))
        self.mass = density * float(np.prod(self.sides))
        self.inertia = self.mass / 12.0 * (np.sum(self.sides**2) - self.sides**2)
        self.groups, self.factors = [], []
        self._set(counts)
        for parity in itertools.product((0, 1), repeat=3):
            group = Group(self, parity)
            values, group.vectors = scipy.linalg.eigh(group.assemble(self) / density, driver="evd", overwrite_a=True)
            group.elastic = values > 1e-7 * young / density / np.max(self.sides) ** 2
            group.omega = np.sqrt(np.where(group.elastic, values, 1.0))
            self.groups.append(group)
        self.static = None
        if static is not None and tuple(static) != tuple(counts):
            self.static = Static(self.sides, poisson, static, young)

    def _set(self, counts):
        self.counts = tuple(counts)
        pairs = [derivatives(n, s) for n, s in zip(counts, self.sides)]
        self.first, self.stiff = [p[0] for p in pairs], [p[1] for p in pairs]

    def frequencies(self):
        return np.sort(np.concatenate([g.omega[g.elastic] for g in self.groups]))

    def modes(self, at, normal):
        """omega, and displacements along the normal per square root of mass, of all elastic modes."""
        omega, shape = [], []
        for g in self.groups:
            row = g.point(self, at, normal) @ g.vectors / np.sqrt(self.density)
            omega.append(g.omega[g.elastic])
            shape.append(row[g.elastic])
        return np.concatenate(omega), np.concatenate(shape)

    def rigid(self, at, normal):
        """1/mass to an impulse along the normal: turning included."""
        arm = np.cross(at, normal)
        return 1.0 / self.mass + float(np.sum(arm**2 / self.inertia))

    def loads(self, at, normal):
        """Quadrature of the five other faces and the fields there: see halfspace.Load."""
        return halfspace.on_box(self, np.asarray(at, float), np.asarray(normal, float))

    def flexibility(self, at, normal):
        """Of a point on a face to a force along its normal, without the half-space's own."""
        load = self.loads(at, normal)
        if self.static is not None:
            return load.explicit + self.static.energy(load)
        total = 0.0
        for g in self.groups:
            rest = load.project(self, g) @ g.vectors
            total += float(np.sum((rest[g.elastic] / g.omega[g.elastic]) ** 2)) / self.density
        return load.explicit + total


class Static(Box):
    """Only the static displacement, with more polynomials: Cholesky's factors of each class."""

    def __init__(self, sides, poisson, counts, young):
        self.sides, self.young, self.poisson, self.density = np.array(sides, float), young, poisson, 1.0
        self.lame = (young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson)))
        self._set(counts)
        self.groups, self.factors = [], []
        for parity in itertools.product((0, 1), repeat=3):
            group = Group(self, parity)
            k = group.assemble(self)
            # rigid motions are held by a stiffness of their own, which a balanced load does not feel
            group.rigid = self._rigid(group)
            for motion in group.rigid:
                k += young * np.max(self.sides) ** -2 * np.outer(motion, motion)
            group.factor = scipy.linalg.cholesky(k, lower=True, overwrite_a=True, check_finite=False)
            self.groups.append(group)

    def _rigid(self, group):
        """The rigid motions of a class, unit vectors of the basis."""
        found = []
        for kind in range(6):
            row = np.zeros(group.start[-1])
            parts = [(kind, (0, 0, 0), 1.0)] if kind < 3 else []
            if kind >= 3:
                a, b = (kind - 2) % 3, (kind - 1) % 3  # u_a = -x_b, u_b = x_a
                parts = [(a, tuple(int(i == b) for i in range(3)), -self.sides[b]), (b, tuple(int(i == a) for i in range(3)), self.sides[a])]
            for component, order, value in parts:
                places = [np.flatnonzero(group.index[component][i] == order[i]) for i in range(3)]
                if all(len(p) for p in places):
                    flat = np.ravel_multi_index([p[0] for p in places], group.shapes[component])
                    row[group.start[component] + flat] = value
            if row.any():
                found.append(row / np.linalg.norm(row))
        return found

    def energy(self, load):
        total = 0.0
        for g in self.groups:
            row = load.project(self, g)
            for motion in g.rigid:
                row -= (row @ motion) * motion
            half = scipy.linalg.solve_triangular(g.factor, row, lower=True, check_finite=False)
            total += float(half @ half)
        return total
