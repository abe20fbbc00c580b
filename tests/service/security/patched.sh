#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Somebody with an identity, whose own plugins of DDS Security were patched so that they forbid him nothing,
# may do what his role says all the same, and no more: daemon and clients look for themselves.
. "$(dirname "$0")/../support/lib.sh"
. "$(dirname "$0")/../support/keys.sh"
plugins=$peers/libpatched_plugins.so

say "an authority, and one of each role"
mkdir "$keys"
expect 0 make_keys create "$keys"
for role in serves asks observes; do
    expect 0 make_keys add "$keys" "$role" "$role"
done
settings "security: $keys/serves" "store: $work/store.db"
start_daemon

say "two identities of one process: permissions of what one saw stay when the other goes"
clients_begin
act '0: ok' "open 0 $keys/asks 30"
act '1: ok' "open 1 $keys/../keys/asks 30"
act '1: freed' "free 1"
act '2: ok' "open 2 $keys/asks 30"
clients_end

# attack ROLE: it asks, listens and says that it is a server, for two seconds
attack() {
    "$peers/wire_patched" "$domain" "$keys/$1" "$plugins" 2 >"$work/attack" 2>&1 9>&- &
    attacker=$!
    others="${others:-} $attacker"
    sleep 0.3
}
attacked() {
    wait "$attacker" || { cat "$work/attack" >&2; fail "the attacker does not get that far"; }
    cat "$work/attack"
}
ask() {
    for _ in 1 2; do
        expect 0 percuss query --security "$keys/asks" --a steel-sphere --b al-beam --speed 0.3
    done
}

say "who asks is answered, and may listen to others, as the manual says"
attack asks
ask
attacked
grep -q '^[1-9][0-9]* answers, [1-9][0-9]* replies' "$work/attack" || fail "the attack itself does not work"

say "who observes is not answered, hears no reply, and is no server to the daemon"
attack observes
ask
attacked
grep -q '^0 answers, 0 replies' "$work/attack" || fail "permissions are not looked at"
wait_for 5 logged 'percuss/v1/Request denied' || fail "the log does not tell"
logged eeeeeeee && fail "the daemon takes it for a server"
stop_daemon

say "nor to a client, for which who serves is one"
attack serves
expect 0 percuss status --security "$keys/observes" --json
shows '"server": "eeeeeeee'
attacked
attack observes
expect 3 percuss status --security "$keys/observes" --timeout 1
attacked
