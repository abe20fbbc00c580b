# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""percuss.ensemble: asked of a daemon and in process, and solved by threads, processes and dask's workers, one of
which dies on the way: the same reply to the last bit."""

import concurrent.futures
import dataclasses
import os
import signal
import tempfile
import threading
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np

import percuss
from percuss import ensemble_share

CATALOGUE = Path(os.environ["PERCUSS_SOURCE"]) / "config" / "catalogue.yaml"
SETTINGS = Path(tempfile.mkdtemp()) / "percussd.yaml"
SETTINGS.write_text(f"catalogue: {CATALOGUE}\n")


def plain(value: Any) -> Any:
    """All bits, without what differs from one asking to the next."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {f.name: plain(getattr(value, f.name)) for f in dataclasses.fields(value) if f.name != "timing"}
    if hasattr(value, "tobytes"):
        return value.tobytes()
    if isinstance(value, (tuple, list)):
        return [plain(one) for one in value]
    if isinstance(value, dict):
        return {name: plain(one) for name, one in value.items()}
    return repr(value)


class Ensembles(unittest.TestCase):
    local: percuss.Local

    @classmethod
    def setUpClass(cls) -> None:
        cls.local = percuss.Local(settings=SETTINGS)

    @classmethod
    def tearDownClass(cls) -> None:
        cls.local.close()

    def question(self, samples: int = 600, **others: Any) -> percuss.Ensemble:
        bodies = self.local.bodies()
        return percuss.Ensemble(
            percuss.contact_pair(bodies["steel-sphere"], bodies["al-beam"], speed=0.25),
            [
                percuss.Input("speed", percuss.Distribution.UNIFORM, 0.1, 0.4),
                percuss.Input("young", percuss.Distribution.NORMAL, 70e9, 1e9, body="al-beam"),
            ],
            samples=samples,
            list_samples=True,
            **others,
        )

    def test_daemon_and_local(self) -> None:
        question = self.question(correlations=[percuss.Correlation(0, 1, 0.3)], sampling=percuss.Sampling.SOBOL)
        told: list[percuss.Progress] = []
        with percuss.connect(int(os.environ["PERCUSS_DOMAIN"]), timeout=10.0) as daemon:
            of_daemon = percuss.ensemble(question, daemon)
        reply = percuss.ensemble(question, self.local, progress=told.append)
        self.assertEqual(plain(reply), plain(of_daemon))
        self.assertEqual((reply.status, reply.complete), (percuss.Status.OK, True))
        assert reply.rows is not None
        self.assertEqual(reply.rows.shape, (reply.samples, 2 + 7))
        # the statistics are those of the samples
        self.assertAlmostEqual(float(reply.rows[:, 2].mean()), reply.restitution.mean, delta=1e-12)
        self.assertEqual(int(reply.sub_impact_counts.sum()), reply.samples)
        self.assertEqual({one.input for one in reply.sensitivities}, {"speed", "young"})
        self.assertEqual(told[-1].done, reply.samples)

    def test_lists_and_refusals(self) -> None:
        question = self.question(samples=0)
        question.inputs = [percuss.Input("speed", percuss.Distribution.LIST, values=[0.1, 0.2, 0.3])]
        reply = percuss.ensemble(question, self.local)
        assert reply.rows is not None
        self.assertEqual(reply.rows[:, 0].tolist(), [0.1, 0.2, 0.3])
        question.inputs = [percuss.Input("speed", percuss.Distribution.UNIFORM, 0.4, 0.1)]
        self.assertEqual(percuss.ensemble(question, self.local).status, percuss.Status.BAD_REQUEST)
        question.inputs = [percuss.Input("speed")] * 65
        with self.assertRaisesRegex(ValueError, "inputs: 65"):
            percuss.ensemble(question, self.local)

    def test_friction(self) -> None:
        """Statistics, samples and influences of the tangential impulse, by the daemon as by the library."""
        bodies = self.local.bodies()
        question = percuss.Ensemble(
            percuss.contact_pair(bodies["steel-sphere"], bodies["steel-wall"], speed=0.3),
            [percuss.Input("friction", percuss.Distribution.UNIFORM, 0.05, 0.1)],
            samples=64,
            sampling=percuss.Sampling.LATIN_HYPERCUBE,
            list_samples=True,
        )
        question.scene.bodies[0].angular_velocity = (30.0, 0.0, 0.0)  # slides throughout
        reply = percuss.ensemble(question, self.local)
        with percuss.connect(int(os.environ["PERCUSS_DOMAIN"]), timeout=10.0) as daemon:
            self.assertEqual(plain(reply), plain(percuss.ensemble(question, daemon)))
        self.assertEqual(reply.status, percuss.Status.OK, reply.message)
        assert reply.rows is not None
        self.assertEqual(reply.rows.shape, (64, 1 + 11))
        self.assertEqual(reply.columns[-1], "restitution_kinematic")
        frame = dict(zip(reply.columns, reply.rows.T))
        size = np.hypot(frame["impulse_tangential_1"], frame["impulse_tangential_2"])
        np.testing.assert_allclose(size, frame["friction"] * frame["impulse"], rtol=1e-9)
        for one in reply.tangential_sensitivities:
            self.assertEqual(one.input, "friction")
            self.assertGreater(one.first_order, 0.9)
            self.assertAlmostEqual(
                reply.statistics[one.quantity].mean, float(frame[one.quantity].mean()), delta=1e-12
            )
        self.assertEqual([one.quantity for one in reply.sensitivities], ["restitution"])
        self.assertGreaterEqual(len(reply.tangential_sensitivities), 1)
        question.inputs = [percuss.Input("model-friction", percuss.Distribution.NORMAL, 0.0, 1.0)]
        refused = percuss.ensemble(question, self.local)
        self.assertEqual(refused.status, percuss.Status.BAD_REQUEST)
        self.assertIn("inputs[0].name: model-friction: contacts[0] must have friction", refused.message)

    def test_cancelled(self) -> None:
        reply = percuss.ensemble(self.question(2000000), self.local, progress=lambda told: told.done < 500)
        self.assertEqual(reply.status, percuss.Status.TRUNCATED)
        self.assertGreaterEqual(reply.samples, 500)

        def fail(told: percuss.Progress) -> bool:
            raise LookupError("enough")

        with self.assertRaisesRegex(LookupError, "enough"):
            percuss.ensemble(self.question(2000000), self.local, progress=fail)

    def test_executors(self) -> None:
        """Threads and processes, with an early stop."""
        for question in (self.question(), self.question(20000, half_width=0.02)):
            alone = plain(percuss.ensemble(question, self.local))
            with concurrent.futures.ThreadPoolExecutor(3) as threads:
                self.assertEqual(plain(percuss.ensemble(question, self.local, executor=threads)), alone)
        with concurrent.futures.ProcessPoolExecutor(2) as processes:
            self.assertEqual(plain(percuss.ensemble(question, self.local, executor=processes)), alone)
        with percuss.connect(int(os.environ["PERCUSS_DOMAIN"]), timeout=10.0) as daemon:
            with self.assertRaisesRegex(percuss.InvalidArgument, "must be a Local"):
                percuss.ensemble(question, daemon, executor=threads)

    def test_a_thread_that_ends(self) -> None:
        """What it has prepared is freed with it, a few MB each."""
        closed: list[int] = []
        close = ensemble_share._Worker.close

        def count(worker: ensemble_share._Worker) -> None:
            closed.append(1)
            close(worker)

        with mock.patch.object(ensemble_share._Worker, "close", count):
            with concurrent.futures.ThreadPoolExecutor(1) as threads:
                percuss.ensemble(self.question(), self.local, executor=threads)
                self.assertEqual(closed, [])
            self.assertEqual(closed, [1])

    def test_damaged_on_its_way(self) -> None:
        """Octets of samples that are not what was solved."""

        class Careless:
            def submit(self, solve: Any, *arguments: Any) -> Any:
                part = bytearray(solve(*arguments))
                part[-20] ^= 4
                future: concurrent.futures.Future[bytes] = concurrent.futures.Future()
                future.set_result(bytes(part))
                return future

        with self.assertRaisesRegex(percuss.InvalidArgument, "damaged on its way"):
            percuss.ensemble(self.question(), self.local, executor=Careless())


class Dask(unittest.TestCase):
    def test_a_worker_that_dies(self) -> None:
        """Two workers, one of which is killed with parts that it has and has had: they are solved again."""
        import distributed

        local = percuss.Local(settings=SETTINGS)
        question = Ensembles.question(self, 40000)  # type: ignore[arg-type]
        alone = percuss.ensemble(question, local)
        cluster: Any = distributed.LocalCluster  # dask is not typed
        connected: Any = distributed.Client
        with cluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as workers, connected(workers) as client:
            victims = [worker["pid"] for worker in client.run(self.about).values()]
            told: list[float] = []
            killed = threading.Event()

            def watch(progress: percuss.Progress) -> None:
                told.append(progress.done)
                if progress.done > 3000 and not killed.is_set():
                    killed.set()
                    os.kill(victims[0], signal.SIGKILL)

            reply = percuss.ensemble(question, local, executor=client, progress=watch)
            self.assertTrue(killed.is_set())
        self.assertEqual(plain(reply), plain(alone))
        local.close()

    @property
    def local(self) -> percuss.Local:
        return percuss.Local(settings=SETTINGS)

    @staticmethod
    def about() -> dict[str, int]:
        return {"pid": os.getpid()}


if __name__ == "__main__":
    unittest.main()
