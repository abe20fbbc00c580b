# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""flit_core's build of this folder, asked for at the root of the tree (../../pyproject.toml)."""

import os
from pathlib import Path

# flit_core looks for pyproject.toml there; folders of results are absolute (PEP 517)
os.chdir(Path(__file__).parent)

from flit_core.buildapi import *  # noqa: E402, F403
