# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Finds libpercuss and loads it."""

import ctypes
import os
from pathlib import Path

VERSION = "0.1.0"

# the interface's number in the library's name; the layouts in _abi.py are those of this one
_NUMBER = "so.0"


def _candidates(name: str) -> list[str]:
    """That beside PERCUSS_LIBRARY alone if it is set; else that of the tree this file is in, or the system's."""
    chosen = os.environ.get("PERCUSS_LIBRARY")
    if chosen:
        return [chosen if name == f"libpercuss.{_NUMBER}" else str(Path(chosen).resolve().parent / name)]
    above = Path(__file__).resolve().parents
    # this file is share/percuss/python/percuss/_library.py in an installed tree, and
    # client/python/percuss/_library.py in a source tree
    installed = [path for tree in above[4:5] for path in (*tree.glob(f"lib*/{name}"), *tree.glob(f"lib/*/{name}"))]
    built = [path for tree in above[3:4] for path in tree.glob(f"build*/client/{name}")]
    # by folders: build comes before build-address, whose sanitizers no Python bears
    return [*map(str, sorted(installed)), name, *map(str, sorted(built))]


def _check_version(library: ctypes.CDLL) -> None:
    """Structs may grow from one minor version to the next."""
    library.percuss_version.restype = ctypes.c_char_p
    version: bytes = library.percuss_version()
    if version.decode().split(".")[:2] != VERSION.split(".")[:2]:
        raise ImportError(f"this package is for libpercuss {VERSION}; {library._name} is {version.decode()}")


def load(part: str = "", version: bool = True) -> ctypes.CDLL:
    """libpercuss, or libpercuss-PART; ImportError says where it was looked for. version: whether it can tell its own."""
    failures = []
    name = f"libpercuss{'-' if part else ''}{part}.{_NUMBER}"
    for candidate in _candidates(name):
        try:
            library = ctypes.CDLL(candidate)
        except OSError as error:
            failures.append(f"\n  {error}")
            continue
        if version:
            _check_version(library)
        return library
    raise ImportError(
        f"{name} was not found: install percuss, or set PERCUSS_LIBRARY to the library's path"
        + "".join(failures)
    )
