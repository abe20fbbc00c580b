# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""A DDS participant's announcement, byte by byte after RTPS 2.1, and whether it is answered.

usage: announce.py send ADDRESS PORT WHERE   says to ADDRESS:PORT that a participant is at 127.0.0.1:WHERE
       announce.py wait WHERE FILE           waits there, and writes the port to FILE (WHERE 0: any free one)
                                             once; exit code 0 when somebody answers, 1 after 3 s
"""

import os
import socket
import struct
import sys
from pathlib import Path


def parameter(name, data):
    return struct.pack("<HH", name, len(data)) + data


def announcement(where):
    prefix = bytes([1, 16]) + os.urandom(10)
    locator = struct.pack("<iI", 1, where) + bytes(12) + socket.inet_aton("127.0.0.1")
    contents = b"".join(
        (
            bytes([0, 3, 0, 0]),  # a little-endian list of parameters
            parameter(0x15, bytes([2, 1, 0, 0])),  # protocol
            parameter(0x16, bytes([1, 16, 0, 0])),  # vendor
            parameter(0x02, struct.pack("<iI", 10, 0)),  # lease, s
            parameter(0x50, prefix + bytes([0, 0, 1, 0xC1])),  # who
            parameter(0x58, struct.pack("<I", 0x0C3F)),  # built-in endpoints
            parameter(0x31, locator),  # where data go
            parameter(0x32, locator),  # where announcements go
            parameter(1, b""),
        )
    )
    data = struct.pack("<HH", 0, 16) + bytes([0, 1, 0, 0xC7, 0, 1, 0, 0xC2]) + struct.pack("<iI", 0, 1) + contents
    return b"RTPS" + bytes([2, 1, 1, 16]) + prefix + struct.pack("<BBH", 0x15, 5, len(data)) + data


def send(address, port, where):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as udp:
        udp.sendto(announcement(where), (address, port))


def wait(where, file):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as udp:
        udp.bind(("127.0.0.1", where))
        udp.settimeout(3.0)
        partial = Path(file + ".partial")
        partial.write_text(f"{udp.getsockname()[1]}\n")
        partial.rename(file)
        try:
            return 0 if udp.recv(65536).startswith(b"RTPS") else 1
        except TimeoutError:
            return 1


if sys.argv[1] == "send":
    send(sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))
else:
    sys.exit(wait(int(sys.argv[2]), sys.argv[3]))
