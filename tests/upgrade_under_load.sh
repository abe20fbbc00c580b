#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Today's daemon and that of 0.2.0, built from this repository's history, take each other's place on one store, up and
# down, some killed, while a client of each strikes a specimen without a pause: nothing that was acknowledged is lost,
# nothing counts twice, and whoever is not answered is told. Takes a minute; OLD is a source tree that is already built,
# for the second time.
# usage: upgrade_under_load.sh [OLD]    (PERCUSS_BUILD is today's build folder)
# Exit code 77: the history is not here.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
revision=93761563
release=0.2.0
# shellcheck source=tests/old_release.sh
. "$here/old_release.sh"

settings "store: dents.db"

# client NAME PROGRAMS ID: asks for one impact after the other, each under its number until it is answered; NAME.done
# has the numbers and what came, NAME.told what it was told instead. Until there is a file "enough".
client() {
    number=0
    while [ ! -e "$work/enough" ]; do
        number=$((number + 1))
        cat >"$work/$1.json" <<JSON
{"client": "$3", "sequence": $number,
 "bodies": [{"id": "steel-sphere", "position": [0.515, 0, 0], "velocity": [-0.3, 0, 0]},
            {"id": "al-rod-1", "specimen": "$1"}],
 "contacts": [{"a": 0, "b": 1, "point": [0.5, 0, 0], "normal": [1, 0, 0]}],
 "options": {"contact_model": "closed-form", "compliance": "half-space"}}
JSON
        until "$2/percuss" query --domain "$domain" --request "$work/$1.json" --json --timeout 3 \
            >"$work/$1.out" 2>"$work/$1.err"; do
            tail -n 1 "$work/$1.err" >>"$work/$1.told"
            [ -s "$work/$1.err" ] || echo "NOTHING" >>"$work/$1.told"
        done
        echo "$number $(field restitution "$work/$1.out")" >>"$work/$1.done"
    done
}
count() {
    [ ! -e "$work/$1.done" ] || wc -l <"$work/$1.done"
}
goes_on() {
    [ "$(count then)" -ge $((then_before + 3)) ] && [ "$(count today)" -ge $((today_before + 3)) ]
}

say "up and down six times, every other one killed"
: >"$work/then.done"
: >"$work/today.done"
PERCUSSD=$then/percussd
start_daemon
client then "$then" 00000000000000000000000000000001 9>&- &
others=$!
client today "$today" 00000000000000000000000000000002 9>&- &
others="$others $!"
for turn in 1 2 3 4 5 6; do
    then_before=$(count then)
    today_before=$(count today)
    wait_for 30 goes_on || fail "turn $turn ($PERCUSSD): the clients are not answered: $(tail -n 2 "$work"/*.told)"
    if [ $((turn % 2)) = 0 ]; then
        stop_daemon
    else
        kill -KILL "$daemon"
        wait "$daemon" 2>/dev/null || true
        daemon=
    fi
    PERCUSSD=$([ "$PERCUSSD" = "$then/percussd" ] && echo "$today/percussd" || echo "$then/percussd")
    start_daemon
done
then_before=$(count then)
today_before=$(count today)
wait_for 30 goes_on || fail "the clients are not answered in the end"
: >"$work/enough"
wait $others
others=

say "each impact is there once, and whoever was not answered was told"
for name in then today; do
    expect 0 "$today/percuss" dents --domain "$domain" --specimen "$name" --json
    impacts=$(field impacts)
    echo "  $name: $(count "$name") acknowledged, $impacts in the store, told $(cat "$work/$name.told" 2>/dev/null | wc -l) times"
    [ "$impacts" = "$(count "$name")" ] || fail "not as many impacts as were acknowledged"
    ! grep -q NOTHING "$work/$name.told" 2>/dev/null || fail "a client was told nothing"
done

say "and the two series, struck by whichever daemon was there, are the same"
# to the last digit, as 0.2.0 and today compute these impacts alike: where a version changes answers, its number is named
both=$(($(count then) < $(count today) ? $(count then) : $(count today)))
for name in then today; do
    head -n "$both" "$work/$name.done" >"$work/$name.series"
done
cmp "$work/then.series" "$work/today.series" || fail "other answers"
PERCUSSD=
stop_daemon
