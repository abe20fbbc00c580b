#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The same question, the same answer: a query, and an ensemble of that one impact.
. "$(dirname "$0")/../support/lib.sh"

cp -r "$source_dir/config/tables" "$work/tables"
settings "tables: tables" "store: $work/specimens.db"
start_daemon

# agree A B SPEED EXPECTED ARGUMENT...: both give that, to the tolerance of 1e-3 (the query to a tenth of it:
# where its number of modes differs by one or two)
agree() {
    pair="--a $1 --b $2" speed=$3 known=$4
    shift 4
    expect 0 percuss query $pair --speed "$speed" --json "$@"
    asked=$(field restitution)
    expect 0 percuss ensemble $pair --speed "$speed" --samples 1 --json "$@"
    drawn=$(field mean)
    awk -v q="$asked" -v e="$drawn" -v x="$known" \
        'BEGIN { exit !(q - e < 1e-3 && e - q < 1e-3 && (x == "-" || (q - x < 1e-4 && x - q < 1e-4))) }' ||
        fail "$pair at $speed $*: query $asked, ensemble $drawn, expected $known"
}

say "the paper's rods, which have tables"
agree steel-sphere al-rod-1 0.3 0.48779
agree steel-sphere al-rod-1 0.3 0.48779 --contact-model table
agree steel-sphere al-rod-2 0.41 0.59245
agree steel-sphere al-rod-2 0.41 0.59245 --contact-model table
agree steel-sphere al-rod-1 0.3 - --contact-model closed-form
agree steel-sphere al-beam 0.3 -
agree al-cylinder al-rod-round 0.3 -

say "a body without a table: auto takes the family for both"
agree glass-sphere al-rod-2 1.2 -
expect 0 percuss query --a glass-sphere --b al-rod-2 --speed 1.2 --json
shows 'by the family of tables'
without=$(field restitution)

say "who insists on one has it computed, a query or an ensemble, within the deadline"
table="--a glass-sphere --b al-rod-2 --contact-model table"
expect 4 percuss ensemble $table --speed 1.2 --samples 4 --deadline 0.3 --timeout 60
says 'of the contact table computed'
expect 0 percuss ensemble $table --speed uniform:1.1:1.3 --samples 4 --timeout 100
[ "$(ls "$work/tables" | grep -c '^[0-9a-f]*\.json$')" -eq 3 ] || fail "not kept in the folder"
agree glass-sphere al-rod-2 1.2 - --contact-model table
[ "$asked" != "$without" ] || fail "no table was used"
agree glass-sphere al-rod-2 1.2 "$without"

say "a table is of one material: inputs and overrides that change it are refused, not computed for each"
expect 5 percuss ensemble --a steel-sphere --b al-rod-1 --speed 0.3 --contact-model table \
    --input young@al-rod-1=normal:70e9:1e9 --samples 10
says "inputs[1].name: young: must be another one with options.contact_model table"
cat >"$work/override.json" <<'JSON'
{"bodies": [{"id": "steel-sphere", "position": [0.515, 0, 0], "velocity": [-0.3, 0, 0]},
            {"id": "al-rod-1", "overrides": {"yield": 210e6}}],
 "contacts": [{"a": 0, "b": 1, "point": [0.5, 0, 0], "normal": [1, 0, 0]}],
 "options": {"contact_model": "table"}}
JSON
expect 5 percuss query --request "$work/override.json"
says "there is no table for steel-sphere on al-rod-1"
expect 0 percuss ensemble --a steel-sphere --b al-rod-1 --speed 0.3 \
    --input young@al-rod-1=normal:70e9:1e9 --samples 10
if grep -q "closed form" "$err"; then fail "samples of other materials have no family"; fi

say "inputs that would change nothing are refused"
expect 5 percuss ensemble --a steel-sphere --b al-rod-1 --speed 0.3 --input damping@steel-sphere=0.1
says "must be a body that vibrates"
stop_daemon
