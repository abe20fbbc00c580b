#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Whole programs of which a call for memory or an operation on files fails: they end by themselves, with a
# status of theirs, say why, and leave nothing under a file's name but the whole of it.
# PERCUSS_FAULTS=whole: each call; otherwise some of them, and each operation on files.
. "$(dirname "$0")/../support/lib.sh"
. "$support/block_deck.sh"

interpose=$build/tests/libinterpose.so
[ -e "$interpose" ] || fail "no $interpose"
if is_sanitized thread; then
    echo "the thread sanitizer bears nothing in front of it"
    exit 77
fi
interpose=$(preload "$interpose")
files=$work/files
run=
whole=$work/whole

# fault KIND N HOW COMMAND...: the N-th call fails: `files`, those in $files; else the program's own calls
# for memory and those of its readers of JSON, YAML and tables
fault() {
    kind=$1 at=$2 how=$3
    shift 3
    case $kind in
    files) set -- PERCUSS_FAULT_PATH="$files" "$@" ;;
    memory) set -- PERCUSS_FAULT_MEMORY=libpercuss:libjansson:libyaml "$@" ;;
    esac
    $run env LD_PRELOAD="$interpose" PERCUSS_FAULT_PROGRAM="$program" PERCUSS_FAULT_COUNT="$work/count" \
        PERCUSS_FAULT_AT="$at" PERCUSS_FAULT_DO="$how" "$@"
}

# differs FILE: from the whole one. Tables and bodies hold how long they took
differs() {
    case $1 in
    *.json) ! grep -v '"seconds"' "$files/$1" | cmp -s - "$work/table" ;;
    *.html) [ "$(tail -n 1 "$files/$1")" != "</html>" ] ;; # which question it was, and how long it took
    *.h5) [ "$(wc -c <"$files/$1")" -ne "$(wc -c <"$whole/$1")" ] ;;
    *) ! cmp -s "$files/$1" "$whole/$1" ;;
    esac
}

# judge WHERE: what the last trial came to
judge() {
    [ "$code" -le 5 ] || fail "$1: exit code $code"
    [ "$code" -eq 0 ] || [ -s "$err" ] || fail "$1: exit code $code without a word"
    for file in "$files"/*; do
        name=${file##*/}
        [ -e "$file" ] || continue
        # where nothing can be removed any more, an empty file or one with a name of its own stays
        [ "$how" != fail-on ] || [ "$kind" != files ] || [ -e "$whole/$name" ] || continue
        [ "$how" != fail-on ] || [ "$kind" != files ] || [ -s "$file" ] || continue
        [ -e "$whole/$name" ] || fail "$1: $name is left"
        ! differs "$name" || fail "$1: half of $name"
    done
    [ "$code" -ne 0 ] || [ "$(ls "$files")" = "$(ls "$whole")" ] || fail "$1: well, but not all files"
}

# try KIND POINTS COMMAND...: all calls fail in turn, or about so many of them
try() {
    kind=$1 points=$2
    shift 2
    program=${1##*/}
    rm -rf "$files" "$whole"
    mkdir "$files"
    expect 0 fault "$kind" 0 fail "$@"
    cp -r "$files" "$whole"
    cat "$whole"/*.json 2>/dev/null | grep -v '"seconds"' >"$work/table" || true
    calls=$(cat "$work/count")
    [ "$calls" -gt 0 ] || fail "$kind: nothing is counted: $*"
    stride=$(((calls + points - 1) / points))
    [ "${PERCUSS_FAULTS:-}" != whole ] || stride=1
    tried=0 failed=0 at=1
    while [ "$at" -le "$calls" ]; do
        for how in fail fail-on; do
            rm -rf "$files"
            mkdir "$files"
            code=0
            fault "$kind" "$at" "$how" timeout 60 "$@" >"$out" 2>"$err" </dev/null 9>&- || code=$?
            judge "$kind, call $at of $calls, $how: $*"
            tried=$((tried + 1))
            [ "$code" -eq 0 ] || failed=$((failed + 1))
        done
        at=$((at + stride))
    done
    echo "  $program, $kind: $tried trials at $calls calls, $failed said so"
    [ "$failed" -gt 0 ] || fail "nothing failed"
}

say "what needs no server"
block 4 2 1 >"$work/block.inp"
reduce="$bin/percuss-reduce $work/block.inp --unit mm -o $files/block.h5 --young 210e9 --poisson 0.3
    --density 7800 --modes 4 --vtk $files/block.vtu"
cat >"$work/two.yaml" <<'YAML'
materials:
  glass:  {young: 48e9, poisson: 0.20, density: 2800}
  al-575: {young: 70e9, poisson: 0.33, density: 2700, yield: 575e6, tangent: 0}
bodies:
  glass-sphere: {shape: sphere, material: glass, radius: 0.010}
  rod: {shape: rod, material: al-575, radius: 0.010, length: 1.0}
YAML
tables="$bin/percuss-tables --catalogue $work/two.yaml --folder $files --speed 0.05 --resolution 6"
try files 100 $tables
try memory 20 $tables
try files 20 $reduce
try memory 15 $reduce
try memory 10 "$bin/percuss" schema request
try memory 10 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" --check-config

say "what a server answers"
start_daemon
pair="--a steel-sphere --b al-beam --domain $domain"
data=$source_dir/client/examples/measured/synthetic-beam.csv
try files 100 "$bin/percuss" query $pair --speed 0.3 --plot "$files/plot.png" --trace "$files/trace.csv"
try files 60 "$bin/percuss" query $pair --speed 0.3 --plot-data "$files"
try memory 8 "$bin/percuss" query $pair --speed 0.3 --plot-data "$files"
try memory 10 "$bin/percuss" query $pair --speed 0.3 --json --trace "$files/trace.csv" --html "$files/impact.html"
try files 100 "$bin/percuss" ensemble $pair --speed uniform:0.1:0.3 --samples 50 --csv "$files/samples.csv"
try memory 10 "$bin/percuss" ensemble $pair --speed uniform:0.1:0.3 --samples 50 --json --html "$files/samples.html"
try files 100 "$bin/percuss" sweep $pair --speed 0.1:0.3:3 --plot "$files/plot.svg"
try memory 10 "$bin/percuss" sweep $pair --speed 0.1:0.3:3 --csv --html "$files/sweep.html"
try memory 8 "$bin/percuss" compare "$data" $pair
stop_daemon

say "a daemon: it does not start, or it answers, or says that it cannot, and ends well"
program=percussd
# live KIND N HOW: one life
live() {
    rm -rf "$files"
    mkdir -p "$files"
    settings "store: $files/specimens.db"
    : >"$log"
    run=exec
    fault "$1" "$2" "$3" "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" 2>>"$log" 9>&- &
    daemon=$!
    run=
    wait_for 30 is_up_or_dead || fail "$1, call $2, $3: neither ready nor dead after 30 s"
    if logged 'ready: domain'; then
        code=0
        query --contact-model closed-form --timeout 20 --specimen-b bar >"$out" 2>"$err" 9>&- || code=$?
        case $code in
        0) ;;
        5) says INTERNAL ;;
        *) fail "$1, call $2, $3: exit code $code" ;;
        esac
        stop_daemon
        return
    fi
    code=0
    wait "$daemon" || code=$?
    daemon=
    [ "$code" -eq 1 ] && [ -s "$log" ] || fail "$1, call $2, $3: it ends with $code"
}
for kind in files memory; do
    live "$kind" 0 fail
    calls=$(cat "$work/count")
    stride=$((calls / 20 + 1))
    [ "${PERCUSS_FAULTS:-}" != whole ] || stride=1
    at=2
    while [ "$at" -le "$calls" ]; do
        live "$kind" "$at" fail
        at=$((at + stride))
    done
    echo "  percussd, $kind: at every $stride. of $calls calls"
done
