#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Who waits for one that was killed hears of it, and what nobody waits for any more is given up.
. "$(dirname "$0")/../support/lib.sh"
crowd=$build/tests/fault/crowd/crowd
# the thread sanitizer sleeps for a second at the end of each program unless it is told otherwise; how long a client
# takes to see that its server has gone is what is looked at
export TSAN_OPTIONS="${TSAN_OPTIONS:-} atexit_sleep_ms=0"

# now: s
now() {
    date +%s.%N
}

# processor time of the daemon, clock ticks
used() {
    awk '{ print $14 + $15 }' "/proc/$daemon/stat"
}

say "a client whose server is killed knows within 2 s"
# a lease of 1.7 s counts from the last word of the server; then a solve waits 0.2 s for a successor; half a
# second for a busy machine
for kind in cheap slow ensemble; do
    start_daemon
    "$crowd" "$domain" probe "$kind" 60 --samples 2000000 >"$out" 2>"$err" 9>&- &
    others=$!
    sleep 1
    kill -KILL "$daemon"
    killed=$(now)
    wait "$daemon" 2>/dev/null || true
    daemon=
    wait "$others" && fail "$kind: goes on without a server"
    others=
    took=$(echo "$killed $(now)" | awk '{ printf "%.2f", $2 - $1 }')
    echo "$kind: $took s"
    grep -q "percussd" "$err" || fail "$kind: does not say which server"
    awk -v took="$took" 'BEGIN { exit !(took <= 2.4) }' || fail "$kind: after $took s"
done

say "one that ended in good order may have a successor, which needs longer to come: 0.4 s"
start_daemon
"$crowd" "$domain" probe cheap 60 >"$out" 2>"$err" 9>&- &
others=$!
sleep 1
stop_daemon
ended=$(now)
wait "$others" && fail "goes on without a server"
others=
took=$(echo "$ended $(now)" | awk '{ printf "%.2f", $2 - $1 }')
echo "in good order: $took s"
# longer than after a kill, 0.2 s, though its end was seen before its process was gone
awk -v took="$took" 'BEGIN { exit !(took > 0.25 && took <= 0.9) }' || fail "after $took s"

say "what killed clients asked for is given up, whatever it is"
start_daemon
for act in "slow 60 --clients 2 --outstanding 256" "ensemble 60 --samples 2000000" \
    "long 60 --outstanding 512"; do
    # shellcheck disable=SC2086
    "$crowd" "$domain" flood $act >/dev/null 2>&1 9>&- &
    others=$!
    sleep 1.5
    before=$(used)
    sleep 0.5
    [ "$(used)" -gt "$before" ] || fail "$act: does not burden the daemon"
    kill -KILL "$others"
    wait "$others" 2>/dev/null || true
    others=
    # a client's lease of 3 s, and a moment for what is being solved
    sleep 5
    expect 0 percuss status --json
    [ "$(field queue_length)" = 0 ] || fail "$act: $(field queue_length) still wait"
    before=$(used)
    sleep 1
    # a second of one processor is a hundred ticks; announcements and heartbeats take one or two
    [ $(($(used) - before)) -le 10 ] || fail "$act: the daemon is still busy"
done
stop_daemon
