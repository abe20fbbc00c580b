#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Samples that are cut short, too long or changed, from anybody in the domain, end neither the daemon nor
# a client, and everybody else gets the true answers. PERCUSS_DAMAGED: how many go to the daemon.
. "$(dirname "$0")/../support/lib.sh"

ask_everything() {
    expect 0 query --json
    numbers "$out" >"$work/$1.query"
    expect 0 percuss sweep --a steel-sphere --b al-beam --speed 0.1:0.4:8 --csv
    cp "$out" "$work/$1.sweep"
    expect 0 percuss ensemble --a steel-sphere --b al-beam --speed uniform:0.1:0.4 --samples 64
    expect 0 percuss bodies
    cp "$out" "$work/$1.bodies"
    expect 0 percuss ping
}

same_answers() {
    for answer in query sweep bodies; do
        cmp "$work/true.$answer" "$work/$1.$answer" || fail "$1: another answer to $answer"
    done
}

# with a store, for the dents
settings "store: $work/store.db"
start_daemon
ask_everything true

say "to the daemon"
expect 0 "$peers/wire_damaged" requests "$domain" "${PERCUSS_DAMAGED:-3000}"
cat "$out"
ask_everything after
same_answers after

say "to clients while they ask"
"$peers/wire_damaged" replies "$domain" 600 2>/dev/null 9>&- &
attacker=$!
others=$attacker
reached=0
rounds=0
# at least three, and on a busy machine until something has come in time
while [ "$rounds" -lt 3 ] || { [ "$reached" -eq 0 ] && [ "$rounds" -lt 30 ]; }; do
    rounds=$((rounds + 1))
    ask_everything "meanwhile"
    same_answers "meanwhile"
    expect 0 query --timeout 20
    reached=$((reached + $(grep -c "deserialization percuss/v1" "$err" || true)))
done
kill "$attacker" 2>/dev/null || fail "the attacker ended by itself"
say "$reached of them reached a client that only asked for one answer"
[ "$reached" -gt 0 ] || fail "nothing was damaged"
stop_daemon
