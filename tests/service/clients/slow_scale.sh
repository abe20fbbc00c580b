#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A co-simulation waits for a daemon, and stops when there is none rather than get other results. With
# leave it goes on when the daemon is killed, with the declared restitution, and asks again when it is
# back.
. "$(dirname "$0")/../support/lib.sh"

start_daemon
say "lists and totals end with the same velocities; one request an impact"
for how in list total; do
    printf '\n\n\n\n' | expect 0 "$peers/slow_client" "$domain" "$how" 5
    grep -c '^percuss e' "$out" | grep -qx 5 || fail "not every impact was answered ($how)"
    shows "5 impacts, 5 requests, 0 repeated, 0 declared"
    # without notes, such as of an impulse that is applied late
    sed -n 's|^\(percuss e = [^ ]* after = [^ ]*\).*|\1|p' "$out" >"$work/$how"
done
paste "$work/list" "$work/total" | awk '{ if ($4 - $11 > 1e-12 || $11 - $4 > 1e-12 ||
    $7 - $14 > 1e-12 || $14 - $7 > 1e-12) exit 1 }' || fail "$(cat "$work/list" "$work/total")"

say "the loop that integrating.md prints, with its callbacks, is the example's; in process it ends alike"
page=$source_dir/docs/integrating.md
engine=$source_dir/client/examples/engine
blocks() { # those of C on the page
    awk '/^```c$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$page"
}
{
    sed 1,3d "$engine/engine.c"
    sed -n '/^static bool my_probe/,/^\/\* Asked/p' "$engine/my_engine.h" | sed '$d' | sed '$d'
} >"$work/printed"
blocks | diff - "$work/printed" >"$out" || fail "another program than client/examples/engine"
expect 0 env PERCUSS_DOMAIN="$domain" "$build/client/examples/engine"
cp "$out" "$work/asked"
grep -q '^0.005000 s: e = 0.7' "$out" || fail "no impact after 1 mm at 0.2 m/s"
expect 0 percuss query --a steel-sphere --b al-beam --speed 0.2 --json
awk -v e="$(field restitution)" '/ e = / { exit !(($5 - e) ^ 2 < 1e-6) }' "$work/asked" || fail "e is not $(field restitution)"
expect 0 "$build/client/examples/engine_in_process"
cmp "$out" "$work/asked" || fail "other numbers in process"

# a client of its own pace: a line into the pipe lets it make the next impact
start_client() { # IMPACTS [fall-back]
    rm -f "$work/pace"
    mkfifo "$work/pace"
    "$peers/slow_client" "$domain" list "$@" <"$work/pace" >"$out" 2>"$err" 9>&- &
    others=$!
    exec 8>"$work/pace"
}
has_lines() {
    [ "$(wc -l <"$out")" -ge "$1" ]
}
line_is() { # NUMBER WHAT: it begins so
    wait_for 150 has_lines "$1" || fail "no line $1"
    sed -n "$1p" "$out" | grep -q "^$2" || fail "line $1 is not: $2, but: $(sed -n "$1p" "$out")"
}
# However loaded the machine is, a daemon that is there is found within 60 s; 1 s is enough not to find
# one that is not.
next_impact() { # NUMBER WHAT [SECONDS]: the next line begins so; a server is looked for so long
    echo "${3:-60}" >&8
    line_is "$1" "$2"
}
end_client() {
    exec 8>&-
    wait "$others" || fail "the client failed"
    others=
}
kill_daemon() {
    kill -KILL "$daemon"
    wait "$daemon" 2>/dev/null || true
    daemon=
}

say "a daemon that comes late changes nothing but the time"
stop_daemon
start_client 1
sleep 2
start_daemon
line_is 1 "percuss e"
end_client
[ "$(sed -n '1s/ *$//p' "$out")" = "$(sed -n 1p "$work/list")" ] || fail "another answer than before"

say "without a daemon the simulation stops, says why, and can go on where it was"
start_client 2
line_is 1 "percuss e"
kill_daemon
next_impact 2 "error impact of steel-sphere and al-beam at 0.4 s: no percussd" 1
start_daemon
next_impact 3 "percuss e"
end_client
shows "2 impacts"
shows "0 declared"

start_client 6 fall-back
line_is 1 "percuss e"
next_impact 2 "percuss e"
say "killed: the declared value, logged"
kill_daemon
next_impact 3 "declared e = 0.45" 1
sed -n 3p "$out" | grep -q "declared restitution 0.45 used" || fail "the reason is not logged"
next_impact 4 "declared e = 0.45" 1
say "back: used again"
start_daemon
next_impact 5 "percuss e"
next_impact 6 "percuss e"
end_client
shows "6 impacts"
shows "2 declared"

say "a daemon that was restarted between two impacts does not know the vibration, but the bodies"
start_client 4
line_is 1 "percuss e"
stop_daemon
start_daemon
next_impact 2 "percuss e"
shows "asked again without earlier vibration"
grep -q "another catalogue" "$out" && fail "the catalogue is the same"

say "another catalogue is not gone over to without a word: read again, or another daemon's"
stiffer() { # FROM TO
    sed -i "s/^\(  aluminium:  {young: \)$1/\1$2/" "$work/catalogue.yaml"
    grep -q "aluminium:  {young: $2" "$work/catalogue.yaml" || fail "aluminium has no Young's modulus $1"
}
warns() { # LINE
    sed -n "$1p" "$out" | grep -q "answered with another catalogue ([0-9a-f]\{8\}) than before (" ||
        fail "line $1 says nothing of the other catalogue"
}
stiffer 70e9 90e9
: >"$log"
kill -HUP "$daemon"
wait_for 20 logged "reload: [0-9]* bodies" || fail "the catalogue is not read again"
next_impact 3 "percuss e"
warns 3
stiffer 90e9 80e9
kill_daemon
start_daemon
next_impact 4 "percuss e"
warns 4
end_client
stop_daemon
