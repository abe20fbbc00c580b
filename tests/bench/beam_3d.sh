#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The paper's Table 2 and Fig. 3 anew: models A, B and C of the sphere on the beam at 0.2 m/s and at the speeds of
# Fig. 5, restitution and times as CSV, histories, the picture; A's at 0.2 m/s for percuss --measured too. A takes some ten minutes of one core.
# usage: beam_3d.sh BUILD_DIR OUTPUT_DIR
set -eu
here=$(dirname "$0")
bin=$1/tests/bench
out=$2
mkdir -p "$out"
export OMP_NUM_THREADS=1
speeds="--speed 0.2 --speed 0.276 --speed 0.287 --speed 0.303"
# words on purpose
# shellcheck disable=SC2086
"$bin/beam_modal" $speeds --history "$out/beam-3d" >"$out/beam-3d-modal.csv"
# shellcheck disable=SC2086
"$bin/beam_3d" $speeds --history "$out/beam-3d-A.csv" >"$out/beam-3d-complete.csv"
# the free approach before the touch, then A's own instants
awk -F, 'BEGIN {
        print "# computed, not measured: complete finite elements in three dimensions (model A), steel sphere on the"
        print "# middle of the beam at 0.2 m/s; what is before 0 is the free approach"
        print "time,velocity_a,displacement_b"
        for (t = -1000; t < 0; t += 10) printf "%.6f,0.2,0\n", 1e-6 * t
    }
    NR > 1 { print $1 "," $4 "," $3 }' "$out/beam-3d-A.csv" >"$out/model-A.csv"
gnuplot -e "a='$out/beam-3d-A.csv'; b='$out/beam-3d-B.csv'; c='$out/beam-3d-C.csv'; output='$out/beam-3d.png'" \
    "$here/beam_3d.gp"
