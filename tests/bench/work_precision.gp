# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Seconds against error, one curve per method: the fastest setting for every error.
# gnuplot -e "folder='...'; scene='beam'; subject='...'; output_name='...'" work_precision.gp
# folder holds <scene>-<method>.dat (error, seconds), fronts made by report.sh.

set logscale xy
set xrange [*:*] reverse
set format x "10^{%T}"
set format y "10^{%T}"
set xlabel "error in the restitution"
set ylabel "seconds per impact, one core"
set title subject
set grid xtics ytics linecolor rgb "#dddddd" linewidth 0.6 linetype 1
set border 3 linecolor rgb "#444444"
set tics nomirror
set key outside right center Left reverse samplen 2 spacing 1.4

file(method) = folder . "/" . scene . "-" . method . ".dat"
colours = "#c0392b #1f5fa8 #6fa8dc #8e44ad #2e8b57 #d68910 #e08a80"
methods = "modal cvode-adams cvode-adams-whole cvode-bdf arkode-explicit verlet modal-solve"
titles = '"percuss, same modes" "CVODE Adams" "CVODE Adams, flights too" "CVODE BDF" "ARKODE explicit" "Verlet, exact modes" "percuss, whole answer*"'
points = "7 5 4 9 11 13 6"
widths = "3 2 1.5 2 2 2 2"

# what differs from the reference by less is the reference itself
least = 1e-13
draw = 'plot for [i = 1:7] file(word(methods, i)) using ($1 > least ? $1 : NaN):2 with linespoints \
    linewidth (word(widths, i) + 0) linecolor rgb word(colours, i) pointtype (word(points, i) + 0) \
    pointsize 0.6 title word(titles, i)'

set terminal svg size 900,520 font "DejaVu Sans,13" background rgb "white"
set output output_name . ".svg"
eval(draw)
set terminal pngcairo size 1350,780 font "DejaVu Sans,15" linewidth 1.4 background rgb "white"
set output output_name . ".png"
eval(draw)
