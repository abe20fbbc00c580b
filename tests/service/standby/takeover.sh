#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Two daemons with the same settings: one answers, the other waits for its place and takes it, under the
# same server id, with the store as it is.
. "$(dirname "$0")/../support/lib.sh"

settings "store: specimens.db" "standby: standby.lock"
start_daemon

# start_standby: beside the one that answers, with a log of its own
start_standby() {
    # emptied first: the shell that opens it may come to that after who looks for the line has looked
    : >"$work/standby.log"
    "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" 2>"$work/standby.log" 9>&- &
    others=$!
    wait_for 20 grep -q "waits until it ends" "$work/standby.log" || fail "$(cat "$work/standby.log")"
}

# takes_over: the standby is now the daemon
takes_over() {
    wait_for 20 grep -q 'ready: domain' "$work/standby.log" || fail "$(cat "$work/standby.log")"
    daemon=$others
    others=
    cp "$work/standby.log" "$log"
}

strike() {
    percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --contact-model closed-form \
        --compliance half-space --specimen-b bar-1 --json "$@"
}

say "who waits is not in the domain: it answers nothing, and is announced to nobody"
start_standby
expect 0 percuss status --json
[ "$(grep -c '"server": "' "$out")" = 1 ] || fail "$(cat "$out")"
server=$(field server)
[ "$server" = "$(cat "$work/standby.lock")" ] || fail "another id than in the file"
expect 0 strike
expect 0 query --json
cp "$out" "$work/first"

say "SIGHUP: a catalogue that it could not serve is said at once"
cp "$work/catalogue.yaml" "$work/good.yaml"
echo nonsense >"$work/catalogue.yaml"
kill -HUP $others
wait_for 20 grep -q "error   standby: .*catalogue.yaml" "$work/standby.log" || fail "$(cat "$work/standby.log")"
cp "$work/good.yaml" "$work/catalogue.yaml"

say "the one that answers is killed: the other one takes its place, its id and its store"
kill -KILL "$daemon"
wait "$daemon" 2>/dev/null || true
takes_over
expect 0 query --json --server "$server"
numbers "$work/first" >"$work/a"
numbers "$out" >"$work/b"
cmp -s "$work/a" "$work/b" || fail "other numbers: $(diff "$work/a" "$work/b")"
expect 0 strike
expect 0 percuss dents --specimen bar-1 --json
[ "$(field impacts)" = 2 ] || fail "$(cat "$out")"

say "a program on the IDL alone: what it has no answer to it asks again"
start_standby
expect 0 "$peers/wire_specimens" "$domain" rig 60 "$work/rig" "$daemon" 20
wait "$daemon" 2>/dev/null || true
known=$(wc -l <"$work/rig")
expect 0 "$peers/wire_specimens" "$domain" rig 60 "$work/rig"
shows "60 answered, $known of them again"
takes_over
expect 0 percuss dents --specimen rig --json
[ "$(field impacts)" = 60 ] || fail "$(cat "$out")"

say "states that only the former one knew are refused as unknown"
cat >"$work/request.json" <<'JSON'
{"bodies": [{"id": "steel-sphere", "position": [0.515, 0, 0], "velocity": [-0.3, 0, 0]},
            {"id": "al-rod-1", "state": "STATE"}],
 "contacts": [{"a": 0, "b": 1, "point": [0.5, 0, 0], "normal": [1, 0, 0]}]}
JSON
sed 's/STATE//' "$work/request.json" >"$work/fresh.json"
expect 0 percuss query --request "$work/fresh.json" --json
state=$(sed -n 's/^ *"state": "\([0-9a-f]\{32\}\)"$/\1/p' "$out" | tail -n 1)
[ -n "$state" ] || fail "no state"
sed "s/STATE/$state/" "$work/request.json" >"$work/later.json"
expect 0 percuss query --request "$work/later.json" --json
start_standby
kill -KILL "$daemon"
wait "$daemon" 2>/dev/null || true
takes_over
expect 5 percuss query --request "$work/later.json"
says "bodies[1].state"

say "the one that answers ends in good order: the same"
start_standby
stop_daemon
takes_over
expect 0 percuss dents --specimen bar-1 --json --server "$server"
[ "$(field impacts)" = 2 ] || fail "$(cat "$out")"

say "one that is stopped for longer than its lease keeps its place: there are never two"
start_standby
kill -STOP "$daemon"
sleep 3
! grep -q "takes over" "$work/standby.log" || fail "$(cat "$work/standby.log")"
kill -CONT "$daemon"
expect 0 strike --timeout 20
[ "$(field server)" = "$server" ] || fail "answered by $(field server)"
expect 0 percuss status --json
[ "$(field process)" = "$daemon" ] || fail "$(cat "$out")"

say "what was submitted is not waited for in vain: it is to be asked again, and is counted once"
"$peers/standby_client" "$domain" bar-2 "$work/go" submit >"$work/client" 2>&1 9>&- &
asking=$!
wait_for 20 grep -q connected "$work/client" || fail "$(cat "$work/client")"
kill -STOP "$daemon"
: >"$work/go"
wait_for 20 grep -q submitted "$work/client" || fail "$(cat "$work/client")"
kill -KILL "$daemon"
wait "$daemon" 2>/dev/null || true
takes_over
wait "$asking" || fail "it ended with $?: $(cat "$work/client")"
grep -q '^lost: .*' "$work/client" || fail "it was not told: $(cat "$work/client")"
grep -q '^lost 1, status 0$' "$work/client" || fail "$(cat "$work/client")"
expect 0 percuss dents --specimen bar-2 --json
[ "$(field impacts)" = 1 ] || fail "$(cat "$out")"
start_standby

say "of two that wait one takes the place, and the other one waits on"
first=$others
"$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" 2>"$work/third.log" 9>&- &
others="$first $!"
third=$!
wait_for 20 grep -q "waits until it ends" "$work/third.log" || fail "$(cat "$work/third.log")"
kill -KILL "$daemon"
wait "$daemon" 2>/dev/null || true
one_is_ready() {
    [ "$(cat "$work/standby.log" "$work/third.log" | grep -c 'ready: domain')" = 1 ]
}
wait_for 20 one_is_ready || fail "$(cat "$work/standby.log" "$work/third.log")"
sleep 0.3
one_is_ready || fail "two answer"
daemon=$third
others=$first
if grep -q 'ready: domain' "$work/standby.log"; then
    daemon=$first
    others=$third
fi
kill -TERM $others
wait $others || fail "it ended with $?"
others=

say "a copy of the lock's file makes two daemons of one id, which both of them say"
cp "$work/standby.lock" "$work/copy.lock"
sed -e "s|standby.lock|copy.lock|" -e "s|specimens.db|other.db|" "$work/percussd.yaml" >"$work/second.yaml"
daemon_log=$work/standby.log
[ "$daemon" != "$third" ] || daemon_log=$work/third.log
"$bin/percussd" --config "$work/second.yaml" --domain "$domain" 2>"$work/second.log" 9>&- &
others=$!
both_say() {
    grep -q "error   percussd .* (process $others on .*) answers in this domain under the id of this one" \
        "$daemon_log" &&
        grep -q "error   percussd .* (process $daemon on .*) answers in this domain under the id of" \
            "$work/second.log"
}
wait_for 20 both_say || fail "$(cat "$work/second.log" "$daemon_log")"
kill -TERM $others
wait $others || fail "it ended with $?"
others=

say "the manager hears that who waits is there, and goes on to be there"
timeout 60 python3 "$support/manager.py" "$work/notify" >"$work/heard" 9>&- &
manager=$!
others=$manager
wait_for 5 test -S "$work/notify" || fail "no manager"
export NOTIFY_SOCKET="$work/notify" WATCHDOG_USEC=400000
start_standby
unset NOTIFY_SOCKET WATCHDOG_USEC
fed_thrice() {
    [ "$(grep -c '^WATCHDOG=1$' "$work/heard")" -ge 3 ]
}
wait_for 20 fed_thrice || fail "$(cat "$work/heard")"
grep -q '^READY=1$' "$work/heard" || fail "$(cat "$work/heard")"
grep -q '^STATUS=standby: waits' "$work/heard" || fail "$(cat "$work/heard")"
kill -TERM $others
wait $others || fail "it ended with $?"
kill "$manager"
wait "$manager" 2>/dev/null || true
others=

say "a standby ends when it is asked to, and one that could not serve does not begin to wait"
start_standby
kill -TERM $others
wait $others || fail "it ended with $?"
others=
sed "s|catalogue.yaml|none.yaml|" "$work/percussd.yaml" >"$work/second.yaml"
expect 1 "$bin/percussd" --config "$work/second.yaml" --domain "$domain"
says "none.yaml: cannot be read"

say "a file that is somebody's is left alone"
sed "s|standby.lock|good.yaml|" "$work/percussd.yaml" >"$work/second.yaml"
expect 1 "$bin/percussd" --config "$work/second.yaml" --domain "$domain"
says "good.yaml: must be empty or hold a server id of 32 hexadecimal digits"
cmp -s "$work/catalogue.yaml" "$work/good.yaml" || fail "it is written to"

say "the store guards itself besides: without the lock a second daemon does not get it"
sed "/^standby/d" "$work/percussd.yaml" >"$work/second.yaml"
expect 1 "$bin/percussd" --config "$work/second.yaml" --domain "$domain"
says "specimens.db: is in use by another process"
stop_daemon

say "the lock's file is deleted: the daemon whose it was ends, and the next one may come"
start_daemon
rm "$work/standby.lock"
wait_for 20 is_gone "$daemon" || fail "it goes on"
code=0
wait "$daemon" || code=$?
[ "$code" -eq 1 ] || fail "it ended with $code"
logged "standby.lock: its lock is not this process's any more: ends at once" || fail "the log does not say why"
start_daemon
expect 0 percuss dents --specimen bar-1 --json
[ "$(field impacts)" = 3 ] || fail "$(cat "$out")"
stop_daemon
