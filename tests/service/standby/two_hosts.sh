#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A daemon and its standby on two hosts, and clients on a third one: network namespaces that a bridge joins. The
# folder of store and lock is one that all of them see; what a network's file system does with locks is not in
# this. A host's process is killed, cables are pulled, and addresses change.
. "$(dirname "$0")/../support/lib.sh"

# of who dies without a word, s. Programs wait for who takes the place until it is over, and the 1.7 s of
# config/cyclonedds.xml were too short for a machine with 50 processes for 2 cores
lease=5
space=percuss-$domain
net=10.198.$domain
remove_hosts() {
    for host in switch left right rig; do
        ip netns del "$space-$host" 2>/dev/null || true
    done
}
skip() {
    remove_hosts
    say "NOT TRIED: no network namespaces joined by a bridge (they take root and Debian's iproute2)"
    exit 77
}

# add_host NAME NUMBER: with the interface eth0, whose cable is the port of that name in the switch
add_host() {
    ip netns add "$space-$1" &&
        ip -n "$space-switch" link add "$1" type veth peer name eth0 netns "$space-$1" &&
        ip -n "$space-switch" link set "$1" master bridge up &&
        ip -n "$space-$1" link set lo up && ip -n "$space-$1" link set eth0 up &&
        ip -n "$space-$1" addr add "$net.$2/24" dev eth0
}
remove_hosts
trap 'cleanup; remove_hosts' EXIT
{ ip netns add "$space-switch" && ip -n "$space-switch" link add bridge type bridge &&
    ip -n "$space-switch" link set bridge up && add_host left 1 && add_host right 2 && add_host rig 3; } \
    >"$err" 2>&1 || skip

cable() {
    ip -n "$space-switch" link set "$1" "$2"
}

# start_on HOST: a daemon there, with its own log; its process is in $started
start_on() {
    : >"$work/$1.log"
    ip netns exec "$space-$1" "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" \
        2>>"$work/$1.log" 9>&- &
    started=$!
    others="${others:-} $started"
}
told() {
    grep -q -- "$2" "$work/$1.log"
}
# expect_told HOST TEXT
expect_told() {
    wait_for 20 told "$1" "$2" || fail "$1: $(cat "$work/$1.log")"
}
is_ready() {
    expect_told "$1" 'ready: domain'
}
waits() {
    start_on "$1"
    expect_told "$1" 'waits until it ends'
}
forget() {
    wait "$1" 2>/dev/null || true
    others=$(echo " $others " | sed "s/ $1 / /")
}
# ends PROCESS: in good order
ends() {
    kill -TERM "$1"
    wait_for 20 is_gone "$1" || fail "process $1 does not end"
    code=0
    wait "$1" || code=$?
    forget "$1"
    [ "$code" -eq "${2:-0}" ] || fail "it ended with $code, not ${2:-0}"
}
kills() {
    kill -KILL "$1"
    forget "$1"
}

# on the third host
percuss() {
    command=$1
    shift
    ip netns exec "$space-rig" "$bin/percuss" "$command" --domain "$domain" "$@"
}
# asks FILE SPECIMEN [ARGUMENT]: a program there that asks until $work/stop is there
asks() {
    : >"$work/$1"
    ip netns exec "$space-rig" "$peers/standby_client" "$domain" "$2" "$work/stop" ${3:+"$3"} \
        >"$work/$1" 2>&1 9>&- &
    asking="${asking:-} $!"
    others="$others $!"
}
impacts_are() {
    expect 0 percuss dents --specimen "$1" --json
    [ "$(field impacts)" = "$2" ] || fail "$1: $(field impacts) impacts, not $2"
}
strike() {
    percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --contact-model closed-form \
        --compliance half-space --specimen-b bar --json "$@"
}

# network EDIT...: the shipped configuration on the interface of these hosts, edited further
network() {
    sed -e 's|Interface address="127.0.0.1"/>|Interface name="eth0"/>|' -e "s|1.7 s|$lease s|" "$@" \
        "$source_dir/config/cyclonedds.xml" >"$work/network.xml"
    CYCLONEDDS_URI=file://$work/network.xml
    export CYCLONEDDS_URI
}
# everybody_goes_on: each program has had answers since `look`
look() {
    for file in one two plain; do
        wc -l <"$work/$file" >"$work/$file.seen"
    done
}
everybody_goes_on() {
    for file in one two plain; do
        [ "$(wc -l <"$work/$file")" -gt "$(cat "$work/$file.seen")" ] || return 1
    done
}
go_on() {
    look
    wait_for 30 everybody_goes_on || fail "a program stands still: $(tail -n 2 "$work/one" "$work/two" "$work/plain")"
}

# stop_asking: no call failed; how many answers there were is in $answered
stop_asking() {
    : >"$work/stop"
    for program in $asking; do
        wait "$program" || fail "a program ended with $?: $(tail -n 2 "$work/one" "$work/two" "$work/plain")"
        forget "$program"
    done
    asking=
    rm "$work/stop"
    answered=$(sed -n 's/^answered //p' "$work/one" "$work/two" | awk '{ sum += $1 } END { print sum }')
    sed -n 's/^waited //p' "$work/one" "$work/two" "$work/plain" | sort -n >"$work/waits"
    echo "  $answered impacts; the longest of $(wc -l <"$work/waits") waits over 0.1 s:" \
        "$(tail -n 1 "$work/waits") s; a lease is $lease s"
}
no_wait_over() {
    awk -v most="$1" '$1 > most { bad = 1 } END { exit bad }' "$work/waits" || fail "somebody waited for more than $1 s"
}

# killed_by_turns SPECIMEN: left, right and left again are killed under load, and the other one goes on
killed_by_turns() {
    start_on left
    first=$started
    is_ready left
    asks one "$1"
    asks two "$1"
    asks plain -
    go_on
    for to in right left right; do
        waits "$to"
        second=$started
        go_on
        kills "$first"
        is_ready "$to"
        go_on
        first=$second
    done
    stop_asking
    # as service/standby/takeover_under_load
    no_wait_over "$(awk -v lease="$lease" 'BEGIN { print 2 * lease }')"
    impacts_are "$1" "$answered"
    [ "$(grep -h '^e ' "$work/plain" | sort -u | wc -l)" = 1 ] || fail "not all answers to one request are the same"
    ends "$first"
}
make_keys() {
    sh "$source_dir/deploy/security/percuss-keys.sh" "$@"
}
settings "store: specimens.db" "standby: standby.lock"

say "hosts that find each other by multicast: the one that answers is killed, three times, under load"
network -e 's|<AllowMulticast>false|<AllowMulticast>true|' -e '/<Peers>/,/<\/Peers>/d'
killed_by_turns multicast

say "the same by a list of peers, without multicast"
peers_listed=$(for i in 1 2 3; do printf '<Peer address="%s.%d"/>' "$net" $i; done)
network -e "s|<Peer address=.*|$peers_listed|"
killed_by_turns unicast

if command -v openssl >/dev/null; then
    say "the same with an identity each"
    network -e 's|<AllowMulticast>false|<AllowMulticast>true|' -e '/<Peers>/,/<\/Peers>/d'
    keys=$work/keys
    mkdir "$keys"
    expect 0 make_keys create "$keys"
    expect 0 make_keys add "$keys" daemon serves
    expect 0 make_keys add "$keys" rig asks
    settings "store: specimens.db" "standby: standby.lock" "security: $keys/daemon"
    PERCUSS_SECURITY=$keys/rig
    export PERCUSS_SECURITY
    killed_by_turns secured
    unset PERCUSS_SECURITY
    settings "store: specimens.db" "standby: standby.lock"
fi
network -e 's|<AllowMulticast>false|<AllowMulticast>true|' -e '/<Peers>/,/<\/Peers>/d'

say "the cable of the one that answers is out for less than a lease: who waits is answered late, and no call fails"
start_on left
answering=$started
is_ready left
waits right
waiting=$started
asks one short
asks two short
asks plain -
go_on
cable left down
sleep 0.5
cable left up
go_on
stop_asking
no_wait_over "$(awk -v lease="$lease" 'BEGIN { print 2 * lease }')"
awk '$1 > 0.5 { late = 1 } END { exit !late }' "$work/waits" || fail "nobody noticed"
impacts_are short "$answered"

say "for longer: what was asked is done and its reply lost, nobody answers, and the standby leaves it its place"
asks cut cut submit
wait_for 20 grep -q connected "$work/cut" || fail "$(cat "$work/cut")"
kill -STOP "$answering"
: >"$work/stop"
wait_for 20 grep -q submitted "$work/cut" || fail "$(cat "$work/cut")"
sleep 0.2
cable left down
kill -CONT "$answering"
wait_for 20 grep -q '^lost: ' "$work/cut" || fail "it is not told: $(cat "$work/cut")"
expect 3 percuss ping --timeout 1
says "no percussd in DDS domain"
expect 0 ip netns exec "$space-left" "$bin/percuss" dents --domain "$domain" --specimen cut --json
[ "$(field impacts)" = 1 ] || fail "on its own host: $(cat "$out")"
sleep 2
! told right "takes over" || fail "$(cat "$work/right.log")"

say "the cable is back: it answers again, and what is asked again with its number was counted once"
back=$(date +%s.%N)
cable left up
wait "${asking# }" || fail "it ended with $?: $(cat "$work/cut")"
forget "${asking# }"
asking=
rm "$work/stop"
grep -q '^lost 1, status 0$' "$work/cut" || fail "$(cat "$work/cut")"
echo "  after $(date +%s.%N | awk -v back="$back" '{ printf "%.2f", $1 - back }') s"
impacts_are cut 1
expect 0 percuss status --json
[ "$(field process)" = "$answering" ] || fail "another one answers: $(cat "$out")"

say "its interface is taken down and brought up: it hears multicast as before"
ip -n "$space-left" link set eth0 down
sleep 2
ip -n "$space-left" link set eth0 up
expect 0 percuss ping --timeout 20

# change HOST KIND: what happens to the network of one that waits
change() {
    case $2 in
    cable) cable "$1" down && sleep 2 && cable "$1" up ;;
    interface) ip -n "$space-$1" link set eth0 down && sleep 2 && ip -n "$space-$1" link set eth0 up ;;
    address)
        ip -n "$space-$1" addr flush dev eth0
        ip -n "$space-$1" addr add "$net.$((10 + ${#1}))/24" dev eth0
        ;;
    esac
}
# take_turns: who waited answers, on the host $to, and $from is the other one's
to=right
from=left
take_turns() {
    is_ready "$to"
    answering=$waiting
    before=$to
    to=$from
    from=$before
}
count=0
for kind in cable interface address; do
    say "the $kind of the one that waits goes and comes: it takes over as ever"
    change "$to" "$kind"
    kills "$answering"
    take_turns
    expect 0 strike
    count=$((count + 1))
    impacts_are bar $count
    waits "$to"
    waiting=$started
done

say "one whose interface is gone when the place is free says so and ends, and the place is the next one's"
ip -n "$space-$to" link set eth0 down
kills "$answering"
expect_told "$to" "eth0: does not match an available interface"
code=0
wait "$waiting" || code=$?
forget "$waiting"
[ "$code" -eq 1 ] || fail "it ended with $code"
ip -n "$space-$to" link set eth0 up
start_on "$from"
answering=$started
is_ready "$from"
waits "$to"
waiting=$started
expect 0 strike
impacts_are bar 4

say "the interface of the one that answers is gone: it can be told to end, and the other one takes over"
ip -n "$space-$from" link set eth0 down
sleep 2
ends "$answering"
take_turns
expect 0 strike
impacts_are bar 5

say "so it can, later, where the configuration gives each socket a thread, which Cyclone DDS does not end then"
ip -n "$space-$to" link set eth0 up
ends "$answering"
network -e 's|<AllowMulticast>false|<AllowMulticast>true|' -e '/<Peers>/,/<\/Peers>/d' -e '/<Internal>/,/<\/Internal>/d'
start_on left
answering=$started
is_ready left
waits right
waiting=$started
expect 0 strike
ip -n "$space-left" link set eth0 down
ends "$answering" 1
expect_told left "DDS does not end within"
is_ready right
expect 0 strike
impacts_are bar 7
ends "$waiting"
