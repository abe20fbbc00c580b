#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# An operation of the daemon on its store fails with EIO, one after the other, once or from then on: it does not start
# and says why, or refuses impacts on specimens by name and answers others. What was acknowledged is there afterwards,
# the rest is asked again, and each impact counts once.
# PERCUSS_FAULTS=whole: each operation; otherwise every 19th, of which the 39th is the first to read pages.
. "$(dirname "$0")/../support/lib.sh"

interpose=$build/tests/libinterpose.so
[ -e "$interpose" ] || fail "no $interpose"
if is_sanitized thread; then
    echo "the thread sanitizer bears nothing in front of it"
    exit 77
fi
interpose=$(preload "$interpose")
stride=19
[ "${PERCUSS_FAULTS:-}" != whole ] || stride=1
store=$work/specimens.db
settings "store: specimens.db" "stored_replies: 2"

# start_failing N HOW: true if it starts; its N-th operation on the store fails
start_failing() {
    : >"$log"
    LD_PRELOAD=$interpose PERCUSS_FAULT_PATH=$store PERCUSS_FAULT_AT=$1 PERCUSS_FAULT_DO=$2 \
        PERCUSS_FAULT_COUNT=$work/count "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" \
        2>>"$log" 9>&- &
    daemon=$!
    wait_for 20 is_up_or_dead || fail "$how at $at: neither ready nor dead after 20 s"
    ! is_gone "$daemon" || {
        code=0
        wait "$daemon" || code=$?
        daemon=
        [ "$code" -eq 1 ] && logged "error .*specimens.db: " || fail "$how at $at: it does not start, with $code"
        return 1
    }
}

# strike NUMBER: an impact with that number
strike() {
    sed "s/NUMBER/$1/" "$work/scene.json" >"$work/request.json"
    percuss query --request "$work/request.json" --json
}
cat >"$work/scene.json" <<'JSON'
{"client": "00112233445566778899aabbccddeeff", "sequence": NUMBER,
 "bodies": [{"id": "steel-sphere", "position": [0.515, 0, 0], "velocity": [-0.3, 0, 0]},
            {"id": "al-rod-1", "specimen": "bar-1"}],
 "contacts": [{"a": 0, "b": 1, "point": [0.5, 0, 0], "normal": [1, 0, 0]}],
 "options": {"contact_model": "closed-form", "compliance": "half-space"}}
JSON

# ask NUMBER: up to three times; true if it was acknowledged
ask() {
    for attempt in 1 2 3; do
        code=0
        strike "$1" >"$out" 2>"$err" 9>&- || code=$?
        [ "$code" -ne 0 ] || return 0
        [ "$code" -eq 5 ] && grep -q '"message": "\(bodies\[1\].specimen: \|the store of specimens cannot be read\)' "$out" ||
            fail "$how at $at: exit code $code"
        refused=$((refused + 1))
    done
    return 1
}

# what the store holds to a daemon that nothing happens to
dents() {
    expect 0 percuss dents --json
}

say "an undisturbed series of three impacts"
start_daemon
for number in 1 2 3; do
    expect 0 strike "$number"
    field restitution >"$work/e-$number"
done
dents
cp "$out" "$work/quiet"
stop_daemon

say "one operation after the other fails"
lives=0 unstarted=0 refused=0
for how in break break-on; do
    at=1
    while :; do
        rm -f "$store"*
        told=0
        if start_failing "$at" "$how"; then
            for number in 1 2; do
                ! ask "$number" || told=$number
                [ "$told" -eq "$number" ] || break
            done
            # one failure is over when it is asked again
            [ "$how" = break-on ] || [ "$told" -eq 2 ] || fail "$how at $at: it does not recover"
            # those without a specimen need no store
            expect 0 query
            stop_daemon
            calls=$(cat "$work/count")
        else
            unstarted=$((unstarted + 1))
            calls=$at
        fi
        ! logged "malformed\$" || fail "$how at $at: it says nothing of the disk"
        lives=$((lives + 1))
        # on a good disk: what was told is there, and the rest is counted once
        start_daemon
        for number in 1 2 3; do
            expect 0 strike "$number"
            [ "$(field restitution)" = "$(cat "$work/e-$number")" ] || fail "$how at $at: another answer to $number"
        done
        dents
        cmp -s "$out" "$work/quiet" || fail "$how at $at: other dents: $(diff "$out" "$work/quiet")"
        stop_daemon
        [ "$calls" -ge "$at" ] || break
        at=$((at + stride))
    done
done
echo "  $lives lives with $((at - stride)) operations: $unstarted did not start, $refused requests were refused"
[ "$unstarted" -gt 0 ] && [ "$refused" -gt 0 ] || fail "nothing has failed"

say "nothing can be written for a while: it goes on without a restart"
rm -f "$store"*
export PERCUSS_FAULT_READ_ONLY="$work/read-only"
start_failing 0 break
unset PERCUSS_FAULT_READ_ONLY
expect 0 strike 1
: >"$work/read-only"
for again in 1 2 3; do
    expect 5 strike 2
    shows "the impact is not stored: disk I/O error: Read-only file system: nothing has changed"
done
rm "$work/read-only"
for number in 2 3; do
    expect 0 strike "$number"
    [ "$(field restitution)" = "$(cat "$work/e-$number")" ] || fail "another answer to $number"
done
dents
cmp -s "$out" "$work/quiet" || fail "other dents: $(diff "$out" "$work/quiet")"
stop_daemon
