# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Programs of C++ that peers.sh compiles with a library of Debian's: they read a problem and print seconds and speeds."""

import os
import subprocess
from pathlib import Path


def version(package):
    told = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], check=True, capture_output=True, text=True)
    return told.stdout.split("+")[0]


def ask(program, *problem):
    """Seconds, and a list of speeds."""
    text = " ".join(f"{word:.17g}" if isinstance(word, float) else str(word) for word in problem)
    told = subprocess.run([Path(os.environ["PEERS"]) / program], input=text, text=True, capture_output=True)
    if told.returncode:
        raise RuntimeError(told.stderr.strip() or f"{program} ends with {told.returncode}")
    seconds, *speeds = map(float, told.stdout.split())
    return seconds, speeds
