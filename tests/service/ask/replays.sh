#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Repeated, late and out-of-order requests, as event location sends them, get the same bytes.
. "$(dirname "$0")/../support/lib.sh"

for choice in true false; do
    say "inline_solves: $choice"
    settings "inline_solves: $choice"
    start_daemon
    expect 0 "$peers/wire_replays" "$domain"
    cat "$out"
    stop_daemon
done
