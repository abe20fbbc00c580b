# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The slow scale (gap of the first sphere) and below it, for the first impacts, the fast scale: every
# sub-impact as a box of its length and peak force.
# gnuplot -e "folder='...'; scene='...'" plot.gp     writes folder/scene.svg
set datafile separator ","
motion = sprintf("%s/%s.csv", folder, scene)
# the sub-impacts of this scene and impact n: offset from its time in ms, half length, peak
boxes(n) = sprintf("< awk -F, '$1 == \"%s\" && $2 == %d' %s/sub_impacts.csv", scene, n, folder)
stats sprintf("< awk -F, 'BEGIN { print 0 } $1 == \"%s\" { print $2 }' %s/impacts.csv", scene, folder) using 1 nooutput
impacts = int(STATS_max)
shown = impacts < 3 ? impacts : 3

set terminal svg size 900,640 dynamic font "sans-serif,13" background "white"
set output sprintf("%s/%s.svg", folder, scene)
set multiplot title scene noenhanced
set border 3 linecolor rgb "#444444"
set tics nomirror
set grid linecolor rgb "#dddddd" linetype 1
unset key

set size 1.0, 0.46
set origin 0.0, 0.48
set xlabel "time, s (slow scale)"
set ylabel "sphere and bar, mm"
set key top right
# the last column is the bar's middle, whatever the number of spheres
columns = int(system(sprintf("head -n 1 %s | awk -F, '{ print NF }'", motion)))
# the sphere by where its surface and the bar's axis would touch: the curves meet in an impact
plot motion using 1:($3 * 1e3 + 25) with lines linewidth 2 linecolor rgb "#1f5fa8" title "first sphere", \
     motion using 1:(column(columns) * 1e3) with lines linewidth 2 linecolor rgb "#b4521e" title "middle of the bar"
unset key

set style fill solid 0.5
set xlabel "ms after the impact (fast scale)"
set yrange [0:*]
set offsets graph 0, graph 0, graph 0.1, graph 0
do for [n = 1:shown] {
    set size 1.0 / shown, 0.46
    set origin (n - 1.0) / shown, 0.0
    set title sprintf("impact %d", n)
    if (n == 1) { set ylabel "peak force, N" } else { unset ylabel }
    stats boxes(n) using ($6 * 1e3) nooutput
    reach = exists("STATS_max") && STATS_records > 0 ? STATS_max * 1.1 + 0.1 : 1
    set xrange [-0.05:reach]
    plot boxes(n) using (0.5e3 * ($5 + $6)):(0.5 * $7):(0.5e3 * ($6 - $5)):(0.5 * $7) with boxxyerror linecolor rgb "#1f5fa8"
}
unset multiplot
