# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# gnuplot -e "data='curves.csv'; output='indentation'" indentation.gp
set terminal svg size 720,480 font "sans,12" background "white"
set output output.".svg"
set datafile separator ","
set encoding utf8
set xlabel "indentation / µm"
set ylabel "force / N"
set key outside top center horizontal
set grid
E = 1/((1-0.3**2)/210e9 + (1-0.33**2)/70e9)
R = 0.015
S = 205e6
C = 1.295*exp(0.736*0.33)
dc = (pi*C*S/2/E)**2*R
Fc = 4./3*(R/E)**2*(pi*C*S/2)**3
a(d) = sqrt(R*d*(d/dc/1.9)**(0.14*exp(23*S/E)))
H(d) = 2.84*(1-exp(-0.82*(a(d)/R)**-0.7))
jg(d) = d/dc < 1.9 ? hertz(d) : Fc*(exp(-(d/dc)**(5./12)/4)*(d/dc)**1.5 + 4*H(d)/C*(1-exp(-(d/dc)**(5./9)/25))*d/dc)
hertz(d) = 4./3*E*sqrt(R)*d**1.5
# everything that was computed; Hertz leaves it
stats data using ($2*1e6):3 nooutput
set xrange [0:1.03*STATS_max_x]
set yrange [0:1.05*STATS_max_y]
set samples 300
plot data using ($1==0 ? $2*1e6 : 1/0):3 with lines lw 2 lc rgb "#1f4e8c" title "loading (table)", \
     for [k=1:20] data using ($1==k ? $2*1e6 : 1/0):3 with lines lc rgb "#8cb4e0" title (k==1 ? "unloading, reloading" : ""), \
     jg(x*1e-6) with lines dt 2 lc rgb "#c05000" title "Jackson-Green 2005", \
     (hertz(x*1e-6) < STATS_max_y ? hertz(x*1e-6) : 1/0) with lines dt 3 lc rgb "#606060" title "Hertz"
