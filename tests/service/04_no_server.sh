#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Without a server a client says so soon.
. "$(dirname "$0")/lib.sh"

say "no daemon in the domain"
expect 3 query --timeout 1
says "no percussd"
expect 3 percuss ping --timeout 1

say "nor any more"
start_daemon
expect 0 query
stop_daemon
expect 3 query --timeout 1
