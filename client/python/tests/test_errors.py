# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""percuss.errors: exceptions go through pickle and from process to process with all that they say."""

import concurrent.futures
import copy
import multiprocessing
import os
import pickle
import unittest
from pathlib import Path

import percuss
from percuss.errors import _CLASSES

CATALOGUE = Path(os.environ["PERCUSS_SOURCE"]) / "config" / "catalogue.yaml"


def open_nothing() -> None:
    percuss.Local("/none.yaml")


def ask_nobody() -> None:
    percuss.connect(int(os.environ["PERCUSS_DOMAIN"]), partition="nobody-is-here", timeout=0.1)


def ask_too_much() -> None:
    with percuss.Local(CATALOGUE) as local:
        bodies = local.bodies()
        request = percuss.contact_pair(bodies["steel-sphere"], bodies["al-rod"], speed=0.3)
        request.options.tolerance = 7.0
        local.solve(request).raise_for_status()


def raised_by(action: object) -> BaseException:
    assert callable(action)
    try:
        action()
    except percuss.PercussError as error:
        return error
    raise AssertionError("nothing was raised")


class Errors(unittest.TestCase):
    def same(self, error: BaseException, other: BaseException) -> None:
        self.assertIs(type(other), type(error))
        self.assertEqual(str(other), str(error))
        self.assertEqual(other.args, error.args)
        self.assertEqual(other.__dict__, error.__dict__)

    def test_every_class(self) -> None:
        errors: list[percuss.PercussError] = [kind(result, "why: 3") for result, kind in _CLASSES.items()]
        errors += [
            percuss.PercussError("something"),
            percuss.CallError(percuss.Result.NO_MEMORY, "no memory"),
            percuss.Refused(percuss.Status.UNKNOWN_BODY, "bodies[1].id: 'x'"),
            percuss.UnknownName("b", "al-bean", ["al-beam", "al-rod"], "in the catalogue"),
        ]
        kinds = {type(error) for error in errors}
        every = {kind for kind in vars(percuss.errors).values() if isinstance(kind, type)}
        self.assertEqual(kinds, {kind for kind in every if issubclass(kind, percuss.PercussError)})
        for error in errors:
            self.assertTrue(str(error))
            for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
                self.same(error, pickle.loads(pickle.dumps(error, protocol)))
            self.same(error, copy.copy(error))

    def test_notes_stay(self) -> None:
        error = percuss.InvalidArgument(percuss.Result.INVALID_ARGUMENT, "speed: -1")
        error.__dict__["sample"] = 17
        self.same(error, pickle.loads(pickle.dumps(error)))

    def test_process_pool(self) -> None:
        spawn = multiprocessing.get_context("spawn")
        with concurrent.futures.ProcessPoolExecutor(1, mp_context=spawn) as pool:
            for action, kind in (
                (open_nothing, percuss.InvalidArgument),
                (ask_nobody, percuss.NoServer),
                (ask_too_much, percuss.Refused),
            ):
                error = pool.submit(action).exception(timeout=60)
                assert error is not None
                self.assertIs(type(error), kind)
                here = raised_by(action)
                # on a busy machine a daemon elsewhere may be seen too late to be told of
                told, here_told = (str(one).partition("; one is in no partition")[0] for one in (error, here))
                self.assertEqual(told, here_told)
                self.assertEqual(error.__dict__, here.__dict__)


if __name__ == "__main__":
    unittest.main()
