#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Many daemons in one domain: in partitions they and their clients never mix; of alike ones a client may ask
# the one that has least to do.
. "$(dirname "$0")/../support/lib.sh"

sed 's/young: 70e9/young: 90e9/' "$work/catalogue.yaml" >"$work/stiff.yaml"
others=

# start_in PARTITION CATALOGUE NAME: a daemon with its own log; its process in $started
start_in() {
    printf '%s\n' "catalogue: $work/$2" "partition: $1" "workers: 2" "store: $3.db" >"$work/$3.yaml"
    : >"$work/$3.log"
    "$bin/percussd" --config "$work/$3.yaml" --domain "$domain" 2>"$work/$3.log" 9>&- &
    started=$!
    others="$others $started"
    wait_for 20 grep -q "ready: domain $domain, partition $1," "$work/$3.log" || fail "$(cat "$work/$3.log")"
}
end() {
    kill -TERM "$1"
    wait "$1" || fail "a daemon ended with $?"
    others=$(echo " $others " | sed "s/ $1 / /")
}

say "three daemons: one in no partition, and one in each of two, with a catalogue of its own"
start_daemon
start_in gears catalogue.yaml gears
gears=$started
start_in cams stiff.yaml cams
cams=$started

say "who names a partition is answered by its daemon, sees no other one, and is warned of none"
for i in 1 2 3 4 5; do
    for partition in '' gears cams; do
        expect 0 query --json --partition "$partition"
        [ ! -s "$err" ] || fail "'$partition': it is warned"
        field server >>"$work/server-$partition"
        field restitution >>"$work/restitution-$partition"
    done
done
for partition in '' gears cams; do
    [ "$(sort -u "$work/server-$partition" | wc -l)" = 1 ] || fail "'$partition': several servers"
    expect 0 percuss status --json --partition "$partition"
    [ "$(grep -c '"server":' "$out")" = 1 ] || fail "'$partition': $(cat "$out")"
    [ "$(field server)" = "$(head -n 1 "$work/server-$partition")" ] || fail "'$partition': another one"
done
[ "$(cat "$work"/server-* | sort -u | wc -l)" = 3 ] || fail "not three servers"
cmp -s "$work/restitution-" "$work/restitution-gears" || fail "one catalogue, other numbers"
! cmp -s "$work/restitution-" "$work/restitution-cams" || fail "another catalogue, the same numbers"

say "so it is with ensembles, histories, bodies, batches and specimens"
expect 0 percuss ensemble --a steel-sphere --b al-beam --speed uniform:0.1:0.4 --samples 256 --json \
    --partition cams
[ "$(field server)" = "$(head -n 1 "$work/server-cams")" ] || fail "answered by $(field server)"
expect 0 query --trace "$work/trace.csv" --partition gears
expect 0 percuss bodies --partition gears
expect 0 percuss sweep --a steel-sphere --b al-beam --speed 0.1:0.4:31 --partition gears
expect 0 percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --specimen-b bar --partition cams
expect 0 percuss dents --specimen bar --partition cams
expect 5 percuss dents --specimen bar --partition gears

say "the partition may come from the environment: for the command, a program, and the daemon"
expect 0 env PERCUSS_PARTITION=cams "$bin/percuss" query --domain "$domain" --a steel-sphere --b al-beam \
    --speed 0.3 --json
[ "$(field server)" = "$(head -n 1 "$work/server-cams")" ] || fail "answered by $(field server)"
expect 0 env PERCUSS_PARTITION=cams PERCUSS_DOMAIN="$domain" "$build/client/examples/query"
expect 0 env PERCUSS_PARTITION=cams "$bin/percuss" query --domain "$domain" --a steel-sphere --b al-beam \
    --speed 0.3 --json --partition gears
[ "$(field server)" = "$(head -n 1 "$work/server-gears")" ] || fail "answered by $(field server)"
expect 2 env PERCUSS_PARTITION='a b' "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain"
says "PERCUSS_PARTITION: a b: must be 1 to 63 letters, digits, '.', '_' and '-'"

say "programs on the types of 0.1.0, which know no partition, find the daemon that is in none"
expect 0 "$peers/old_clients" "$domain"
expect 0 "$peers/old_exchanges" "$domain"

say "no daemon takes another one for its neighbour, nor another one's clients for its own"
for file in "$log" "$work/gears.log" "$work/cams.log"; do
    ! grep -q "in this domain too" "$file" || fail "$(cat "$file")"
done

say "names that would be patterns, or nothing, are refused"
expect 2 query --partition 'ge*'
says "partition: 'ge*': 1 to 63 letters, digits, '.', '_' and '-' are allowed"
expect 2 "$bin/percussd" --config "$work/percussd.yaml" --partition 'ge*'
says "--partition: ge*: must be 1 to 63"
settings "partition: a/b"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --check-config
says "percussd.yaml:2: partition: a/b: must be 1 to 63"

say "who finds nobody is told which partitions have a daemon"
expect 3 percuss ping --partition nuts --timeout 1
says "no percussd in partition nuts of DDS domain $domain; one is in "
for partition in 'partition gears' 'partition cams' 'no partition'; do
    says "in $partition"
done
stop_daemon
end "$cams"
expect 3 percuss ping --timeout 1
says "no percussd in DDS domain $domain; one is in partition gears"

percuss() {
    command=$1
    shift
    "$bin/percuss" "$command" --domain "$domain" --partition gears "$@"
}
say "of two that are alike the one that has been up longest is asked, or by its load the first of equals"
start_in gears catalogue.yaml second
second=$started
elder=$(head -n 1 "$work/server-gears")
has_two() {
    percuss status --json >"$out" 2>"$err" && [ "$(grep -c '"server":' "$out")" = 2 ]
}
wait_for 20 has_two || fail "status does not list two servers"
expect 0 query --json --server least-loaded
[ "$(field server)" = "$elder" ] || fail "answered by $(field server)"
[ ! -s "$err" ] || fail "it is warned"

say "the elder is busy with a long ensemble: the other one is asked"
"$bin/percuss" ensemble --domain "$domain" --partition gears --server "$elder" --a steel-sphere --b al-beam \
    --speed uniform:0.1:0.4 --samples 2000000 >"$work/long" 2>&1 9>&- &
long=$!
others="$others $long"
is_busy() {
    percuss status >"$out" 2>"$err" && grep -q '^activity' "$out"
}
wait_for 20 is_busy || fail "nobody says that he is busy"
asked=0
for i in 1 2 3 4 5 6; do
    expect 0 query --json --server least-loaded
    [ "$(field server)" != "$elder" ] || asked=$((asked + 1))
    expect 0 env PERCUSS_SERVER=least-loaded "$bin/percuss" query --domain "$domain" --partition gears \
        --a steel-sphere --b al-beam --speed 0.3 --json
    [ "$(field server)" != "$elder" ] || asked=$((asked + 1))
done
[ "$asked" -eq 0 ] || fail "the busy one was asked $asked times of 12"

say "though nobody has heard of that one yet: the elder has, and says so"
# for less than its lease of 1.7 s, after which it counts as gone
kill -STOP "$second"
(sleep 1 && kill -CONT "$second") 9>&- &
resume=$!
expect 0 query --json --server least-loaded
[ "$(field server)" != "$elder" ] || fail "the busy one was asked: it was the only one to be heard of at first"
wait "$resume"
expect 0 env PERCUSS_SERVER="$elder" "$bin/percuss" query --domain "$domain" --partition gears \
    --a steel-sphere --b al-beam --speed 0.3 --json
[ "$(field server)" = "$elder" ] || fail "answered by $(field server)"
kill -INT "$long" 2>/dev/null || true
wait "$long" || true
others=$(echo " $others " | sed "s/ $long / /")

say "one of another catalogue is warned of, though the choice was left to the load"
start_in gears stiff.yaml third
warns() {
    expect 0 query --server least-loaded
    grep -q "answers here too, with ANOTHER CATALOGUE" "$err"
}
wait_for 20 warns || fail "no warning"
expect 2 query --server least
says "--server: 'least' is not 1 to 32 hexadecimal digits, nor least-loaded"
end "$started"
end "$second"
end "$gears"
