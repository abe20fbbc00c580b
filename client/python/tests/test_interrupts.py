# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C and other signals while a call waits for what takes minutes, beside the daemon that the environment names."""

import os
import signal
import sys
import threading
import time
import unittest
from collections.abc import Callable
from pathlib import Path
from typing import Any

import percuss

CATALOGUE = Path(os.environ["PERCUSS_SOURCE"]) / "config" / "catalogue.yaml"
# each of these takes longer than a test may
LONG = 600.0


def long_question(client: percuss.Client) -> percuss.Request:
    bodies = client.bodies()
    question = percuss.contact_pair(bodies["steel-sphere"], bodies["al-rod-1"], speed=0.3)
    question.options.contact_model = percuss.ContactModel.COMPLETE_FE
    question.options.tolerance = 1e-4
    return question


def long_ensemble(client: percuss.Client) -> percuss.Ensemble:
    bodies = client.bodies()
    scene = percuss.contact_pair(bodies["steel-sphere"], bodies["al-beam"], speed=0.3)
    scene.options.method = percuss.Method.CVODE  # hours, all samples together
    speed = percuss.Input("speed", percuss.Distribution.UNIFORM, 0.1, 0.4)
    return percuss.Ensemble(scene, [speed], samples=1_000_000)


class Interrupts(unittest.TestCase):
    def connect(self) -> percuss.Client:
        return percuss.connect(int(os.environ["PERCUSS_DOMAIN"]), timeout=10.0)

    def interrupted(self, call: Callable[[], Any], after: float = 0.7) -> None:
        """Ctrl-C ends it, long before it would be answered or time out."""
        timer = threading.Timer(after, os.kill, (os.getpid(), signal.SIGINT))
        begun = time.monotonic()
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                call()
        finally:
            timer.join()
        self.assertLess(time.monotonic() - begun, LONG / 4)

    def has_no_tasks(self, client: percuss.Client) -> None:
        """What was given up is gone from the server, which says so once a second."""
        end = time.monotonic() + 60.0
        while any(task.client == client.id for server in client.servers() for task in server.tasks):
            self.assertLess(time.monotonic(), end, "the server goes on")
            time.sleep(0.2)

    def test_solve(self) -> None:
        with self.connect() as client:
            self.interrupted(lambda: client.solve(long_question(client), timeout=LONG), after=2.5)
            self.has_no_tasks(client)
            # and the client goes on
            question = long_question(client)
            question.options.contact_model = percuss.ContactModel.HERTZ
            client.solve(question, timeout=60.0).raise_for_status()

    def test_seen(self) -> None:
        """What waits is seen with its kind and age."""
        with self.connect() as client:
            sequence = client.submit(long_question(client))
            tasks: tuple[percuss.Task, ...] = ()
            end = time.monotonic() + 60.0
            while not tasks and time.monotonic() < end:
                time.sleep(0.2)
                tasks = tuple(one for server in client.servers() for one in server.tasks if one.client == client.id)
            self.assertEqual([(task.kind, task.sequence) for task in tasks], [(percuss.TaskKind.REQUEST, sequence)])
            self.assertGreaterEqual(tasks[0].age, 0.0)
            client.cancel(sequence)
            self.has_no_tasks(client)

    def test_wait(self) -> None:
        """A question that is waited for stays outstanding."""
        with self.connect() as client:
            sequence = client.submit(long_question(client))
            self.interrupted(lambda: client.wait(sequence, timeout=LONG))
            self.assertIsNone(client.poll(sequence))
            client.cancel(sequence)
            with self.assertRaises(percuss.UnknownSequence):
                client.poll(sequence)
            self.has_no_tasks(client)

    def test_batch_and_ensemble(self) -> None:
        with self.connect() as client:
            batch = [long_question(client)] * 3
            self.interrupted(lambda: client.solve_batch(batch, timeout=LONG))
            ensemble = long_ensemble(client)
            self.interrupted(lambda: percuss.ensemble(ensemble, client, timeout=LONG))
            self.interrupted(lambda: percuss.ensemble(ensemble, client, timeout=LONG, progress=lambda _: True))
            self.has_no_tasks(client)

    def test_before_the_first_line(self) -> None:
        """Ctrl-C just where C calls the function that is told of the progress."""

        def interrupt(frame: Any, _: str, __: Any) -> None:
            if frame.f_code.co_name == "_told":
                raise KeyboardInterrupt

        with self.connect() as client:
            ensemble = long_ensemble(client)
            sys.settrace(interrupt)
            try:
                with self.assertRaises(KeyboardInterrupt):
                    percuss.ensemble(ensemble, client, timeout=LONG, progress=lambda _: True)
            finally:
                sys.settrace(None)
            self.has_no_tasks(client)

    def test_local(self) -> None:
        with percuss.Local(CATALOGUE) as local:
            question = long_question(local)
            self.interrupted(lambda: local.solve(question, timeout=LONG))
            self.interrupted(lambda: local.solve_batch([question] * 3, timeout=LONG))
            ensemble = long_ensemble(local)
            self.interrupted(lambda: percuss.ensemble(ensemble, local, timeout=LONG))
            question.options.contact_model = percuss.ContactModel.HERTZ
            local.solve(question).raise_for_status()

    def test_other_signals(self) -> None:
        """A handler that does not raise runs while the call waits, which goes on."""
        heard: list[float] = []
        before = signal.signal(signal.SIGUSR1, lambda *_: heard.append(time.monotonic()))
        try:
            with self.connect() as client:
                question = long_question(client)
                timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGUSR1))
                timer.start()
                with self.assertRaises(percuss.AnswerTimeout):
                    client.solve(question, timeout=3.0)
                ended = time.monotonic()
                timer.join()
        finally:
            signal.signal(signal.SIGUSR1, before)
        self.assertEqual(len(heard), 1)
        self.assertLess(heard[0], ended)

    def test_other_threads(self) -> None:
        """They are not asked: a call there goes on when the main thread is interrupted."""
        with self.connect() as client:
            question = long_question(client)
            caught: list[BaseException] = []

            def ask() -> None:
                try:
                    client.solve(question, timeout=4.0)
                except BaseException as problem:
                    caught.append(problem)

            thread = threading.Thread(target=ask)
            thread.start()
            self.interrupted(lambda: client.solve(question, timeout=LONG))
            thread.join()
            self.assertEqual([type(one) for one in caught], [percuss.AnswerTimeout])


if __name__ == "__main__":
    unittest.main()
