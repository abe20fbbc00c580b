#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Draws the pictures of docs/friction.md: the rebound along the surface of a steel ball that hits an equal one, and the
# tangential impulse of the paper's beam over the coefficient of friction.
# usage: friction.sh [BUILD [FOLDER]]   (some ten seconds; FOLDER: docs/figures)
set -eu
cd "$(dirname "$0")/../.."
percuss=${1:-build}/bin/percuss
figures=${2:-docs/figures}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# the shipped catalogue; these metals stay elastic
sed -e '/^  \(steel\|aluminium\):/s/}/, yield: none}/' config/catalogue.yaml >"$work/catalogue.yaml"
ln -s "$PWD/config/bodies" "$work/bodies"
ask() {
    command=$1
    shift
    "$percuss" "$command" --local --catalogue "$work/catalogue.yaml" --csv "$@" 2>>"$work/warnings"
}

ask sweep --a steel-sphere --b steel-sphere --speed 1 --angle 1:68:135 --friction 0.3 >"$work/balls.csv"

# angle, coefficient, tangential impulse of the impact, of its first and of its second blow
for angle in 30 60; do
    for hundredths in $(seq 1 60); do
        mu=$(awk -v n="$hundredths" 'BEGIN { print n / 100 }')
        ask query --a steel-sphere --b al-beam --speed 0.3 --angle "$angle" --friction "$mu" |
            awk -F, -v angle="$angle" -v mu="$mu" '
                NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
                { total = $at["impulse_tangential_1"]; blow[NR - 1] = $at["sub_impulse_tangential_1"] }
                END { print angle, mu, -1e3 * total, -1e3 * blow[1], -1e3 * blow[2] }'
    done
done >"$work/beam.txt"

gnuplot - <<END
set encoding utf8
set grid linecolor rgb "#dddddd" linewidth 0.6 linetype 1
set border 3 linecolor rgb "#444444"
set tics nomirror
set key samplen 2 spacing 1.2

set terminal pngcairo size 1100,620 font "DejaVu Sans,14" linewidth 1.4 background rgb "white"
set output "$figures/friction-balls.png"
kappa = 1.4/1.7
mu = 0.3
chi = 3.5*kappa/2
set xlabel "slip before: ψ_1 = κ slip / (μ approach)"
set ylabel "slip after: ψ_2"
set xrange [0:6.7]
set yrange [-1.7:1.6]
set xzeroaxis linecolor rgb "#888888"
set key left top Left reverse
\$check << EOD
0.25 0.0416
0.5 0.0478
0.75 0.0142
1 -0.0597
1.25 -0.2188
1.5 -0.4280
2 -0.8372
2.5 -1.1623
3 -1.3797
3.5 -1.4773
4 -1.4365
4.5 -1.2176
EOD
set arrow from 4*chi - 1, graph 0 to 4*chi - 1, graph 1 nohead dashtype 3 linecolor rgb "#888888"
set label "from here on it slides throughout" at 4*chi - 1, 1.45 right offset -1, 0
# one column a number: 9 is the angle, 12 the slip after
plot "< tail -n +2 $work/balls.csv | tr ',' ' '" using (kappa/mu*tan(\$9*pi/180)):(kappa/mu*\$12/cos(\$9*pi/180)) \
        with lines linewidth 2 linecolor rgb "#1f5fa8" title "percuss, tolerance 1e-3", \
    \$check with points pointtype 7 pointsize 1 linecolor rgb "#c0392b" title "foundation of 2000 cells", \
    x < 4*chi ? 0 : x - 4*chi with lines dashtype 2 linecolor rgb "#606060" title "Coulomb's law of rigid bodies"
unset label
unset arrow

set terminal pngcairo size 1350,600 font "DejaVu Sans,14" linewidth 1.4 background rgb "white"
set output "$figures/friction-beam.png"
set xlabel "coefficient of friction"
set ylabel "impulse along the surface, against the slip / (mN s)"
set xrange [0:0.6]
set yrange [-5:15]
\$other << EOD
30 0.1 3.2821 2.495 0.787
30 0.3 4.6861 7.047 -2.361
60 0.1 2.0369 1.488 0.549
60 0.3 6.1106 4.465 1.646
EOD
array name[3] = ["both blows", "first blow", "second blow"]
set multiplot layout 1, 2
do for [angle in "30 60"] {
    set title angle."° from the normal"
    plot for [k=3:5] "$work/beam.txt" using (\$1 == angle ? \$2 : 1/0):k with lines linewidth 2 \
            linecolor rgb word("#222222 #1f5fa8 #c0392b", k - 2) \
            title name[k - 2], \
        for [k=3:5] \$other using (\$1 == angle ? \$2 : 1/0):k with points pointtype 7 pointsize 1 \
            linecolor rgb word("#222222 #1f5fa8 #c0392b", k - 2) \
            title k == 3 ? "program of our own" : ""
}
unset multiplot
END
