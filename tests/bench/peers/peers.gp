# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Seconds against error of peers.py, a panel for each scene, a curve for each program.
# gnuplot -e "folder='...'; output_name='...'" peers.gp; folder holds <scene>-<program>.dat

set terminal svg size 900,420 font "DejaVu Sans,13" background rgb "white"
set output output_name . ".svg"
set multiplot layout 1,2
set logscale xy
set xrange [1:1e-9] reverse
set xtics (1, 1e-2, 1e-4, 1e-6, 1e-8)
set yrange [5e-5:40]
set format x "10^{%T}"
set format y "10^{%T}"
set xlabel "error in the restitution"
set ylabel "seconds of one core"
set grid xtics ytics linecolor rgb "#dddddd" linewidth 0.6 linetype 1
set border 3 linecolor rgb "#444444"
set tics nomirror
set key at graph 0.50, graph 0.60 left top reverse Left samplen 1.5 spacing 0.9 width -6 font ",10"

scenes = "rod beam"
titles = '"A sphere on a rod, 0.3 m/s" "A sphere on a beam, 0.2 m/s"'
programs = "percuss scipy exudyn siconos simbody calculix mujoco drake"
names = '"percuss" "scipy, modes" "Exudyn, chain of masses" "Siconos, modes" "Simbody, chain of bodies" "CalculiX, trusses" "MuJoCo, percuss export" "Drake, percuss export"'
colours = "#c0392b #1f5fa8 #2e8b57 #7d3c98 #117a8b #8d6e63 #d68910 #5d6d7e"
points = "7 5 9 11 4 8 13 6"
file(scene, program) = folder . "/" . word(scenes, scene) . "-" . word(programs, program) . ".dat"
there(scene, program) = system("test -s '" . file(scene, program) . "' && echo yes") eq "yes"
shown(scene, program) = there(scene, program) ? file(scene, program) : "/dev/null"
set style line 1 linewidth 2 pointsize 0.6
do for [s = 1:2] {
    set title word(titles, s)
    plot for [i = 1:words(programs)] shown(s, i) using 1:2 with linespoints linestyle 1 linecolor rgb word(colours, i) \
        pointtype (word(points, i) + 0) title (s == 1 || !there(1, i) ? word(names, i) : "")
}
unset multiplot
