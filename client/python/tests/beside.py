# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""For tests that put Python beside the program: one daemon and one of this process, with the same catalogue."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import percuss

DOMAIN = int(os.environ["PERCUSS_DOMAIN"])
SOURCE = Path(os.environ["PERCUSS_SOURCE"])
SETTINGS = Path(tempfile.mkdtemp()) / "percussd.yaml"
SETTINGS.write_text(f"catalogue: {SOURCE / 'config' / 'catalogue.yaml'}\n")


def program(*arguments: str, check: bool = True) -> str:
    """What percuss prints."""
    command = [str(Path(os.environ["PERCUSS_BUILD"]) / "bin" / "percuss"), *arguments, "--domain", str(DOMAIN)]
    return subprocess.run(command, check=check, capture_output=True, text=True).stdout


class Beside(unittest.TestCase):
    client: percuss.Client
    local: percuss.Local

    @classmethod
    def setUpClass(cls) -> None:
        cls.client = percuss.connect(DOMAIN, timeout=10.0)
        cls.local = percuss.Local(settings=SETTINGS)

    @classmethod
    def tearDownClass(cls) -> None:
        cls.client.close()
        cls.local.close()
