# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Signals, Ctrl-C above all, while a call of the library waits."""

from __future__ import annotations

import threading
from collections.abc import Generator
from typing import Any

from . import _abi


class Signals:
    """Runs Python's signal handlers while the main thread waits in the library: where one raises, as that of
    Ctrl-C does, the call is given up, and `settle` raises the same."""

    def __init__(self) -> None:
        self._raised: BaseException | None = None
        asked = self._ask()
        next(asked)
        # not a function of Python: there a handler runs before the first line, where nothing catches what it raises
        self.function = _abi.WATCH(asked.send)

    def _ask(self) -> Generator[bool, Any, None]:
        while True:
            try:
                # going on from here, Python runs the handlers
                yield self._raised is None
            except GeneratorExit:
                return
            except BaseException as raised:
                # without this frame: who clears those of a traceback would end the generator
                trace = raised.__traceback__
                self._raised = raised.with_traceback(trace and trace.tb_next)

    def settle(self) -> None:
        """Raises what a handler has raised."""
        raised, self._raised = self._raised, None
        if raised is not None:
            raise raised


def listening() -> Signals | None:
    """For the main thread, in which alone Python runs handlers."""
    return Signals() if threading.current_thread() is threading.main_thread() else None
