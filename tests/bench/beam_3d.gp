# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The paper's Fig. 3: displacements of sphere and beam, and the sphere's velocity, of models A, B, C.
# gnuplot -e "a='A.csv'; b='BC-B.csv'; c='BC-C.csv'; output='beam-3d.png'" beam_3d.gp
set terminal pngcairo size 900,800 font "sans,11" background "white"
set output output
set datafile separator ","
set key autotitle columnhead
set grid
set xrange [0:*]
set offsets graph 0, graph 0, graph 0.04, graph 0.04
set multiplot layout 2,1
set ylabel "displacement / mm"
set key outside top center horizontal Left reverse
plot a using ($1*1e3):($2*1e3) with lines lw 3 lc rgb "#8cb4e0" title "sphere, A (3-D finite elements)", \
     b using ($1*1e3):($2*1e3) every 10 with lines lw 2 lc rgb "#1f4e8c" title "B (modes, region in every step)", \
     c using ($1*1e3):($2*1e3) every 10 with lines dt 2 lw 2 lc rgb "#101010" title "C (modes, table)", \
     a using ($1*1e3):($3*1e3) with lines lw 3 lc rgb "#f0b080" title "beam's axis, A", \
     b using ($1*1e3):($3*1e3) every 10 with lines lw 2 lc rgb "#c05000" title "B", \
     c using ($1*1e3):($3*1e3) every 10 with lines dt 2 lw 2 lc rgb "#602000" title "C"
set ylabel "sphere's velocity / (m/s)"
set xlabel "time / ms"
unset key
plot a using ($1*1e3):4 with lines lw 3 lc rgb "#8cb4e0" title "A", \
     b using ($1*1e3):4 every 10 with lines lw 2 lc rgb "#1f4e8c" title "B", \
     c using ($1*1e3):4 every 10 with lines dt 2 lw 2 lc rgb "#101010" title "C"
unset multiplot
