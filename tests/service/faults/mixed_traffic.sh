#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# All kinds of traffic at once: queries, batches, ensembles, specimens, tokens, wrong input and clients that
# vanish, while the catalogue is exchanged under them. Nobody ends by itself, no sanitizer complains, what is
# asked before and after gets the same answer, and every impact on a specimen is counted once.
# PERCUSS_SOAK: for how many seconds (12); tests/soak.sh runs it for an hour under sanitizers.
. "$(dirname "$0")/../support/lib.sh"

seconds=${PERCUSS_SOAK:-12}
patience=${PERCUSS_SOAK_PATIENCE:-20}
settings "store: $work/store.db" "tables: $source_dir/config/tables"
cp -r "$source_dir/config/bodies" "$work/bodies"
cp "$source_dir/config/catalogue.yaml" "$work/whole.yaml"
start_daemon

# reference NAME: answers that may not change
reference() {
    expect 0 query --json --timeout "$patience"
    numbers "$out" >"$work/$1.query"
    expect 0 percuss sweep --a steel-sphere --b al-rod-1 --speed 0.1:0.4:8 --csv --timeout "$patience"
    cp "$out" "$work/$1.sweep"
}
reference before

# what each kind of traffic does for a turn, in a folder of its own; `ask` is a client whose end is looked at
ask() {
    code=none
    [ "$(date +%s)" -lt "$end" ] || return 0
    code=0
    percuss "$@" --timeout "$patience" >"out" 2>"err" 9>&- || code=$?
    echo "$code $*" >>codes
    if grep -q "Sanitizer\|runtime error" err; then cat err >>"$work/complaints"; fi
    return 0
}

turn_queries() {
    ask query --a steel-sphere --b al-beam --speed "0.$((1 + turn % 7))" --json
    ask query --a steel-sphere --b al-rod-1 --speed "0.$((1 + turn % 9))" --conditioning
    ask query --a steel-sphere --b al-beam --at 0.3 --speed 0.2 --trace trace.csv
    ask bodies
    ask status
    ask ping
}

turn_batches() {
    ask sweep --a steel-sphere --b al-beam --speed "0.1:0.4:$((20 + turn % 200))" --csv
    ask sweep --a steel-sphere --b al-rod-1 --speed "0.1:2:50" --contact-model closed-form --csv
}

turn_ensembles() {
    ask ensemble --a steel-sphere --b al-beam --speed uniform:0.1:0.4 --samples $((64 + turn % 500)) --json
    ask ensemble --a steel-sphere --b al-rod-1 --speed normal:0.3:0.01 --input young@al-rod-1=normal:7e10:1e9 \
        --samples 200
}

turn_specimens() {
    ask query --a steel-sphere --b al-rod-1 --speed 0.3 --contact-model closed-form --specimen-b "bar-$((turn % 3))"
    if [ "$code" = 0 ] || [ "$code" = 1 ]; then echo "bar-$((turn % 3))" >>impacts; fi
    ask dents
    [ $((turn % 7)) -ne 6 ] || ask dents --specimen passing --clear
    ask query --a steel-sphere --b al-beam --speed 0.3 --specimen-b passing
}

# a second blow on the bodies as the first has left them
turn_tokens() {
    body='"bodies": [{"id": "steel-sphere", "position": [0, 0, 0.025], "velocity": [0, 0, -0.3]}, {"id": "al-beam"'
    touch='"contacts": [{"a": 0, "b": 1, "point": [0, 0, 0.01], "normal": [0, 0, 1]}]'
    echo "{$body}], $touch}" >first.json
    ask query --request first.json --json
    token=$(sed -n 's/.*"state_after": "\([0-9a-f]\{32\}\)".*/\1/p' out | tail -n 1)
    echo "{$body, \"state\": \"$token\", \"elapsed\": 1e-3}], $touch}" >second.json
    ask query --request second.json
    echo "{$body, \"state\": \"00112233445566778899aabbccddeeff\"}], $touch}" >stranger.json
    ask query --request stranger.json
}

turn_wrong() {
    ask query --a nobody --b al-beam --speed 0.3
    ask query --a steel-sphere --b al-beam --speed 1e30
    ask query --a steel-sphere --b al-beam --speed 0.3 --tolerance 1e-30
    ask sweep --a steel-sphere --b nowhere --speed 0.1:0.4:5
    echo '{"bodies": [{"id": "steel-sphere", "orientation": [0, 0, 0, 0]}, {"id": "al-beam"}],
           "contacts": [{"a": 0, "b": 1, "normal": [0, 1, 1]}]}' >wrong.json
    ask query --request wrong.json
    "$peers/wire_damaged" requests "$domain" 200 >/dev/null 2>damaged 9>&- || true
}

# killed while they are answered; the programs themselves, not shells that run them
turn_vanishing() {
    common="--domain $domain --a steel-sphere --b al-beam"
    "$bin/percuss" ensemble $common --speed uniform:0.1:0.4 --samples 200000 >/dev/null 2>&1 9>&- &
    gone=$!
    "$bin/percuss" sweep $common --speed 0.1:0.4:2000 --tolerance 1e-6 >/dev/null 2>&1 9>&- &
    gone="$gone $!"
    "$bin/percuss" query $common --speed 0.3 --contact-model concurrent-fe >/dev/null 2>&1 9>&- &
    gone="$gone $!"
    sleep "0.$((3 + turn % 6))"
    kill -KILL $gone 2>/dev/null || true
    wait
}

# other catalogues, good and broken, each for a moment
turn_reloads() {
    case $((turn % 4)) in
    0) sed 's/^bodies:/bodies:\n  guest: {shape: sphere, material: steel, radius: 0.01}/' "$work/whole.yaml" >"$work/next" ;;
    1) head -c 900 "$work/whole.yaml" >"$work/next" ;;
    2) sed 's/young/younger/' "$work/whole.yaml" >"$work/next" ;;
    3) cp "$work/whole.yaml" "$work/next" ;;
    esac
    mv "$work/next" "$work/catalogue.yaml"
    kill -HUP "$daemon"
    sleep 0.7
}

# go KIND: its turns until the time is over
go() (
    trap - EXIT
    mkdir -p "$work/$1"
    cd "$work/$1"
    : >codes
    turn=0
    while [ "$(date +%s)" -lt "$end" ]; do
        "turn_$1"
        turn=$((turn + 1))
        echo "$turn" >turns
    done
)

end=$(($(date +%s) + seconds))
kinds="queries batches ensembles specimens tokens wrong vanishing reloads"
others=
for kind in $kinds; do
    go "$kind" &
    others="$others $!"
done
largest=0
all_gone() {
    for child in $others; do
        is_gone "$child" || return 1
    done
}
until all_gone; do
    if is_gone "$daemon"; then fail "the daemon has ended"; fi
    resident=$(sed -n 's/^VmRSS:[[:space:]]*\([0-9]*\) kB/\1/p' "/proc/$daemon/status")
    [ "${resident:-0}" -le "$largest" ] || largest=$resident
    # one client may wait for as long as it may
    [ "$(date +%s)" -lt $((end + 2 * patience + 60)) ] || {
        tail -n 3 "$work"/*/codes >&2
        fail "traffic does not end"
    }
    sleep 1
done
wait $others || fail "traffic ended by itself"
others=

say "nobody complains"
[ ! -s "$work/complaints" ] || { cat "$work/complaints" >&2 && fail "a sanitizer complains of a client"; }
if grep "Sanitizer\|runtime error" "$log"; then fail "a sanitizer complains of the daemon"; fi
asked=0
for kind in $kinds; do
    [ "$(cat "$work/$kind/turns")" -gt 0 ] || fail "$kind: nothing was done"
    asked=$((asked + $(wc -l <"$work/$kind/codes")))
    # signals, and what is none of the exit codes of the man page
    if grep -v '^[0-5] ' "$work/$kind/codes"; then fail "$kind: a client ended so"; fi
done
# good questions of kinds that nothing stands in the way of
for kind in queries batches tokens; do
    grep -q '^[01] ' "$work/$kind/codes" || fail "$kind: nothing was answered"
done

say "all is as before"
cp "$work/whole.yaml" "$work/catalogue.yaml"
kill -HUP "$daemon"
revision=$(field catalogue_revision "$work/before.query")
restored() {
    grep 'reload: .* revision' "$log" | tail -n 1 | grep -q "$revision"
}
wait_for "$patience" restored || fail "the catalogue is not back"
reference after
cmp "$work/before.query" "$work/after.query" || fail "another answer"
cmp "$work/before.sweep" "$work/after.sweep" || fail "other answers of a batch"
expect 0 percuss dents --json --timeout "$patience"
for bar in bar-0 bar-1 bar-2; do
    counted=$(tr -d ' \n' <"$out" | sed -n 's/.*"specimen":"'"$bar"'"[^{]*"impacts":\([0-9]*\).*/\1/p')
    hit=$(grep -c "$bar" "$work/specimens/impacts" || true)
    [ "${counted:-0}" -eq "$hit" ] || fail "$bar: $counted impacts are counted, $hit were answered"
done
say "$asked clients in $seconds s, $(grep -c reload "$log") lines about reloads; at most $((largest / 1024)) MiB resident"
stop_daemon
