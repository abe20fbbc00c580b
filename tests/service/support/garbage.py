# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Takes part in a DDS domain on loopback to learn who is there, then sends what only looks like RTPS.

Submessages of every kind with numbers, lengths and flags of any kind, and samples cut anywhere, in fragments
that do not fit: as a participant of its own that has announced itself, in the name of others, and of nobody.

usage: garbage.py DOMAIN PACKETS FILE   ends after that many; writes FILE when it listens, sends once somebody is
heard
"""

import random
import socket
import struct
import sys
import time
from pathlib import Path

HIGHEST = 100  # participants of a machine, see idl/wire_loopback.c
LARGEST = 1400
ODD = (0, 1, 2, 3, 4, 7, 8, 0x7F, 0x80, 0xFF, 0x100, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF)
# RTPS 9.4.5: PAD, ACKNACK, HEARTBEAT, GAP, INFO_TS, INFO_SRC, INFO_REPLY_IP4, INFO_DST, INFO_REPLY, NACK_FRAG,
# HEARTBEAT_FRAG, DATA, DATA_FRAG, and those of security
KINDS = (1, 6, 7, 8, 9, 12, 13, 14, 15, 18, 19, 21, 22, 0x30, 0x31, 0x32, 0x33, 0x34)
DATA, DATA_FRAGMENT = 21, 22
# writers and readers of discovery and liveliness, and of users
ENTITIES = (0x000100C2, 0x000100C7, 0x000003C2, 0x000003C7, 0x000004C2, 0x000004C7, 0x000200C2, 0x000200C7)
PARAMETERS = (0x00, 0x01, 0x02, 0x05, 0x07, 0x0F, 0x15, 0x16, 0x1A, 0x1D, 0x21, 0x29, 0x2C, 0x31, 0x32, 0x40)
PARAMETERS += (0x49, 0x50, 0x52, 0x55, 0x58, 0x5A, 0x60, 0x62, 0x70, 0x71, 0x75, 0x8001, 0x8015, 0x4001)

chance = random.Random(1)


def number():
    return chance.choice(ODD) if chance.random() < 0.6 else chance.randrange(1 << 32)


def noise(most):
    return chance.randbytes(chance.randrange(most + 1))


def parameters(end):
    """A parameter list whose lengths are sometimes wrong."""
    text = b""
    for _ in range(chance.randrange(8)):
        value = noise(64)
        if chance.random() < 0.5:
            value = struct.pack(end + "II", number(), number()) + value
        value += bytes(-len(value) % 4)
        length = len(value) if chance.random() < 0.8 else number() & 0xFFFF
        text += struct.pack(end + "HH", chance.choice(PARAMETERS), length) + value
    return text + (struct.pack(end + "HH", 1, 0) if chance.random() < 0.8 else b"")


def payload(end):
    header = struct.pack(">HH", chance.choice((0, 1, 2, 3, 6, 7, 8, 9, 10, 11)), chance.choice((0, 0, 1, 2, 3)))
    return header + (parameters(end) if chance.random() < 0.5 else noise(400))


def entity():
    return chance.choice(ENTITIES) if chance.random() < 0.7 else number()


def submessage(others):
    kind, flags = chance.choice(KINDS), chance.randrange(256)
    end = "<" if flags & 1 else ">"
    if kind == 14:
        body = chance.choice(others) if others else noise(12)
    elif kind in (DATA, DATA_FRAGMENT):
        offset = 16 if kind == DATA else 28
        body = struct.pack(end + "HH", 0, offset if chance.random() < 0.8 else number() & 0xFFFF)
        body += struct.pack(">II", entity(), entity()) + struct.pack(end + "iI", chance.choice((0, 0, -1)), number())
        if kind == DATA_FRAGMENT:
            body += struct.pack(end + "IHHI", number(), number() & 0xFFFF, number() & 0xFFFF, number())
        body += (parameters(end) if flags & 2 else b"") + payload(end)
    else:
        body = struct.pack(">II", entity(), entity())
        body += b"".join(struct.pack(end + "I", number()) for _ in range(chance.randrange(12))) + noise(16)
    length = len(body) if chance.random() < 0.85 else number() & 0xFFFF
    return struct.pack("BB", kind, flags) + struct.pack(end + "H", length) + body


def packet(others, own):
    if chance.random() < 0.1:
        return noise(LARGEST)
    source = chance.random()
    prefix = own if source < 0.5 else chance.choice(others) if others and source < 0.9 else chance.randbytes(12)
    text = b"RTPS" + bytes((2, chance.choice((1, 5, 255)))) + chance.choice((b"\x01\x10", noise(2).ljust(2, b"\0"))) + prefix
    for _ in range(1 + chance.randrange(4)):
        text += submessage(others)
    return text[: LARGEST if chance.random() < 0.8 else chance.randrange(1, LARGEST)]


def place(first):
    """Sockets at the ports of the highest free participant: announcements are sent to these."""
    for index in reversed(range(HIGHEST)):
        pair = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2)]
        try:
            for k in range(2):
                pair[k].bind(("127.0.0.1", first + 2 * index + k))
                pair[k].setblocking(False)
            return pair, index
        except OSError:
            for one in pair:
                one.close()
    sys.exit("no free ports")


def listen(pair, found):
    """Whose packets come: their prefixes, and one announcement to copy."""
    for one in pair:
        while True:
            try:
                text = one.recv(65536)
            except BlockingIOError:
                break
            if text.startswith(b"RTPS") and len(text) > 20:
                found[text[8:20]] = text


def main():
    domain, left = int(sys.argv[1]), int(sys.argv[2])
    first = 7400 + 250 * domain + 10  # RTPS 9.6.1.1
    pair, index = place(first)
    found, own = {}, chance.randbytes(12)
    Path(sys.argv[3]).write_text("listening\n")
    # who begins announces himself to all
    while not found:
        listen(pair, found)
        time.sleep(0.01)
    while left > 0:
        listen(pair, found)
        others = [prefix for prefix in found if prefix != own][-50:]
        if others and chance.random() < 0.02:
            # somebody's announcement under our own name; now and then a new one, so that leases pile up
            own = own if chance.random() < 0.9 else chance.randbytes(12)
            them = chance.choice(others)
            text = found[them].replace(them, own)
        else:
            text = packet(others, own)
        for port in range(first, first + 2 * HIGHEST) if left % 50 == 0 else chance.sample(range(first, first + 40), 8):
            if port not in (first + 2 * index, first + 2 * index + 1):
                pair[0].sendto(text, ("127.0.0.1", port))
                left -= 1
        time.sleep(0.0005)
    print(len(found), "participants were heard")


main()
