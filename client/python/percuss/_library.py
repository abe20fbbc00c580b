# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Finds libpercuss and loads it."""

import ctypes
import os
from pathlib import Path

VERSION = "0.2.0"

# the interface's number in the library's name; the layouts in _abi.py are those of this one
_NUMBER = "so.1"


def _candidates(name: str) -> list[str]:
    """That beside PERCUSS_LIBRARY alone if it is set; else that of the wheel or tree this file is in, or the
    system's."""
    chosen = os.environ.get("PERCUSS_LIBRARY")
    if chosen:
        return [chosen if name == f"libpercuss.{_NUMBER}" else str(Path(chosen).resolve().parent / name)]
    above = list(Path(__file__).resolve().parents)
    # a wheel has its libraries inside (deploy/wheel.sh), and no others
    within = above[0] / "lib" / name
    if within.exists():
        return [str(within)]
    # this file is share/percuss/python/percuss/_library.py in an installed tree, and
    # client/python/percuss/_library.py in a source tree
    installed = [path for tree in above[4:5] for path in (*tree.glob(f"lib*/{name}"), *tree.glob(f"lib/*/{name}"))]
    built = [path for tree in above[3:4] for path in tree.glob(f"build*/client/{name}")]
    # and who took the package out of an installed tree by pip has where that was
    noted = Path(__file__).with_name("libraries.txt")
    kept = [str(Path(noted.read_text().strip()) / name)] if noted.exists() else []
    # by folders: build comes before build-address, whose sanitizers no Python bears
    return [*map(str, sorted(installed)), *kept, name, *map(str, sorted(built))]


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
        f"{name} was not found: install percuss, or a wheel that has it inside (sh deploy/wheel.sh BUILD FOLDER), or set "
        "PERCUSS_LIBRARY to libpercuss's path (sh deploy/quickstart.sh builds build/client/libpercuss.so)" + "".join(failures)
    )
