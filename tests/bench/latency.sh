#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Measures what the service costs its callers and writes the tables of docs/lab/latency.md between its marks. The bare
# round trip and the service are measured several times, each time anew: the tables have the medians of the runs, and
# of the ratio the least and the largest. Two minutes on a machine that has nothing else to do.
# usage: latency.sh [--quick] [BUILD [FOLDER]]    BUILD: build; --quick: few turns, to see that it works; a copy of
#                                                 docs/lab to write to instead
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
runs=5 turns=2000 answers=1000
if [ "${1:-}" = --quick ]; then
    runs=2 turns=64 answers=10
    shift
fi
bench=${1:-$root/build}/tests/bench
page=${2:-$root/docs/lab}/latency.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# as the page calls the scenes
named='function named(scene) {
    if (scene ~ /^rod/) return "rod 0.3 m/s, 1e-4"
    if (scene ~ /^beam/) return "beam 0.2 m/s, " substr(scene, 6)
    return scene
}
function order(scene) { if (!(scene in seen)) { seen[scene] = 1; scenes[++many] = scene } }
function median(list,  n, part, i, j, kept) {
    n = split(list, part, " ")
    for (i = 2; i <= n; i++)
        for (j = i; j > 1 && part[j] + 0 < part[j - 1] + 0; j--) {
            kept = part[j]; part[j] = part[j - 1]; part[j - 1] = kept
        }
    least = part[1]; most = part[n]
    return n % 2 ? part[(n + 1) / 2] : (part[n / 2] + part[n / 2 + 1]) / 2
}'

# of FILE, lines of scene, asks, gets, raw, p99, service, p99, ratio, solve, busy, rest
trips() {
    awk "$named"'
    NF == 11 && $4 + 0 > 0 { order($1); for (i = 4; i <= NF; i++) all[$1, i] = all[$1, i] " " $i }
    END {
        print "| scene | raw | p99 | service | p99 | ratio | least to most | solve | busy | rest |"
        print "|---|---|---|---|---|---|---|---|---|---|"
        for (s = 1; s <= many; s++) {
            line = "| " named(scenes[s]) " |"
            for (i = 4; i <= 11; i++) {
                value = median(all[scenes[s], i])
                if (i == 8) line = line sprintf(" %.2f | %.2f to %.2f |", value, least, most)
                else if (i == 9 && scenes[s] == "ping") line = line " |"
                else line = line sprintf(" %.0f |", value)
            }
            print line
        }
    }' "$1"
}

# of FILE, lines as round_trip --throughput --csv prints them
throughput() {
    awk -F, "$named"'
    $5 + 0 > 0 { order($1); rate[$1, $2] = rate[$1, $2] " " $5; cpu[$1, $2] = cpu[$1, $2] " " 1e6 * $8 }
    function thousands(n) { return sprintf(n < 10000 ? "%d" : "%d %03d", n < 10000 ? n : n / 1000, n % 1000) }
    function both(scene, mode) {
        return sprintf(" %s | %.0f µs |", thousands(100 * int(median(rate[scene, mode]) / 100 + 0.5)),
            median(cpu[scene, mode]))
    }
    END {
        print "| scene | one client, batches of 64: requests/s | CPU per request | 8 clients with 64 outstanding: requests/s | CPU per request |"
        print "|---|---|---|---|---|"
        for (s = 1; s <= many; s++)
            print "| " named(scenes[s]) " |" both(scenes[s], "batch") both(scenes[s], "pipeline")
    }' "$1"
}

# of FILE, lines as fixed_part --csv prints them
fixed() {
    awk -F, "$named"'
    $2 + 0 > 0 { order($1); for (i = 3; i <= NF; i++) all[$1, i] = all[$1, i] " " 1e6 * $i }
    END {
        print "| scene | answer | solution | fixed | without a trip: answer | solution | fixed |"
        print "|---|---|---|---|---|---|---|"
        for (s = 1; s <= many; s++) {
            line = "| " named(scenes[s]) " |"
            for (i = 3; i <= 8; i++) line = line sprintf(" %.1f |", median(all[scenes[s], i]))
            print line
        }
    }' "$1"
}

for run in $(seq "$runs"); do
    echo "latency: run $run of $runs" >&2
    "$bench/round_trip" --trips "$turns" >>"$work/trips"
    "$bench/round_trip" --throughput --csv --trips "$turns" >>"$work/throughput"
    "$bench/fixed_part" --csv --trips "$answers" >>"$work/fixed"
done
for table in trips throughput fixed; do
    "$table" "$work/$table" >"$work/$table.table"
    sh "$root/tests/bench/tables.sh" "$page" "$work/$table.table" "$table"
done
cat "$work"/*.table
