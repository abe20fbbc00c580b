#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# What a service manager hears: readiness, reloads, how it goes, the end; and a watchdog that is fed as long
# as every thread that should move does.
. "$(dirname "$0")/../support/lib.sh"
heard=$work/heard
: >"$heard"

hears() {
    grep -q -- "$1" "$heard"
}

fed() {
    grep -c '^WATCHDOG=1$' "$heard" || true
}

# fed_beyond COUNT
fed_beyond() {
    [ "$(fed)" -gt "$1" ]
}

# by the last status
is_idle() {
    ! grep '^STATUS=' "$heard" | tail -n 1 | grep -q ensemble
}

# hold NAME: stops the threads of that name until `release`
hold() {
    rm -f "$work/held"
    mkfifo "$work/held"
    : >"$work/stopped"
    "$peers/stop_thread" "$daemon" "$1" <"$work/held" >"$work/stopped" 2>"$err" 9>&- &
    holder=$!
    exec 8>"$work/held"
    wait_for 5 grep -q stopped "$work/stopped" && return
    code=0
    wait "$holder" || code=$?
    [ "$code" -eq 77 ] || fail "the threads $1 are not stopped"
    echo "a thread cannot be stopped here: $(cat "$err")"
    exit 77
}

release() {
    exec 8>&-
    wait "$holder" || fail "the thread does not go on"
}

python3 "$support/manager.py" "$work/notify" >>"$heard" 9>&- &
others=$!
wait_for 5 test -S "$work/notify" || fail "no manager"

say "it is ready when it answers, and says how it goes"
export NOTIFY_SOCKET="$work/notify" WATCHDOG_USEC=10000000
start_daemon
unset NOTIFY_SOCKET WATCHDOG_USEC
wait_for 5 hears '^READY=1$' || fail "it is not ready"
wait_for 5 hears '^STATUS=ready: [0-9]* bodies of catalogue [0-9a-f]\{8\}; 0 answered, 0 refused, 0 waiting$' ||
    fail "no status: $(cat "$heard")"
expect 0 query
wait_for 5 hears '^STATUS=.*; 1 answered' || fail "the answer is not counted"

say "the watchdog is fed"
wait_for 10 fed_beyond "$(($(fed) + 1))" || fail "it is not fed"

say "a reload is told, with its time, and that it is over"
: >"$heard"
kill -HUP "$daemon"
wait_for 5 hears '^READY=1$' || fail "the reload does not end"
grep -A 1 '^RELOADING=1$' "$heard" | grep -q '^MONOTONIC_USEC=[0-9]*$' || fail "the reload is not told"

say "threads without work may sleep: a worker that stands still while it has none is no matter"
hold worker
sleep 6
before=$(fed)
wait_for 10 fed_beyond "$before" || fail "it is not fed"
release

say "a reading thread that does not move starves it; one that moves again feeds it"
hold reader
wait_for 15 logged 'error.*the reading thread: has not moved for' || fail "the log does not say so"
sleep 1.5
before=$(fed)
sleep 3
[ "$(fed)" -eq "$before" ] || fail "it is fed without a reading thread"
release
wait_for 5 fed_beyond "$before" || fail "it is not fed again"
logged 'all threads move again' || fail "the log does not say so"

say "long computations feed it, until their thread stands still"
"$bin/percuss" ensemble --domain "$domain" --a steel-sphere --b al-beam --speed uniform:0.089:0.411 \
    --samples 1000000 --tolerance 1e-6 >"$out" 2>"$err" 9>&- &
asker=$!
others="$others $asker"
wait_for 10 hears '^STATUS=.*ensemble: ' || fail "no ensemble runs"
sleep 7
before=$(fed)
wait_for 10 fed_beyond "$before" || fail "an ensemble starves it"
hold long
wait_for 15 logged 'error.*a worker: has not moved for' || fail "the log does not say so"
before=$(fed)
sleep 3
[ "$(fed)" -eq "$before" ] || fail "it is fed with a worker that stands still"
release
kill "$asker"
wait_for 20 fed_beyond "$before" || fail "it is not fed again"
wait_for 40 is_idle || fail "the ensemble of a client that has gone goes on"

say "the end is told, with the time it may take"
stop_daemon
grep -A 1 '^STOPPING=1$' "$heard" | grep -q '^EXTEND_TIMEOUT_USEC=40000000$' || fail "the end is not told"

say "programs that it runs do not speak for it, and a manager that has gone is no matter"
export NOTIFY_SOCKET="$work/nobody" WATCHDOG_USEC=10000000
start_daemon
expect 0 query
stop_daemon
