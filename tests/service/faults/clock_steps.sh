#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The time of day is set back and forth by hours, under the daemon and under its clients: nothing hangs,
# nothing expires that should not, and no reply is taken for an old one.
. "$(dirname "$0")/../support/lib.sh"

interpose=$build/tests/libinterpose.so
[ -e "$interpose" ] || fail "no $interpose"
if is_sanitized thread; then
    echo "the thread sanitizer bears nothing in front of it"
    exit 77
fi
interpose=$(preload "$interpose")
settings "store: specimens.db" "inline_solves: true" "tokens: {minutes: 1}" "session_minutes: 1"
clock=$work/clock
printf '%-16s' 0 >"$clock"

# set_clock SECONDS: from now on the daemon's time of day is off by so much
set_clock() {
    printf '%-16s' "$1" | dd of="$clock" conv=notrunc 2>/dev/null
}
# with_clock COMMAND...: under that time of day
with_clock() {
    LD_PRELOAD=$interpose PERCUSS_FAULT_CLOCK=$clock "$@"
}

: >"$log"
# not by the function: it is the daemon that is to be told to end
LD_PRELOAD=$interpose PERCUSS_FAULT_CLOCK=$clock "$bin/percussd" --config "$work/percussd.yaml" \
    --domain "$domain" 2>>"$log" 9>&- &
daemon=$!
wait_for 20 is_up_or_dead || fail "not ready"

say "set back by 50 hours under a daemon that nobody talks to, and nobody leaves: who comes then finds it"
# threads of DDS wait for what they do every second by then, and have missed the next turn
sleep 3
set_clock -180000
sleep 3
expect 0 query --json --timeout 10
logged 'warning the time of day of this machine went back by 180000 s' || fail "the log does not tell"
set_clock 0
wait_for 10 logged 'info    the time of day of this machine went forward by 180000 s' || fail "not of this, either"

expect 0 query --json
cp "$out" "$work/first"
numbers "$work/first" >"$work/expected"
token=$(sed -n 's/^ *"state": "\([0-9a-f]\{32\}\)"$/\1/p' "$work/first" | tail -n 1)
[ -n "$token" ] || fail "no token"
cat >"$work/state.json" <<JSON
{"bodies": [{"id": "steel-sphere", "position": [0, 0, 0.025], "velocity": [0, 0, -0.3]},
            {"id": "al-beam", "state": "$token", "elapsed": 0.5}],
 "contacts": [{"a": 0, "b": 1, "point": [0, 0, 0.010], "normal": [0, 0, 1]}]}
JSON
# one client, which the steps must not make forget what was answered
cat >"$work/again.json" <<'JSON'
{"client": "00112233445566778899aabbccddeeff", "sequence": 3,
 "bodies": [{"id": "steel-sphere", "position": [0, 0, 0.025], "velocity": [0, 0, -0.3]}, {"id": "al-beam"}],
 "contacts": [{"a": 0, "b": 1, "point": [0, 0, 0.010], "normal": [0, 0, 1]}], "options": {"trace": true}}
JSON
expect 0 percuss query --request "$work/again.json" --json
grep -v '"queue"\|"solve"' "$out" >"$work/reply"

# a client that stays: one request after the other, while the clock jumps under daemon and client
LD_PRELOAD=$interpose PERCUSS_FAULT_CLOCK=$clock "$peers/wire_clients" "$domain" >"$work/clients" 2>&1 9>&- &
others=$!

impact=0
for seconds in 18000 -18000 90000 -90000 0; do
    say "the clock is off by $seconds s"
    before=$(date +%s)
    set_clock "$seconds"
    # a client with the right time, and one with the daemon's
    expect 0 query --json --timeout 20
    numbers "$out" | cmp -s - "$work/expected" || fail "another answer"
    expect 0 with_clock "$bin/percuss" query --domain "$domain" --a steel-sphere --b al-beam --speed 0.3 \
        --json --timeout 20
    numbers "$out" | cmp -s - "$work/expected" || fail "another answer"
    # states are known by the time that passes, not by that of day; so are replies
    expect 0 percuss query --request "$work/state.json" --json
    expect 0 percuss query --request "$work/again.json" --json
    grep -v '"queue"\|"solve"' "$out" | cmp -s - "$work/reply" || fail "another reply"
    # an ensemble ends, a specimen is hit once
    expect 0 percuss ensemble --a steel-sphere --b al-rod --speed uniform:0.2:0.3 --samples 16 --json
    impact=$((impact + 1))
    expect 0 percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --contact-model closed-form \
        --specimen-b bar-1
    expect 0 percuss dents --specimen bar-1 --json
    [ "$(field impacts)" -eq "$impact" ] || fail "$(field impacts) impacts of $impact"
    took=$(($(date +%s) - before))
    # some ten commands, each far below a second, on a machine with other work
    [ "$took" -le 30 ] || fail "it took $took s"
done
wait "$others" || fail "$(cat "$work/clients")"
others=

say "set back by an hour under a client that waits for an answer: its time is over when it said"
# complete finite elements take minutes; a wait by the time of day would take an hour
started=$(date +%s)
with_clock timeout 60 "$bin/percuss" query --domain "$domain" --a steel-sphere --b al-rod --speed 0.3 \
    --contact-model complete-fe --tolerance 1e-9 --timeout 4 >"$out" 2>"$err" 9>&- &
others=$!
# it is known, and waits
is_asked() { percuss status --json 2>/dev/null | grep -q '"running"'; }
wait_for 20 is_asked || fail "nothing runs"
set_clock -3600
code=0
wait "$others" || code=$?
others=
[ "$code" -eq 4 ] || fail "exit code $code, not 4, after $(($(date +%s) - started)) s"
is_gone "$daemon" && fail "the daemon has gone"
kill -USR1 "$daemon"
wait_for 10 logged "store: 1 specimens, 5 replies, 0 marks of clients: 0 damaged" || fail "the store"
stop_daemon
