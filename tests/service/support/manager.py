# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""A service manager as sd_notify(3) describes it: prints the lines of each datagram at SOCKET, and "." after it."""

import socket
import sys

listening = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
listening.bind(sys.argv[1])
while True:
    print(listening.recv(65536).decode(), ".", sep="\n", flush=True)
