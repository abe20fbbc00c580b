#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# percuss-ensemble in one, two and four processes of mpirun says to the byte what one process says.
. "$(dirname "$0")/../support/lib.sh"
[ -x "$bin/percuss-ensemble" ] || {
    echo "skipped: percuss-ensemble was not built: no MPI"
    exit 77
}
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1
paper="--a steel-sphere --b al-beam --speed uniform:0.1:0.4 --config $work/percussd.yaml"

# spread RANKS ARGUMENT...
spread() {
    ranks=$1
    shift
    mpirun --oversubscribe -n "$ranks" "$bin/percuss-ensemble" "$@"
}

plain() {
    numbers "$1" | sed -e '/"client":/d' -e '/"server":/d' -e '/"queue":/d' -e '/"solve":/d'
}

# same ARGUMENT...: for any number of processes
same() {
    expect 0 "$bin/percuss" ensemble --local "$@" --json --csv "$work/alone.csv"
    plain "$out" >"$work/alone"
    for ranks in 1 2 4; do
        expect 0 spread $ranks "$@" --json --csv "$work/spread.csv"
        plain "$out" >"$work/spread"
        cmp "$work/alone" "$work/spread" || fail "another report by $ranks processes: $*"
        cmp "$work/alone.csv" "$work/spread.csv" || fail "other samples by $ranks processes: $*"
    done
}

say "the same report and the same samples for any number of processes"
same $paper --input young@al-beam=normal:70e9:1e9 --samples 1500
same $paper --samples 512 --sampling sobol --input radius@steel-sphere=normal:0.015:0.0002

say "and stopped early at the same sample"
same $paper --samples 20000 --half-width 0.02

say "a sweep is an ensemble whose speeds are a list"
{
    echo speed
    seq 0.1 0.01 0.4
} >"$work/speeds.csv"
same --a steel-sphere --b al-beam --speed "list:$work/speeds.csv" --config "$work/percussd.yaml"
[ "$(wc -l <"$work/spread.csv")" -eq 32 ] || fail "it has not a row for each speed"

say "what a daemon says of it"
start_daemon
expect 0 percuss ensemble --a steel-sphere --b al-beam --speed uniform:0.1:0.4 --samples 700 --json
plain "$out" >"$work/daemon"
stop_daemon
expect 0 spread 3 $paper --samples 700 --json
plain "$out" >"$work/spread"
cmp "$work/daemon" "$work/spread" || fail "another report than the daemon's"

say "what is wrong is said once"
expect 5 spread 2 --a steel-sphere --b nobody --speed uniform:0.1:0.4 --config "$work/percussd.yaml"
[ "$(grep -c UNKNOWN_BODY "$err")" -eq 1 ] || fail "it is said $(grep -c UNKNOWN_BODY "$err") times"
expect 2 spread 2 $paper --samples nonsense
[ "$(grep -c "'nonsense'" "$err")" -eq 1 ] || fail "it is said more than once"

expect 2 spread 2 --a steel-sphere --b al-beam --speed uniform:0.1:0.4 --catalogue "$work/none.yaml"
[ "$(grep -c "none.yaml: cannot be read" "$err")" -eq 1 ] || fail "it is not said once"

# uneven OPTIONS: a second process with these; its command line is not the first one's
uneven() {
    first="--a steel-sphere --b al-beam --samples 300"
    mpirun --oversubscribe -n 1 "$bin/percuss-ensemble" $first --catalogue "$work/catalogue.yaml" \
        --speed uniform:0.1:0.4 : -n 1 "$bin/percuss-ensemble" $first "$@"
}

say "a process that has been given something else ends all, and says why"
sed 's/^  al-beam:/  a-beam:/' "$work/catalogue.yaml" >"$work/other.yaml"
expect 1 uneven --catalogue "$work/other.yaml" --speed uniform:0.1:0.4
says "process 1: bodies[1].id: 'al-beam': not in the catalogue"
expect 5 uneven --catalogue "$work/catalogue.yaml" --speed uniform:0.1:0.3
says "a process has solved something else: part: of another request"

say "an interrupt leaves what was found"
mpirun --oversubscribe -n 2 "$bin/percuss-ensemble" $paper --samples 2000000 >"$out" 2>"$err" 9>&- &
others=$!
has_workers() {
    [ "$(pgrep -c -P "$others" percuss-ensembl)" -eq 2 ]
}
wait_for 20 has_workers || fail "no processes"
sleep 2
kill -INT "$(pgrep -P "$others" percuss-ensembl | head -n 1)"
code=0
wait "$others" || code=$?
others=
shows "restitution"
grep -q "cancelled" "$out" "$err" || fail "it does not say that it was cancelled"

say "a process that dies ends all, with a word, and no report"
mpirun --oversubscribe -n 3 "$bin/percuss-ensemble" $paper --samples 2000000 >"$out" 2>"$err" 9>&- &
others=$!
has_three() {
    [ "$(pgrep -c -P "$others" percuss-ensembl)" -eq 3 ]
}
wait_for 20 has_three || fail "no processes"
sleep 1
kill -KILL "$(pgrep -P "$others" percuss-ensembl | tail -n 1)"
code=0
wait "$others" || code=$?
others=
[ "$code" -ne 0 ] || fail "it ended well"
says "signal 9"
[ ! -s "$out" ] || fail "there is a report"
