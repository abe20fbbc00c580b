#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Precomputed contact tables: found beside the settings, chosen, left out when damaged.
. "$(dirname "$0")/lib.sh"

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
awk -v e="$first" 'BEGIN { exit !(e > 0.49 && e < 0.51) }' || fail "e = $first"
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

say "auto without a table takes the closed form and says so"
expect 0 percuss query --a glass-sphere --b al-rod-1 --speed 0.3 --json
[ "$(field contact_model)" = closed-form ] || fail "model $(field contact_model)"
shows 'no table for these bodies'
stop_daemon

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

say "a folder that is not there: served without tables"
settings "tables: nowhere"
start_daemon
logged 'nowhere: cannot be read' || fail "no warning"
expect 0 ask
[ "$(field contact_model)" = closed-form ] || fail "model $(field contact_model)"
stop_daemon
