# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""An elastic, ideally plastic contact of a sphere and a flat as its papers and docs/contact-models.md ("The closed form") have it.

Loading: Jackson and Green, J. Tribology 127 (2005) 343; the dent that stays: Jackson, Green and Marghitu, Nonlinear Dynamics 60
(2010) 217. Both begin smoothly, as percuss has them: the first between 1.9 and 3.8 times the depth of yield, the second between
1 and 1.9 times.
"""

import math


class Contact:
    def __init__(self, stiffness, modulus, poisson, strength, radius):
        """stiffness: Hertz's k, N/m^1.5; modulus: E*, Pa; poisson, strength (Pa): of the material that yields; radius: m."""
        c = 1.295 * math.exp(0.736 * poisson)
        self.depth = (0.5 * math.pi * c * strength / modulus) ** 2 * radius  # at which it yields
        self.stiffness, self.radius = stiffness, radius
        self.growth, self.hardness = 0.14 * math.exp(23.0 * strength / modulus), 4.0 * 2.84 / c

    def load(self, d):
        """Force of an indentation that is the largest so far, N."""
        elastic = self.stiffness * d * math.sqrt(d) if d > 0.0 else 0.0
        w = d / self.depth
        if w <= 1.9:
            return elastic
        size = math.sqrt(self.depth / self.radius * w * (w / 1.9) ** self.growth)  # a/R
        hard = self.hardness * (1.0 - math.exp(-0.82 * size**-0.7))
        plastic = math.exp(-0.25 * w ** (5.0 / 12.0)) * w**1.5 + hard * (1.0 - math.exp(-(w ** (5.0 / 9.0)) / 25.0)) * w
        t = min(1.0, (w - 1.9) / 1.9)
        share = t**3 * (10.0 + t * (6.0 * t - 15.0))
        return elastic + share * (self.stiffness * self.depth**1.5 * plastic - elastic)

    def dent(self, d):
        """The depth that stays of it, m."""
        w = d / self.depth
        if w <= 1.0:
            return 0.0
        t = min(1.0, (w - 1.0) / 0.9)
        return 1.02 * d * (1.0 - ((w + 5.9) / 6.9) ** -0.54) * t * t * (3.0 - 2.0 * t)
