# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Peers whose types differ from the IDL do not harm the daemon in DDS domain PERCUSS_DOMAIN.

Cyclone DDS 0.10.2, which the daemon runs on, would end its process for some of them.
"""

import os
import sys
import time
import unittest
from dataclasses import dataclass, field
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "examples"))
import plain_dds
from cyclonedds.core import Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.annotations import appendable, final, key
from cyclonedds.idl.types import array, byte, float64, sequence, uint8, uint64
from cyclonedds.pub import DataWriter
from cyclonedds.topic import Topic
from cyclonedds.util import duration

# several clients of one process: the configuration stands in the environment
os.environ["CYCLONEDDS_URI"] = plain_dds.LOOPBACK
DOMAIN = int(os.environ["PERCUSS_DOMAIN"])


@dataclass
@appendable
class Uint8Request(IdlStruct, typename="percuss::v1::Request"):
    """The same bytes, but a member type that Cyclone DDS 0.10.2 does not know."""

    client: array[uint8, 16]
    key("client")
    sequence: uint64
    bodies: sequence[plain_dds.BodyMotion, 64] = field(default_factory=list)
    contacts: sequence[plain_dds.Contact, 64] = field(default_factory=list)
    delassus: sequence[float64, 4096] = field(default_factory=list)
    options: plain_dds.Options = field(default_factory=plain_dds.Options)


@dataclass
@appendable
class NewerRequest(IdlStruct, typename="percuss::v1::Request"):
    """With a member that this daemon does not know."""

    client: array[byte, 16]
    key("client")
    sequence: uint64
    bodies: sequence[plain_dds.BodyMotion, 64] = field(default_factory=list)
    contacts: sequence[plain_dds.Contact, 64] = field(default_factory=list)
    delassus: sequence[float64, 4096] = field(default_factory=list)
    options: plain_dds.Options = field(default_factory=plain_dds.Options)
    server: array[byte, 16] = bytes(16)
    more: float64 = 1.0


@dataclass
@appendable
class OlderRequest(IdlStruct, typename="percuss::v1::Request"):
    """Ends before the options, a struct: there is no default for that."""

    client: array[byte, 16]
    key("client")
    sequence: uint64


@dataclass
@appendable
class OlderBatch(IdlStruct, typename="percuss::v1::BatchRequest"):
    """A batch of such."""

    client: array[byte, 16]
    key("client")
    sequence: uint64
    requests: sequence[OlderRequest, 256] = field(default_factory=lambda: 3 * [OlderRequest(bytes(16), 1)])


@dataclass
@appendable
class OlderEnsemble(IdlStruct, typename="percuss::v1::EnsembleRequest"):
    """An ensemble of such."""

    client: array[byte, 16]
    key("client")
    sequence: uint64
    scene: OlderRequest = field(default_factory=lambda: OlderRequest(bytes(16), 1))


@dataclass
@final
class FinalRequest(IdlStruct, typename="percuss::v1::Request"):
    """Encoded in another way, and with other contents."""

    client: array[byte, 16]
    key("client")
    sequence: uint64
    text: str = "x" * 1000


class Peers(unittest.TestCase):
    def tearDown(self):
        # whatever came before, a proper client is answered
        plain_dds.Client(DOMAIN).connect(10.0)

    def connect(self, request_type, timeout=10.0):
        with mock.patch.object(plain_dds, "Request", request_type):
            client = plain_dds.Client(DOMAIN)
            client.connect(timeout)
        return client

    def test_uint8_for_octet(self):
        """It names no server, as in version 0.1.0, and is answered."""
        client = self.connect(Uint8Request)
        reply = client.ask(Uint8Request(client.id, 1, [plain_dds.BodyMotion("nothing")]))
        self.assertEqual(reply.server, client.server)

    def test_newer(self):
        self.connect(NewerRequest)

    def test_older(self):
        """Dropped, since there is nothing to answer."""
        with self.assertRaises(TimeoutError):
            self.connect(OlderRequest, 1.0)

    def test_older_inside(self):
        for sample_type in (OlderBatch, OlderEnsemble):
            participant = DomainParticipant(DOMAIN)
            topic = Topic(participant, "percuss/v1/" + sample_type.__idl_typename__.split("::")[-1], sample_type)
            writer = DataWriter(participant, topic, qos=Qos(*plain_dds.EXCHANGE))
            end = time.monotonic() + 10
            while not writer.get_matched_subscriptions():
                self.assertLess(time.monotonic(), end)
                time.sleep(0.01)
            writer.write(sample_type(os.urandom(16), 1))
            # it has arrived; the next client is answered all the same
            self.assertTrue(writer.wait_for_acks(duration(seconds=5)))

    def test_final(self):
        with self.assertRaises(TimeoutError):
            self.connect(FinalRequest, 1.0)


if __name__ == "__main__":
    unittest.main()
