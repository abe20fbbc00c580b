#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Compares the contact region with CalculiX (Debian: calculix-ccx), an independent FE program with its
# own elements, plasticity and contact, on the paper's sphere (R 15 mm) and rod material.
# usage: calculix.sh BUILD_DIR [RESOLUTION]
set -eu
deck=$1/tests/bench/calculix_deck
resolution=${2:-16}
command -v ccx >/dev/null || {
    echo "calculix.sh: ccx is missing: apt-get install calculix-ccx" >&2
    exit 77
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
echo "indentation yield ours error calculix difference"
for case in "1e-5 inf" "5e-6 205e6" "1e-5 205e6" "2e-5 205e6"; do
    set -- $case
    "$deck" "$1" "$2" "$resolution" >"$folder/deck.inp" 2>"$folder/ours"
    (cd "$folder" && timeout 1200 ccx -i deck >ccx.log 2>&1)
    # the last line holds the forces on the two-degree wedge that CalculiX makes of an axisymmetric body
    theirs=$(awk 'NF == 3 { fy = $2 } END { printf "%.8g", 180 * fy }' "$folder/deck.dat")
    read -r ours error <"$folder/ours"
    awk -v d="$1" -v y="$2" -v o="$ours" -v e="$error" -v c="$theirs" \
        'BEGIN { printf "%s %s %.2f %.2g %.2f %+.2f%%\n", d, y, o, e, c, 100 * (o / c - 1) }'
done
