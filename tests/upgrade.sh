#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Today's build beside the programs of 0.1.0, built from this repository's history: clients of each ask the
# daemon of the other, and today's daemon goes on with the store of then. Takes two minutes; OLD is a source
# tree that is already built, for the second time.
# usage: upgrade.sh [OLD]    (PERCUSS_BUILD is today's build folder)
# Exit code 77: the history is not here.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
# the last one before requests could name a server, and before stores had checksums
revision=729c323
release=0.1.0
# shellcheck source=tests/old_release.sh
. "$here/old_release.sh"

# the programs of then do not know PERCUSS_DOMAIN
ask() {
    program=$1
    shift
    expect 0 "$program/percuss" query --domain "$domain" --a steel-sphere --b al-rod --speed 0.2 --json "$@"
}

# everything a client does
everything() {
    ask "$1"
    # the same body and the same law then and now: within what both allow themselves
    awk -v e="$(field restitution)" 'BEGIN { exit !(e > 0.667568 - 0.002 && e < 0.667568 + 0.002) }' ||
        fail "e = $(field restitution)"
    expect 0 "$1/percuss" sweep --domain "$domain" --a steel-sphere --b al-rod --speed 0.1:0.3:3 --csv
    [ "$(grep -Ec ',OK(,|$)' "$out")" -eq 3 ] || fail "a sweep of another length"
    expect 0 "$1/percuss" ensemble --domain "$domain" --a steel-sphere --b al-rod --speed uniform:0.1:0.3 --samples 300
    shows "mean"
    expect 0 "$1/percuss" bodies --domain "$domain"
    shows "al-rod-1"
    expect 0 "$1/percuss" status --domain "$domain"
    expect 5 "$1/percuss" query --domain "$domain" --a steel-sphere --b no-such --speed 0.2
}

impacts() {
    expect 0 "$today/percuss" dents --domain "$domain" --json
    field impacts
}

say "programs of then among themselves, which leave a store"
cp "$old/config/catalogue.yaml" "$work/catalogue.yaml"
settings "store: dents.db" "tables: tables"
cp -r "$old/config/tables" "$work/tables"
bin=$then
start_daemon
everything "$bin"
ask "$bin" --specimen-b rod-1
ask "$bin" --specimen-b rod-1

say "clients of today ask the daemon of then"
everything "$today"
ask "$today" --specimen-b rod-1
[ "$(impacts)" = 3 ] || fail "$(impacts) impacts, not 3"
stop_daemon

say "the daemon of today with the settings, catalogue, tables and store of then"
bin=$today
expect 0 "$bin/percussd" --config "$work/percussd.yaml" --check-config
start_daemon
[ "$(impacts)" = 3 ] || fail "$(impacts) impacts, not 3"
logged 'left out' && fail "a table of then is left out"
everything "$today"

say "clients of then ask the daemon of today"
everything "$then"
ask "$then" --specimen-b rod-1
[ "$(impacts)" = 4 ] || fail "$(impacts) impacts, not 4"
stop_daemon

say "the daemon of then leaves a store of today alone"
bin=$then
"$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" >"$out" 2>"$err" 9>&- && fail "it starts"
says "is of version"
