# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The solver in this process: a daemon's answers without one."""

from __future__ import annotations

import ctypes
import os

from . import _abi
from ._library import load
from .client import Client
from .errors import check
from .vocabulary import Id

_library: ctypes.CDLL | None = None


def _load() -> ctypes.CDLL:
    """libpercuss-local, when it is first needed: it brings LAPACK and others along."""
    global _library
    if _library is None:
        _library = load("local")
        for name, result, arguments in _abi.LOCAL_FUNCTIONS:
            function = _library[f"percuss_{name}"]
            function.restype = result
            function.argtypes = arguments
            setattr(_library, f"percuss_{name}", function)
    return _library


class Local(Client):
    """A client whose questions are answered in this process, to the same bits as by a percussd: no daemon,
    no network. It is connected from the beginning and has all methods of Client.

    A question is solved by the thread that asks, within `solve`, or after `submit` within `wait` or `poll`;
    several threads may ask at once, and Python goes on meanwhile."""

    def __init__(
        self,
        catalogue: str | os.PathLike[str] | None = None,
        settings: str | os.PathLike[str] | None = None,
        id: bytes | str | None = None,
        first_sequence: int = 1,
        threads: int = 0,
    ) -> None:
        """catalogue: file; None: that of the settings, or else the one that is installed. settings: file as
        percussd reads it, of which count: catalogue, tables, bodies, store, workers, tokens, limits; None: none.
        id: 16 octets, or their hexadecimal digits; None: zeros. first_sequence: of the first request, > 0. threads: of an ensemble; 0: as
        the settings say, or as many as there are processors. InvalidArgument, with file, line and what is
        allowed, for files that do not do."""
        self._handle = ctypes.c_void_p()
        given = bytes(16) if id is None else Id(id)
        for name, number, most in (("first_sequence", first_sequence, 2**64 - 1), ("threads", threads, 2**32 - 1)):
            if not 0 <= number <= most:
                raise ValueError(f"{name}: {number}: up to {most} is allowed")
        self.settings_file = None if settings is None else os.fsdecode(settings)
        self.catalogue_file = None if catalogue is None else os.fsdecode(catalogue)
        library = _load()
        config = _abi.LocalConfig(
            None if settings is None else os.fsencode(settings),
            None if catalogue is None else os.fsencode(catalogue),
            (ctypes.c_uint8 * 16)(*given),
            first_sequence,
            threads,
        )
        check(library.percuss_local_open(ctypes.byref(config), ctypes.byref(self._handle)), library)
