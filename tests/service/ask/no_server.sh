#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Without a server a client says so soon.
. "$(dirname "$0")/../support/lib.sh"

say "no daemon in the domain"
expect 3 query --timeout 1
says "no percussd"
! grep -q "looking for" "$err" || fail "who waits for 1 s is told that it takes long"
expect 3 percuss ping --timeout 1

say "who waits longer is told after 2 s what for, by the command line and by a program in C"
expect 3 percuss ping --timeout 3
says "percuss: looking for a daemon in DDS domain $domain ..."
[ "$(grep -c "looking for" "$err")" = 1 ] || fail "it is said more than once"
expect 1 "$build/client/examples/query" "$domain"
says "looking for a percussd"
says "no percussd in DDS domain $domain"

say "nor any more"
start_daemon
expect 0 query

say "who asks in an empty domain is told in which domains of this host there is one"
# another one that no other story uses, as tests/service/support/lib.sh draws them
empty=20
until [ "$empty" != "$domain" ] && exec 8>"${PERCUSS_DOMAIN_LOCKS:-${TMPDIR:-/tmp}}/percuss-domain-$empty.lock" &&
    flock -n 8; do
    empty=$((empty + 1))
done
names_ours() {
    expect 3 "$bin/percuss" ping --domain "$empty" --timeout 0.5
    grep -q "no percussd in DDS domain $empty;.*; one is in domain \(.*, \)\{0,1\}$domain[,;]" "$err"
}
# sooner or later: on a busy machine half a second may not do
wait_for 10 names_ours || fail "it is not told"
says "start one with: "
! grep -q systemctl "$err" || fail "a unit is advised that is not installed"

say "where the daemon's unit is installed and its settings name the domain, it is what is started"
mkdir -p "$work/usr/bin" "$work/usr/lib/systemd/system" "$work/etc/percuss"
cp "$bin/percuss" "$work/usr/bin"
cp "$source_dir/deploy/systemd/percussd.service" "$work/usr/lib/systemd/system"
for settled in "$empty" "$domain"; do
    printf 'catalogue: catalogue.yaml\ndomain: %s\n' "$settled" >"$work/etc/percuss/percussd.yaml"
    expect 3 "$work/usr/bin/percuss" ping --domain "$empty" --timeout 0.5
    grep -q "start one with: systemctl start percussd; or by yourself: percussd --config" "$err" ||
        [ "$settled" = "$domain" ] || fail "the unit is not advised"
done
! grep -q systemctl "$err" || fail "the unit of another domain is advised"
exec 8>&-
stop_daemon
expect 3 query --timeout 1
expect 3 "$bin/percuss" ping --domain "$empty" --timeout 0.5
! grep -q "one is in domain \(.*, \)\{0,1\}$domain[,;]" "$err" || fail "one that has gone is named"
