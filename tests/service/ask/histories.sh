#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Time histories of an impact, and pictures of them.
. "$(dirname "$0")/../support/lib.sh"

start_daemon

# sum FILE: the impulse of the force shown in a trace
sum() {
    awk -F, 'NR > 2 { sum += ($2 - t) * ($3 + f) / 2 } { t = $2; f = $3 } END { print sum }' "$1"
}

# near A B RELATIVE
near() {
    awk -v a="$1" -v b="$2" -v r="$3" 'BEGIN { d = a - b; exit !(d * d <= r * r * b * b) }'
}

# picture FILE LEAST_BYTES: a PNG or SVG of some content
picture() {
    [ -s "$1" ] && [ "$(wc -c <"$1")" -ge "$2" ] || fail "$1 is no picture"
    case $1 in
    *.png) [ "$(od -An -tx1 -N8 "$1" | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "$1 is no PNG" ;;
    *.svg) head -c 200 "$1" | grep -q '<?xml' && grep -q '</svg>' "$1" || fail "$1 is no SVG" ;;
    esac
}

say "the histories have the reply's impulse, and change no number of it"
expect 0 query --json
numbers "$out" >"$work/plain"
expect 0 query --json --trace "$work/trace.csv"
numbers "$out" >"$work/traced"
cmp -s "$work/plain" "$work/traced" || fail "asking for histories changes the reply"
head -n 1 "$work/trace.csv" | grep -q '^contact,time,force,indentation,gap,gap_rate,displ' ||
    fail "the columns have other names"
near "$(sum "$work/trace.csv")" "$(field impulse)" 2e-3 ||
    fail "force shown $(sum "$work/trace.csv"), impulse $(field impulse)"

say "with friction the tangential force and the slip come behind"
head -n 1 "$work/trace.csv" | grep -qx 'contact,time,force,indentation,gap,gap_rate,displacement_a,velocity_a,displacement_b,velocity_b' ||
    fail "without friction there are other columns"
expect 0 percuss query --a steel-sphere --b al-beam --speed 0.3 --angle 30 --friction 0.3 --json --trace "$work/slides.csv"
head -n 1 "$work/slides.csv" | grep -qx 'contact,time,.*,velocity_b,force_tangential_1,force_tangential_2,slip_1,slip_2' ||
    fail "the columns have other names: $(head -n 1 "$work/slides.csv")"
# of each blow in mN s: the second one slides backward; nowhere beyond Coulomb's law
awk -F, 'NR > 2 { blow[$2 > 1e-3] += 500 * ($2 - t) * ($11 + f) }
    NR > 1 { t = $2; f = $11; if ($11 * $11 > 0.09 * $3 * $3 * (1 + 1e-12)) beyond = 1 }
    END { print blow[0], blow[1]; exit beyond }' "$work/slides.csv" >"$work/blows" || fail "more than the coefficient allows"
read -r first second <"$work/blows"
near "$first" -7.101 2e-3 && near "$second" 2.356 2e-3 || fail "tangential impulses shown: $first, $second mN s"
# the last one is the contact's, those of its sub-impacts stand before
total=$(sed -n '/"impulse_tangential": \[/{n;s/[ ,]//g;p}' "$out" | tail -n 1)
near "$(awk '{ print 1e-3 * ($1 + $2) }' "$work/blows")" "$total" 2e-3 || fail "not the reply's impulse_tangential: $total"
expect 0 percuss query --a steel-sphere --b al-beam --speed 0.3 --angle 30 --friction 0.3 --units --trace "$work/units.csv"
head -n 1 "$work/units.csv" | grep -q ',force_tangential_1 \[N\],force_tangential_2 \[N\],slip_1 \[m/s\],slip_2 \[m/s\]$' ||
    fail "units: $(head -n 1 "$work/units.csv")"

say "pictures by gnuplot"
expect 0 query --plot "$work/beam.png" --trace "$work/again.csv"
picture "$work/beam.png" 20000
cmp -s "$work/trace.csv" "$work/again.csv" || fail "the same question has other histories"
expect 0 percuss query --a steel-sphere --b al-rod --speed 0.3 --plot "$work/rod.svg"
picture "$work/rod.svg" 10000
expect 0 percuss sweep --a steel-sphere --b al-rod-1 --b al-rod-2 --contact-model hertz \
    --contact-model auto --speed 0.05:0.5:4 --csv --plot "$work/rods.svg"
picture "$work/rods.svg" 8000
[ "$(grep -c '^al-rod-[12],\(hertz\|auto\),0\.' "$out")" -eq 16 ] || fail "not four curves of four points"
shows "b,contact_model,speed,restitution,"
expect 0 percuss sweep --a steel-sphere --b al-beam --speed 0.1:0.3:9 --plot "$work/sweep.png"
picture "$work/sweep.png" 10000
expect 2 query --b al-rod
says "--b: one body is needed, not 2"
expect 2 query --plot "$work/beam.jpg"
says ".png, .svg or .pdf"
mkdir "$work/empty"
PATH=$work/empty expect 1 "$bin/percuss" query --domain "$domain" --a steel-sphere --b al-rod \
    --speed 0.3 --plot "$work/none.png"
says "gnuplot is not installed"

say "refusals have no histories"
expect 5 percuss query --a steel-sphere --b al-bean --speed 0.3 --trace "$work/none.csv"
[ ! -e "$work/none.csv" ] || fail "a refusal has histories"

stop_daemon
