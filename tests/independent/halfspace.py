# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Boussinesq's field of a point force on a half-space, and what it leaves on the faces of a body.

A body under a balanced point load l moves by u = u_B + u_r. The rest u_r is smooth and is solved for with the tractions
t_B of u_B on the faces; the compliance beyond the half-space's is

    C = -2 int rho a.u_B dV - int t_B.u_B dS + (g, K^-1 g),    g(v) = -int t_B.v dS - int rho a.v dV,

a being the rigid acceleration that balances the load. As (g, K^-1 g) is an energy it converges twice as fast as u_r."""

import numpy as np


def field(offset, inward, young, poisson, outward=None):
    """Displacement, and traction on surfaces with the outward normals, of a unit force along `inward` at the origin."""
    z = offset @ inward
    lateral = offset - z[:, None] * inward
    rho2 = np.einsum("ij,ij->i", lateral, lateral)
    r = np.sqrt(rho2 + z * z)
    plus = r + z
    scale = (1 + poisson) / (2 * np.pi * young)
    along = scale * (2 * (1 - poisson) / r + z * z / r**3)
    across = scale * (z / r**3 - (1 - 2 * poisson) / (r * plus))
    u = along[:, None] * inward + across[:, None] * lateral
    if outward is None:
        return u, None
    # sigma n, with sigma = a (l l) + b (1 - z z) + c (l z + z l) + d z z of the lateral vector l
    n = np.broadcast_to(outward, offset.shape)
    b = (1 - 2 * poisson) * (z / r**3 - 1 / (r * plus))
    a = (1 - 2 * poisson) * (2 * r + z) / (r**3 * plus**2) - 3 * z / r**5
    c, d = -3 * z * z / r**5, -3 * z**3 / r**5
    nz = n @ inward
    nl = np.einsum("ij,ij->i", n, lateral)
    t = (a * nl + c * nz)[:, None] * lateral + b[:, None] * (n - nz[:, None] * inward)
    t += (c * nl + d * nz)[:, None] * inward
    return u, t / (2 * np.pi)


def graded(low, high, centre, scale, order=10, coarsest=0.12):
    """Gauss points and weights on (low, high), finer about the centre, whose nearest singularity is `scale` away."""
    marks = {low, high}
    centre = min(max(centre, low), high)
    marks.add(centre)
    for sign in (-1, 1):
        step = 0.75 * scale
        at = centre
        while low < at + sign * step < high:
            at += sign * step
            marks.add(at)
            step = min(max(step, 0.75 * abs(at - centre)), coarsest * (high - low))
    marks = np.array(sorted(marks))
    marks = marks[np.concatenate([[True], np.diff(marks) > 1e-12 * (high - low)])]
    x, w = np.polynomial.legendre.leggauss(order)
    half = 0.5 * np.diff(marks)
    return (0.5 * (marks[1:] + marks[:-1])[:, None] + half[:, None] * x).ravel(), (half[:, None] * w).ravel()


def acceleration(body, at, inward):
    """Of the rigid body under a unit force: linear, angular."""
    return inward / body.mass, np.cross(at, inward) / body.inertia


class BoxLoad:
    def __init__(self):
        self.faces, self.explicit, self.known = [], 0.0, {}

    def project(self, box, group):
        """-int t_B p dS of the polynomials of a class."""
        import box as boxes

        tables = self.known.get(box.counts)
        if tables is None:
            tables = []
            for axis, value, (one, other), tractions in self.faces:
                p = boxes.legendre(box.counts[one[0]], box.sides[one[0]], one[1])
                q = boxes.legendre(box.counts[other[0]], box.sides[other[0]], other[1])
                edge = boxes.legendre(box.counts[axis], box.sides[axis], [value])[0]
                tables.append((axis, one[0], other[0], edge, [p.T @ t @ q for t in tractions]))
            self.known[box.counts] = tables
        row = np.zeros(group.start[-1])
        for axis, one, other, edge, matrices in tables:
            for c in range(3):
                orders = group.index[c]
                part = matrices[c][np.ix_(orders[one], orders[other])]
                part = np.multiply.outer(edge[orders[axis]], part)
                row[group.start[c] : group.start[c + 1]] -= np.transpose(part, np.argsort((axis, one, other))).ravel()
        return row


def on_box(box, at, normal):
    load = BoxLoad()
    inward = -normal
    linear, angular = acceleration(box, at, inward)
    here = linear + np.cross(angular, at)
    struck = int(np.argmax(np.abs(normal)))
    for axis in range(3):
        for sign in (-1.0, 1.0):
            if axis == struck and sign == np.sign(normal[axis]):
                continue
            value = 0.5 * sign * box.sides[axis]
            distance = abs(value - at[axis])
            axes = [(axis + 1) % 3, (axis + 2) % 3]
            points, weights = [], []
            for i in axes:
                p, w = graded(-0.5 * box.sides[i], 0.5 * box.sides[i], at[i], distance)
                points.append(p)
                weights.append(w)
            grid = np.zeros((len(points[0]), len(points[1]), 3))
            grid[..., axis] = value
            grid[..., axes[0]] = points[0][:, None]
            grid[..., axes[1]] = points[1][None, :]
            offset = grid.reshape(-1, 3) - at
            outward = np.zeros(3)
            outward[axis] = sign
            u, t = field(offset, inward, box.young, box.poisson, outward)
            weight = np.multiply.outer(*weights).ravel()
            # pyramids with their tip at the load: u_B goes with 1/distance, the acceleration is affine
            there = linear + np.cross(angular, offset + at)
            mean = 0.5 * here + (there - here) / 3.0
            load.explicit -= 2.0 * box.density * distance * float(weight @ np.einsum("ij,ij->i", u, mean))
            load.explicit -= float(weight @ np.einsum("ij,ij->i", u, t))
            tractions = [(weight * t[:, c]).reshape(grid.shape[:2]) for c in range(3)]
            load.faces.append((axis, value, ((axes[0], points[0]), (axes[1], points[1])), tractions))
    return load
