# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Finds libpercuss and loads it."""

import ctypes
import os
from pathlib import Path

VERSION = "0.1.0"

# the interface's number in the library's name; the layouts in _abi.py are those of this one
_NAME = "libpercuss.so.0"


def _candidates() -> list[str]:
    """PERCUSS_LIBRARY alone if it is set; else what the system's loader finds, else a build tree."""
    chosen = os.environ.get("PERCUSS_LIBRARY")
    if chosen:
        return [chosen]
    # this file is client/python/percuss/_library.py in a source tree
    builds = Path(__file__).resolve().parents[3].glob(f"build*/client/{_NAME}")
    return [_NAME, *sorted(str(path) for path in builds)]


def _check_version(library: ctypes.CDLL) -> None:
    """Structs may grow from one minor version to the next."""
    library.percuss_version.restype = ctypes.c_char_p
    version: bytes = library.percuss_version()
    if version.decode().split(".")[:2] != VERSION.split(".")[:2]:
        raise ImportError(f"this package is for libpercuss {VERSION}; {library._name} is {version.decode()}")


def load() -> ctypes.CDLL:
    """The library; ImportError says where it was looked for."""
    failures = []
    for candidate in _candidates():
        try:
            library = ctypes.CDLL(candidate)
        except OSError as error:
            failures.append(f"\n  {error}")
            continue
        _check_version(library)
        return library
    raise ImportError(
        f"{_NAME} was not found: install percuss, or set PERCUSS_LIBRARY to the library's path"
        + "".join(failures)
    )
