# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Asks a percussd with nothing but its IDL: no libpercuss, no other part of percuss.

Needs `pip install cyclonedds==11.0.1` and a percussd with the shipped catalogue, in the DDS domain that is the argument
or stands in PERCUSS_DOMAIN, else 0, and in the partition PERCUSS_PARTITION, else in none. The types below are those of
percuss_wire.idl, which also states the conventions; docs/dds.md explains the rest.
"""

import os
import sys
import time
from dataclasses import dataclass, field

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import Domain, DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.annotations import appendable, key, nested
from cyclonedds.idl.types import array, bounded_str, byte, float64, sequence, uint32, uint64
from cyclonedds.pub import DataWriter, Publisher
from cyclonedds.sub import DataReader, Subscriber
from cyclonedds.topic import Topic
from cyclonedds.util import duration

Name = bounded_str[63]
Octets = array[byte, 16]
Vector = array[float64, 3]


def zeros(count):
    return field(default_factory=lambda: [0.0] * count)


@dataclass
@appendable
@nested
class BodyMotion(IdlStruct, typename="percuss::v1::BodyMotion"):
    id: Name = ""
    position: Vector = zeros(3)
    orientation: array[float64, 4] = field(default_factory=lambda: [1.0, 0.0, 0.0, 0.0])
    velocity: Vector = zeros(3)
    angular_velocity: Vector = zeros(3)
    state: Name = ""
    elapsed: float64 = 0.0
    specimen: Name = ""


@dataclass
@appendable
@nested
class Contact(IdlStruct, typename="percuss::v1::Contact"):
    a: uint32 = 0
    b: uint32 = 0
    point: Vector = zeros(3)
    normal: Vector = zeros(3)
    gap: float64 = 0.0
    gap_acceleration: float64 = 0.0


@dataclass
@appendable
@nested
class Options(IdlStruct, typename="percuss::v1::Options"):
    tolerance: float64 = 0.0
    horizon: float64 = 0.0
    contact_model: uint32 = 0
    method: uint32 = 0
    compliance: uint32 = 0
    dents: uint32 = 0
    conditioning: bool = False
    trace: bool = False
    deadline: float64 = 0.0


@dataclass
@appendable
class Request(IdlStruct, typename="percuss::v1::Request"):
    client: Octets
    key("client")
    sequence: uint64
    bodies: sequence[BodyMotion, 64] = field(default_factory=list)
    contacts: sequence[Contact, 64] = field(default_factory=list)
    delassus: sequence[float64, 4096] = field(default_factory=list)
    options: Options = field(default_factory=Options)
    server: Octets = bytes(16)  # everybody


@dataclass
@appendable
@nested
class SubImpact(IdlStruct, typename="percuss::v1::SubImpact"):
    start: float64
    compression_end: float64
    end: float64
    impulse: float64
    compression_impulse: float64
    peak_force: float64
    max_indentation: float64
    gap_rate_before: float64
    gap_rate_after: float64
    negligible: bool


@dataclass
@appendable
@nested
class ContactResult(IdlStruct, typename="percuss::v1::ContactResult"):
    impulse: float64
    impulse_vector: Vector
    impulse_compression: float64
    restitution: float64
    inverse_effective_mass: float64
    end_time: float64
    sub_impact_count: uint32
    sub_impacts: sequence[SubImpact, 256]
    impulse_error: float64


@dataclass
@appendable
@nested
class BodyVelocity(IdlStruct, typename="percuss::v1::BodyVelocity"):
    id: Name
    velocity: Vector
    angular_velocity: Vector
    velocity_error: float64
    angular_velocity_error: float64


@dataclass
@appendable
@nested
class BodyState(IdlStruct, typename="percuss::v1::BodyState"):
    id: Name
    state: Name


@dataclass
@appendable
@nested
class BodyEnergy(IdlStruct, typename="percuss::v1::BodyEnergy"):
    id: Name
    energy: float64


@dataclass
@appendable
@nested
class Energy(IdlStruct, typename="percuss::v1::Energy"):
    available: float64
    rigid_after: float64
    vibration: sequence[BodyEnergy, 64]
    damping: float64
    plastic: float64
    stored: float64
    closure: float64


@dataclass
@appendable
@nested
class ErrorEstimate(IdlStruct, typename="percuss::v1::ErrorEstimate"):
    restitution_time: float64
    restitution_modes: float64
    impulse_time: float64
    impulse_modes: float64
    restitution_by_speed: float64
    tolerance_met: bool
    restitution_model: float64
    restitution_total: float64
    total_met: bool
    restitution_yield: float64


@dataclass
@appendable
@nested
class BodyModel(IdlStruct, typename="percuss::v1::BodyModel"):
    id: Name
    modes: uint32
    rigid: bool
    theory: bounded_str[31]
    shear_factor: float64


@dataclass
@appendable
@nested
class Model(IdlStruct, typename="percuss::v1::Model"):
    bodies: sequence[BodyModel, 64]
    contact_model: uint32
    compliance: uint32
    method: uint32
    reason: bounded_str[511]
    omitted_error: float64


@dataclass
@appendable
@nested
class Timing(IdlStruct, typename="percuss::v1::Timing"):
    queue: float64
    solve: float64


@dataclass
@appendable
class Reply(IdlStruct, typename="percuss::v1::Reply"):
    client: Octets
    key("client")
    sequence: uint64
    server: Octets
    catalogue_revision: Name
    version: bounded_str[31]
    status: uint32
    message: bounded_str[1023]
    complete: bool
    end_reason: uint32
    window: float64
    contacts: sequence[ContactResult, 64]
    delassus_source: uint32
    velocity_after: sequence[BodyVelocity, 64]
    states_after: sequence[BodyState, 64]
    energy: Energy
    error: ErrorEstimate
    model: Model
    time_shift: float64
    warnings: sequence[str]
    timing: Timing


# finds percussd where CYCLONEDDS_URI is not set; unlike percussd it receives at every address
LOOPBACK = """<CycloneDDS><Domain Id="any">
<General>
  <Interfaces><NetworkInterface address="127.0.0.1"/></Interfaces><AllowMulticast>false</AllowMulticast>
</General>
<Discovery>
  <ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>119</MaxAutoParticipantIndex>
  <Peers><Peer address="127.0.0.1"/></Peers>
</Discovery>
</Domain></CycloneDDS>"""

# how both ends exchange requests and replies
EXCHANGE = (
    Policy.Reliability.Reliable(duration(milliseconds=100)),
    Policy.Durability.Volatile,
    Policy.History.KeepLast(64),
)


class Client:
    """One request after another."""

    def __init__(self, domain, partition=""):
        self.domain, self.partition = domain, partition
        self.id = os.urandom(16)
        self.server = bytes(16)
        self._domain = Domain(domain, LOOPBACK) if not os.environ.get("CYCLONEDDS_URI") else None
        participant = DomainParticipant(domain)
        # replies come in a partition of our own: the daemon sees this reader and makes its writer there
        replies = f"c_{self.id.hex()}" + (f".{partition}" if partition else "")
        ours = Subscriber(participant, qos=Qos(Policy.Partition([replies])))
        self._replies = DataReader(ours, Topic(participant, "percuss/v1/Reply", Reply), qos=Qos(*EXCHANGE))
        requests = Topic(participant, "percuss/v1/Request", Request)
        theirs = Publisher(participant, qos=Qos(Policy.Partition([partition] if partition else [])))
        self._requests = DataWriter(theirs, requests, qos=Qos(*EXCHANGE))

    def connect(self, timeout=5.0):
        """Waits for a match in both directions, then until a ping is answered. Who answered is `server`: a
        request that names it is answered by no other."""
        end = time.monotonic() + timeout
        while time.monotonic() < end:
            matched = self._requests.get_matched_subscriptions() and self._replies.get_matched_publications()
            reply = self.ask(Request(self.id, 0), 0.01) if matched else None
            if reply:
                self.server = reply.server
                return
            time.sleep(0.005)
        where = f"DDS domain {self.domain}" + (f", partition {self.partition}" if self.partition else "")
        raise TimeoutError(f"no percussd answers in {where} within {timeout:g} s: start one there, or say where it is by "
                           "PERCUSS_DOMAIN, PERCUSS_PARTITION or the argument")

    def ask(self, request, timeout=10.0):
        """The reply, or None. A ping is a request with sequence 0."""
        self._requests.write(request)
        end = time.monotonic() + timeout
        while time.monotonic() < end:
            for reply in self._replies.take(16):
                if reply.sequence == request.sequence:
                    return reply
            time.sleep(0.0002)
        return None


def domain_asked():
    """The argument, or what PERCUSS_DOMAIN says, or else 0."""
    given = sys.argv[1] if len(sys.argv) > 1 else os.environ.get("PERCUSS_DOMAIN") or "0"
    if not given.isdecimal() or int(given) > 230:
        sys.exit(f"domain: {given!r}: 0..230 is allowed")
    return int(given)


def main():
    client = Client(domain_asked(), os.environ.get("PERCUSS_PARTITION", ""))
    try:
        client.connect()
    except TimeoutError as nobody:
        sys.exit(str(nobody))
    print(f"domain {client.domain}")
    # a sphere of 15 mm just touches the top of a beam of 10 mm radius, half-way along it
    sphere = BodyMotion("steel-sphere", position=[0.0, 0.0, 0.025], velocity=[0.0, 0.0, -0.2])
    touch = Contact(0, 1, point=[0.0, 0.0, 0.010], normal=[0.0, 0.0, 1.0])
    reply = client.ask(Request(client.id, 1, [sphere, BodyMotion("al-beam")], [touch], server=client.server))
    if reply is None or reply.status != 0:
        sys.exit(f"refused: {reply.message}" if reply else "no answer")
    for contact in reply.contacts:
        print(f"restitution {contact.restitution!r}")
        print(f"impulse {contact.impulse!r}")
        for one in contact.sub_impacts:
            print(f"  from {1e3 * one.start:.4f} to {1e3 * one.end:.4f} ms: {one.impulse:.7f} N s")
    # what is refused is an answer too
    refused = client.ask(Request(client.id, 2, [sphere, BodyMotion("nothing")], [touch], server=client.server))
    print(refused.message if refused else "no answer")


if __name__ == "__main__":
    main()
