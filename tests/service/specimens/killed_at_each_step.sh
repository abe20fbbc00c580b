#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The daemon is killed at each operation on its store, in the middle of what it writes: whatever was
# acknowledged is there, what was not is asked for again, and each impact counts once.
# PERCUSS_FAULTS=whole: at each one; otherwise at every eighth.
. "$(dirname "$0")/../support/lib.sh"

interpose=$build/tests/libinterpose.so
[ -e "$interpose" ] || fail "no $interpose"
if is_sanitized thread; then
    echo "the thread sanitizer bears nothing in front of it"
    exit 77
fi
interpose=$(preload "$interpose")
stride=8
[ "${PERCUSS_FAULTS:-}" != whole ] || stride=1
settings "store: specimens.db" "stored_replies: 2"

# start_daemon_killed N: it ends itself at the N-th operation
start_daemon_killed() {
    : >"$log"
    LD_PRELOAD=$interpose PERCUSS_FAULT_PATH=$work/specimens.db PERCUSS_FAULT_AT=$1 PERCUSS_FAULT_DO=kill \
        PERCUSS_FAULT_COUNT=$work/count "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" \
        2>>"$log" 9>&- &
    daemon=$!
    wait_for 20 is_up_or_dead || fail "the daemon is not ready after 20 s"
}

# strike NUMBER: an impact with that number, its reply in $work/reply
strike() {
    sed "s/NUMBER/$1/" "$work/scene.json" >"$work/request.json"
    percuss query --request "$work/request.json" --json --timeout 30
}
cat >"$work/scene.json" <<'JSON'
{"client": "00112233445566778899aabbccddeeff", "sequence": NUMBER,
 "bodies": [{"id": "steel-sphere", "position": [0.515, 0, 0], "velocity": [-0.3, 0, 0]},
            {"id": "al-rod-1", "specimen": "bar-1"}],
 "contacts": [{"a": 0, "b": 1, "point": [0.5, 0, 0], "normal": [1, 0, 0]}],
 "options": {"contact_model": "closed-form", "compliance": "half-space"}}
JSON

is_over() {
    is_gone "$daemon" || is_gone "$asking"
}

# ask NUMBER: true if it was acknowledged before the daemon died
ask() {
    strike "$1" >"$work/reply" 2>"$err" 9>&- &
    asking=$!
    wait_for 30 is_over || fail "neither an answer nor a death"
    # an answer may be on its way from one that died behind it
    is_gone "$asking" || sleep 0.3
    kill "$asking" 2>/dev/null || true
    wait "$asking" 2>/dev/null
}

say "the daemon dies at one operation after the other"
at=1
number=1
deaths=0
unsaid=0
while :; do
    start_daemon_killed "$at"
    acknowledged=0
    if ! is_gone "$daemon" && ask "$number"; then
        acknowledged=1
    fi
    if ! is_gone "$daemon"; then
        # a later operation may be that of its end
        kill -TERM "$daemon"
        wait_for 20 is_gone "$daemon" || fail "it does not end"
    fi
    code=0
    wait "$daemon" 2>/dev/null || code=$?
    daemon=
    if [ "$code" -eq 137 ]; then
        deaths=$((deaths + 1))
        # what is there now, to a daemon that nothing happens to
        start_daemon
        logged " 0 damaged" || fail "the store is damaged"
        counted=0
        if percuss dents --specimen bar-1 --json >"$out" 2>"$err"; then
            counted=$(field impacts)
        fi
        [ "$counted" -ge $((number - 1 + acknowledged)) ] && [ "$counted" -le "$number" ] ||
            fail "operation $at: $counted impacts, $((number - 1 + acknowledged)) acknowledged"
        [ "$counted" -eq $((number - 1 + acknowledged)) ] || unsaid=$((unsaid + 1))
        # asked again, it is counted once
        expect 0 strike "$number"
        [ "$acknowledged" -eq 0 ] || cmp -s "$out" "$work/reply" || fail "operation $at: another reply"
        expect 0 percuss dents --specimen bar-1 --json
        [ "$(field impacts)" -eq "$number" ] || fail "operation $at: $(field impacts) impacts of $number"
        stop_daemon
    else
        [ "$acknowledged" -eq 1 ] || fail "operation $at: neither killed nor answered"
        break
    fi
    number=$((number + 1))
    at=$((at + stride))
done
echo "  killed $deaths times, at every $stride. of $(cat "$work/count") operations; $unsaid impacts were there that nobody was told of"
[ "$deaths" -ge $((40 / stride)) ] || fail "only $deaths deaths"

say "the dents are those of a series that nothing happened to"
start_daemon
expect 0 percuss dents --specimen bar-1 --json
cp "$out" "$work/dents"
stop_daemon
rm "$work/specimens.db"*
start_daemon
for i in $(seq 1 "$number"); do
    expect 0 strike "$i"
done
expect 0 percuss dents --specimen bar-1 --json
cmp -s "$out" "$work/dents" || fail "other dents: $(diff "$out" "$work/dents")"
stop_daemon
