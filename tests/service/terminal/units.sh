#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A user types numbers as his instruments show them.
. "$(dirname "$0")/../support/lib.sh"
start_daemon
pair="--a steel-sphere --b al-beam"

# same OPTION=VALUE WITH-UNITS COMMAND...: the same answer to the byte, but for what differs from asking to asking
same() {
    plain=$1
    typed=$2
    shift 2
    expect 0 percuss "$@" "$plain"
    # neither who asks nor how long it took
    numbers "$out" >"$work/plain"
    expect 0 percuss "$@" "$typed"
    numbers "$out" | cmp -s - "$work/plain" || fail "$typed is not $plain"
}

# refused TEXT ARGUMENT...: before any server is asked
refused() {
    text=$1
    shift
    expect 2 "$bin/percuss" "$@"
    says "$text"
}

say "speeds and times, of every command that takes them"
# words
# shellcheck disable=SC2086
{
    same --speed=0.3 --speed=300mm/s query $pair --json
    same --speed=0.3 "--speed=30 cm/s" query $pair --json
    same --speed=0.009 --speed=9mm/s query $pair --json
    same --speed=0.25 "--speed=0.9 km/h" query $pair --json
    same --at=0.25 --at=250mm query $pair --speed 0.3 --json
    same --at=0.25 --at=25% query $pair --speed 0.3 --json
    same --at=0.25 "--at=25 %" query $pair --speed 0.3 --json
    same --at=0.5 --at=middle query $pair --speed 0.3 --json
    same --at=1 --at=1m query $pair --speed 0.3 --json
    same --horizon=0.02 --horizon=20ms query $pair --speed 0.3 --json
    same --speed-sigma=0.01 --speed-sigma=10mm/s query $pair --speed 0.3
    same --timeout=60 --timeout=1min query $pair --speed 0.3 --json
    same --speed=0.2:0.5:4 "--speed=0.2 m/s:0.5 m/s:4" sweep $pair --csv
    same --speed=0.2:0.5:4 --speed=200mm/s:0.5:4 sweep $pair --csv
    same --speed=uniform:0.1:0.4 --speed=uniform:100mm/s:400mm/s ensemble $pair --samples 32 --json
    same --deadline=50 --deadline=50000ms ensemble $pair --speed uniform:0.1:0.4 --samples 32 --json
    same --timeout=50 --timeout=50s ensemble $pair --speed uniform:0.1:0.4 --samples 32 --json
}

say "speeds of a sweep with equal ratios, and those of a file"
# shellcheck disable=SC2086
{
    expect 0 percuss sweep $pair --speed 0.03:3:5:log --csv
    [ "$(cut -d, -f 1 "$out" | tail -n +2 | awk '{ printf "%.5g ", $1 }')" = "0.03 0.094868 0.3 0.94868 3 " ] ||
        fail "no equal ratios"
    cp "$out" "$work/log.csv"
    expect 0 percuss sweep $pair --speeds "$work/log.csv" --csv
    cmp "$work/log.csv" "$out" || fail "the file's speeds are others"
    printf 'rig 7\n no;v [mph]\n1;2\n2;\n3;0,5\n' >"$work/rig.csv"
    expect 0 percuss sweep $pair --speeds "$work/rig.csv" --column speed=v --csv
    says "rig.csv: 1 of 3 rows left out: no speed in line 4"
    [ "$(cut -d, -f 1 "$out" | tail -n +2 | awk '{ printf "%.6g ", $1 }')" = "0.89408 0.22352 " ] || fail "not the speeds"
    refused "--speed or --speeds, not both" sweep $pair --speed 1:2:3 --speeds "$work/rig.csv" --column speed=v
    refused "rig.csv:1: column 'speed': missing" sweep $pair --speeds "$work/rig.csv"
    refused "--measured FILE or --speeds FILE is needed" sweep $pair --speed 1:2:3 --column speed=v
    refused "--speed: '1:2:3:lin' is not LO:HI:N" sweep $pair --speed 1:2:3:lin
}

say "a table has the total error of the restitution, which the models make"
# shellcheck disable=SC2086
{
    percuss query $pair --speed 0.3 --json >"$work/reply.json" 2>"$err"
    percuss query $pair --speed 0.3 --csv >"$work/query.csv" 2>"$err"
    percuss sweep $pair --speed 0.3:0.3:1 --csv >"$work/sweep.csv" 2>"$err"
    percuss sweep $pair --speed 0.3:0.3:1 >"$work/sweep.txt" 2>"$err"
}
python3 - "$work" <<'END' || fail "not the total error"
import csv, json, sys
reply = json.load(open(f"{sys.argv[1]}/reply.json"))
total, time, modes = (reply["error"][f"restitution_{name}"] for name in ("total", "time", "modes"))
for name in "query", "sweep":
    row = next(csv.DictReader(open(f"{sys.argv[1]}/{name}.csv")))
    assert float(row["error_total"]) == total and float(row["error"]) == abs(time) + abs(modes), row
# twenty times and more: the aluminium states no yield
assert total > 20 * (abs(time) + abs(modes))
assert float(open(f"{sys.argv[1]}/sweep.txt").read().splitlines()[1].split()[2]) == float(f"{total:.1e}")
END

# shellcheck disable=SC2086
expect 2 percuss query $pair --speed 0.3 --at 1.2m
says "--at: 1.2 m from its end is beyond al-beam, which is 1 m long"

say "the tip and the root of a beam that is held at one end, whichever that is"
cat >"$work/held.yaml" <<'END'
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7800}
bodies:
  ball: {shape: sphere, material: steel, diameter: 16 mm}
  ahead: {shape: beam, material: steel, diameter: 10 mm, length: 0.4, ends: cantilever}
  behind: {shape: beam, material: steel, diameter: 10 mm, length: 0.4, ends: free-pinned}
  held: {shape: beam, material: steel, diameter: 10 mm, length: 0.4, ends: clamped-pinned}
END
local="--local --catalogue $work/held.yaml --a ball --speed 0.3"
# at BODY PLACE: where the contact is along x
at() {
    # shellcheck disable=SC2086
    "$bin/percuss" query $local --b "$1" --at "$2" 2>/dev/null | sed -n 's/^  impact  *0.3 m.s, //p'
}
[ "$(at ahead tip)" = "at the free end of ahead at +x" ] || fail "$(at ahead tip)"
[ "$(at ahead root)" = "at the clamped end of ahead at -x" ] || fail "$(at ahead root)"
[ "$(at behind tip)" = "at the free end of behind at -x" ] || fail "$(at behind tip)"
[ "$(at behind root)" = "at the pinned end of behind at +x" ] || fail "$(at behind root)"
# shellcheck disable=SC2086
{
    same --at=1 --at=tip query $local --b ahead --json
    same --at=0 --at=tip query $local --b behind --json
    expect 2 "$bin/percuss" query $local --b held --at tip
    says "--at: tip: the ends of held are clamped and pinned, so that it has no tip and no root: --at 0 is its end"
    expect 2 "$bin/percuss" query $local --b held --at top
    says "--at: 'top': a fraction of the length"
}

say "the answer says what was asked: speed, place, ends and materials, and which place nobody chose"
# shellcheck disable=SC2086
expect 0 percuss query $pair --speed 300mm/s
shows "  impact       0.3 m/s, in the middle of al-beam (default; --at S)"
shows "  bodies       steel-sphere of steel; al-beam of aluminium, ends free and free"
# shellcheck disable=SC2086
expect 0 percuss query $pair --speed 300mm/s --at 40%
shows "  impact       0.3 m/s, at 40 % of the length of al-beam"
cat >"$work/turning.json" <<'END'
{"bodies": [{"id": "steel-sphere", "position": [0.1, 0, 0.025], "velocity": [0, 0, -0.3]},
            {"id": "al-beam", "position": [0, 0, 0], "angular_velocity": [0, -1, 0]}],
 "contacts": [{"a": 0, "b": 1, "point": [0.1, 0, 0.010], "normal": [0, 0, 1]}]}
END
expect 0 percuss query --request "$work/turning.json"
shows "  impact       0.4 m/s at (0.1, 0, 0.01) m"

say "uncertain moduli, lengths and densities; where a calibration starts"
for inputs in "young@al-beam=normal:70e9:1e9 young@al-beam=normal:70GPa:1GPa" \
    "young@al-beam=normal:70e9:1e9 young:al-beam=normal:70GPa:1GPa" \
    "site@al-beam=uniform:0.4:0.6 at:al-beam=uniform:0.4:0.6" \
    "density@al-beam=uniform:2650:2750 density@al-beam=uniform:2.65g/cm^3:2.75g/cm^3" \
    "radius@steel-sphere=0.0149 radius@steel-sphere=14.9mm"; do
    # shellcheck disable=SC2086
    same "--input=${inputs% *}" "--input=${inputs#* }" ensemble $pair --speed 0.2 --samples 32 --json
done
beam=$source_dir/client/examples/measured/synthetic-beam.csv
# the data are the document's; whether they determine it is not asked here
for start in 69e9 69GPa; do
    # shellcheck disable=SC2086
    percuss calibrate "$beam" $pair --fit "young:al-beam=$start" --json >"$work/$start" 2>"$err" || [ $? -eq 1 ] ||
        fail "calibrate from $start"
done
cmp -s "$work/69e9" "$work/69GPa" || fail "another calibration"
# shellcheck disable=SC2086
percuss calibrate "$beam" $pair --fit young@al-beam=69GPa --json >"$work/at" 2>"$err" || [ $? -eq 1 ] || fail "with an @"
cmp -s "$work/69e9" "$work/at" || fail "another calibration with an @"
grep -q '"start": 69000000000' "$work/69GPa" || fail "it does not start there"

say "seconds between two looks"
timeout 20 "$bin/percuss" status --domain "$domain" --watch=100ms >"$out" 2>"$err" 9>&- &
others=$!
# s: two looks, on a busy machine
two_looks() {
    [ "$(grep -c '^rate ' "$out")" -ge 2 ]
}
wait_for 20 two_looks || fail "it does not look again"
kill "$others"
wait "$others" 2>/dev/null || true
others=
stop_daemon

say "what does not fit is refused with the option, the value and what is allowed"
# shellcheck disable=SC2086
{
    refused "--speed: '8 kg': a speed is needed, in m/s or with a unit, such as 300 mm/s; kg is no speed" \
        query $pair --speed "8 kg"
    refused "--speed: '300 mms': a speed is needed, in m/s or with a unit, such as 300 mm/s; mms is no unit that is" \
        query $pair --speed "300 mms"
    refused "--speed: '0': a speed > 0 is needed" query $pair --speed 0
    refused "--speed: '-3mm/s': a speed > 0 is needed" query $pair --speed=-3mm/s
    refused "--horizon: '20mm': a time is needed, in s or with a unit, such as 20 ms; mm is no time" \
        query $pair --speed 0.3 --horizon 20mm
    refused "--timeout: '1 Hz': a time is needed, in s or with a unit, such as 20 ms; Hz is no time" \
        query $pair --speed 0.3 --timeout "1 Hz"
    refused "--at: '0.2 s': a fraction of the length, 0..1, or a length from the end at -x, such as 250mm, is needed" \
        query $pair --speed 0.3 --at "0.2 s"
    refused "--at: '1.5': a fraction of the length" query $pair --speed 0.3 --at 1.5
    refused "--at: '-1mm': a fraction of the length" query $pair --speed 0.3 --at=-1mm
    refused "--tolerance: '1 mm': a number is needed, without a unit" query $pair --speed 0.3 --tolerance "1 mm"
    refused "--speed: '0.1:0.4m:31': LO:HI:N: a speed is needed, in m/s or with a unit, such as 300 mm/s; m is no" \
        sweep $pair --speed 0.1:0.4m:31
    refused "--speed: '100:400mm/s:31': 0 < LO <= HI is needed, here 100 to 0.4 m/s" \
        sweep $pair --speed 100:400mm/s:31
    refused "--speed: '0.1:0.4:31mm/s' is not LO:HI:N" sweep $pair --speed 0.1:0.4:31mm/s
    refused "--speed: 'uniform:0.1:4 s' is not uniform:LOWEST:HIGHEST: a speed is needed" \
        ensemble $pair --speed "uniform:0.1:4 s"
    refused "DEVIATION:LOWEST:HIGHEST: a stress is needed, in Pa or with a unit, such as 70 GPa; mm is no stress" \
        ensemble $pair --speed 0.2 --input young@al-beam=normal:70GPa:1mm
    refused "--input: 'youngs@al-beam=70GPa': 'youngs' is none of speed, direction, model-force, " \
        ensemble $pair --speed 0.2 --input youngs@al-beam=70GPa
    says ": did you mean 'young'?"
    refused "--input: 'al-baem' is neither --a nor --b: did you mean 'al-beam'?" \
        ensemble $pair --speed 0.2 --input young@al-baem=70GPa
    refused "tangent, damping, radius or scale: did you mean 'young'?" calibrate "$beam" $pair --fit yong:al-beam
    refused "--fit: 'al-bem' is neither --a nor --b: did you mean 'al-beam'?" \
        calibrate "$beam" $pair --fit young:al-bem
    refused "--fit: 'young': a body is needed: young:ID" calibrate "$beam" $pair --fit young
    refused "--fit: 'young:al-beam=69mm': START: a stress is needed, in Pa or with a unit, such as 70 GPa; mm is no" \
        calibrate "$beam" $pair --fit young:al-beam=69mm
}
refused "--watch: '10ms': 0.1 to 86400 s are allowed" status --watch=10ms

say "percuss-tables, percuss-reduce and the bridge read them in the same way"
expect 2 "$bin/percuss-tables" --catalogue "$work/catalogue.yaml" --folder "$work" --speed 3mm
says "--speed: 3mm: must be a speed, 0.001 to 1000 m/s, or with a unit, such as 300 mm/s"
# far too fast for it: the unit was read
expect 2 "$bin/percuss-tables" --catalogue "$work/catalogue.yaml" --folder "$work" --speed 3mm/us
says "--speed: 3mm/us: must be a speed"
expect 2 "$bin/percuss-reduce" body.msh -o body.h5 --progress 2d
says "--progress: 2d: must be a time, 0.1 to 86400 s, or with a unit, such as 20 ms"
expect 2 "$bin/percuss-reduce" body.msh -o body.h5 --unit mm --size 2kg
says "--size: 2kg: must be a number, 1e-09 to 1e+09, in the unit of the mesh, or a length with its own, such as 8mm"
for site in 1,2 1,2,3,4 1,2kg,3 1,,3; do
    expect 2 "$bin/percuss-reduce" body.msh -o body.h5 --site "$site"
    says "--site: $site: must be three numbers, X,Y,Z, in the unit of the mesh or with their own, such as 8mm"
done
# off the surface of a block by as much, in whatever unit that is said; the unit of the mesh may come last
. "$support/block_deck.sh"
block 4 1 1 >"$work/block.inp"
for site in 10,2.5,9 10mm,0.25cm,9 "10 mm,2.5 mm,0.009 m"; do
    expect 1 "$bin/percuss-reduce" "$work/block.inp" -o "$work/block.h5" --young 210GPa --poisson 0.3 \
        --density 7.8g/cm^3 --site "$site" --unit mm
    says "--site: 10,2.5,9: is 4 mm off the surface"
done
expect 2 "$bin/percuss-ros2" --timeout 1mm
says "--timeout: '1mm': a time > 0 is needed, in s or with a unit, such as 20 ms"
