# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The slow scale (gap of the first sphere) and below it, for the first impacts, the fast scale: every
# sub-impact as a box of its length and peak force.
# gnuplot -e "folder='...'; scene='...'" plot.gp     writes folder/scene.svg; format='png' or 'pdf': another
set datafile separator ","
motion = sprintf("%s/%s.csv", folder, scene)
# the sub-impacts of this scene and impact n (0: of all that are shown): offset from its time in ms, half length, peak
boxes(n) = sprintf("< awk -F, '$1 == \"%s\" && (%d == 0 ? $2 <= 3 : $2 == %d)' %s/sub_impacts.csv", scene, n, n, folder)
stats sprintf("< awk -F, 'BEGIN { print 0 } $1 == \"%s\" { print $2 }' %s/impacts.csv", scene, folder) using 1 nooutput
impacts = int(STATS_max)
shown = impacts < 3 ? impacts : 3

if (!exists("format")) { format = "svg" }
if (format eq "png") { set terminal pngcairo size 900,700 font "sans,11" background "white" }
if (format eq "pdf") { set terminal pdfcairo size 9.4,7.3 font "sans,9" fontscale 1 linewidth 1.5 }
if (format eq "svg") { set terminal svg size 900,700 dynamic font "sans-serif,13" background "white" }
set output sprintf("%s/%s.%s", folder, scene, format)
set multiplot title scene noenhanced
set border 3 linecolor rgb "#444444"
set tics nomirror
set grid linecolor rgb "#dddddd" linetype 1
set lmargin 10

set size 1.0, 0.47
set origin 0.0, 0.47
set xlabel "time, s (slow scale)"
set ylabel "sphere and bar, mm"
set key outside top center horizontal
set autoscale xfix
set offsets graph 0, graph 0.01, graph 0.05, graph 0.05
# the last column is the bar's middle, whatever the number of spheres
columns = int(system(sprintf("head -n 1 %s | awk -F, '{ print NF }'", motion)))
# the sphere by where its surface and the bar's axis would touch: the curves meet in an impact
plot motion using 1:($3 * 1e3 + 25) with lines linewidth 2 linecolor rgb "#1f5fa8" title "first sphere", \
     motion using 1:(column(columns) * 1e3) with lines linewidth 2 linecolor rgb "#b4521e" title "middle of the bar"
set offsets 0, 0, 0, 0

set style fill solid 0.5
set xlabel "ms after the impact (fast scale)"
# one axis of force for all: the highest peak and a twentieth
highest = 1
if (shown > 0) {
    stats boxes(0) using 7 nooutput
    highest = STATS_max
}
# some four marks on an axis of that length
magnitude(length) = 10 ** floor(log10(length / 4))
step(length) = magnitude(length) * (length / 4 > 5 * magnitude(length) ? 10 : length / 4 > 2 * magnitude(length) ? 5 : 2)
do for [n = 1:shown] {
    set size 1.0 / shown, 0.46
    set origin (n - 1.0) / shown, 0.0
    set title sprintf("impact %d", n)
    if (n == 1) { set ylabel "peak force, N" } else { unset ylabel }
    # what is counted must not be cut off by the axes of the last one
    set xrange [*:*]
    set yrange [*:*]
    stats boxes(n) using ($5 * 1e3) name "BEGIN" nooutput
    stats boxes(n) using ($6 * 1e3) name "END" nooutput
    margin = 0.05 * (END_max - BEGIN_min) + 0.02
    set xtics step(END_max - BEGIN_min + 2 * margin)
    set xrange [BEGIN_min - margin:END_max + margin]
    set yrange [0:1.05 * highest]
    # of several contacts each has a colour and a name
    stats boxes(n) using 3 name "CONTACT" nooutput
    if (CONTACT_max > 0) { set key outside top center horizontal } else { unset key }
    plot for [c = 0:CONTACT_max] boxes(n) using ($3 == c ? 0.5e3 * ($5 + $6) : NaN):(0.5 * $7):(0.5e3 * ($6 - $5)):(0.5 * $7) \
        with boxxyerror linecolor rgb word("#1f5fa8 #b4521e #3c8c46 #8a4ba0", int(c) % 4 + 1) title sprintf("contact %d", c + 1)
}
unset multiplot
