#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# What the wire promises: repeated requests, states, deadlines, batches.
. "$(dirname "$0")/../support/lib.sh"

for choice in true false; do
    say "inline_solves: $choice"
    settings "inline_solves: $choice"
    start_daemon
    expect 0 "$peers/wire_exchanges" "$domain"
    cat "$out"
    stop_daemon
done
