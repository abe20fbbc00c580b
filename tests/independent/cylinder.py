# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""A free elastic cylinder along x by Ritz's method: harmonics of the angle, polynomials of the radius and along the axis.

u_r = (p + m) cos, u_t = (p - m) sin, u_x = s cos of n times the angle: p has powers n + 1, n + 3, ... of the radius, m
|n - 1|, ..., s n, n + 2, ...: these are smooth on the axis. The angle is counted from the plane of the load."""

import functools

import numpy as np
import scipy.linalg
import scipy.special

import halfspace
from box import derivatives, legendre


def radial(power, count, radius, r):
    """Zernike's polynomials of the power, orthonormal with the weight r, and their derivatives, and them over r."""
    x = 2.0 * (r / radius) ** 2 - 1.0
    values, slopes, over = [], [], []
    for k in range(count):
        norm = np.sqrt(2.0 * (power + 2 * k + 1)) / radius
        p = scipy.special.eval_jacobi(k, 0, power, x)
        dp = 0.5 * (k + power + 1) * scipy.special.eval_jacobi(k - 1, 1, power + 1, x) if k else 0.0 * x
        s = r / radius
        values.append(norm * s**power * p)
        lower = s ** (power - 1) if power else 0.0
        slopes.append(norm / radius * (power * lower * p + s**power * dp * 4.0 * s))
        over.append(values[-1] / r)
    return np.array(values).T, np.array(slopes).T, np.array(over).T


class Part:
    """One harmonic and one parity along the axis."""

    def __init__(self, body, n, odd):
        self.n, self.odd = n, odd
        counts = body.counts
        self.powers = [n + 1, abs(n - 1), n] if n else [1, 0]
        self.kinds = "pms" if n else "ps"
        # u_x has the other parity
        self.orders = [np.arange(odd ^ (kind == "s"), counts[0], 2) for kind in self.kinds]
        self.count = counts[1]
        self.start = np.concatenate([[0], np.cumsum([len(o) * self.count for o in self.orders])])
        self.turn = np.pi if n else 2 * np.pi

    def assemble(self, body):
        x, w = np.polynomial.legendre.leggauss(2 * self.count + self.n + 6)
        r = 0.5 * body.radius * (x + 1)
        weight = 0.5 * body.radius * w * r
        lam, mu = body.lame
        n = self.n
        strains = []  # per kind: list of (strain, radial factor, derivative along x)
        for power, kind in zip(self.powers, self.kinds):
            f, df, of = radial(power, self.count, body.radius, r)
            if kind == "s":
                strains.append({"xx": (f, 1), "rx": (df, 0), "tx": (-n * of, 0)})
            else:
                sign = 0.0 if not n else 1.0 if kind == "p" else -1.0
                strains.append({"rr": (df, 0), "tt": (of + sign * n * of, 0), "rt": (-n * of + sign * (df - of), 0), "rx": (f, 1), "tx": (sign * f, 1)})
        k = np.zeros((self.start[-1], self.start[-1]))
        normal = ("rr", "tt", "xx")
        for a in range(len(self.kinds)):
            for b in range(len(self.kinds)):
                block = 0.0
                for s, (fa, da) in strains[a].items():
                    for t, (fb, db) in strains[b].items():
                        if s in normal and t in normal:
                            modulus = lam + (2 * mu if s == t else 0.0)
                        else:
                            modulus = mu if s == t else 0.0
                        if modulus == 0.0:
                            continue
                        rows, columns = self.orders[a], self.orders[b]
                        along = {(0, 0): body.unit, (0, 1): body.first, (1, 0): body.first.T, (1, 1): body.stiff}[da, db]
                        block = block + modulus * np.kron(fa.T @ (weight[:, None] * fb), along[np.ix_(rows, columns)])
                k[self.start[a] : self.start[a + 1], self.start[b] : self.start[b + 1]] = block
        # masses: p and m are orthonormal up to 2, s up to 1; the angle's integral is common to both
        mass = np.concatenate([np.full(self.start[i + 1] - self.start[i], 1.0 if kind == "s" or not self.n else 2.0) for i, kind in enumerate(self.kinds)])
        scale = 1.0 / np.sqrt(mass)
        return k * np.outer(scale, scale), scale


class Cylinder:
    def __init__(self, radius, length, poisson, counts, young=1.0, density=1.0):
        """counts: polynomials along the axis, of the radius, harmonics."""
        self.radius, self.length, self.poisson = radius, length, poisson
        self.young, self.density, self.counts = young, density, tuple(counts)
        self.lame = (young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson)))
        self.mass = density * np.pi * radius**2 * length
        across = self.mass * (radius**2 / 4 + length**2 / 12)
        self.inertia = np.array([0.5 * self.mass * radius**2, across, across])
        self.first, self.stiff = derivatives(counts[0], length)
        self.unit = np.eye(counts[0])
        self.parts = []
        for n in range(counts[2]):
            for odd in (0, 1):
                part = Part(self, n, odd)
                k, part.scale = part.assemble(self)
                values, part.vectors = scipy.linalg.eigh(k / density, driver="evd", overwrite_a=True)
                part.elastic = values > 1e-7 * young / density / max(length, 2 * radius) ** 2
                part.omega = np.sqrt(np.where(part.elastic, values, 1.0))
                self.parts.append(part)

    def frequencies(self):
        return np.sort(np.concatenate([p.omega[p.elastic] for p in self.parts]))

    def rigid(self, at, normal):
        arm = np.cross(at, normal)
        return 1.0 / self.mass + float(np.sum(arm**2 / self.inertia))

    def _along(self, part, component, x, r):
        """Displacement along r (or x) of the basis at angle 0."""
        row = np.zeros(part.start[-1])
        for i, kind in enumerate(part.kinds):
            if (kind == "s") != (component == "x"):
                continue
            f = radial(part.powers[i], part.count, self.radius, np.array([max(r, 1e-9 * self.radius)]))[0][0]
            row[part.start[i] : part.start[i + 1]] = np.kron(f, legendre(self.counts[0], self.length, [x])[0][part.orders[i]])
        return row * part.scale / np.sqrt(part.turn)

    def modes(self, at, normal):
        """The place turned into the plane of the load."""
        x, r = at[0], float(np.hypot(at[1], at[2]))
        component = "x" if abs(normal[0]) > 0.5 else "r"
        sign = float(normal[0]) if component == "x" else 1.0
        omega, shape = [], []
        for part in self.parts:
            row = sign * self._along(part, component, x, r) @ part.vectors / np.sqrt(self.density)
            omega.append(part.omega[part.elastic])
            shape.append(row[part.elastic])
        return np.concatenate(omega), np.concatenate(shape)

    def flexibility(self, at, normal, contact=None):
        """Beyond the half-space; of a place on the side that of a contact of this radius."""
        at, normal = np.asarray(at, float), np.asarray(normal, float)
        side = abs(normal[0]) < 0.5
        explicit, faces = self._load(at, normal, contact if side else None)
        total = 0.0
        for part in self.parts:
            row = self._project(part, faces) @ part.vectors
            total += float(np.sum((row[part.elastic] / part.omega[part.elastic]) ** 2)) / self.density
        return explicit + total

    def _load(self, at, normal, contact):
        inward = -normal
        linear, angular = halfspace.acceleration(self, at, inward)
        here = linear + np.cross(angular, at)
        side = contact is not None
        explicit, faces = 0.0, []
        centre = float(np.arctan2(at[2], at[1])) if (side or np.hypot(at[1], at[2]) > 0) else 0.0
        r0 = float(np.hypot(at[1], at[2]))

        def add(x, r, angle, outward, weight, shape, kind):
            nonlocal explicit
            direction = np.stack([0 * angle, np.cos(angle + centre), np.sin(angle + centre)], 1)
            across = np.stack([0 * angle, -np.sin(angle + centre), np.cos(angle + centre)], 1)
            point = direction * r[:, None]
            point[:, 0] = x
            offset = point - at
            n = outward if outward is not None else direction
            u, t = halfspace.field(offset, inward, self.young, self.poisson, n)
            height = np.abs(np.einsum("ij,ij->i", offset, np.broadcast_to(n, offset.shape)))
            there = linear + np.cross(angular, offset + at)
            mean = 0.5 * here + (there - here) / 3.0
            explicit -= 2.0 * self.density * float(weight @ (height * np.einsum("ij,ij->i", u, mean)))
            explicit -= float(weight @ np.einsum("ij,ij->i", u, t))
            parts = [np.einsum("ij,ij->i", t, direction), np.einsum("ij,ij->i", t, across), t[:, 0]]
            faces.append((kind, x, r, angle, [(weight * one).reshape(shape) for one in parts]))

        # the side
        if side:
            # the singular place, from the contact on
            cut = contact * CUT
            self._around(at, cut, add)
        else:
            gap = max(self.radius - r0, 1e-3 * self.radius)
            xs, wx = halfspace.graded(-0.5 * self.length, 0.5 * self.length, at[0], gap, coarsest=0.1)
            ts, wt = halfspace.graded(-np.pi, np.pi, 0.0, gap / self.radius)
            x, angle = [g.ravel() for g in np.meshgrid(xs, ts, indexing="ij")]
            add(x, np.full(len(x), self.radius), angle, None, np.multiply.outer(wx, wt).ravel() * self.radius, (len(xs), len(ts)), ("side", xs, ts))
        for sign in (-1.0, 1.0):
            if not side and sign == np.sign(normal[0]):
                continue
            value = 0.5 * sign * self.length
            distance = abs(value - at[0])
            rs, wr = halfspace.graded(0.0, self.radius, r0, distance, coarsest=0.25)
            ts, wt = halfspace.graded(-np.pi, np.pi, 0.0, max(distance, 1e-3 * self.radius) / self.radius if r0 > 0 else 10.0)
            r, angle = [g.ravel() for g in np.meshgrid(rs, ts, indexing="ij")]
            add(np.full(len(r), value), r, angle, np.array([sign, 0.0, 0.0]), np.multiply.outer(wr * rs, wt).ravel(), (len(rs), len(ts)), ("end", rs, ts, value))
        return explicit, faces

    def _around(self, at, cut, add):
        """The side, graded towards the load by squares of ever smaller size down to the cut."""
        half = 0.5 * self.length
        reach = np.pi * self.radius

        def cell(x0, x1, s0, s1):
            order = 10
            g, w = np.polynomial.legendre.leggauss(order)
            pieces_x = np.linspace(x0, x1, max(1, int(np.ceil((x1 - x0) / (1.0 * self.radius)))) + 1)
            pieces_s = np.linspace(s0, s1, max(1, int(np.ceil((s1 - s0) / (1.0 * self.radius)))) + 1)
            hx, hs = 0.5 * np.diff(pieces_x), 0.5 * np.diff(pieces_s)
            xs = (0.5 * (pieces_x[1:] + pieces_x[:-1])[:, None] + hx[:, None] * g).ravel()
            ss = (0.5 * (pieces_s[1:] + pieces_s[:-1])[:, None] + hs[:, None] * g).ravel()
            wx, ws = (hx[:, None] * w).ravel(), (hs[:, None] * w).ravel()
            x, s = [m.ravel() for m in np.meshgrid(xs, ss, indexing="ij")]
            ts = ss / self.radius
            add(x, np.full(len(x), self.radius), s / self.radius, None, np.multiply.outer(wx, ws).ravel(), (len(xs), len(ss)), ("side", xs, ts))

        # rings of rectangles, each half the size of the one outside
        low, high, span = -half, half, reach
        size = min(0.5 * self.radius, half - abs(at[0]))
        a, b = at[0] - size, at[0] + size
        for x0, x1, s0, s1 in ((low, a, -span, span), (b, high, -span, span), (a, b, -span, -size), (a, b, size, span)):
            if x1 - x0 > 1e-12 * self.length:
                cell(x0, x1, s0, s1)
        while size > cut:
            inner = max(0.5 * size, cut) if 0.5 * size > 0.6 * cut else cut
            x0, x1 = at[0] - size, at[0] + size
            y0, y1 = at[0] - inner, at[0] + inner
            cell(x0, y0, -size, size)
            cell(y1, x1, -size, size)
            cell(y0, y1, -size, -inner)
            cell(y0, y1, inner, size)
            size = inner

    def _project(self, part, faces):
        row = np.zeros(part.start[-1])
        n = part.n
        for kind, _, _, _, tractions in faces:
            if kind[0] == "side":
                along, rim = legendre(self.counts[0], self.length, kind[1]), np.array([self.radius])
                cos, sin = np.cos(n * kind[2]), np.sin(n * kind[2])
                parts = [tractions[0] @ cos, tractions[1] @ sin, tractions[2] @ cos]  # over x
            else:
                along, rim = legendre(self.counts[0], self.length, [kind[3]])[0], kind[1]
                cos, sin = np.cos(n * kind[2]), np.sin(n * kind[2])
                parts = [tractions[0] @ cos, tractions[1] @ sin, tractions[2] @ cos]  # over r
            for i, name in enumerate(part.kinds):
                load = parts[2] if name == "s" else parts[0] + (parts[1] if name == "p" else -parts[1]) * (n > 0)
                f = _radial(part.powers[i], part.count, self.radius, rim)
                if kind[0] == "side":
                    block = np.kron(f[0], along[:, part.orders[i]].T @ load)
                else:
                    block = np.kron(f.T @ load, along[part.orders[i]])
                row[part.start[i] : part.start[i + 1]] -= block
        return row * part.scale / np.sqrt(part.turn)


CUT = 0.9
"""Half the side of the square without load that stands for the circle of the contact, over its radius."""

_cache = {}


def _radial(power, count, radius, r):
    key = (power, count, radius, r.tobytes())
    if key not in _cache:
        if len(_cache) > 4000:
            _cache.clear()
        _cache[key] = radial(power, count, radius, r)[0]
    return _cache[key]
