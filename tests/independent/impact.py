# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Hertz's law and a blow of a ball on a body of free modes, each propagated exactly under a force that is linear in a step."""

import numpy as np
import scipy.optimize
import scipy.special


class Hertz:
    """F = k d^(3/2) of a ball of the radius on a flat, or across (and along) the side of a round bar."""

    def __init__(self, ball, body, radius, bar=None):
        self.modulus = 1.0 / sum((1 - m["poisson"] ** 2) / m["young"] for m in (ball, body))
        self.radius, self.bar = radius, bar
        if bar is None:
            self.stiffness = 4.0 / 3.0 * self.modulus * np.sqrt(radius)
            return
        # Johnson 4.27: the ratio of the curvatures tells the eccentricity, A < B
        least, most = 0.5 / radius, 0.5 * (1 / radius + 1 / bar)

        def ratio(m):
            k, e = scipy.special.ellipk(m), scipy.special.ellipe(m)
            return (e / (1 - m) - k) / (k - e) - most / least

        m = scipy.optimize.brentq(ratio, 1e-9, 1 - 1e-12)
        k, e = scipy.special.ellipk(m), scipy.special.ellipe(m)
        self.long = (3 * (k - e) / (2 * np.pi * self.modulus * m * least)) ** (1 / 3)
        self.short = self.long * np.sqrt(1 - m)
        self.stiffness = (2 * np.pi * self.modulus * self.long / (3 * k)) ** 1.5

    def axes(self, force):
        if self.bar is None:
            a = (0.75 * force * self.radius / self.modulus) ** (1 / 3)
            return a, a
        return self.long * force ** (1 / 3), self.short * force ** (1 / 3)

    def rigid_blow(self, w, speed):
        """Peak force and duration of a blow of rigid masses."""
        depth = (1.25 * speed**2 / (w * self.stiffness)) ** 0.4
        return self.stiffness * depth**1.5, 2.9433 * depth / speed


class Unsettled(Exception):
    """The bodies have not parted within what is looked at."""


def _solve(k, start, give):
    """d + give k d^(3/2) = start, the smallest d > 0."""
    d = start
    for _ in range(50):
        root = np.sqrt(d)
        slope = 1.0 + 1.5 * give * k * root
        if slope <= 0.0:
            raise Unsettled("a compliance more negative than the contact")
        new = d - (d + give * k * d * root - start) / slope
        if new <= 0.0:
            new = 0.5 * d
        if abs(new - d) <= 1e-14 * start:
            return new
        d = new
    return d


class _Modes:
    def __init__(self, omega, shape, dt):
        self.omega, self.shape = omega, shape
        t = omega * dt
        c, s = np.cos(t), np.sin(t)
        # of slow modes by series: 1 - sin(t)/t and so on lose digits
        small = t < 1e-3
        ts = np.where(small, 1.0, t)
        w2 = 1.0 / omega**2
        self.c, self.s = c, s
        self.a0 = shape * np.where(small, dt * dt / 3 , w2 * (s / ts - c))
        self.a1 = shape * np.where(small, dt * dt / 6, w2 * (1 - s / ts))
        self.g0 = shape * np.where(small, 0.5 * dt / omega, w2 * (s + (c - 1) / ts))
        self.g1 = shape * np.where(small, 0.5 * dt / omega, w2 * (1 - c) / ts)


def restitution(hertz, w, speed, omega, shape, flexibility, steps=400, cut=80.0, most=3000.0):
    """Impulse over what stops the rigid approach, less 1; number of sub-impacts. flexibility: static, all of it beyond
    half-spaces, rigid motions apart. cut: modes up to this over the duration of a rigid blow are followed. most: durations
    after which bodies that have not parted are given up, or 20 ms or two longest periods."""
    _, duration = hertz.rigid_blow(w, speed)
    keep = omega * duration < cut
    omega, shape = omega[keep], shape[keep]
    rest = flexibility - float(np.sum((shape / omega) ** 2))
    dt = duration / steps
    m = _Modes(omega, shape, dt)
    give = rest + w * dt * dt / 6 + float(shape @ m.a1)
    k = hertz.stiffness
    x, v, f = 0.0, speed, 0.0  # rigid approach, its speed, force
    q, p = np.zeros_like(omega), np.zeros_like(omega)
    impulse, blows, time, end = 0.0, 0, 0.0, min(most * duration, max(0.02, 4 * np.pi / omega.min(initial=np.inf)))
    pressed = False
    while True:
        ahead = x + v * dt - w * dt * dt * f / 3
        q1 = m.c * q + m.s * p + m.a0 * f
        start = ahead - float(shape @ q1)
        new = k * _solve(k, start, give) ** 1.5 if start > 0.0 else 0.0
        p = m.c * p - m.s * q + m.g0 * f + m.g1 * new
        q = q1 + m.a1 * new
        x, v = ahead - w * dt * dt * new / 6, v - 0.5 * w * dt * (f + new)
        impulse += 0.5 * dt * (f + new)
        f, time = new, time + dt
        if f > 0.0:
            blows += not pressed
            pressed = True
            if time > end:
                raise Unsettled("pressed")
            continue
        pressed = False
        skip = _flight(x, v, q, p, m, end - time, dt)
        if skip is None:
            break
        if skip < 0.0:
            raise Unsettled("near")
        t = m.omega * skip
        c, s = np.cos(t), np.sin(t)
        q, p = c * q + s * p, c * p - s * q
        x, time = x + v * skip, time + skip
    return impulse * w / speed - 1.0, blows


def _flight(x, v, q, p, m, left, dt):
    """Time until just before the next touch; None: they part for good; -1: not within what is left."""
    size = np.abs(m.shape) * np.hypot(q, p)
    reach = size.sum()
    if v < 0.0 and -x > reach:
        return None
    order = np.argsort(size)[::-1]
    # a touch that small ones alone would make has no impulse
    tail = np.cumsum(size[order][::-1])[::-1]
    big = order[tail > 1e-4 * reach]
    phase = m.omega[big]
    fq, fp = m.shape[big] * q[big], m.shape[big] * p[big]
    step = min(2.0 * dt, 0.2 / phase.max()) if len(big) else dt
    step = max(step, 0.5 * dt)
    count, t0 = max(16, min(4000, int(2e5 / max(len(big), 1)))), 0.0
    turn = np.exp(1j * np.outer(np.arange(1, count + 1) * step, phase))
    amplitude = fq - 1j * fp
    while t0 < left:
        if v < 0.0 and -(x + v * t0) > reach:
            return None
        times = t0 + step * np.arange(1, count + 1)
        motion = (turn @ (amplitude * np.exp(1j * phase * t0))).real
        near = np.flatnonzero(x + v * times - motion > 0.0)
        if len(near):
            return max(t0 + step * near[0] - step, 0.0)
        t0 = times[-1]
    return None if v < 0.0 and -(x + v * t0) > reach else -1.0
