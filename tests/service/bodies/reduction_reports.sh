#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# What is heard of a mesh that is being reduced, could not be, or does not go with its catalogue.
. "$(dirname "$0")/../support/lib.sh"
. "$support/block_deck.sh"

# body KEYS: the catalogue with a block of these keys besides its file
body() {
    awk -v line="  block: {shape: mesh, file: block.inp, unit: mm, material: aluminium$1}" \
        '/^bodies:/ { print; print line; next } { print }' "$source_dir/config/catalogue.yaml" >"$work/catalogue.yaml"
}

cat >"$work/request.json" <<'JSON'
{"bodies": [{"id": "steel-sphere", "velocity": [0, 0, -0.2]}, {"id": "block"}],
 "contacts": [{"a": 0, "b": 1, "point": [0, 0, 0.005], "normal": [0, 0, 1]}]}
JSON
# told TEXT: what who asks for the block is told
told() {
    percuss query --request "$work/request.json" >"$out" 2>"$err" 9>&- || true
    grep -q -- "$1" "$err"
}
begun() {
    grep -c 'is being reduced by process' "$log" || true
}
begins() {
    [ "$(begun)" -eq "$1" ]
}
reloaded() {
    [ "$(grep -c 'reload: ' "$log")" -eq "$1" ]
}

say "how far it is, and by which stage"
block 24 20 20 >"$work/block.inp"
body ", max_frequency: 60e3"
settings "bodies: reduced"
start_daemon
wait_for 60 told "its mesh is being reduced, [0-9]* % ([a-z].*): ask again later" || fail "not told how far"
shown() {
    expect 0 percuss status
    grep -q 'activity    reducing block, [0-9]* %' "$out"
}
wait_for 10 shown || fail "status does not show it"

say "one that was killed says so, and SIGHUP tries it again"
process=$(sed -n 's/.*reduced by process \([0-9]*\),.*/\1/p' "$log")
kill -KILL "$process"
wait_for 10 told "could not be reduced: percuss-reduce was ended by signal 9" || fail "no reason"
kill -HUP "$daemon"
wait_for 10 begins 2 || fail "not tried again"
wait_for 10 told "its mesh is being reduced" || fail "not told"

say "one that is refused stays so over SIGHUP, until its entry changes"
block 4 2 2 >"$work/block.inp"
body ", fixed: [nowhere]"
stop_daemon
start_daemon
wait_for 20 told "could not be reduced: percuss-reduce: .*nowhere" || fail "no reason"
wait_for 10 reloaded 1 || fail "not loaded"
kill -HUP "$daemon"
wait_for 10 reloaded 2 || fail "not loaded again"
sleep 1.5
[ "$(begun)" -eq 1 ] || fail "tried again"
told "could not be reduced: percuss-reduce: .*nowhere" || fail "the reason is lost"

say "one whose site is off its surface: the old catalogue stays, and the reason is told"
body ", sites: {far: {point: [10, 5, 60]}}"
kill -HUP "$daemon"
wait_for 20 told "its mesh is reduced, but the catalogue cannot be loaded with it: .*sites.far" || fail "no reason"
expect 0 query
body ", sites: {top: {point: [10, 5, 10]}}"
kill -HUP "$daemon"
there() {
    percuss query --a steel-sphere --b block --at-b top --speed 0.2 >"$out" 2>"$err" 9>&-
}
wait_for 10 there || fail "not there"
[ "$(begun)" -eq 2 ] || fail "reduced again"
stop_daemon

say "a folder that cannot be written stops nobody but the meshes"
rm -r "$work/reduced"
echo >"$work/reduced"
start_daemon
wait_for 10 told "its mesh cannot be reduced: .*reduced" || fail "no reason"
expect 0 query
rm "$work/reduced"
mkdir "$work/reduced"
kill -HUP "$daemon"
wait_for 20 there || fail "not there"
stop_daemon
