#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The solver in the process of who asks: a daemon's answers to the byte, without one, from the command line
# and from a program that loads the library while it runs.
. "$(dirname "$0")/../support/lib.sh"

paper="--a steel-sphere --b"

in_process() {
    command=$1
    shift
    "$bin/percuss" "$command" --local --config "$work/percussd.yaml" "$@"
}

# asked HOW COMMAND [ARGUMENT...]: what it says and writes, without what differs from one asking to the next;
# however long it takes
asked() {
    rm -f "$work/file.csv"
    code=0
    "$@" --timeout 600 >"$out" 2>"$err" 9>&- || code=$?
    shift
    echo "== $* -> $code"
    numbers "$out" | sed -e '/"client":/d' -e '/"server":/d' -e '/"queue":/d' -e '/"solve":/d' -e '/^ *server /d'
    # whose catalogue lacks a body
    sed '/that is the catalogue /d' "$err"
    cat "$work/file.csv" 2>/dev/null || true
}

# all HOW: questions of every kind
all() {
    asked "$1" bodies --json
    for body in al-rod al-rod-1 al-rod-2 al-beam al-cylinder al-half-plate steel-wall nobody; do
        asked "$1" query $paper $body --speed 0.3 --json
    done
    for model in hertz closed-form table complete-fe; do
        asked "$1" query $paper al-rod-1 --speed 0.3 --contact-model $model --json
    done
    asked "$1" query $paper al-cylinder --speed 0.3 --contact-model concurrent-fe --json
    # of the default tolerance CVODE takes a minute each time
    asked "$1" query $paper al-beam --speed 0.25 --method cvode --tolerance 0.01 --json
    asked "$1" query $paper al-beam --speed 0.25 --speed-sigma 0.01 --json
    asked "$1" query $paper al-beam --speed 0.3 --trace "$work/file.csv"
    asked "$1" query $paper al-beam --speed 1 --tolerance 7
    asked "$1" sweep $paper al-rod-1 --speed 0.1:0.4:5 --csv
    asked "$1" ensemble $paper al-beam --speed uniform:0.1:0.4 --samples 300 --json --csv "$work/file.csv"
    asked "$1" ensemble $paper al-beam --speed uniform:0.4:0.1 --samples 10
    asked "$1" compare "$source_dir/client/examples/measured/synthetic-beam.csv" $paper al-beam --csv
}

say "a newcomer's first command needs no daemon"
expect 0 "$bin/percuss" query --local $paper al-rod --speed 0.1
shows "restitution  0.72"
shows "server       none"
expect 0 "$bin/percuss" --local status
shows "solves in this process"
expect 0 "$bin/percuss" --local ping
expect 0 "$bin/percuss" --local dents

say "what it cannot do it says as a client does"
expect 5 in_process query $paper nobody --speed 1
expect 2 in_process query $paper al-rod --speed -1
expect 4 in_process query $paper al-rod-1 --contact-model complete-fe --speed 0.3 --timeout 0.01
says "is not answered in time"
expect 2 in_process bodies --catalogue "$work/none.yaml"
says "none.yaml"
expect 2 in_process bodies --config "$work/none.yaml"
says "none.yaml"
expect 2 "$bin/percuss" query --catalogue "$work/catalogue.yaml" $paper al-rod --speed 1
says "needs --local"

say "every answer is the daemon's, to the byte"
cp -r "$source_dir/config/tables" "$work/tables"
settings "tables: tables"
start_daemon
all percuss >"$work/by_daemon"
expect 0 "$build/tests/bench/in_process" "$domain" 20
stop_daemon
all in_process >"$work/by_itself"
diff "$work/by_daemon" "$work/by_itself" >"$out" || fail "the answers differ"
[ "$(grep -c '^== ' "$work/by_itself")" -eq 22 ] || fail "not all was asked"

say "for any number of threads"
ensemble="ensemble $paper al-rod-1 --speed normal:0.3:0.05 --samples 200 --json"
for workers in 1 3; do
    settings "tables: tables" "workers: $workers"
    expect 0 in_process $ensemble
    numbers "$out" >"$work/with_$workers"
done
cmp "$work/with_1" "$work/with_3" >"$out" || fail "the number of threads shows"

say "specimens keep their dents from one program to the next, in the store that the settings name"
for how in percuss in_process; do
    settings "tables: tables" "store: $work/$how.db"
    [ $how = in_process ] || start_daemon
    for speed in 0.3 0.2 0.4; do
        asked $how query $paper al-rod-1 --speed $speed --specimen-b one --json
        asked $how query $paper al-rod-2 --speed $speed --specimen-a two --specimen-b three --json
    done >"$work/blows_$how"
    asked $how dents --json >>"$work/blows_$how"
    asked $how dents --clear --specimen two >>"$work/blows_$how"
    asked $how dents >>"$work/blows_$how"
    asked $how dents --clear --specimen two >>"$work/blows_$how"
    [ $how = in_process ] || stop_daemon
done
diff "$work/blows_percuss" "$work/blows_in_process" >"$out" || fail "the blows differ"
grep -q '"impacts": 3' "$work/blows_in_process" || fail "not all blows are counted"

say "which no daemon has open at the same time"
start_daemon
expect 2 in_process dents
says "in_process.db"
stop_daemon

say "a catalogue of one's own, and its mistakes"
sed 's/^  al-rod: .*/  al-rod: {shape: rod, material: aluminium, radius: 0.02, length: 1.0}/' \
    "$work/catalogue.yaml" >"$work/other.yaml"
expect 0 "$bin/percuss" query --local --catalogue "$work/other.yaml" $paper al-rod --speed 0.1
grep -q "restitution  0.72" "$out" && fail "the rod is the shipped one"
sed 's/radius: 0.02, length/radius: -1, length/' "$work/other.yaml" >"$work/wrong.yaml"
expect 2 "$bin/percuss" query --local --catalogue "$work/wrong.yaml" $paper al-rod --speed 0.1
says "wrong.yaml:"
says "bodies.al-rod.radius"

say "a plugin loads and unloads it, threads and all"
library=$build/client/libpercuss-local.so
if is_sanitized; then
    say "  not looked at: a sanitizer keeps it"
else
    expect 0 "$peers/unload_local" "$library" "$work/catalogue.yaml"
    shows "100 times loaded and unloaded"
fi

say "it links no DDS, and shows its own functions alone"
ldd "$library" >"$out"
grep -q 'libddsc' "$out" && fail "DDS is linked"
nm -D --defined-only "$library" | awk '$3 !~ /^percuss_[a-z_]*$/' >"$out"
[ ! -s "$out" ] || fail "other symbols leave the library"
nm -D --undefined-only "$library" | grep ' dds_' >"$out" && fail "it calls DDS"
exit 0
