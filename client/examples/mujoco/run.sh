#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The paper's beam impacts inside a MuJoCo simulation: starts percussd on loopback with the scenes'
# bodies, runs the scenes, plots them, stops what it started.
# usage: run.sh [BUILD [OUTPUT]]    (default: build/ of this source tree, and BUILD/mujoco; of an
# installed tree, build-mujoco/ where you are)
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../../.." && pwd)
if [ -e "$source/CMakeLists.txt" ]; then
    build=${1:-$source/build}
    program=$build/client/examples/mujoco/percuss_mujoco
    percussd=$build/bin/percussd
    prefix=
    [ -x "$program" ] || sh "$source/deploy/dependencies.sh" test
else # share/percuss/examples/mujoco of an installed tree
    prefix=$(cd "$here/../../../.." && pwd)
    source=$(dirname "$here")
    build=${1:-build-mujoco}
    program=$build/mujoco/percuss_mujoco
    percussd=$prefix/sbin/percussd
fi
output=${2:-$build/mujoco}

if [ ! -x "$program" ]; then
    cmake -S "$source" -B "$build" -DCMAKE_BUILD_TYPE=Release ${prefix:+-DCMAKE_PREFIX_PATH="$prefix"} >&2
    cmake --build "$build" --parallel "$(nproc)" >&2
fi
[ -x "$program" ] || {
    echo "run: $program was not built: is libmujoco-dev installed?" >&2
    exit 1
}
mkdir -p "$output"

# a domain of its own, so that nothing else on the machine is met
domain=$((100 + $$ % 100))
log=$output/percussd.log
printf 'catalogue: %s\n' "$here/catalogue.yaml" >"$output/percussd.yaml"
"$percussd" --config "$output/percussd.yaml" --domain "$domain" 2>"$log" &
daemon=$!
trap 'kill "$daemon" 2>/dev/null || true; wait "$daemon" 2>/dev/null || true' EXIT
waited=0
until grep -q ready "$log"; do
    waited=$((waited + 1))
    if [ "$waited" -gt 100 ] || ! kill -0 "$daemon" 2>/dev/null; then
        cat "$log" >&2
        exit 1
    fi
    sleep 0.1
done

"$program" --domain "$domain" --scenes "$here/scenes" --output "$output"
if command -v gnuplot >/dev/null; then
    for motion in "$output"/*-*.csv; do
        scene=$(basename "$motion" .csv)
        gnuplot -e "folder='$output'; scene='$scene'" "$here/plot.gp"
    done
    echo "plots and CSV: $output"
else
    echo "CSV: $output (gnuplot is not installed: no plots)"
fi
