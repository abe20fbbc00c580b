#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A sweep that is interrupted, or whose server dies, leaves what was answered, and is gone on with.
. "$(dirname "$0")/../support/lib.sh"
pair="--a steel-sphere --b al-beam"
# fine enough to last
long="$pair --speed 0.1:0.3:100000 --tolerance 1e-8"

rows() {
    wc -l <"$1" | tr -d ' '
}

# begins FILE COMMAND...: in the background, its rows in FILE, until there are some
begins() {
    file=$1
    shift
    "$bin/percuss" sweep --domain "$domain" "$@" >"$file" 2>"$err" 9>&- &
    others=$!
    wait_for 20 has_rows "$file" || fail "no rows come"
}

has_rows() {
    [ -s "$1" ] && [ "$(rows "$1")" -gt 20 ]
}

# ends CODE
ends() {
    code=0
    wait "$others" || code=$?
    others=
    [ "$code" -eq "$1" ] || fail "the sweep ended with $code, not $1"
}

say "rows come one by one, and are those of the whole"
start_daemon
expect 0 percuss sweep $pair --speed 0.1:0.3:60 --csv
cp "$out" "$work/whole.csv"

say "an interrupt leaves whole rows and says how many"
begins "$work/cut.csv" $long --csv
kill -INT "$others"
ends 1
says "interrupted: $(($(rows "$work/cut.csv") - 1)) of 100000 points"
[ -z "$(tail -c 1 "$work/cut.csv" | tr -d '\n')" ] || fail "the last row is cut"

say "as JSON: one whole object with the points that are there"
"$bin/percuss" sweep --domain "$domain" $long --json >"$work/cut.json" 2>"$err" 9>&- &
others=$!
sleep 1
kill -TERM "$others"
ends 1
says "interrupted: "
python3 - "$work/cut.json" <<'EOF'
import json, sys
points = json.load(open(sys.argv[1]))["points"]
assert 0 < len(points) < 100000 and all(point["status"] == "OK" for point in points), len(points)
EOF

say "so does the death of the server"
begins "$work/dead.csv" $long --csv
kill -KILL "$daemon"
wait "$daemon" 2>/dev/null || true
ends 3
says "is gone"
says "$(($(rows "$work/dead.csv") - 1)) of 100000 points"
start_daemon

say "a file is begun, and gone on with from wherever it was cut, to the same bytes"
expect 0 percuss sweep $pair --speed 0.1:0.3:60 --resume "$work/new.csv"
cmp "$work/whole.csv" "$work/new.csv" || fail "another file than by --csv"
size=$(wc -c <"$work/whole.csv")
for share in 1 3 50 97; do
    head -c $((size * share / 100)) "$work/whole.csv" >"$work/part.csv"
    expect 0 percuss sweep $pair --speed 0.1:0.3:60 --resume "$work/part.csv" --plot "$work/part.svg"
    cmp "$work/whole.csv" "$work/part.csv" || fail "$share % are not gone on with"
done
expect 0 percuss sweep $pair --speed 0.1:0.3:60 --resume "$work/part.csv"
cmp "$work/whole.csv" "$work/part.csv" || fail "a whole file is changed"
expect 0 percuss sweep $pair --b al-rod --speed 0.1:0.3:20 --csv
cp "$out" "$work/two.csv"
head -n 25 "$work/two.csv" >"$work/part.csv"
expect 0 percuss sweep $pair --b al-rod --speed 0.1:0.3:20 --resume "$work/part.csv"
cmp "$work/two.csv" "$work/part.csv" || fail "two curves are not gone on with"

say "a file of another sweep is left as it is"
head -n 10 "$work/whole.csv" >"$work/part.csv"
cp "$work/part.csv" "$work/before.csv"
expect 2 percuss sweep $pair --speed 0.1:0.31:60 --resume "$work/part.csv"
says "part.csv:3: "
expect 2 percuss sweep --a steel-sphere --b al-rod --speed 0.1:0.3:60 --resume "$work/part.csv"
says "it has the answers to another question"
expect 2 percuss sweep $pair --b al-rod --speed 0.1:0.3:60 --resume "$work/part.csv"
says "is not the first line of this sweep"
cmp "$work/before.csv" "$work/part.csv" || fail "it was changed"
sed 's/,[^,]*$//' "$work/before.csv" >"$work/older.csv"
expect 2 percuss sweep $pair --speed 0.1:0.3:60 --resume "$work/older.csv"
says "older.csv: has no column error_total: an older percuss began it"
expect 2 percuss sweep $pair --speed 0.1:0.3:60 --resume "$work/none/part.csv"
says "--resume: $work/none/part.csv: cannot be written"

say "whoever reads the first rows only has the picture all the same"
percuss sweep $pair --speed 0.1:0.3:200 --plot "$work/whole.svg" 2>"$err" | head -n 2 >"$out"
wait_for 20 test -s "$work/whole.svg" || fail "no picture"
stop_daemon
