#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Limits of the process that are too low: refused with the number that is needed, before DDS starts; with that
# number the daemon holds under load.
. "$(dirname "$0")/../support/lib.sh"

# limited OPTION NUMBER COMMAND...: with that ulimit
limited() (
    ulimit -c 0
    ulimit "$1" "$2"
    shift 2
    exec "$@"
)

run() {
    limited "$1" "$2" timeout 20 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain"
}

# under OPTION NUMBER: a daemon with that limit
under() {
    : >"$log"
    (
        ulimit -c 0
        ulimit "$1" "$2"
        exec "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" 2>>"$log" 9>&-
    ) &
    daemon=$!
    wait_for 20 is_up_or_dead || fail "not ready after 20 s"
    logged 'ready: domain' || fail "did not start"
}

# load: six clients at a time, with ensembles, whose threads are many
load() {
    clients=
    for k in 1 2 3 4 5 6; do
        {
            percuss sweep --a steel-sphere --b al-beam --speed "0.1:0.$((k + 1)):20"
            percuss ensemble --a steel-sphere --b al-beam --speed uniform:0.1:0.3 --samples 400
        } >"$work/load.$k" 2>&1 &
        clients="$clients $!"
    done
    for client in $clients; do
        wait "$client" || fail "a client: $(cat "$work"/load.*)"
    done
}

say "descriptors"
# fewer do not suffice to load libraries
for number in 7 8 9 16 63; do
    expect 1 run -n "$number"
    says "file descriptors: $number are allowed (ulimit -n, LimitNOFILE=): must be at least 64"
done
expect 1 limited -n 8 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" --check-config
says "file descriptors: 8 are allowed"
settings "store: specimens.db" "metrics: percuss.prom"
under -n 64
load
expect 0 percuss query --a steel-sphere --b al-rod --speed 0.2 --specimen-b bar
for number in 7 8 9 10; do
    expect 3 limited -n "$number" "$bin/percuss" query --a steel-sphere --b al-beam --speed 0.3 --domain "$domain"
    says "DDS participant: fewer than 8 file descriptors are left, which DDS needs: ulimit -n must be higher"
done
expect 0 limited -n 16 "$bin/percuss" query --a steel-sphere --b al-beam --speed 0.3 --domain "$domain"
[ "$(find "/proc/$daemon/fd" -type l | wc -l)" -lt 40 ] || fail "$(ls -l "/proc/$daemon/fd")"
stop_daemon

if is_sanitized; then
    echo "a sanitizer needs more address space than there is"
    exit 0
fi

say "address space"
settings "workers: 2"
expect 1 run -v 300000
says "address space: 300000 KiB are allowed (ulimit -v or -d, LimitAS=): must be at least "
needed=$(sed -n 's/.*must be at least \([0-9]*\) with 2 workers.*/\1/p' "$err")
expect 1 run -v $((needed - 1))
under -v "$needed"
logged "memory: the process may have [0-9]* MiB of address space: tokens.megabytes 8 of 256, replies.megabytes 8 of 256" ||
    fail "the caches are not told"
load
load
stop_daemon
start_daemon
expect 3 limited -v 60000 "$bin/percuss" query --a steel-sphere --b al-beam --speed 0.3 --domain "$domain"
says "KiB of address space are left, which the threads of DDS need: ulimit -v must be higher"
expect 0 limited -v 200000 "$bin/percuss" query --a steel-sphere --b al-beam --speed 0.3 --domain "$domain"
stop_daemon
settings "workers: 32"
expect 1 run -v "$needed"
says "with 32 workers"
