#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A catalogue with slips of units, which are possible numbers: told before a start and by the daemon's own
# bodies.
. "$(dirname "$0")/../support/lib.sh"

cat >"$work/catalogue.yaml" <<'END'
materials:
  steel: {young: 210 GPa, poisson: 0.3, density: 7.8}
  brass: {young: 100e3, poisson: 0.34, density: 8500}
  lead: {young: 16 MPa, poisson: 0.44, density: 11340}
  rubber: {young: 16 MPa, poisson: 0.45, density: 1200, loss_factor: 0.1}
bodies:
  ball: {shape: sphere, material: steel, radius: 8}
  pin: {shape: rod, material: brass, radius: 8 mm, length: 30 mm}
  bar: {shape: rod, material: brass, radius: 8 mm, length: 30}
  wall: {shape: half-space, material: steel}
  sinker: {shape: sphere, material: lead, radius: 8 mm}
  bumper: {shape: sphere, material: rubber, radius: 8 mm}
END
remarks='materials.steel.density: 7.8 kg/m^3: below 100 kg/m^3
materials.brass.young: 100000 Pa: below 1e+06 Pa
materials.lead.young: 1.6e+07 Pa: below 1e+09 Pa: softer than what has this density: is GPa meant?
bodies.ball.size: 16 m: more than 2 m
bodies.pin.length: 0.03 m: shorter than four radii (of 0.008 m)
bodies.bar.length: 30 m: more than 1000 radii (of 0.008 m)'

say "--check-config warns of them, each once, and says that a start would succeed"
expect 0 "$bin/percussd" --config "$work/percussd.yaml" --check-config
shows "ok"
echo "$remarks" | while read -r remark; do
    says "percussd: warning: $remark"
done
[ "$(wc -l <"$err")" -eq 6 ] || fail "other warnings"

say "rubber without a loss is named, which is no warning"
sed -i 's/, loss_factor: 0.1}/}/' "$work/catalogue.yaml"
expect 0 "$bin/percussd" --config "$work/percussd.yaml" --check-config
says "percussd: materials.rubber.loss_factor: not stated: its contacts lose nothing by it"
[ "$(wc -l <"$err")" -eq 7 ] || fail "other lines"
expect 1 "$bin/percuss" bodies --local --catalogue "$work/catalogue.yaml" --check
shows "materials.rubber.loss_factor: not stated: its contacts lose nothing by it"
sed -i 's/density: 1200}/density: 1200, loss_factor: 0}/' "$work/catalogue.yaml"

say "so does percuss bodies --check of a daemon that runs"
start_daemon
expect 1 percuss bodies --check
echo "$remarks" | while read -r remark; do
    shows "$remark"
done
[ "$(wc -l <"$out")" -eq 6 ] || fail "other remarks"
[ ! -s "$err" ] || fail "it says something on stderr"
expect 1 percuss bodies --check --json
shows '"bodies": 6'
[ "$(grep -c '"text":' "$out")" -eq 6 ] || fail "other remarks in JSON"
shows '"key": "density"'

say "and of the shipped bodies nothing"
cp "$source_dir/config/catalogue.yaml" "$work/catalogue.yaml"
kill -HUP "$daemon"
wait_for 10 logged 'reload: [0-9]* bodies'
expect 0 percuss bodies --check
shows "bodies: nothing improbable"
[ "$(grep -c '^materials.*yield: not stated' "$out")" -eq 3 ] || fail "other metals that state no yield"
shows "materials.steel.yield: not stated: it stays elastic in every contact; a metal yields (mostly at 210 to 2100 MPa)"
! grep -q "glass" "$out" || fail "glass states that it has none"
expect 0 percuss bodies --check --json
[ "$(grep -c '"key": "yield"' "$out")" -eq 3 ] && [ "$(grep -c '"key":' "$out")" -eq 3 ] || fail "other remarks"
stop_daemon

say "files that a daemon writes later are looked at too, but stop no start"
settings "metrics: nowhere/percuss.prom" "store: dents.db" "backup: nowhere/dents.db"
expect 0 "$bin/percussd" --config "$work/percussd.yaml" --check-config
says "percussd: warning: metrics: $work/nowhere/percuss.prom: cannot be made: No such file or directory"
says "percussd: warning: backup: $work/nowhere/dents.db: cannot be made: No such file or directory"
mkdir "$work/nowhere"
expect 0 "$bin/percussd" --config "$work/percussd.yaml" --check-config
! grep -v "yield: not stated" "$err" || fail "it says something else on stderr"
