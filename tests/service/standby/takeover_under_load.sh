#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The daemon that answers is killed under load, again and again; a standby takes its place each time. Programs
# that know nothing of it get every answer; each impact on a specimen is counted once.
# PERCUSS_FAULTS=whole: 30 times with 16 clients; otherwise 3 times with 6.
. "$(dirname "$0")/../support/lib.sh"

kills=3
clients=6
if [ "${PERCUSS_FAULTS:-}" = whole ]; then
    kills=30
    clients=16
fi
# of a daemon on the loopback interface (idl/wire_loopback.c), s
lease=1.7

settings "store: specimens.db" "standby: standby.lock"
start_daemon

start_standby() {
    : >"$work/standby.log"
    "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" 2>"$work/standby.log" 9>&- &
    standby=$!
    others="$standby $asking"
    wait_for 20 grep -q "waits until it ends" "$work/standby.log" || fail "$(cat "$work/standby.log")"
}

# half of the clients hit specimens of their own, but for the first two, who share one
asking=
for i in $(seq 1 $clients); do
    specimen=-
    [ $((i % 2)) -eq 0 ] || specimen=bar-$((i < 4 ? 1 : i))
    "$peers/standby_client" "$domain" "$specimen" "$work/stop" >"$work/client-$i" 2>&1 9>&- &
    asking="$asking $!"
    echo "$specimen" >"$work/specimen-$i"
done
others=$asking

# everybody_goes_on: each client has had answers since the last look
everybody_goes_on() {
    for i in $(seq 1 $clients); do
        before=$(cat "$work/seen-$i" 2>/dev/null || echo 0)
        [ "$(wc -l <"$work/client-$i")" -gt "$before" ] || return 1
    done
}
look() {
    for i in $(seq 1 $clients); do
        wc -l <"$work/client-$i" >"$work/seen-$i"
    done
}

say "the daemon is killed $kills times while $clients clients ask"
for kill in $(seq 1 $kills); do
    start_standby
    look
    wait_for 30 everybody_goes_on || fail "a client stands still: $(tail -n 2 "$work"/client-*)"
    kill -KILL "$daemon"
    wait "$daemon" 2>/dev/null || true
    daemon=$standby
    wait_for 20 grep -q 'ready: domain' "$work/standby.log" || fail "$(cat "$work/standby.log")"
    look
    wait_for 30 everybody_goes_on || fail "a client stands still: $(tail -n 2 "$work"/client-*)"
done
others=$asking

say "every request was answered: no call failed"
: >"$work/stop"
for client in $asking; do
    wait "$client" || fail "a client ended with $?: $(tail -n 2 "$work"/client-*)"
done
others=
answered=$(sed -n 's/^answered //p' "$work"/client-* | awk '{ sum += $1 } END { print sum }')
sed -n 's/^waited //p' "$work"/client-* | sort -n >"$work/waits"
echo "  $answered answers; of $(wc -l <"$work/waits") waits over 0.1 s the median is" \
    "$(awk '{ all[NR] = $1 } END { print all[int((NR + 1) / 2)] }' "$work/waits") s," \
    "the longest $(tail -n 1 "$work/waits") s; a lease is $lease s"
awk -v lease="$lease" '$1 > 2 * lease { bad = 1 } END { exit bad }' "$work/waits" ||
    fail "somebody waited for more than two leases"

say "nothing was lost or done twice: each specimen has as many impacts as were answered"
for name in $(sort -u "$work"/specimen-* | grep bar); do
    asked=0
    for i in $(seq 1 $clients); do
        [ "$(cat "$work/specimen-$i")" != "$name" ] ||
            asked=$((asked + $(sed -n 's/^answered //p' "$work/client-$i")))
    done
    expect 0 percuss dents --specimen "$name" --json
    [ "$(field impacts)" = "$asked" ] || fail "$name: $asked answered, $(field impacts) counted"
    echo "  $name: $asked impacts"
done

say "the dents and every answer are those of a series that nothing happened to"
last=$((clients - 1))
count=$(sed -n 's/^answered //p' "$work/client-$last")
expect 0 percuss dents --specimen "bar-$last" --json
sed 's/bar-'$last'/quiet/' "$out" >"$work/dents"
rm "$work/stop"
expect 0 "$peers/standby_client" "$domain" quiet "$work/stop" "$count"
grep '^e ' "$out" >"$work/quiet"
grep '^e ' "$work/client-$last" >"$work/disturbed"
cmp -s "$work/quiet" "$work/disturbed" || fail "another series: $(diff "$work/quiet" "$work/disturbed" | head -n 4)"
expect 0 percuss dents --specimen quiet --json
cmp -s "$out" "$work/dents" || fail "other dents: $(diff "$out" "$work/dents")"
grep -h '^e ' "$work/client-2" | sort -u >"$work/plain"
[ "$(wc -l <"$work/plain")" = 1 ] || fail "not all answers to one request are the same"
stop_daemon
