#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# 1000 requests from each of 8 clients: none is lost, none is crossed.
. "$(dirname "$0")/../support/lib.sh"

say "with room for all"
start_daemon
expect 0 "$peers/wire_clients" "$domain"
cat "$out"
shows " 0 asked again"
expect 0 percuss status
stop_daemon

say "with a full queue: BUSY at once, and asked again it is answered"
settings "workers: 1" "queue_capacity: 4"
start_daemon
expect 0 "$peers/wire_clients" "$domain"
cat "$out"
grep -q " 0 asked again" "$out" && fail "the queue was never full"
stop_daemon
