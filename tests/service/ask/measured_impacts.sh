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
expect 0 percuss compare "$data/synthetic-beam.csv" $pair --json --plot "$work/compare.png"
[ "$(od -An -tx1 -N8 "$work/compare.png" | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "no PNG"
[ "$(wc -c <"$work/compare.png")" -gt 20000 ] || fail "an empty picture"
[ "$(grep -c '"simulated": {' "$out")" -eq 54 ] || fail "not 53 twins"
awk '/"kolmogorov_smirnov"/ { found = 1 } found && /"p":/ { exit !($2 + 0 > 0.05) }' "$out" ||
    fail "the same beam's distributions are told apart"
expect 0 percuss compare "$data/synthetic-beam.csv" $pair --csv
[ "$(wc -l <"$out")" -eq 54 ] || fail "not 53 lines"

say "histories of the sphere's velocity"
expect 0 percuss compare "$data/synthetic-histories.csv" $pair --csv
[ "$(wc -l <"$out")" -eq 4 ] || fail "not three impacts"
# the first sub-impact is not chaotic: impulse and duration as simulated, but for the modulus
awk -F, 'NR > 1 { i = $6 / $12 - 1; d = $7 / $13 - 1; bad += i * i > 1e-4 || d * d > 1e-2 }
    END { exit bad }' "$out" || fail "the first sub-impacts differ"

say "measurements laid over pictures"
expect 0 percuss query $pair --speed 0.276 --measured "$data/synthetic-history-1.csv" --plot "$work/over.svg"
grep -q history-1.csv "$work/over.svg" || fail "no measured history in the picture"
expect 0 percuss sweep $pair --speed 0.1:0.4:7 --measured "$data/synthetic-beam.csv" --plot "$work/points.svg"
grep -q beam.csv "$work/points.svg" || fail "no measured points in the picture"
expect 2 percuss query $pair --speed 0.276 --measured "$data/synthetic-history-1.csv"
says "--plot FILE is needed"
expect 2 percuss query $pair --speed 0.276 --measured "$data/synthetic-beam.csv" --plot "$work/over.svg"
says "column 'time': missing"

say "Young's modulus within its interval, damping not determined"
expect 0 percuss calibrate "$data/synthetic-beam.csv" $pair --fit young:al-beam --json
low=$(field low)
high=$(field high)
awk -v l="$low" -v h="$high" 'BEGIN { exit !(l < 72.5e9 && h > 72.5e9 && h - l < 2e9) }' ||
    fail "the interval is $low to $high"
expect 1 percuss calibrate "$data/synthetic-beam.csv" $pair --fit damping:al-beam
says "do not determine the damping of al-beam"

say "bad files and questions"
printf 'speed,restitution\n0.2,0.7\n0.3,x\n' >"$work/bad.csv"
expect 2 percuss compare "$work/bad.csv" $pair
says "bad.csv:3: restitution: 'x': must be a finite number"
printf 'speed,restitution,sub_impacts\n0.2,0.7,2\n0.3,0.24,2\n' >"$work/few.csv"
expect 2 percuss calibrate "$work/few.csv" $pair --fit young:al-beam
says "chaotic and calibrates nothing"
expect 2 percuss calibrate "$data/synthetic-beam.csv" $pair --fit yield:al-beam
says "give --fit yield:al-beam=START"
expect 2 percuss calibrate "$data/synthetic-beam.csv" $pair --fit young:al-rod
says "neither --a nor --b"

say "rigs as they are: the restitution that made a file lies in the interval that is told of each impact"
cat >"$work/holds.py" <<'END'
import json, re, sys
reply, file, least = json.load(open(sys.argv[1])), sys.argv[2], int(sys.argv[3])
truth = float(re.match(r"# synthetic: restitution ([0-9.]+);", open(file).read())[1])
off = [(one["measured"]["restitution"] - truth, one["restitution_half_width"]) for one in reply["impacts"]]
assert len(off) == least and all(abs(error) <= half for error, half in off), off
# and is no idle one
assert all(half < 0.01 for _, half in off), off
END
# rig NAME IMPACTS BODY OPTION...
rig() {
    name=$1
    impacts=$2
    body=$3
    shift 3
    expect 0 percuss compare "$data/synthetic-$name.csv" --a steel-sphere --b "$body" --json "$@"
    python3 "$work/holds.py" "$out" "$data/synthetic-$name.csv" "$impacts" || fail "not the truth: $name"
}
camera="--column time=frame:frame --column displacement_a=y:px"
rig heights 5 steel-wall --uncertainty drop=1mm --uncertainty rebound=2mm
rig microphone 7 steel-wall --uncertainty bounce=0.04ms --uncertainty drop=0.1mm
# words
# shellcheck disable=SC2086
{
    rig camera 3 steel-wall $camera --scale 0.12mm --rate 240
    rig camera 3 steel-wall $camera --scale 0.12mm --rate 240 --gravity 1g
    rig camera 3 steel-wall --column displacement_a=y --scale 0.12mm --rate 240
}
rig accelerometers 1 steel-wall
rig targets 1 steel-sphere
expect 0 percuss compare "$data/synthetic-heights.csv" --a steel-sphere --b steel-wall --json
cp "$out" "$work/heights.json"
expect 0 percuss compare "$data/synthetic-heights.csv" --a steel-sphere --b steel-wall --json --scale 0.12mm
cmp "$out" "$work/heights.json" || fail "heights are taken for pixels"
[ "$(grep -c '"restitution_half_width": null' "$out")" -eq 5 ] || fail "an interval of which nothing is known"

say "and what does not fit is refused with what it would be"
# unfit TEXT FILE OPTION...
unfit() {
    text=$1
    file=$2
    shift 2
    expect 2 percuss compare "$file" --a steel-sphere --b steel-wall "$@"
    says "$text"
}
# shellcheck disable=SC2086
{
    unfit "changes its velocity by 10.6" "$data/synthetic-camera.csv" $camera --scale 0.13mm --rate 240 --gravity 1g
    says "where gravity is 9.807 m/s^2: are its unit, --scale and --rate right?"
    unfit "time: 'frame': --rate F, frames a second, is needed" "$data/synthetic-camera.csv" $camera --scale 0.12mm
    unfit "displacement_a: 'px': --scale LENGTH, that of a pixel, is needed" "$data/synthetic-camera.csv" $camera --rate 240
}
unfit "tells no speed of A" "$data/synthetic-target.csv"
unfit "the motion of steel-wall does not tell the impulse, because it vibrates or is held" "$data/synthetic-targets.csv"
sed 5d "$data/synthetic-microphone.csv" >"$work/missing.csv"
unfit "A rises higher than it fell: is a touch missing?" "$work/missing.csv"
printf 'drop [mm],rebound [mm]\n300,301\n' >"$work/high.csv"
unfit "high.csv:2: rebound: 0.301 m: must be at most the 0.3 m that A fell" "$work/high.csv"
printf 'drop,speed,rebound\n0.3,1,0.1\n' >"$work/both.csv"
unfit "both.csv:2: drop: must be absent beside speed: both say the same" "$work/both.csv"
printf 'bounce,restitution\n0,1\n1,1\n2,1\n' >"$work/beside.csv"
unfit "column 'restitution': must be absent beside 'bounce', but for 'drop'" "$work/beside.csv"
# an accelerometer that has recorded the next bounce as well
awk 'BEGIN { print "time,acceleration_a"
    for (i = 0; i < 30000; i++) { t = i * 1e-5; p = t - 0.005; q = t - 0.205; a = sin(i * i)
        if (p > 0 && p < 3e-4) a += 1.981 * 3.14159 / 6e-4 * sin(3.14159 * p / 3e-4)
        if (q > 0 && q < 3e-4) a += 1.5 * 3.14159 / 6e-4 * sin(3.14159 * q / 3e-4); print t "," a } }' >"$work/twice.csv"
printf 'speed,history\n1,twice.csv\n' >"$work/bounced.csv"
unfit "a contact 0.2 s after another, when gravity brings A back: cut it off before" "$work/bounced.csv"
unfit "'colour=1mm': NAME=VALUE is needed, of a column of impacts" "$work/high.csv" --uncertainty colour=1mm

say "a drop instead of a speed"
expect 0 percuss query --a steel-sphere --b al-rod-1 --drop 300mm --json
cp "$out" "$work/dropped.json"
expect 0 percuss query --a steel-sphere --b al-rod-1 --speed 2.4256937152080846 --json
[ "$(grep '"restitution":' "$out")" = "$(grep '"restitution":' "$work/dropped.json")" ] || fail "not that of the fall"
expect 0 percuss sweep --a steel-sphere --b al-rod-1 --drop 0.05:0.2:2 --gravity 10 --csv
[ "$(cut -d, -f 1 "$out" | tail -n +2 | tr '\n' ' ')" = "1 2 " ] || fail "not the speeds of the falls: $(cat "$out")"

stop_daemon
