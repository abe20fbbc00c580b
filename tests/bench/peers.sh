#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The same impacts in other programs, from PyPI in the versions below and from Debian: seconds of one core against the error, as a
# picture and the tables of docs/lab/peers.md. Some twenty minutes.
# usage: peers.sh [BUILD [OUTPUT]]      build and docs/figures
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
build=$(cd "${1:-$source/build}" && pwd)
output=$(cd "${2:-$source/docs/figures}" && pwd)

sh "$source/deploy/dependencies.sh" peers
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet numpy==2.4.6 scipy==1.17.1 exudyn==1.13.6 mujoco==4.0.0 drake==1.51.1

siconos=/usr/include/siconos
g++ -std=c++17 -O2 "$here/peers/siconos.cpp" -o "$work/siconos" -I$siconos -I$siconos/kernel -I$siconos/numerics \
    -I$siconos/externals -lsiconos_kernel -lsiconos_numerics
# its own standard of C++ would be older
g++ $(pkg-config --cflags simbody) -std=c++14 -O2 "$here/peers/simbody.cpp" -o "$work/simbody" $(pkg-config --libs simbody)

programs="percuss scipy exudyn siconos simbody calculix mujoco drake"
echo "peers: the same impacts in $programs: some twenty minutes"
echo "scene,program,settings,error,seconds,why" >"$work/peers.csv"
for program in $programs; do
    OMP_NUM_THREADS=1 PEERS="$work" OPENBLAS_NUM_THREADS=1 PERCUSS_LIBRARY="$build/client/libpercuss.so" \
        PYTHONPATH="$source/client/python" "$work/venv/bin/python" "$here/peers/peers.py" $program "$work/peers.csv" \
        >"$work/$program.log" 2>&1 || {
        tail -n 20 "$work/$program.log" >&2
        exit 1
    }
done
cp "$work/peers.csv" "$output/peers.csv"

# of each program the settings that nothing beats in both: error, seconds
for scene in rod beam; do
    for program in $programs; do
        awk -F, -v scene=$scene -v program=$program '$1 == scene && $2 == program && $4 != "" && $4 + 0 < 1 { print $4, $5 }' \
            "$output/peers.csv" | sort -g -k 2 -k 1 |
            awk '!seen || $1 + 0 < least { print; least = $1 + 0; seen = 1 }' >"$work/$scene-$program.dat"
    done
done
gnuplot -e "folder='$work'; output_name='$output/peers'" "$here/peers/peers.gp"
python3 "$here/peers/table.py" "$output/peers.csv" "$source/docs/lab/peers.md"

sh "$here/peers/solids.sh" "$build" "$output" "$work/venv/bin/python"
echo "peers: $output/peers.csv, $output/solids.csv, $output/peers.svg"
