#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Whoever asks for more than the service can do keeps nobody waiting but himself.
. "$(dirname "$0")/../support/lib.sh"
crowd=$build/tests/fault/crowd/crowd

# flood ARGUMENT...: in the background
flood() {
    "$crowd" "$domain" flood "$@" >"$work/flood" 2>&1 9>&- &
    others=$!
    sleep 1
}

end_flood() {
    kill -KILL "$others" 2>/dev/null || true
    wait "$others" 2>/dev/null || true
    others=
}

# median KIND: of the probe's last line, ms
median() {
    sed -n "s/^$1 .*p50 *\([0-9.]*\) ms.*/\1/p" "$out"
}

# within KIND MILLISECONDS
within() {
    awk -v found="$(median "$1")" -v most="$2" 'BEGIN { exit !(found != "" && found < most) }' ||
        fail "$1: takes longer than $2 ms"
}

# The bounds are those of a machine that does other things besides. Without turns a question waits for
# all of a flood: for 128 soft-metal questions of 0.16 s each, ten seconds with two workers; for two
# million samples, a minute.
start_daemon

say "beside a flood of cheap questions"
flood cheap 60 --outstanding 1024
expect 0 "$crowd" "$domain" probe cheap 2
cat "$out"
within cheap 500
end_flood

say "beside soft metals, which nobody can tell beforehand"
flood slow 60 --clients 2 --outstanding 64
expect 0 "$crowd" "$domain" probe cheap 2
cat "$out"
within cheap 500
expect 0 "$crowd" "$domain" probe ping 1
within ping 100
end_flood

say "with a queue that is full of somebody else's"
stop_daemon
settings "queue_capacity: 16"
start_daemon
flood slow 60 --outstanding 256
expect 0 "$crowd" "$domain" probe cheap 1
cat "$out"
grep -q " 0 busy" "$out" || fail "the newcomer is refused"
end_flood

say "beside two million samples: other ensembles, and what takes long"
flood ensemble 60 --samples 2000000
expect 0 "$crowd" "$domain" probe long 1
cat "$out"
within long 2000
expect 0 "$crowd" "$domain" probe ensemble 1 --samples 200
cat "$out"
kill -0 "$others" || fail "the samples are done already"
end_flood
stop_daemon

say "nobody takes all places for replies, and the log says it in few lines"
settings "limits: {clients: 100}"
start_daemon
"$peers/wire_readers" "$domain" 2000 5 >"$work/readers" 2>&1 9>&- &
others=$!
wait_for 20 test -s "$work/readers" || fail "no readers"
expect 0 query
grep -q "gets no replies .* of limits.clients 100" "$log" || fail "the log does not say so"
[ "$(grep -c "gets no replies" "$log")" -le 10 ] || fail "the log says it too often"
wait "$others" || fail "$(cat "$work/readers")"
others=
stop_daemon

say "one request has its limits"
settings "limits: {seconds: 0.02, samples: 1000}"
start_daemon
expect 5 percuss ensemble --a steel-sphere --b al-rod --speed uniform:0.1:1 --samples 1001
says "samples: 1001: must be at most 1000, as the server's limits.samples says"
expect 1 "$crowd" "$domain" probe slow 0
says "TIMEOUT"
expect 0 query
stop_daemon
