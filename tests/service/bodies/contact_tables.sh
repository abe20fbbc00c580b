#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Precomputed contact tables: found beside the settings, chosen, left out when damaged.
. "$(dirname "$0")/../support/lib.sh"

cp -r "$source_dir/config/tables" "$work/tables"
settings "tables: tables"
start_daemon
logged 'tables: 2 from' || fail "not two tables"

ask() {
    percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --json "$@"
}

say "a table by name, and by auto where it yields"
expect 0 ask --contact-model table
[ "$(field contact_model)" = table ] || fail "model $(field contact_model)"
first=$(field restitution)
awk -v e="$first" 'BEGIN { exit !(e > 0.457 && e < 0.497) }' || fail "e = $first"
expect 0 ask
[ "$(field contact_model)" = table ] || fail "auto took $(field contact_model)"
[ "$(field restitution)" = "$first" ] || fail "auto: $(field restitution), not $first"
expect 0 percuss query --a steel-sphere --b al-rod-1 --speed 0.005 --json
[ "$(field contact_model)" = hertz ] || fail "model $(field contact_model)"

say "another sphere, the same materials: the same table"
sed 's/^  steel-sphere:.*/  steel-sphere: {shape: sphere, material: steel, radius: 0.008}/' \
    "$source_dir/config/catalogue.yaml" >"$work/catalogue.yaml"
kill -HUP "$daemon"
wait_for 10 logged 'reload: ' || fail "no reload"
expect 0 ask --contact-model table
[ "$(field contact_model)" = table ] || fail "model $(field contact_model)"
[ "$(field restitution)" != "$first" ] || fail "the same answer for another sphere"
cp "$source_dir/config/catalogue.yaml" "$work/catalogue.yaml"

say "auto without a table of its own takes the family and says so"
expect 0 percuss query --a glass-sphere --b al-rod-1 --speed 0.3 --json
[ "$(field contact_model)" = table ] || fail "model $(field contact_model)"
shows 'by the family of tables'
stop_daemon

say "without a family auto takes the closed form and says so; a damaged family is left out"
mkdir "$work/alone"
cp "$work"/tables/[0-9]*.json "$work/tables"/c*.json "$work/alone"
sed 's/"poisson":\[0.1/"poisson":[0.2/' "$work/tables/family.json" >"$work/alone/family.json"
settings "tables: alone" "tables_alone: true"
start_daemon
logged 'table left out: .*/family.json: content: .*damaged' || fail "not complained about"
logged 'tables: 2 from .*no family there' || fail "not two tables alone"
expect 0 percuss query --a glass-sphere --b al-rod-1 --speed 0.3 --json
[ "$(field contact_model)" = closed-form ] || fail "model $(field contact_model)"
shows 'no table for these bodies'
expect 0 percuss query --a steel-sphere --b al-rod-1 --speed 3
says 'the table ends before the largest indentation'
stop_daemon
settings "tables: tables"

say "damaged, foreign and outdated files are left out, the others serve"
set -- "$work"/tables/*.json
cp "$1" "$work/tables/renamed.json"
sed -i '0,/"force": \[/!b; /"force": \[/{n;s/\./.5/}' "$work/tables/renamed.json"
head -c 2000 "$2" >"$work/tables/short.json"
echo '{"format": "something else"}' >"$work/tables/foreign.json"
sed 's/"indentation_version": [0-9]*/"indentation_version": 999/' "$2" >"$work/tables/old.json"
: >"$work/tables/empty.json"
mkdir "$work/tables/folder.json"
start_daemon
logged 'tables: 2 from' || fail "not two tables"
for name in renamed short foreign old empty folder; do
    logged "table left out: .*/$name.json: " || fail "$name.json is not complained about"
done
expect 0 ask --contact-model table
[ "$(field restitution)" = "$first" ] || fail "e = $(field restitution), not $first"
stop_daemon

say "a folder that is not there: served by the shipped tables, or without any"
settings "tables: nowhere"
start_daemon
logged 'nowhere: cannot be read' || fail "no warning"
expect 0 ask
[ "$(field restitution)" = "$first" ] || fail "e = $(field restitution), not $first"
stop_daemon
settings "tables: nowhere" "tables_alone: true"
start_daemon
logged 'nowhere: cannot be read' || fail "no warning"
expect 0 ask
[ "$(field contact_model)" = closed-form ] || fail "model $(field contact_model)"
stop_daemon

# one of many seconds: the others must be seen to be served before it ends. Fifteen times as many under the thread
# sanitizer, on a machine that is not idle
patience=100
! is_sanitized || patience=1000
say "a table that is not there: computed in the long lane, with progress, others are served meanwhile"
settings "tables: $work/tables"
start_daemon
strike() { # strike DEADLINE
    cat >"$work/request.json" <<JSON
{"bodies": [{"id": "glass-sphere", "position": [0.51, 0, 0], "velocity": [-0.3, 0, 0]},
            {"id": "al-rod-1", "position": [0, 0, 0]}],
 "contacts": [{"a": 0, "b": 1, "point": [0.5, 0, 0], "normal": [1, 0, 0]}],
 "options": {"contact_model": "table", "deadline": $1}}
JSON
}
strike 0.3
expect 4 percuss query --request "$work/request.json" --timeout 60
says 'of the contact table computed'
strike $patience
percuss query --request "$work/request.json" --timeout $patience --json >"$work/slow" 2>>"$err" 9>&- &
slow=$!
others=$slow
computes() {
    percuss status 2>/dev/null | grep -q 'computing a contact table'
}
wait_for 30 computes || fail "the status does not tell of the computation"
expect 0 ask
kill -0 "$slow" || fail "the slow one did not wait"
wait "$slow" || fail "the slow one ended with $?"
others=
[ "$(field contact_model "$work/slow")" = table ] || fail "model $(field contact_model "$work/slow")"
[ "$(ls "$work/tables" | grep -c '^[0-9a-f]*\.json$')" -eq 3 ] || fail "not kept in the folder"

say "from then on it is there for who asks for a table; auto stays as it was until the next start"
expect 0 percuss query --request "$work/request.json" --json
[ "$(field restitution)" = "$(field restitution "$work/slow")" ] || fail "e = $(field restitution)"
auto() {
    expect 0 percuss query --a glass-sphere --b al-rod-1 --speed 1.2 --json
    shows "elastic-plastic contact by $1"
}
auto 'the family of tables'
stop_daemon
start_daemon
logged 'tables: 3 from' || fail "not three tables"
auto 'a table'
expect 0 percuss query --request "$work/request.json" --json
[ "$(field restitution)" = "$(field restitution "$work/slow")" ] || fail "e = $(field restitution)"

say "a material of the request's own makes no table: clients cannot fill the folder"
for yield in 190e6 191e6 192e6; do
    sed 's/"id": "al-rod-1"/&, "overrides": {"yield": '$yield'}/' "$work/request.json" >"$work/own.json"
    grep -q overrides "$work/own.json" || fail "no override"
    expect 5 percuss query --request "$work/own.json"
    says 'there is no table for'
done
[ "$(ls "$work/tables" | grep -c '^[0-9a-f]*\.json$')" -eq 3 ] || fail "$(ls "$work/tables")"

say "no table of an elliptic contact"
sed -i 's/^  al-beam:.*material: aluminium/  al-beam: {shape: beam, material: al-205/' "$work/catalogue.yaml"
kill -HUP "$daemon"
wait_for 10 logged 'reload: ' || fail "no reload"
expect 5 query --contact-model table
says 'elliptic'
stop_daemon
