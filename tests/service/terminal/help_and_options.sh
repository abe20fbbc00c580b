#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A user types what he types everywhere.
. "$(dirname "$0")/../support/lib.sh"

commands=$("$bin/percuss" help | sed -n '/^Commands:$/,/^$/s/^  \([a-z]*\) .*/\1/p')
[ "$(echo "$commands" | wc -w)" -ge 10 ] || fail "the commands are not listed"

say "-h, help COMMAND and --help say the same, without a server"
for name in $commands; do
    "$bin/percuss" "$name" --help >"$work/help"
    grep -q "^Usage: percuss $name" "$work/help" || fail "$name --help is not about it"
    expect 0 "$bin/percuss" "$name" -h
    cmp -s "$out" "$work/help" || fail "$name -h"
    expect 0 "$bin/percuss" help "$name"
    cmp -s "$out" "$work/help" || fail "help $name"
    grep -q "^\.Cm $name$" "$source_dir/client/man/percuss.1" || fail "the man page lacks $name"
done
"$bin/percuss" --help >"$work/help"
for arguments in -h help "help help" "help --help"; do
    # words
    # shellcheck disable=SC2086
    expect 0 "$bin/percuss" $arguments
    cmp -s "$out" "$work/help" || fail "$arguments"
done
expect 2 "$bin/percuss" help qury
says "'qury' is not a command"

say "-v and --version"
"$bin/percuss" --version >"$work/version"
grep -q '^percuss [0-9]' "$work/version" || fail "no version"
for arguments in -v -V "query -v"; do
    # shellcheck disable=SC2086
    expect 0 "$bin/percuss" $arguments
    cmp -s "$out" "$work/version" || fail "$arguments"
done

start_daemon
say "comma-separated values say what JSON says, to the last bit"
cat >"$work/same.py" <<'END'
import csv, json, math, sys

def same(text, value):  # JSON has no infinity and no nan
    number = float(text)
    return value is None and not math.isfinite(number) or number == value

kind, table, reply = sys.argv[1], list(csv.DictReader(open(sys.argv[2], newline=""))), json.load(open(sys.argv[3]))
if kind == "query":
    contact = reply["contacts"][0]
    assert len(table) == contact["sub_impact_count"] > 1, table
    for row, sub in zip(table, contact["sub_impacts"]):
        assert (row["a"], row["b"], row["status"]) == ("steel-sphere", "al-beam", "OK"), row
        for name in "restitution", "impulse", "end_time":
            assert same(row[name], contact[name]), name
        for name in "start", "end", "peak_force", "max_indentation":
            assert same(row[name], sub[name]), name
        assert same(row["sub_impulse"], sub["impulse"])
        assert row["negligible"] == str(int(sub["negligible"]))
else:
    assert [row["id"] for row in table] == [body["id"] for body in reply["bodies"]]
    for row, body in zip(table, reply["bodies"]):
        for name in "shape", "material", "description":
            assert row[name] == body[name], name
        for name in "mass", "tip_radius", "radius", "young", "poisson", "density", "yield", "tangent", "damping":
            assert same(row[name], body[name]), (body["id"], name)
        assert same(row["half_extent_z"], body["half_extents"][2])
END
for kind in query bodies; do
    set -- "$kind"
    [ "$kind" = bodies ] || set -- query --a steel-sphere --b al-beam --speed 0.2
    percuss "$@" --csv >"$work/$kind.csv"
    percuss "$@" --json >"$work/$kind.json"
    expect 0 python3 "$work/same.py" "$kind" "$work/$kind.csv" "$work/$kind.json"
    expect 2 percuss "$@" --csv --json
done
# a contact of two that never closes has its line, too
cat >"$work/two.json" <<'END'
{"bodies": [{"id": "al-beam"}, {"id": "steel-sphere", "position": [0, 0, 0.025], "velocity": [0, 0, -0.3]},
            {"id": "steel-sphere", "position": [0.4, 0, 0.025], "velocity": [0, 0, 3]}],
 "contacts": [{"a": 1, "b": 0, "point": [0, 0, 0.010], "normal": [0, 0, 1]},
              {"a": 2, "b": 0, "point": [0.4, 0, 0.010], "normal": [0, 0, 1]}]}
END
expect 0 percuss query --request "$work/two.json" --csv
[ "$(sed -n 's/^1,.*,OK,\(.*\),[^,]*$/\1/p' "$out")" = "0,nan,nan,nan,nan,nan,0" ] || fail "the line of the second contact"

say "units in their first line where they are wanted, and nothing else of them is changed"
pair="--a steel-sphere --b al-beam"
for arguments in "query $pair --speed 0.2 --csv" "bodies --csv" "sweep $pair --b al-rod --speed 0.1:0.2:2 --csv" \
    "ensemble $pair --speed 0.2 --input young@al-beam=uniform:69e9:71e9 --samples 20 --csv FILE" \
    "query $pair --speed 0.2 --trace FILE" \
    "compare $source_dir/client/examples/measured/synthetic-beam.csv $pair --csv"; do
    for units in "" --units; do
        file=$work/with$units
        # words
        # shellcheck disable=SC2086
        percuss $(echo "$arguments" | sed "s|FILE|$file|") $units >"$out" 2>"$err"
        [ "${arguments%FILE}" != "$arguments" ] || mv "$out" "$file"
    done
    head -n 1 "$work/with--units" | grep -q ' \[[A-Za-z/^3 ]*\]' || fail "no units: $arguments"
    sed '1s/ \[[^]]*\]//g' "$work/with--units" | cmp - "$work/with" || fail "more than units: $arguments"
done
grep -q 'second_start \[s\],simulated_restitution,simulated_impulse \[N s\]' "$work/with--units" ||
    fail "units of the twins"

say "a time-out says what was waited for, of whom and how long, and what to do"
# this takes a minute
expect 4 percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --contact-model complete-fe --timeout 0.7
grep -q "request [0-9]* is not answered by percussd [0-9a-f]* (process $daemon on .*) after 0\.7 s; --timeout S" "$err" ||
    fail "it does not say what was waited for"

say "on a terminal lines go on below, between words; nothing is lost, no number is broken"
# on_terminal WIDTH ARGUMENT...: what it shows, without the ends of lines that terminals have
on_terminal() {
    width=$1
    shift
    script -qec "stty cols $width; $bin/percuss $* --domain $domain 2>/dev/null" /dev/null </dev/null | tr -d '\r' >"$out"
}
for width in 40 50 80; do
    for arguments in bodies "query $pair --speed 0.3" "sweep $pair --speed 0.1:0.4:3" \
        "compare $source_dir/client/examples/measured/synthetic-heights.csv --a steel-sphere --b steel-wall"; do
        # shellcheck disable=SC2086
        percuss $arguments >"$work/whole"
        on_terminal "$width" "$arguments"
        [ "$(awk '{ if (length($0) > n) n = length($0) } END { print n }' "$work/whole")" -gt "$width" ] ||
            [ "$width" -gt 50 ] || fail "nothing is to be folded: $arguments"
        ! awk -v w="$width" 'length($0) > w { found = 1 } END { exit !found }' "$out" || fail "too wide: $arguments"
        # word for word
        for file in "$work/whole" "$out"; do
            tr -s ' \n' '\n\n' <"$file" >"$file.words"
        done
        cmp "$work/whole.words" "$out.words" || fail "not the same words: $arguments"
    done
done
on_terminal 50 bodies --json
percuss bodies --json | cmp - "$out" || fail "JSON is folded"
on_terminal 50 bodies --csv
percuss bodies --csv | cmp - "$out" || fail "CSV is folded"

say "helps and bars fit a terminal of 40 columns, but for words that are longer"
# fits FILE WHAT
fits() {
    ! awk 'length($0) > 40 && $0 ~ /[^ ] +[^ ]/ { print; found = 1 } END { exit !found }' "$1" >"$work/wide" ||
        fail "$2 is too wide: $(cat "$work/wide")"
}
for name in $commands; do
    on_terminal 40 "$name" --help
    [ "$(wc -l <"$out")" -gt 40 ] || fail "no help of $name"
    fits "$out" "the help of $name"
done
on_terminal 40 ensemble $pair --speed uniform:0.1:0.4 --samples 64 --seed 7 -v
grep -q '###' "$out" || fail "no histogram"
fits "$out" "an ensemble"
for arguments in "sweep $pair --speed 0.1:0.4:200" "ensemble $pair --speed uniform:0.1:0.4 --samples 2000"; do
    script -qec "stty cols 40; $bin/percuss $arguments --domain $domain >/dev/null" "$work/typescript" </dev/null >/dev/null
    tr '\r' '\n' <"$work/typescript" | grep '^\[' >"$work/bars" || fail "no bars of $arguments"
    ! awk 'length($0) > 40 { found = 1 } END { exit !found }' "$work/bars" || fail "a bar is too wide: $arguments"
done
