# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Cost of a contact step against modes and against contacts, from growth's CSV.
# gnuplot -e "data='growth.csv'; output_name='growth.png'" growth.gp

set datafile separator ","
set terminal pngcairo size 1350,600 font "DejaVu Sans,14" linewidth 1.4 background rgb "white"
set output output_name
set logscale xy
set format y "10^{%T}"
set grid xtics ytics linecolor rgb "#dddddd" linewidth 0.6 linetype 1
set border 3 linecolor rgb "#444444"
set tics nomirror
set key left top Left reverse samplen 2
set ylabel "seconds per contact step, one core"

of(kind) = "< grep '^" . kind . ",' " . data

set multiplot layout 1, 2
set xrange [3:4000]
set yrange [1e-7:1e-4]
set xlabel "modes that take part"
plot of("modes") using 3:6 with linespoints linewidth 2 pointtype 7 pointsize 0.6 \
        linecolor rgb "#c0392b" title "a sphere on a pinned beam", \
    x * 8e-9 with lines dashtype 2 linecolor rgb "#888888" title "linear"
set xrange [0.8:100]
set yrange [1e-7:1e-4]
set xlabel "contacts at once"
plot of("contacts") using 2:6 with linespoints linewidth 2 pointtype 7 pointsize 0.6 \
        linecolor rgb "#c0392b" title "on one beam with 40 modes", \
    of("pairs") using 2:6 with linespoints linewidth 2 pointtype 5 pointsize 0.6 \
        linecolor rgb "#1f5fa8" title "pairs of spheres", \
    x * 3e-7 with lines dashtype 2 linecolor rgb "#888888" title "linear"
unset multiplot
