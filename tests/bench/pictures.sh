#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Redoes the pictures in docs/figures that the pages on measurements, uncertainty and contact models draw with
# percuss --plot, by the commands that stand there. (Those of the paper's page: client/examples/paper/run.sh.)
# usage: pictures.sh [BUILD]
set -eu
cd "$(dirname "$0")/../.."
percuss=${1:-build}/bin/percuss
figures=docs/figures
measured=client/examples/measured

draw() {
    command=$1
    picture=$2
    shift 2
    "$percuss" "$command" --local --a steel-sphere "$@" --plot "$figures/$picture" >/dev/null
}

draw compare compare-beam.png "$measured/synthetic-beam.csv" --b al-beam
draw query histories-beam.png --b al-beam --speed 0.276 --measured "$measured/synthetic-history-1.csv"
draw ensemble ensemble-beam.png --b al-beam --speed uniform:0.089:0.411 --samples 100000
draw sweep restitution-rods.png --b al-rod-1 --b al-rod-2 --contact-model hertz --contact-model auto \
    --speed 0.02:0.5:49
