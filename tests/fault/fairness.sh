#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# How long a client waits beside others who ask for more than the service can do. Prints quantiles; judges
# nothing. PERCUSS_BUILD: the build folder, PERCUSSD: another daemon's program.
#
# usage: fairness.sh [SECONDS of each measurement (5)]
. "$(dirname "$0")/../service/support/lib.sh"
seconds=${1:-5}

crowd=$build/tests/fault/crowd/crowd

# beside NAME ARGUMENT...: a burden, and what probes find meanwhile
beside() {
    name=$1
    probes=$2
    shift 2
    start_daemon
    others=
    echo "beside $name"
    if [ $# -gt 0 ]; then
        "$crowd" "$domain" flood "$@" >"$work/flood" 2>&1 9>&- &
        others=$!
        sleep 1
    fi
    for probe in $probes; do
        timeout 60 "$crowd" "$domain" probe "$probe" "$seconds" --samples 1000 2>&1 9>&- ||
            echo "$probe    no answer within 60 s"
    done
    if [ -n "$others" ]; then
        kill "$others" 2>/dev/null && echo "(still busy)" || cat "$work/flood"
        wait "$others" 2>/dev/null || true
    fi
    others=
    kill -KILL "$daemon"
    wait "$daemon" 2>/dev/null || true
}

span=$((seconds * 2 + 3))
beside "nobody" "ping cheap slow long ensemble"
beside "a flood of cheap questions" "ping cheap" cheap $span --outstanding 1024
beside "64 soft-metal questions of 2 clients" "ping cheap" slow $span --clients 2 --outstanding 32
beside "ten times what can be done, 8 clients" "ping cheap" slow $span --clients 8 --outstanding 256
beside "2 million samples" "cheap long ensemble" ensemble 600 --samples 2000000
