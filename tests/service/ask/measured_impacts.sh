#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Measured impacts: compared with their twins, and Young's modulus found from them. The shipped set is
# synthetic: another model, 1 % noise, Young's modulus 72.5 GPa (the catalogue says 70).
. "$(dirname "$0")/../support/lib.sh"

start_daemon
data=$source_dir/client/examples/measured
pair="--a steel-sphere --b al-beam"

say "twins of measured impacts, and how different the distributions are"
expect 0 percuss compare "$data/beam.csv" $pair --json --plot "$work/compare.png"
[ "$(od -An -tx1 -N8 "$work/compare.png" | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "no PNG"
[ "$(wc -c <"$work/compare.png")" -gt 20000 ] || fail "an empty picture"
[ "$(grep -c '"simulated": {' "$out")" -eq 54 ] || fail "not 53 twins"
awk '/"kolmogorov_smirnov"/ { found = 1 } found && /"p":/ { exit !($2 + 0 > 0.05) }' "$out" ||
    fail "the same beam's distributions are told apart"
expect 0 percuss compare "$data/beam.csv" $pair --csv
[ "$(wc -l <"$out")" -eq 54 ] || fail "not 53 lines"

say "histories of the sphere's velocity"
expect 0 percuss compare "$data/histories.csv" $pair --csv
[ "$(wc -l <"$out")" -eq 4 ] || fail "not three impacts"
# the first sub-impact is not chaotic: impulse and duration as simulated, but for the modulus
awk -F, 'NR > 1 { i = $6 / $12 - 1; d = $7 / $13 - 1; bad += i * i > 1e-4 || d * d > 1e-2 }
    END { exit bad }' "$out" || fail "the first sub-impacts differ"

say "measurements laid over pictures"
expect 0 percuss query $pair --speed 0.276 --measured "$data/history-1.csv" --plot "$work/over.svg"
grep -q history-1.csv "$work/over.svg" || fail "no measured history in the picture"
expect 0 percuss sweep $pair --speed 0.1:0.4:7 --measured "$data/beam.csv" --plot "$work/points.svg"
grep -q beam.csv "$work/points.svg" || fail "no measured points in the picture"
expect 2 percuss query $pair --speed 0.276 --measured "$data/history-1.csv"
says "--plot FILE is needed"
expect 2 percuss query $pair --speed 0.276 --measured "$data/beam.csv" --plot "$work/over.svg"
says "column 'time': missing"

say "Young's modulus within its interval, damping not determined"
expect 0 percuss calibrate "$data/beam.csv" $pair --fit young:al-beam --json
low=$(field low)
high=$(field high)
awk -v l="$low" -v h="$high" 'BEGIN { exit !(l < 72.5e9 && h > 72.5e9 && h - l < 2e9) }' ||
    fail "the interval is $low to $high"
expect 1 percuss calibrate "$data/beam.csv" $pair --fit damping:al-beam
says "do not determine the damping of al-beam"

say "bad files and questions"
printf 'speed,restitution\n0.2,0.7\n0.3,x\n' >"$work/bad.csv"
expect 2 percuss compare "$work/bad.csv" $pair
says "bad.csv:3: restitution: 'x': must be a finite number"
printf 'speed,restitution,sub_impacts\n0.2,0.7,2\n0.3,0.24,2\n' >"$work/few.csv"
expect 2 percuss calibrate "$work/few.csv" $pair --fit young:al-beam
says "chaotic and calibrates nothing"
expect 2 percuss calibrate "$data/beam.csv" $pair --fit yield:al-beam
says "give --fit yield:al-beam=START"
expect 2 percuss calibrate "$data/beam.csv" $pair --fit young:al-rod
says "neither --a nor --b"

stop_daemon
