#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# What takes long is seen while it runs and waits, and is given up when nobody waits for it any more.
. "$(dirname "$0")/../support/lib.sh"

# task KIND STATE: the first such line of percuss status in $work/task
task() {
    percuss status >"$out" 2>"$err" && grep "^ *$2  $1 " "$out" | head -n 1 >"$work/task" && [ -s "$work/task" ]
}

has_no_tasks() {
    percuss status >"$out" 2>"$err" && ! grep -q '^tasks' "$out"
}

# age: of the line in $work/task, s
age() {
    sed 's/.* of [0-9a-f]* *\([0-9.]*\) s.*/\1/' "$work/task"
}

# ask ARGUMENT...: a long question, in the background; its process is $others
ask() {
    : >"$work/answer"
    : >"$work/complaint"
    "$bin/percuss" "$@" --domain "$domain" --timeout 100 >"$work/answer" 2>"$work/complaint" 9>&- &
    others=$!
}

say "nothing runs, and nothing is said of it"
settings "workers: 1"
start_daemon
expect 0 percuss status
grep -q '^tasks' "$out" && fail "there are tasks"
expect 0 percuss status --json
[ "$(field all_tasks)" = 0 ] || fail "all_tasks is $(field all_tasks)"

say "a long question is seen with its age, which grows, and with the share done"
ask query --a steel-sphere --b al-rod-1 --speed 0.3 --contact-model complete-fe --tolerance 1e-4
wait_for 5 task request running || fail "it is not seen"
first=$(age)
is_older() {
    task request running && awk -v now="$(age)" -v first="$first" 'BEGIN { exit !(now >= first + 1) }'
}
wait_for 5 is_older || fail "its age does not grow"
has_share() {
    task request running && grep -q '%' "$work/task"
}
wait_for 5 has_share || fail "the share done is not told"

say "the same in JSON, and once more in percuss status --watch"
expect 0 percuss status --json
[ "$(field all_tasks)" = 1 ] || fail "all_tasks is $(field all_tasks)"
[ "$(field kind)" = request ] || fail "kind is $(field kind)"
[ "$(field running)" = true ] || fail "running is $(field running)"
client=$(field client)
echo "$client" | grep -qx '[0-9a-f]\{32\}' || fail "client is $client"
grep -q "$(echo "$client" | cut -c 1-8)" "$work/task" || fail "the table names another client"
timeout -s INT 2 "$bin/percuss" status --domain "$domain" --watch=0.5 >"$out" 2>"$err" || true
[ "$(grep -c '^ *running  request ' "$out")" -ge 2 ] || fail "--watch does not show it"

say "what comes after it waits for its turn"
long=$others
"$bin/percuss" ensemble --domain "$domain" --a steel-sphere --b al-beam --speed uniform:0.1:0.4 --samples 2000000 \
    >/dev/null 2>&1 9>&- &
others="$long $!"
wait_for 5 task ensemble running || fail "the ensemble is not seen"

say "a killed client's tasks go"
# shellcheck disable=SC2086
kill -KILL $others
# shellcheck disable=SC2086
wait $others || true
others=
wait_for 20 has_no_tasks || fail "they are still there"

say "an interrupted question is given up: gone from the status long before a lease is over"
settings "workers: 1" "log_level: debug"
stop_daemon
start_daemon
ask query --a steel-sphere --b al-rod-1 --speed 0.3 --contact-model complete-fe --tolerance 1e-4
wait_for 5 task request running || fail "it is not seen"
# a shell ignores SIGINT for what it runs in the background, and percuss takes it up again
kill -INT "$others"
code=0
wait "$others" || code=$?
others=
[ "$code" -eq 130 ] || fail "exit code $code, not 130"
grep -q '^percuss: interrupted$' "$work/complaint" || fail "it does not say so"
wait_for 5 logged 'cancelled by its client' || fail "the daemon was not told"
wait_for 5 has_no_tasks || fail "it is still there"

say "a batch as well, and what waits behind another one goes without its turn"
cat >"$work/impacts.csv" <<EOF
speed,restitution
0.3,0.5
0.31,0.5
EOF
ask query --a steel-sphere --b al-rod-1 --speed 0.3 --contact-model complete-fe --tolerance 1e-4
first=$others
wait_for 5 task request running || fail "it is not seen"
"$bin/percuss" query --domain "$domain" --a steel-sphere --b al-rod-1 --speed 0.31 --contact-model complete-fe \
    --tolerance 1e-4 --timeout 100 >/dev/null 2>&1 9>&- &
others="$first $!"
both_run() {
    percuss status >"$out" 2>"$err" && [ "$(grep -c '^ *running  request ' "$out")" = 2 ]
}
wait_for 5 both_run || fail "two clients do not have their turns side by side"
"$bin/percuss" compare --domain "$domain" --a steel-sphere --b al-rod-1 --contact-model complete-fe \
    --tolerance 1e-4 --timeout 100 "$work/impacts.csv" >/dev/null 2>"$work/complaint" 9>&- &
batch=$!
others="$others $batch"
wait_for 5 task batch waiting || fail "the batch does not wait"
kill -TERM "$batch"
code=0
wait "$batch" || code=$?
[ "$code" -eq 143 ] || fail "exit code $code, not 143: $(cat "$work/complaint")"
only_requests() {
    percuss status >"$out" 2>"$err" && ! grep -q ' batch ' "$out" && grep -q ' request ' "$out"
}
wait_for 5 only_requests || fail "the batch is still there"
grep -q ' 0 of [0-9]* places in the queue taken' "$out" || fail "it still has its place in the queue"

say "a question that was not answered in time is given up"
# shellcheck disable=SC2086
kill -INT $others 2>/dev/null || true
# shellcheck disable=SC2086
wait $others || true
others=
wait_for 5 has_no_tasks || fail "they are still there"
expect 4 percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --contact-model complete-fe --tolerance 1e-4 \
    --timeout 1
[ "$(grep -c 'cancelled by its client' "$log")" -ge 5 ] || fail "the daemon was not told"

say "in this process an interrupt ends it as well"
"$bin/percuss" query --local --catalogue "$work/catalogue.yaml" --a steel-sphere --b al-rod-1 --speed 0.3 \
    --contact-model complete-fe --tolerance 1e-4 --timeout 100 >"$out" 2>"$err" 9>&- &
others=$!
# SIGINT is bit 1 of the signals that it catches; the shell before it, which has a trap of its own, catches it, too
catches_interrupts() {
    grep -q '^Name:[[:space:]]*percuss$' "/proc/$others/status" && grep -q '^SigCgt:.*[2367abef]$' "/proc/$others/status"
}
wait_for 20 catches_interrupts || fail "it catches no interrupt"
kill -INT "$others"
code=0
wait "$others" || code=$?
others=
[ "$code" -eq 130 ] || fail "exit code $code, not 130"
says "interrupted"
stop_daemon
