#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The figures and tables of the paper, computed: starts percussd on loopback, asks for every impact of
# them, draws them, and puts the numbers into docs/lab/paper.md of a source tree.
# Table 2 and model A of Fig. 3 are those kept in docs/figures and beside this script; with PERCUSS_PAPER=all
# they are computed anew, which takes some twenty minutes more and needs the benchmarks (tests/bench/beam_3d.sh).
# usage: run.sh [BUILD [OUTPUT [PART]...]]    (default: build/ of this source tree, BUILD/paper, and all of table_1,
# figure_1, figure_2, table_2, figure_3, figure_5, figure_6)
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../../.." && pwd)
build=${1:-$source/build}
output=${2:-$build/paper}
[ $# -le 2 ] && parts="table_1 figure_1 figure_2 table_2 figure_3 figure_5 figure_6" || {
    shift 2
    parts=$*
}
measured=$source/client/examples/measured
mkdir -p "$output"

# a domain of its own, so that nothing else on the machine is met
domain=$((100 + $$ % 100))
log=$output/percussd.log
"$build/bin/percussd" --config "$source/config/percussd.yaml" --domain "$domain" 2>"$log" &
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

# complete finite elements take minutes
ask() {
    command=$1
    shift
    "$build/bin/percuss" "$command" "$@" --domain "$domain" --timeout 900
}

# member NAME: the first number of that name in a reply on standard input
member() {
    awk -v name="\"$1\":" '$1 == name { sub(",", "", $2); print $2; exit }'
}

say() {
    echo "run: $*" >&2
}

# one row of Table 1: B, model, the name and numbers that the paper has
table_1_row() {
    ask query --a steel-sphere --b "$1" --speed 0.3 --contact-model "$2" --json >"$output/reply.json" ||
        say "$1 by $2: not within its tolerance"
    awk -v e="$(member restitution <"$output/reply.json")" -v s="$(member solve <"$output/reply.json")" \
        -v what="$3" -v its_e="$4" -v its_s="$5" \
        'BEGIN { printf "| %s | %.4f | %.2g | %s | %s |\n", what, e, s, its_e, its_s }'
}

table_1() {
    echo "| rod, model | e | s | the paper's e | the paper's s |"
    echo "|---|---|---|---|---|"
    table_1_row al-rod complete-fe "elastic, A" 0.633 462
    table_1_row al-rod concurrent-fe "elastic, B" 0.631 285
    table_1_row al-rod table "elastic, C" 0.632 0.04
    table_1_row al-rod-1 complete-fe "205 MPa, A" 0.481 937
    table_1_row al-rod-1 concurrent-fe "205 MPa, B" 0.477 354
    table_1_row al-rod-1 table "205 MPa, C" 0.477 0.05
}

figure_1() {
    ask sweep --a steel-sphere --b al-rod-1 --b al-rod-2 --contact-model hertz --contact-model auto \
        --speed 0.05:0.5:46 --measured "al-rod-1=$measured/synthetic-rod-1.csv" --measured "al-rod-2=$measured/synthetic-rod-2.csv" \
        --plot "$output/figure-1.png" --plot-data "$output/figure-1" >"$output/figure-1.txt"
}

# curves FILE.csv: one row a speed, one column a curve
curves() {
    awk -F, 'NR > 1 {
            if (!($1 in column)) { column[$1] = ++columns; name[columns] = $1 }
            if (columns == 1) speed[++rows] = $3
            e[$3, column[$1]] = $4
        }
        END {
            printf "| m/s |"; for (c = 1; c <= columns; c++) printf " %s |", name[c]; print ""
            printf "|---|"; for (c = 1; c <= columns; c++) printf "---|"; print ""
            for (r = 1; r <= rows; r++) {
                printf "| %g |", speed[r]
                for (c = 1; c <= columns; c++) printf " %.4f |", e[speed[r], c]
                print ""
            }
        }' "$1"
}

figure_2() {
    bodies="--b al-cylinder --b al-half-plate --b al-half-plate-10 --b al-rod --b al-beam"
    ask sweep --a steel-sphere $bodies --speed 0.025:0.5:96 --plot "$output/figure-2.png" \
        --plot-data "$output/figure-2" >/dev/null
    ask sweep --a steel-sphere $bodies --speed 0.05:0.5:10 --csv >"$output/figure-2.csv"
    curves "$output/figure-2.csv"
}

# one row of Table 2: the file, its model and the columns of setup and run; what the paper has
table_2_row() {
    awk -F, -v model="$2" -v setup="$3" -v run="$4" -v its_e="$5" -v its_s="$6" '
        $1 == model && $2 == 0.2 {
            printf "| %s | %.4f | %.3g | %.3g | %s | %s |\n", model, $(setup - 4), $setup, $run, its_e, its_s
        }' "$1"
}

table_2() {
    kept=$source/docs/figures
    if [ "${PERCUSS_PAPER:-}" = all ]; then
        kept=$output
        sh "$source/tests/bench/beam_3d.sh" "$build" "$output" >&2
        cp "$output/model-A.csv" "$here/model-A.csv"
    fi
    echo "| model | e | ahead, s | impact, s | the paper's e | the paper's s |"
    echo "|---|---|---|---|---|---|"
    table_2_row "$kept/beam-3d-complete.csv" A 14 15 0.707 80564
    table_2_row "$kept/beam-3d-modal.csv" B 10 11 0.700 2422
    table_2_row "$kept/beam-3d-modal.csv" C 10 11 0.717 "16 (and 1000 ahead)"
}

figure_3() {
    ask query --a steel-sphere --b al-beam --speed 0.2 --contact-model concurrent-fe --contact-model table \
        --measured "$here/model-A.csv" --plot "$output/figure-3.png" --plot-data "$output/figure-3" \
        >"$output/figure-3.txt"
}

# a speed, and what the paper says
figure_5_row() {
    awk -F, -v speed="$1" -v paper="$2" '
        NR > 1 && $1 == speed { e = $6; if ($NF == 0) starts = starts (starts ? ", " : "") sprintf("%.2f", 1e3 * $13) }
        END { printf "| %s | %.3f | %s | %s |\n", speed, e, starts, paper }' "$output/figure-5.csv"
}

figure_5() {
    ask query --a steel-sphere --b al-beam --speed 0.276 --speed 0.287 --speed 0.303 \
        --measured "$measured/synthetic-history-1.csv" --measured "$measured/synthetic-history-2.csv" \
        --measured "$measured/synthetic-history-3.csv" --plot "$output/figure-5.png" --plot-data "$output/figure-5" \
        --csv | awk -F, -v OFS=, 'NR > 1 { $1 = sprintf("%g", $1) } 1' >"$output/figure-5.csv"
    echo "| m/s | e | starts of sub-impacts, ms | the paper: simulated e; measured e; sub-impacts |"
    echo "|---|---|---|---|"
    figure_5_row 0.276 "0.687; 0.664; a second after 4 ms, a third after 5.2 ms"
    figure_5_row 0.287 "0.334; 0.620; a second after 4 ms"
    figure_5_row 0.303 "0.243; 0.230; a second after 4 ms (measured: a third after 5.7 ms)"
}

# statistics of an ensemble: mean, deviation, range
statistics() {
    awk -v what="$1" '
        function number(text) { sub(",", "", text); return text }
        $1 == "\"mean\":" && mean == "" { mean = number($2) }
        $1 == "\"standard_deviation\":" && deviation == "" { deviation = number($2) }
        $1 == "\"lowest\":" && low == "" { low = number($2) }
        $1 == "\"highest\":" && high == "" { high = number($2) }
        END { printf "| %s | %.4f | %.4f | %.2f .. %.2f |\n", what, mean, deviation, low, high }'
}

figure_6() {
    ask compare "$measured/synthetic-beam.csv" --a steel-sphere --b al-beam --plot "$output/figure-6.png" \
        --plot-data "$output/figure-6" >"$output/figure-6.txt"
    echo "| | mean of e | standard deviation | range |"
    echo "|---|---|---|---|"
    ask ensemble --a steel-sphere --b al-beam --speed uniform:0.089:0.411 --samples 100000 --json \
        --plot "$output/ensemble.png" | statistics "uniform speeds of that mean and deviation"
    ask ensemble --a steel-sphere --b al-beam --speed normal:0.25:0.0929 --samples 100000 --json |
        statistics "normal speeds of that mean and deviation"
    echo "| the paper, 53 speeds, simulated | 0.3981 | 0.2275 | 0.07 .. 0.73 |"
    echo "| the paper, 53 speeds, measured | 0.3800 | 0.2125 | |"
}

# the parts of the page between its marks are what was computed
put() {
    [ -w "$source/docs/lab/paper.md" ] || return 0
    awk -v name="$1" -v file="$output/$1.md" '
        $0 == "<!-- " name " -->" { print; while ((getline line < file) > 0) print line; skip = 1; next }
        $0 == "<!-- end -->" { skip = 0 }
        !skip' "$source/docs/lab/paper.md" >"$output/paper.md"
    cp "$output/paper.md" "$source/docs/lab/paper.md"
}

for part in $parts; do
    say "$part"
    "$part" >"$output/$part.md"
    put "$part"
done
[ ! -d "$source/docs/figures" ] || for picture in "$output"/figure-*.png; do
    cp "$picture" "$source/docs/figures/paper-$(basename "$picture")"
done
say "pictures and numbers are in $output"
