#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Clients come, ask once and go, every other one killed with a question open, while others ask on. The
# daemon's memory, threads and descriptors after half of it, three quarters and all. PERCUSS_BUILD: the build folder.
#
# usage: passers.sh [CLIENTS that come and go (10000)] [at once (8)] [REQUESTS of two that stay (1000000)]
. "$(dirname "$0")/../service/support/lib.sh"
passers=${1:-10000}
together=${2:-8}
requests=${3:-1000000}
crowd=$build/tests/fault/crowd/crowd

# what is remembered of clients that have gone ends soon, to be seen to end
settings "session_minutes: 0.05" "replies: {per_client: 64, megabytes: 8}"

# figures WHEN: resident kB, threads, descriptors
figures() {
    memory=$(awk '/^VmRSS/ { print $2 }' "/proc/$daemon/status")
    threads=$(awk '/^Threads/ { print $2 }' "/proc/$daemon/status")
    files=$(find "/proc/$daemon/fd" -mindepth 1 | wc -l)
    echo "$1: $memory kB, $threads threads, $files descriptors"
}

# come_and_ask PASSERS REQUESTS
come_and_ask() {
    "$crowd" "$domain" steady $(($2 / 2)) --clients 2 --outstanding 64 >"$out" 2>"$err" 9>&- &
    others=$!
    "$crowd" "$domain" pass "$1" --clients "$together" >"$work/pass" 2>>"$err" 9>&- ||
        fail "those that pass: $(cat "$work/pass")"
    cat "$work/pass"
    wait "$others" || fail "those that stay: $(cat "$out")"
    others=
    # leases and sessions end
    sleep 7
}

start_daemon
come_and_ask $((passers / 2)) $((requests / 2))
figures "after half of all"
first_memory=$memory first_threads=$threads first_files=$files
for part in "three quarters" all; do
    come_and_ask $((passers / 4)) $((requests / 4))
    figures "after $part"
done
# who is forgotten leaves nothing; the allocator's slack, a heap for each of the threads that get their
# first request late, is a tenth or 4 MB. A sanitizer keeps what was given back, for a while
is_sanitized || [ "$memory" -le $((first_memory + first_memory / 10 + 4096)) ] || fail "the memory grows"
[ "$threads" -le "$first_threads" ] || fail "the threads grow"
[ "$files" -le "$first_files" ] || fail "the descriptors grow"
stop_daemon
