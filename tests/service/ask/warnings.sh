#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# What a query warns of is not lost where many impacts are asked for: counted, each kind once.
. "$(dirname "$0")/../support/lib.sh"

pair="--a steel-sphere --b al-beam"
settings "workers: 1"
start_daemon

# once TEXT FILE: in exactly one line
once() {
    [ "$(grep -cF -- "$1" "$2")" -eq 1 ] || fail "'$1' in $(grep -cF -- "$1" "$2") lines, not one"
}

say "200 m/s on an elastic beam: a query says what is wrong with it"
expect 0 percuss query $pair --speed 200
says "is more than 1 % of the wave speed in al-beam"

say "so does a sweep, with how many points"
expect 0 percuss sweep $pair --speed 1:200:5
once "points: 3 of 5, first at 100.5 m/s: contacts[0]: the approach at 100 m/s is more than 1 % of the wave speed in al-beam" "$err"
expect 0 percuss sweep $pair --speed 1:200:5 --csv
once "wave speed in al-beam" "$err"
expect 0 percuss sweep $pair --speed 1:200:5 --json
sed -n '/^  "warnings": \[/,/^  \]/p' "$out" >"$work/list"
once "wave speed in al-beam" "$work/list"
[ ! -s "$err" ] || fail "twice"
expect 0 percuss sweep $pair --b al-rod --speed 0.3:60:2
once "points: 1 of 4, first of al-rod, auto, at 60 m/s: contacts[0]: the approach at 60 m/s is more than 1 % of the wave speed in al-rod" "$err"

say "and a comparison"
printf 'speed,restitution\n0.2,0.7\n100,0.5\n150,0.3\n' >"$work/fast.csv"
expect 0 percuss compare "$work/fast.csv" $pair
once "twins: 2 of 3, first impact 2: contacts[0]: the approach at 100 m/s is more than 1 % of the wave speed in al-beam" "$err"
expect 0 percuss compare "$work/fast.csv" $pair --json
once "wave speed in al-beam" "$out"
# how the file was understood is said there, as of every file
! grep -v "fast.csv:4: speed: 150: above 100" "$err" || fail "twice"

say "and a calibration, of its result"
{
    echo "speed,restitution,sub_impacts,first_impulse"
    percuss sweep --a steel-sphere --b al-rod --speed 55:70:6 --csv |
        awk -F, 'NR > 1 { printf "%s,%s,1,%s\n", $1, $2, $4 * 1.01 }'
} >"$work/impulses.csv"
code=0
percuss calibrate "$work/impulses.csv" --a steel-sphere --b al-rod --fit density:al-rod >"$out" 2>"$err" || code=$?
[ "$code" -le 1 ] || fail "exit code $code"
once "twins: 6 of 6, first impact 1: contacts[0]: the approach at 55 m/s is more than 1 % of the wave speed in al-rod" "$err"
percuss calibrate "$work/impulses.csv" --a steel-sphere --b al-rod --fit density:al-rod --json >"$out" 2>"$err" || code=$?
once "wave speed in al-rod" "$out"

say "and an ensemble"
expect 0 percuss ensemble $pair --speed uniform:10:200 --samples 100 --tolerance 0.01
grep -q 'samples: [0-9]* of 100, first [0-9]*: contacts\[0\]: the approach at .* wave speed in al-beam' "$err" ||
    fail "not said"
once "wave speed in al-beam" "$err"
expect 0 percuss ensemble $pair --speed uniform:10:200 --samples 100 --tolerance 0.01 --json
sed -n '/^  "warnings": \[/,/^  \]/p' "$out" >"$work/one-worker"
once "wave speed in al-beam" "$work/one-worker"
[ ! -s "$err" ] || fail "twice"

say "sliding at 45 degrees is not answered without a word"
cat >"$work/oblique.json" <<'JSON'
{"bodies": [{"id": "steel-sphere", "position": [0, 0, 0.025], "velocity": [0.3, 0, -0.3]},
            {"id": "al-beam"}],
 "contacts": [{"a": 0, "b": 1, "point": [0, 0, 0.010], "normal": [0, 0, 1]}]}
JSON
expect 0 percuss query --request "$work/oblique.json"
says "contacts[0]: the bodies slide there at 0.3 m/s, 1 times the approach: without a coefficient of friction"
sed 's/\[0.3, 0, -0.3\]/[0.3, 0, -0.3], "angular_velocity": [0, 20, 0]/' "$work/oblique.json" >"$work/rolling.json"
expect 0 percuss query --request "$work/rolling.json"
! grep -q slide "$err" || fail "rolling taken for sliding"
expect 0 percuss ensemble $pair --speed uniform:0.1:0.4 --input direction=normal:0:0.1 --samples 100
once "the bodies slide there" "$err"
expect 0 percuss query $pair --speed 0.3
once "no yield (or none) is stated of steel (steel-sphere) and aluminium (al-beam)" "$err"
[ "$(wc -l <"$err")" -eq 1 ] || fail "something else is said of an ordinary impact"
stop_daemon

say "four workers say the same"
settings "workers: 4"
start_daemon
expect 0 percuss ensemble $pair --speed uniform:10:200 --samples 100 --tolerance 0.01 --json
sed -n '/^  "warnings": \[/,/^  \]/p' "$out" >"$work/four-workers"
cmp -s "$work/one-worker" "$work/four-workers" || fail "other warnings"
stop_daemon
