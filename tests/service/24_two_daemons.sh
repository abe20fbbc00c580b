#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Two daemons in one domain, with different catalogues: a client stays with one of them and says which.
. "$(dirname "$0")/lib.sh"

start_daemon
say "a request that names a server is answered by no other"
expect 0 "$peers/wire_servers" "$domain"
stop_daemon
