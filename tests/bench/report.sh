#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Measures speed against error and redoes the data and the figures in docs/figures/ and the tables in
# docs/lab/work-precision.md. Some five minutes on one core.
# usage: report.sh [--csv FILE] [BUILD]   (BUILD: build; --csv: figures and tables of an earlier run)
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
figures=$root/docs/figures
page=$root/docs/lab/work-precision.md
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

# A method's curve is its settings from the loosest to the tightest, of one kind. What it takes to be at an error: no
# setting counts whose error, or that of a tighter one, is larger, so that none is good by chance; between the last
# that is not and the first that counts along a straight line of the logarithms. The same for all methods.
tables() {
    awk -F, '
    function text(s) {
        if (s == "") return "–"
        if (s < 1e-3) return sprintf("%.3g µs", s * 1e6)
        if (s < 1) return sprintf("%.3g ms", s * 1e3)
        return sprintf("%.3g s", s)
    }
    function ratio(a, b) { return a == "" || b == "" ? "–" : sprintf(a < 10 * b ? "%.2g" : "%.0f", a / b) }
    function seconds(curve, limit,  i, worst, reached, best) {
        for (i = settings[curve]; i > 0; i--) {
            if (error[curve, i] > worst) worst = error[curve, i]
            if (worst > limit) break
            reached = worst
            if (best == "" || time[curve, i] < best) best = time[curve, i]
        }
        if (i == 0 || best == "" || reached <= 0 || time[curve, i] >= best) return best
        return time[curve, i] * (best / time[curve, i]) ^ (log(worst / limit) / log(worst / reached))
    }
    # of the curves whose names match, the fastest
    function at(scene, pattern, limit,  c, s, best) {
        for (c = 1; c <= curves[scene]; c++) {
            if (curve[scene, c] !~ pattern) continue
            s = seconds(scene "," curve[scene, c], limit)
            if (s != "" && (best == "" || s < best)) best = s
        }
        return best
    }
    NR > 1 {
        if (!($1 in curves)) scenes[++count] = $1
        kind = $3
        sub(/^[a-z]+=[^ ]*/, "", kind)
        name = $1 "," $2 kind
        if (!(name in settings)) curve[$1, ++curves[$1]] = $2 kind
        i = ++settings[name]
        error[name, i] = $5 + 0
        time[name, i] = $6 + 0
        if ($3 == "tolerance=1e-03") asked[$1, $2] = $6 + 0
    }
    END {
        methods = split("modal cvode-adams cvode-bdf arkode-explicit verlet", method, " ")
        print "| scene | method | 1e-3 | 1e-6 | 1e-9 |\n|---|---|---|---|---|"
        for (s = 1; s <= count; s++)
            for (m = 1; m <= methods; m++)
                print "| " scenes[s] " | " method[m] " | " text(at(scenes[s], "^" method[m] "( |$)", 1e-3)) " | " \
                    text(at(scenes[s], "^" method[m] "( |$)", 1e-6)) " | " \
                    text(at(scenes[s], "^" method[m] "( |$)", 1e-9)) " |"
        print "\nTimes relative to modal, error 1e-6:\n"
        print "| scene | CVODE, best | CVODE, flights too | ARKODE | Verlet |\n|---|---|---|---|---|"
        for (s = 1; s <= count; s++) {
            own = at(scenes[s], "^modal$", 1e-6)
            print "| " scenes[s] " | " ratio(at(scenes[s], "^cvode", 1e-6), own) " | " \
                ratio(at(scenes[s], "^cvode.* whole", 1e-6), own) " | " \
                ratio(at(scenes[s], "^arkode", 1e-6), own) " | " ratio(at(scenes[s], "^verlet", 1e-6), own) " |"
        }
        print "\nWhole answers (modal-solve), error against all modes; and when 1e-3 is asked for:\n"
        print "| scene | 1e-3 | 1e-6 | CVODE, best, relative to that | asked for 1e-3 | the first time (modal-first) |"
        print "|---|---|---|---|---|---|"
        for (s = 1; s <= count; s++) {
            own = at(scenes[s], "^modal-solve$", 1e-6)
            if (own != "")
                print "| " scenes[s] " | " text(at(scenes[s], "^modal-solve$", 1e-3)) " | " text(own) " | " \
                    ratio(at(scenes[s], "^cvode", 1e-6), own) " | " text(asked[scenes[s], "modal-solve"]) " | " \
                    text(asked[scenes[s], "modal-first"]) " |"
        }
    }' "$data"
}

tables >"$work/tables"
sh "$root/tests/bench/tables.sh" "$page" "$work/tables"
cat "$work/tables"
