#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Asks a build a set of questions of every kind and writes all that it answers, to the last bit:
# random scenes (single contacts, groups, ringing and dented bodies, every contact model), batches,
# the simulator's own masses, refusals, ensembles, sweeps, traces, specimens, tables. Two builds that
# should behave alike give the same file on one machine; compare.sh does both.
# usage: record.sh SCENES FILE      SCENES: a folder by save_scenes
# environment: PERCUSS_BUILD, PERCUSS_SOURCE: the build and its sources; PERCUSS_PYTHON: a Python with numpy;
#   PERCUSS_IN_PROCESS=1: no daemon is asked, but the solver in each asking process
ask_py=$(cd "$(dirname "$0")" && pwd)/ask.py
. "$(dirname "$0")/../service/support/lib.sh"
scenes=$(cd "$1" && pwd)
record=$2

python() {
    PYTHONPATH=$source_dir/client/python PERCUSS_LIBRARY=$build/client/libpercuss.so PYTHONDONTWRITEBYTECODE=1 \
        "${PERCUSS_PYTHON:-python3}" "$ask_py" "$@" 9>&-
}

# kept COMMAND [ARGUMENT...]: its output, messages and exit code, without what differs from one asking to the next
kept() {
    code=0
    percuss "$@" --timeout 120 >"$out" 2>"$err" 9>&- || code=$?
    echo "== percuss $* -> $code" | sed "s|$work/||; s|$source_dir/||"
    numbers "$out" | sed -e '/"client":/d' -e '/"server":/d' -e '/"version":/d' -e '/^ *server /d' \
        -e '/"queue":/d' -e '/"solve":/d'
    cat "$err"
}

paper="--a steel-sphere --b"
whom=$domain
if [ "${PERCUSS_IN_PROCESS:-}" ]; then
    whom=$work/percussd.yaml
    percuss() {
        command=$1
        shift
        "$bin/percuss" "$command" --local --config "$whom" "$@"
    }
fi

single_questions() {
    kept bodies --json
    for body in al-rod al-rod-1 al-rod-2 al-beam al-cylinder steel-wall; do
        for model in auto hertz closed-form; do
            kept query $paper $body --speed 0.3 --contact-model $model --json
        done
    done
    for body in al-rod-1 al-rod-2 al-beam; do
        kept query $paper $body --speed 0.3 --contact-model table --json
    done
    for body in al-rod-2 al-beam al-cylinder; do
        kept query $paper $body --speed 0.3 --contact-model concurrent-fe --json
    done
    for body in al-cylinder al-rod-1; do
        kept query $paper $body --speed 0.3 --contact-model complete-fe --json
    done
    for body in al-rod al-rod-1 al-beam al-beam-pinned timoshenko-beam al-cylinder; do
        kept query $paper $body --speed 0.25 --method cvode --json
        kept query $paper $body --speed 0.25 --tolerance 1e-5 --compliance half-space
        kept query $paper $body --speed 0.25 --speed-sigma 0.01 --at 0.3 --json
    done
    for speed in 0.001 0.02 3 30 200; do
        kept query $paper al-rod-1 --speed $speed --json
        kept query $paper al-beam --speed $speed --horizon 0.005 --json
    done
    kept query $paper nobody --speed 1
    kept query $paper al-beam --speed -1
    kept query $paper al-beam --speed 1 --at 1.5
    kept query $paper al-beam --speed 1 --tolerance 7
}

# three blows on each of two specimens, which keep their dents
blows_on_specimens() {
    for speed in 0.3 0.2 0.4; do
        kept query $paper al-rod-1 --speed $speed --specimen-b one --json
        kept query $paper al-rod-2 --speed $speed --specimen-a two --specimen-b three --json
    done
    kept dents
    kept dents --clear --specimen two
    kept dents --json
}

time_histories() {
    for body in al-rod-1 al-beam; do
        kept query $paper $body --speed 0.3 --trace "$work/trace.csv"
        cat "$work/trace.csv"
    done
}

many_impacts() {
    for body in al-rod-1 al-beam; do
        kept sweep $paper $body --speed 0.1:0.4:7 --csv
    done
    for sampling in plain latin-hypercube sobol; do
        kept ensemble $paper al-beam --speed uniform:0.1:0.4 --input young@al-beam=normal:70e9:1e9 \
            --samples 512 --sampling $sampling --json --csv "$work/samples.csv"
        cat "$work/samples.csv"
    done
    kept ensemble $paper al-rod-1 --speed normal:0.3:0.05 --input yield@al-rod-1=uniform:150e6:250e6 \
        --input radius@steel-sphere=normal:0.015:0.0002 --correlate 1,2=0.5 --samples 200 --json
    kept ensemble $paper al-rod-2 --speed uniform:0.1:0.4 --contact-model table --samples 200 --json
    kept ensemble $paper al-beam --speed normal:0.2:0.02 --input site@al-beam=uniform:0.2:0.5 \
        --input damping@al-beam=log-normal:0.01:0.003 --half-width 0.01 --samples 2000 --json
    kept ensemble $paper al-beam --speed uniform:0.4:0.1 --samples 10
    kept ensemble $paper al-beam --speed 0.1 --input length@al-beam=1 --samples 10
    kept compare "$source_dir/client/examples/measured/synthetic-beam.csv" $paper al-beam --csv
}

# the catalogue of the scenes, with that of the shipped bodies
catalogue_of_all() {
    python catalogue "$scenes" | sed '/^contact:/d' >"$work/scenes.yaml"
    awk 'NR == FNR { if (/^[a-z]/) { part = $1 } else more[part] = more[part] $0 "\n"; next }
         { print } /^(materials|bodies):/ { printf "%s", more[$1] }' \
        "$work/scenes.yaml" "$source_dir/config/catalogue.yaml" >"$work/catalogue.yaml"
}

catalogue_of_all
cp -r "$source_dir/config/tables" "$work/tables"
settings "tables: tables" "store: $work/specimens.db"
[ "${PERCUSS_IN_PROCESS:-}" ] || start_daemon
{
    python "$whom" "$scenes" || fail "ask.py"
    single_questions
    blows_on_specimens
    time_histories
    many_impacts
} >"$record"
# a warning's command has the paths of this run and of its build, and a daemon says which one it is
sed -i "s|$work|WORK|g; s|$build|BUILD|g; s|^\\(percuss: that is the catalogue [^ ]*\\) of percussd .*|\\1|" "$record"
[ "${PERCUSS_IN_PROCESS:-}" ] || stop_daemon
echo "$(grep -c '^{"asked"\|^== percuss' "$record") questions, $(wc -c <"$record") bytes in $record"
