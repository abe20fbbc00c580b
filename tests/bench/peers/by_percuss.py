# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""percuss itself, asked from Python in the same process."""

import time

import percuss
from scenes import answer, client, question

VERSION = f"percuss {percuss.__version__}"
CASES = [(10.0**-i,) for i in range(1, 8)]


def run(scene, tolerance):
    asked = question(scene, tolerance)
    client().solve(asked)  # the bodies' modes, once
    repeats = 20
    began = time.process_time()
    for _ in range(repeats):
        reply = client().solve(asked)
    return answer(reply, scene), (time.process_time() - began) / repeats
