#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Pictures for a paper: as PDF, with their data and the script that draws them; legends beside what they explain,
# no words over each other, axes that hold everything.
. "$(dirname "$0")/../support/lib.sh"
for program in pdftotext gnuplot; do
    command -v "$program" >/dev/null || {
        echo "$program is not installed (sh deploy/dependencies.sh test): skipped"
        exit 77
    }
done
start_daemon
data=$source_dir/client/examples/measured
pair="--a steel-sphere --b al-beam"

# is_sound FOLDER PICTURE.pdf NAME...: what pictures.py says of it
is_sound() {
    folder=$1
    shift
    python3 "$support/pictures.py" data "$folder" >"$out" 2>&1 || fail "$folder: $(cat "$out")"
    [ "$(head -c 4 "$1")" = %PDF ] || fail "$1 is no PDF"
    python3 "$support/pictures.py" words "$@" >"$out" 2>&1 || fail "$1: $(cat "$out")"
}

# picture NAME WORDS COMMAND...: draws it as PDF, whose words (separated by |) and axes are looked at
picture() {
    name=$1
    words=$2
    shift 2
    expect 0 percuss "$@" --plot "$work/$name.pdf" --plot-data "$work/$name"
    (
        IFS='|'
        # words on purpose
        # shellcheck disable=SC2086
        is_sound "$work/$name" "$work/$name.pdf" $words
    )
}

say "one impact: its bodies, what was measured, the force"
picture impact "steel-sphere, synthetic-history-2.csv|al-beam|e = 0.3276, 3 sub-impacts|contact force / N" \
    query $pair --speed 0.287 --measured "$data/synthetic-history-2.csv"
head -n 1 "$work/impact/impact_1_1.csv" | grep -qx 'time,force,displacement_a,displacement_b,velocity_a,velocity_b' ||
    fail "the columns have other names"
# SI: the peak of the first blow is 310 N, 0.1 ms after the touch
awk -F, 'NR > 1 && $2 > f { f = $2; t = $1 } END { exit !(f > 300 && f < 320 && t > 5e-5 && t < 1e-4) }' \
    "$work/impact/impact_1_1.csv" || fail "no force in N over s"

say "the axis of time fits the contacts: a short touch is not a stroke at the edge of what its beam does afterwards"
cat >cantilever.yaml <<END
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7800}
bodies:
  ball: {shape: sphere, material: steel, radius: 0.006}
  cantilever: {shape: beam, material: steel, section: {width: 0.02, height: 0.004}, length: 0.2, ends: [clamped, free]}
END
for place in 0.5 1; do
    picture "at_$place" "ball|cantilever" query --local --catalogue cantilever.yaml --a ball --b cantilever --speed 0.3 \
        --at "$place"
    expect 0 percuss query --local --catalogue cantilever.yaml --a ball --b cantilever --speed 0.3 --at "$place" \
        --json
    # in ms: from the touch to a quarter of the contacts' time after the last of them, and the margins of 2 %
    end=$(sed -n 's/^ *"end_time": \([^,]*\),*$/\1/p' "$out")
    sed -n 's/^set xrange \[\(.*\):\(.*\)\]$/\1 \2/p' "$work/at_$place/plot.gp" | sort -u |
        awk -v end="$end" '{ high = 1e3 * end * 1.25 * 1.021; exit !(end > 0 && $2 <= high && $2 > 1.2e3 * end && $1 <= 0) }' ||
        fail "axis of time $(grep xrange "$work/at_$place/plot.gp" | head -n 1), last contact until $end s"
done

say "several speeds beside each other, each with its measured history; several models over each other"
picture speeds "0.276 m/s: e = 0.7102|0.303 m/s: e = 0.2455|history-1.csv|history-3.csv" query $pair \
    --speed 0.276 --speed 0.287 --speed 0.303 --measured "$data/synthetic-history-1.csv" \
    --measured "$data/synthetic-history-2.csv" --measured "$data/synthetic-history-3.csv"
picture models "steel-sphere, closed-form|al-rod-1, hertz" query --a steel-sphere --b al-rod-1 --speed 0.3 \
    --contact-model closed-form --contact-model hertz --horizon 0.002
[ "$(ls "$work/models")" = "$(printf 'impact_1_1.csv\nimpact_1_2.csv\nplot.gp')" ] || fail "$(ls "$work/models")"

say "their answers: each told from the others, as a table, CSV and JSON"
several="query $pair --speed 0.2 --speed 0.3 --contact-model hertz --contact-model auto"
expect 0 percuss $several
[ "$(grep -c '^  restitution' "$out")" -eq 4 ] || fail "not four answers"
shows "0.3 m/s, contact model auto: steel-sphere on al-beam"
asked="steel-sphere of steel on al-beam of aluminium, ends free and free, in the middle of al-beam"
grep -q "multiplot title '$asked'" "$work/impact/plot.gp" || fail "the picture does not say what was asked"
expect 0 percuss $several --csv
[ "$(cut -d, -f 1,2 "$out" | uniq | tr '\n' ' ')" = \
    "speed,contact_model 0.20000000000000001,hertz 0.20000000000000001,auto 0.29999999999999999,hertz 0.29999999999999999,auto " ] ||
    fail "not the four questions: $(cut -d, -f 1,2 "$out")"
expect 0 percuss $several --json
python3 - "$out" <<'PYTHON' || fail "not the answers"
import json, sys
answers = json.load(open(sys.argv[1]))["answers"]
assert [(a["speed"], a["contact_model"]) for a in answers] == [(v, m) for v in (0.2, 0.3) for m in ("hertz", "auto")]
assert all(a["reply"]["contacts"][0]["restitution"] > 0.2 for a in answers)
PYTHON
if python3 -c 'import jsonschema' 2>/dev/null; then
    "$bin/percuss" schema query >"$work/query.schema"
    python3 "$source_dir/tests/reference/validate.py" "$work/query.schema" "$out" >"$err" 2>&1 || fail "not as its schema"
fi
expect 5 percuss query --a steel-sphere --b nobody --speed 0.2 --speed 0.3 --plot "$work/none.pdf"
[ ! -e "$work/none.pdf" ] || fail "a picture of a refusal"
# refuses TEXT ARGUMENT...
refuses() {
    text=$1
    shift
    expect 2 percuss query $pair "$@"
    says "$text"
}
refuses "--trace: one --speed and one --contact-model are needed, not 2 and 0" --speed 0.2 --speed 0.3 --trace -
refuses "--speed-sigma: one --speed and one --contact-model are needed, not 1 and 2" --speed 0.2 --speed-sigma 0.01 \
    --contact-model hertz --contact-model auto
refuses "--measured: one a speed at most, not 2 of 1" --speed 0.2 --measured "$data/synthetic-history-1.csv" \
    --measured "$data/synthetic-history-2.csv" --plot "$work/none.pdf"
refuses "at most 6 speeds; percuss sweep takes more" --speed 1 --speed 1 --speed 1 --speed 1 --speed 1 --speed 1 --speed 1

say "restitution over speed: bodies, models, both; measured points where they belong"
picture bodies "al-cylinder|al-half-plate-10|al-beam|beam.csv|without negligible ones" sweep --a steel-sphere \
    --b al-cylinder --b al-half-plate-10 --b al-rod --b al-beam --speed 0.05:0.5:10 --measured "al-beam=$data/synthetic-beam.csv"
picture both "al-rod-1|al-rod-2|hertz|auto|points.csv" sweep --a steel-sphere --b al-rod-1 --b al-rod-2 \
    --contact-model hertz --contact-model auto --speed 0.05:0.5:10 --measured "al-rod-2=$(
        printf 'speed,restitution\n0.02,0.9\n0.6,0.3\n' >"$work/points.csv"
        echo "$work/points.csv"
    )"
[ "$(grep -c "title 'points.csv'" "$work/both/plot.gp")" -eq 1 ] || fail "points of one body on the other's panel"
expect 2 percuss sweep $pair --speed 0.1:0.2:2 --measured "al-rod=$data/synthetic-beam.csv" --plot "$work/none.pdf"
says "a body that --b names is needed before the ="

say "with friction the tangential force within its limits, the slip, and each sub-impact larger"
askew="--a steel-sphere --b al-beam --angle 30 --friction 0.3"
picture friction "normal force|limit|tangential force|slip / (m/s)|2 sub-impacts, friction 0.3|1 at 0 ms: reversed|2 at 4.86 ms: slid" \
    query $askew --speed 0.3
head -n 1 "$work/friction/impact_1_1.csv" |
    grep -qx 'time,force,displacement_a,displacement_b,velocity_a,velocity_b,limit,force_tangential_1,force_tangential_2,slip_1,slip_2' ||
    fail "the columns have other names"
# mN s of each: the second one slides backward
for blow in 1 2; do
    awk -F, 'NR > 2 { sum += 500 * ($1 - t) * ($3 + f) } NR > 1 { t = $1; f = $3; if ($3 * $3 > $2 * $2 * (1 + 1e-8)) beyond = 1 }
        END { printf "%.2f ", sum; exit beyond }' "$work/friction/sub_impact_${blow}_1.csv" || fail "beyond Coulomb's limit"
done >"$work/blows"
[ "$(cat "$work/blows")" = "-7.10 2.36 " ] || fail "tangential impulses drawn: $(cat "$work/blows")"
! grep -q circle "$work/friction/plot.gp" || fail "a circle of forces along one line"
picture slides "0.3 m/s: e = 0.2938, 2 sub-impacts, friction 0.3|0.2 m/s: e = 0.6205" query $askew --speed 0.3 --speed 0.2
picture slid_models "al-beam, hertz|al-beam, auto" query $askew --speed 0.3 --contact-model hertz --contact-model auto

# of an impact that is straight the slip is rounding, which is no mountain range
picture straight "0.3 m/s|slip / (m/s)|friction 0.3" query --a steel-sphere --b al-beam --friction 0.3 --speed 0.3
sed -n 's/^set yrange \[\(.*\):\(.*\)\]$/\1 \2/p' "$work/straight/plot.gp" | sed -n 4p |
    awk '{ exit !($2 > 0.02 && $1 < -0.02) }' || fail "an axis of rounding errors"
! grep -q circle "$work/straight/plot.gp" || fail "a circle of rounding errors"

# the numbers of slow ones have room as well
picture slow "velocity / (mm/s)|slip / (mm/s)|contact force / N" query $askew --speed 0.01

say "along two tangents Coulomb's circle as well"
cat >two.json <<END
{"bodies": [{"id": "steel-sphere", "position": [0.1, 0, 0.025], "velocity": [0.12, 0.09, -0.26]}, {"id": "al-beam"}],
 "contacts": [{"a": 0, "b": 1, "point": [0.1, 0, 0.01], "normal": [0, 0, 1], "friction": 0.3}]}
END
picture circle "along the first tangent|along the second|force along the first / limit|along the second / limit|3 sub-impacts" \
    query --request two.json
grep -q 'circle at 0,0 size 1' "$work/circle/plot.gp" || fail "no circle"
awk -F, 'NR > 1 && $5 != "nan" { r = $5 * $5 + $6 * $6; if (r > most) most = r } END { exit !(most > 0.99 && most < 1 + 1e-7) }' \
    "$work/circle/sub_impact_1_1.csv" || fail "not within the circle, or never on it"
head -n 1 "$work/impact/impact_1_1.csv" | grep -q 'slip\|limit' && fail "friction in a picture without it"

say "a sweep with friction: tangential impulse and restitution; where they differ both restitutions"
picture angles "0.3 m/s, friction 0.3|tangential impulse / mN s|tangential restitution|angle / degrees" sweep --a steel-sphere \
    --b steel-sphere --speed 0.3 --angle 5:65:13 --friction 0.3
grep -q kinematic "$work/angles/plot.gp" && fail "two restitutions of two balls"
[ "$(head -n 1 "$work/angles/curve_1.csv")" = "angle,restitution,error,sub_impacts,significant,impulse_tangential_1,tangential_restitution,restitution_kinematic,error_total,bar_low,bar_high" ] ||
    fail "the columns have other names"
awk -F, '$1 == 45 { found = $6 < -4.8e-3 && $6 > -5e-3 && $7 > 0.46 && $7 < 0.47 } END { exit !found }' \
    "$work/angles/curve_1.csv" || fail "not the tangential impulse and restitution at 45 degrees"
cat >short.yaml <<END
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7800}
bodies:
  ball: {shape: sphere, material: steel, radius: 0.015}
  short: {shape: beam, material: steel, radius: 0.01, length: 0.1}
  long: {shape: beam, material: steel, radius: 0.01, length: 1}
END
picture short "0.3 m/s, friction 0.3|kinematic|tangential restitution" sweep --local --catalogue short.yaml --a ball --b short \
    --speed 0.3 --angle 20:60:3 --friction 0.3 --at 0.9
picture askew_groups "short, 0.3 m/s, friction 0.3|long, 0.3 m/s, friction 0.3|hertz|auto" sweep --local --catalogue short.yaml \
    --a ball --b short --b long --speed 0.3 --angle 20:60:3 --friction 0.3 --contact-model hertz --contact-model auto
grep -q impulse_tangential "$work/bodies/curve_1.csv" && fail "friction in a sweep without it"

say "measured and simulated impacts on areas A to D, which may reach below 0"
picture compare "synthetic-beam.csv|simulated|A to D: ± 0.5, 1, 1.5, 2 σ|share of impacts below" compare "$data/synthetic-beam.csv" $pair
for letter in A B C D; do
    [ "$(pdftotext "$work/compare.pdf" - | grep -c "^$letter\$")" -ge 2 ] || fail "no letters $letter"
done
printf 'speed,restitution\n0.2,0.05\n0.3,0.9\n0.25,0.1\n' >"$work/wide.csv"
picture wide "A to D" compare "$work/wide.csv" $pair
sed -n 's/^set yrange \[\(-[0-9.]*\):.*/\1/p' "$work/wide/plot.gp" | head -n 1 | grep -q . || fail "area D is cut at 0"

say "an ensemble"
picture ensemble "3 sub-impacts|local ± σ|quantiles, 95 % intervals|with its interactions|young@al-beam|share of the variance" \
    ensemble $pair --speed uniform:0.089:0.411 --input young@al-beam=normal:70e9:1e9 --samples 500

for name in compare ensemble; do
    grep -q "multiplot .*title '$asked" "$work/$name/plot.gp" || fail "$name: the picture does not say what was asked"
done
picture sweep "$asked" sweep $pair --speed 0.1:0.3:3
# the bars are the total error's, and end where no restitution is
grep -q '1:7:(0):($8-$7) with vectors' "$work/sweep/plot.gp" || fail "bars of another error"
awk -F, 'NR > 1 && !($6 > 20 * $3 && $7 >= 0 && $8 <= 1) { exit 1 }' "$work/sweep/curve_1.csv" || fail "not the total error, or beyond what can be"
printf 'speed\n0.3\n0.1\n0.2\n' >"$work/speeds.csv"
picture listed "$asked" sweep $pair --speeds "$work/speeds.csv"
cmp "$work/sweep/curve_1.csv" "$work/listed/curve_1.csv" || fail "the curve goes to and fro"
picture decades "$asked" sweep $pair --speed 0.01:1:3:log
grep -q '^set logscale x$' "$work/decades/plot.gp" || fail "the axis is not logarithmic"

say "the script draws the same picture from the files; they are there without gnuplot, too"
for format in png svg; do
    expect 0 query --plot "$work/again.$format" --plot-data "$work/again"
    (cd "$work/again" && gnuplot plot.gp) >"$out" 2>"$err" || fail "the script fails"
    cmp "$work/again.$format" "$work/again/again.$format" || fail "another picture"
done
mkdir "$work/empty"
PATH=$work/empty expect 0 "$bin/percuss" query --domain "$domain" $pair --speed 0.3 --plot-data "$work/alone"
(cd "$work/alone" && gnuplot plot.gp) || fail "the script fails"
[ "$(od -An -tx1 -N4 "$work/alone/plot.png" | tr -d ' \n')" = 89504e47 ] || fail "no picture by the script"

say "the locale of C, of which the script has signs that it lacks, draws the same without a word"
for asked in "query $pair --speed 0.287" "compare $data/synthetic-beam.csv $pair" "sweep $pair --speed 0.1:0.3:3" \
    "ensemble $pair --speed uniform:0.1:0.3 --samples 50"; do
    for locale in C.UTF-8 C; do
        (
            LC_ALL=$locale
            export LC_ALL
            # words
            # shellcheck disable=SC2086
            percuss $asked --plot "$work/$locale.svg"
        ) >"$out" 2>"$err" || fail "no picture: $asked"
    done
    cmp "$work/C.UTF-8.svg" "$work/C.svg" || fail "another picture: $asked"
    ! grep -qi 'iconv\|degree' "$err" || fail "gnuplot warns: $asked"
done

say "a folder that cannot be written is refused at once, a full disk is said"
expect 2 percuss query $pair --speed 0.3 --plot-data "$work/none/folder" --domain 229 --timeout 0
says "--plot-data: $work/none/folder: cannot be written: No such file or directory"
expect 2 percuss query $pair --speed 0.3 --plot-data "$data/synthetic-beam.csv" --domain 229 --timeout 0
says "cannot be written: Not a directory"
expect 2 percuss query $pair --speed 0.3 --plot-data "$work/later" --timeout 0 --horizon never
[ ! -e "$work/later" ] || fail "an empty folder is left"
mkdir "$work/full"
ln -s /dev/full "$work/full/plot.gp"
expect 1 percuss query $pair --speed 0.3 --plot-data "$work/full"
says "plot.gp: could not be written: No space left on device"
stop_daemon
