#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A catalogue that names meshes: the daemon has them reduced while it answers about other bodies.
. "$(dirname "$0")/../support/lib.sh"
. "$support/block_deck.sh"

check() {
    "$bin/percussd" --config "$work/percussd.yaml" --check-config
}

# body LINE: the catalogue with one more body
body() {
    awk -v line="  $1" '/^bodies:/ { print; print line; next } { print }' "$source_dir/config/catalogue.yaml" >"$work/catalogue.yaml"
}

# refused TEXT LINE
refused() {
    body "$2"
    expect 1 check
    says "$1"
}

block 4 2 2 >"$work/block.inp"
settings "bodies: reduced"

say "what a mesh needs beside it"
refused "block: unit: missing: must be m, cm, mm" "block: {shape: mesh, file: block.inp}"
refused "unit: furlong: must be m, cm, mm" "block: {shape: mesh, file: block.inp, unit: furlong}"
refused "max_frequency: -1: must be a frequency in Hz" "block: {shape: mesh, file: block.inp, unit: mm, max_frequency: -1}"
refused "raise: maybe: must be true or false" "block: {shape: mesh, file: block.inp, unit: mm, raise: maybe}"
refused "flexibility: soon: must be ahead or later" "block: {shape: mesh, file: block.inp, unit: mm, flexibility: soon}"
refused "instance: must be absent" "block: {shape: mesh, file: block.h5, instance: B-1}"
refused "none.inp: No such file" "block: {shape: mesh, file: none.inp, unit: mm}"
refused "unit: must be absent" "block: {shape: mesh, file: block.h5, unit: mm}"
settings
refused "block.inp: must be a body file of percuss-reduce" "block: {shape: mesh, file: block.inp, unit: mm}"

say "--check-config says what will be reduced"
settings "bodies: reduced"
block="shape: mesh, file: block.inp, unit: mm, material: aluminium, sites: {top: {point: [10, 5, 10]}}"
body "block: {$block}"
expect 0 check
shows "block: will be reduced from $work/block.inp"

cat >"$work/request.json" <<'JSON'
{"bodies": [{"id": "steel-sphere", "velocity": [0, 0, -0.2]}, {"id": "block"}],
 "contacts": [{"a": 0, "b": 1, "point": [0, 0, 0.005], "normal": [0, 0, 1]}]}
JSON
asks() {
    percuss query --request "$work/request.json" >"$out" 2>"$err" 9>&- || true
}

say "others are answered meanwhile; who asks for it is told"
start_daemon
asks
says "ask again later"
expect 0 query

say "then it is there, of the catalogue's material"
reduced() {
    logged "block: reduced"
}
wait_for 100 reduced || fail "not reduced"
loaded() {
    logged "reload: "
}
wait_for 10 loaded || fail "not loaded"
expect 0 percuss query --a steel-sphere --b block --at-b top --speed 0.2
expect 0 percuss bodies --json
shows '"block"'
stop_daemon
[ "$(ls "$work/reduced" | wc -l)" -eq 1 ] || fail "files are left over"

say "once and for all: the next daemon has it from its start"
expect 0 check
[ "$(cat "$out")" = ok ] || fail "it is reduced again"
old=$work/reduced/$(printf '%064d' 0).h5
touch -d "40 days ago" "$old" "$work"/reduced/*.h5
start_daemon
[ ! -e "$old" ] || fail "what nobody names stays for ever"
[ "$(ls "$work/reduced" | wc -l)" -eq 1 ] || fail "what is used has gone"
expect 0 percuss query --a steel-sphere --b block --at-b top --speed 0.2

say "one that cannot be reduced: log and requests say why"
body "block: {$block, instance: nowhere, raise: true}"
kill -HUP "$daemon"
failed() {
    logged "block: could not be reduced: percuss-reduce: .*nowhere"
}
wait_for 20 failed || fail "no reason in the log"
told() {
    asks
    grep -q "could not be reduced: percuss-reduce: .*nowhere" "$err"
}
wait_for 10 told || fail "no reason for who asks"

say "flexibility of a second body later: its sites once it is reduced, another place when a request hits it"
later="shape: mesh, file: block.inp, unit: mm, material: aluminium, max_frequency: 150 kHz, flexibility: later"
body "later: {$later, sites: {top: {point: [10, 5, 10]}}}"
kill -HUP "$daemon"
added() { # added COUNT
    [ "$(grep -c 'later: sites added' "$log")" -eq "$1" ]
}
wait_for 100 added 1 || fail "no sites"
answered() {
    percuss query --a steel-sphere --b later --at-b top --speed 0.2 >"$out" 2>"$err" 9>&-
}
wait_for 20 answered || fail "not answered at its site"
cp "$out" "$work/at_top"
cat >"$work/request.json" <<'JSON'
{"bodies": [{"id": "steel-sphere", "position": [0.004, 0, 0.020], "velocity": [0, 0, -0.2]}, {"id": "later"}],
 "contacts": [{"a": 0, "b": 1, "point": [0.004, 0, 0.005], "normal": [0, 0, 1]}]}
JSON
asks
says "contacts[0].point: on mesh later: its flexibility there"
says "ask again later"
asked_again() {
    asks
    grep -q restitution "$out"
}
wait_for 20 asked_again || fail "not answered at another place"
added 2 || fail "$(grep -c 'later: sites added' "$log") additions"
answered && sed -i '/warning/d' "$out" "$work/at_top" && cmp "$out" "$work/at_top" || fail "an earlier answer has changed"

say "of a mesh that has changed meanwhile none are added; requests say so"
block 4 2 3 >"$work/block.inp"
sed -i 's/0.004, 0/-0.004, 0/' "$work/request.json"
refused_place() {
    asks
    grep -q "could not be solved for at places on it: percuss-reduce: .*block.inp: is not the mesh that" "$err"
}
wait_for 20 refused_place || fail "no reason for who asks"

say "a daemon that ends takes the reduction with it"
block 30 20 20 >"$work/block.inp"
body "block: {$block}"
kill -HUP "$daemon"
begun() {
    logged "block.inp is being reduced by process"
    [ "$(grep -c 'is being reduced by process' "$log")" -eq 2 ]
}
wait_for 10 begun || fail "no second reduction"
process=$(sed -n 's/.*reduced by process \([0-9]*\),.*/\1/p' "$log" | tail -n 1)
stop_daemon
is_gone "$process" || fail "percuss-reduce still runs"
