#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Measures speed against error and redoes the data and the figures in docs/figures/ and the tables in
# docs/work-precision.md. Some minutes on one core.
# usage: report.sh [--csv FILE] [BUILD]   (BUILD: build; --csv: figures and tables of an earlier run)
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
figures=$root/docs/figures
page=$root/docs/work-precision.md
data=$figures/work-precision.csv

given=
if [ "${1:-}" = --csv ]; then
    given=$2
    shift 2
fi
build=${1:-$root/build}

command -v gnuplot >/dev/null || {
    echo "report: gnuplot is not installed (Debian: apt-get install gnuplot-nox)" >&2
    exit 1
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$figures"

if [ -n "$given" ]; then
    cp "$given" "$work/csv"
else
    pin=
    # one core, if the system lets us
    if command -v taskset >/dev/null && taskset -c 0 true 2>/dev/null; then
        pin="taskset -c 0"
    fi
    $pin "$build/tests/bench/work_precision" --csv >"$work/csv"
fi
cp "$work/csv" "$data"

# front SCENE METHOD PATTERN: the settings that no other one beats in both error and time
front() {
    awk -F, -v s="$1" -v m="$2" -v p="$3" '$1 == s && $2 == m && $3 ~ p {
        print ($5 + 0 > 1e-16 ? $5 : 1e-16), $6 }' "$data" | sort -k2,2g |
        awk 'NR == 1 || $1 < best { print; best = $1 }'
}

for scene in rod beam; do
    for method in modal cvode-bdf arkode-explicit verlet modal-solve; do
        front "$scene" "$method" . >"$work/$scene-$method.dat"
    done
    front "$scene" cvode-adams phases >"$work/$scene-cvode-adams.dat"
    front "$scene" cvode-adams whole >"$work/$scene-cvode-adams-whole.dat"
    subject="Sphere on a rod's end, 0.3 m/s, 64 modes"
    [ "$scene" = rod ] || subject="Sphere on a free beam, 0.276 m/s, three contacts, 160 modes"
    gnuplot -e "folder=\"$work\"; scene=\"$scene\"; subject=\"$subject\"; \
        output_name=\"$figures/work-precision-$scene\"" "$root/tests/bench/work_precision.gp"
done

tables() {
    awk -F, '
    function text(s) {
        if (s == "") return "–"
        if (s < 1e-3) return sprintf("%.3g µs", s * 1e6)
        if (s < 1) return sprintf("%.3g ms", s * 1e3)
        return sprintf("%.3g s", s)
    }
    function keep(key, s) { if (!(key in best) || s < best[key]) best[key] = s }
    function ratio(a, b) { return a == "" || b == "" ? "–" : sprintf(a < 10 * b ? "%.2g" : "%.0f", a / b) }
    NR > 1 {
        if (!($1 in seen)) { seen[$1] = 1; scenes[++count] = $1 }
        for (i = 1; i <= 3; i++)
            if ($5 + 0 <= limit[i]) {
                keep($1 "," $2 "," i, $6 + 0)
                if ($2 ~ /^cvode/) keep($1 ",cvode," i, $6 + 0)
                if ($2 ~ /^cvode/ && $3 ~ /whole/) keep($1 ",cvode-whole," i, $6 + 0)
            }
    }
    BEGIN { limit[1] = 1e-3; limit[2] = 1e-6; limit[3] = 1e-9 }
    END {
        methods = split("modal cvode-adams cvode-bdf arkode-explicit verlet", method, " ")
        print "| scene | method | 1e-3 | 1e-6 | 1e-9 |\n|---|---|---|---|---|"
        for (s = 1; s <= count; s++)
            for (m = 1; m <= methods; m++) {
                row = "| " scenes[s] " | " method[m] " |"
                for (i = 1; i <= 3; i++)
                    row = row " " text(best[scenes[s] "," method[m] "," i]) " |"
                print row
            }
        print "\nTimes relative to modal, error at most 1e-6:\n"
        print "| scene | CVODE, best | CVODE, flights too | ARKODE | Verlet |\n|---|---|---|---|---|"
        for (s = 1; s <= count; s++) {
            own = best[scenes[s] ",modal,2"]
            print "| " scenes[s] " | " ratio(best[scenes[s] ",cvode,2"], own) " | " \
                ratio(best[scenes[s] ",cvode-whole,2"], own) " | " \
                ratio(best[scenes[s] ",arkode-explicit,2"], own) " | " \
                ratio(best[scenes[s] ",verlet,2"], own) " |"
        }
        print "\nWhole answers (modal-solve), error against all modes:\n"
        print "| scene | 1e-3 | 1e-6 |\n|---|---|---|"
        for (s = 1; s <= count; s++)
            if ((scenes[s] ",modal-solve,1") in best)
                print "| " scenes[s] " | " text(best[scenes[s] ",modal-solve,1"]) " | " \
                    text(best[scenes[s] ",modal-solve,2"]) " |"
    }' "$data"
}

tables >"$work/tables"
awk -v tables="$work/tables" '
    /<!-- tables end -->/ { inside = 0 }
    !inside { print }
    /<!-- tables begin -->/ { inside = 1; while ((getline line < tables) > 0) print line }
' "$page" >"$work/page"
cp "$work/page" "$page"
cat "$work/tables"
