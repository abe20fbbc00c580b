# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""What an elastic sphere gives way beyond its half-space, by its series in Legendre polynomials (Lur'e)."""

import functools

import numpy as np


@functools.lru_cache(maxsize=None)
def _table(poisson):
    """At some radii of the contact, times E and the sphere's radius: it is a constant and a logarithm."""
    sizes = np.array([0.02, 0.05, 0.1])
    values = [regular(poisson, a) for a in sizes]
    return np.polyfit(np.log(sizes), values, 1)


def flexibility(young, poisson, radius, contact):
    slope, constant = _table(round(poisson, 6))
    return (constant + slope * np.log(contact / radius)) / (young * radius)


def regular(poisson, size, count=None):
    """Hertz's pressure on a circle of the radius `size`, its work less that on a half-space, balanced by inertia."""
    count = count or int(120 / size)
    # pressure of the force 1, by Gauss in sqrt(1 - (s/size)^2)
    x, w = np.polynomial.legendre.leggauss(400)
    q = 0.5 * (x + 1.0)
    s = size * np.sqrt(1.0 - q * q)
    pressure, area = 1.5 / (np.pi * size**2) * q, np.pi * size**2 * q * w  # 2 pi s ds, over q
    cosine = np.cos(s)
    shear = 1.0 / (2.0 * (1.0 + poisson))
    lam = poisson / ((1 + poisson) * (1 - 2 * poisson))
    work, before, now = 0.0, np.ones_like(cosine), cosine
    weight = pressure * area
    weight /= weight.sum()
    for n in range(count):
        polynomial = np.ones_like(cosine) if n == 0 else now
        load = (2 * n + 1) / (4 * np.pi) * float(weight @ polynomial)
        if n == 0:
            inward = load * (1 - 2 * poisson)
        elif n == 1:
            inward = 1.2 * load / (6 * lam + 4 * shear)
        else:
            m = np.array([[n * (n - 1), (n + 1) * (n * n - n - 2 - 2 * poisson)], [n - 1, n * n + 2 * n - 1 + 2 * poisson]])
            a, b = np.linalg.solve(m, [load, 0.0])
            inward = (a * n + b * (n + 1) * (n - 2 + 4 * poisson)) / (2 * shear)
        work += inward * load * 4 * np.pi / (2 * n + 1)
        if n >= 1:
            before, now = now, ((2 * n + 1) * cosine * now - n * before) / (n + 1)
    return work - 0.6 * (1 - poisson**2) / size
