#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A body's file that is not there keeps nobody from the other bodies.
. "$(dirname "$0")/../support/lib.sh"

sed '/^bodies:/a\  plate: {shape: mesh, file: plate.h5, sites: {edge: {point: [0, 0, 0]}}}' \
    "$source_dir/config/catalogue.yaml" >"$work/catalogue.yaml"
cat >"$work/request.json" <<'JSON'
{"bodies": [{"id": "steel-sphere", "velocity": [0, 0, -0.2]}, {"id": "plate"}],
 "contacts": [{"a": 0, "b": 1, "point": [0, 0, 0], "normal": [0, 0, 1]}]}
JSON

say "--check-config refuses"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --check-config
says "catalogue.yaml:"
says "bodies.plate.file: $work/plate.h5: cannot be opened: No such file"
[ ! -s "$out" ] || fail "it says ok"

say "the daemon starts without it; log and requests say why"
start_daemon
logged "error *plate is left out: its file is missing: .*plate.h5" || fail "not in the log"
expect 0 query
expect 0 percuss query --a steel-sphere --b al-half-plate --speed 0.3
expect 5 percuss query --request "$work/request.json"
says "plate.h5: cannot be opened: No such file"
expect 0 percuss bodies
! grep -q '^plate' "$out" || fail "it is listed"

say "percuss-tables does without it"
cp -r "$source_dir/config/tables" "$work/tables"
tables() {
    "$bin/percuss-tables" --catalogue "$work/catalogue.yaml" --folder "$work/tables" --a steel-sphere "$@"
}
expect 0 tables --b al-rod-1
shows "is there"
expect 1 tables --b plate
says "plate: its file is missing"

say "once it is there SIGHUP takes it; a damaged one leaves the old catalogue"
echo damaged >"$work/plate.h5"
kill -HUP "$daemon"
refused() {
    logged "reload: .*bodies.plate.file.*the old catalogue stays"
}
wait_for 10 refused || fail "a damaged file is taken"
cp "$source_dir/config/bodies/half-plate-20.h5" "$work/plate.h5"
kill -HUP "$daemon"
loaded() {
    logged "reload: [0-9]* bodies"
}
wait_for 10 loaded || fail "not loaded"
expect 0 percuss query --a steel-sphere --b plate --at-b edge --speed 0.3
stop_daemon
