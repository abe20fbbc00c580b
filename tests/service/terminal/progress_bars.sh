#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Who waits at a terminal sees how long and how far it is; whoever reads a file does not.
. "$(dirname "$0")/../support/lib.sh"
command -v script >/dev/null || {
    say "script (Debian: bsdutils), which makes a terminal, is not installed: skipped"
    exit 77
}
cat >"$work/impacts.csv" <<EOF
speed,restitution,sub_impacts,first_impulse
0.3,0.5,1,0.01
0.31,0.5,1,0.011
0.32,0.5,1,0.012
EOF
long="--a steel-sphere --b al-rod-1 --contact-model complete-fe --tolerance 1e-4"

# at_terminal EXIT_CODE COMMAND...: what it shows at a terminal is in $work/screen, a line for each drawing
at_terminal() {
    expected=$1
    shift
    code=0
    script -qec "$*" "$work/typescript" >/dev/null 2>&1 9>&- </dev/null || code=$?
    tr '\r' '\n' <"$work/typescript" | sed 's/\x1b\[K//g' >"$work/screen"
    [ "$code" -eq "$expected" ] || { cat "$work/screen" >&2 && fail "exit code $code, not $expected: $*"; }
}

# drawings of so many seconds, and of a share: not more than ten a second
count() {
    grep -cE "^(\[[# ]{40}\] +[0-9]+ %  |waits for its turn  )?$1[0-9.]+ s\$" "$work/screen" || true
}

start_daemon
say "a long question at a terminal: how long, and what share is done"
at_terminal 4 "$bin/percuss" query --domain "$domain" $long --speed 0.3 --timeout 6
drawn=$(count "")
echo "$drawn drawings in 6 s"
[ "$drawn" -ge 3 ] || fail "it is hardly shown"
[ "$drawn" -le 60 ] || fail "it is drawn more than ten times a second"
grep -qE '^\[[# ]{40}\] +[0-9]+ %' "$work/screen" || fail "the share done is not shown"
grep -q 'percuss: request' "$work/screen" || fail "the message is not on a line of its own"

say "calibrate and compare at a terminal: how many impacts are answered"
at_terminal 4 "$bin/percuss" calibrate --domain "$domain" $long --fit young:al-rod-1 --timeout 4 "$work/impacts.csv"
[ "$(count '0 impacts  ')" -ge 2 ] || fail "it is not shown"
at_terminal 4 "$bin/percuss" compare --domain "$domain" $long --timeout 4 "$work/impacts.csv"
[ "$(count '0 impacts  ')" -ge 2 ] || fail "it is not shown"

say "in this process as well"
at_terminal 4 "$bin/percuss" query --local --catalogue "$work/catalogue.yaml" $long --speed 0.3 --timeout 4
[ "$(count "")" -ge 2 ] || fail "it is not shown"

say "what is answered soon shows nothing, and a file gets none of it"
at_terminal 0 "$bin/percuss" query --domain "$domain" --a steel-sphere --b al-rod --speed 0.3
[ "$(count "")" = 0 ] || fail "something is drawn"
expect 4 percuss query $long --speed 0.3 --timeout 3
[ "$(wc -l <"$err")" = 1 ] || fail "more than the message is on standard error"
grep -q "$(printf "\r")" "$err" && fail "something is drawn in a file"
stop_daemon
