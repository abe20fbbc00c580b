# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Listens to a DDS domain on loopback and sends changed copies of its packets to where they went.

usage: mutate.py DOMAIN COPIES FILE   ends after that many; writes FILE when it listens
"""

import random
import socket
import struct
import sys
from pathlib import Path

ETHERNET, UDP, RTPS_HEADER, HIGHEST = 14, 8, 20, 102
EVERY_PROTOCOL = 3
EACH = 6  # copies of a packet


def ports_of(domain):
    first = 7400 + 250 * domain + 10  # RTPS 9.6.1.1
    return range(first, first + 2 * HIGHEST)


def damaged(packet, chance):
    """Bytes changed, a length or the end of it; seldom in the header, which says whose it is."""
    changed = bytearray(packet)
    first = 0 if chance.random() < 0.1 else RTPS_HEADER
    for _ in range(chance.choice((1, 1, 2, 4, 16))):
        if first < len(changed):
            changed[chance.randrange(first, len(changed))] = chance.choice((0, 1, 0x7F, 0x80, 0xFF, chance.randrange(256)))
    kind = chance.random()
    if kind < 0.25:
        del changed[chance.randrange(len(changed)) :]
    elif kind < 0.5:
        at = chance.randrange(len(changed)) & ~3
        changed[at : at + 4] = struct.pack(chance.choice("<>") + "I", chance.choice((0, 1, 0x7FFFFFFF, 0xFFFFFFFF)))
    return bytes(changed)


def main():
    domain, left = int(sys.argv[1]), int(sys.argv[2])
    ports, chance = ports_of(domain), random.Random(1)
    with (
        socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(EVERY_PROTOCOL)) as ear,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as mouth,
    ):
        ear.bind(("lo", 0))
        mouth.bind(("127.0.0.1", 0))
        own = mouth.getsockname()[1]
        Path(sys.argv[3]).write_text("listening\n")
        while left > 0:
            frame = ear.recv(65536)
            if len(frame) < ETHERNET + 20 or frame[12:14] != b"\x08\x00" or frame[ETHERNET + 9] != socket.IPPROTO_UDP:
                continue
            udp = ETHERNET + 4 * (frame[ETHERNET] & 15)
            source, target = struct.unpack_from(">HH", frame, udp)
            packet = frame[udp + UDP :]
            if target not in ports or source == own or not packet.startswith(b"RTPS"):
                continue
            for _ in range(min(EACH, left)):
                mouth.sendto(damaged(packet, chance), ("127.0.0.1", target))
                left -= 1


main()
