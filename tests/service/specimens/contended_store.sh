#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Another process wants the store, or has its lock: it gets nothing from a daemon that runs, one that starts waits for
# it for 2 s or says so, and one whose store could not be opened yet refuses impacts on specimens by name until it is free.
. "$(dirname "$0")/../support/lib.sh"

store=$work/specimens.db
settings "store: specimens.db"

# strike NUMBER: an impact with that number
strike() {
    cat >"$work/request.json" <<JSON
{"client": "00112233445566778899aabbccddeeff", "sequence": $1,
 "bodies": [{"id": "steel-sphere", "position": [0.515, 0, 0], "velocity": [-0.3, 0, 0]},
            {"id": "al-rod-1", "specimen": "bar-1"}],
 "contacts": [{"a": 0, "b": 1, "point": [0.5, 0, 0], "normal": [1, 0, 0]}],
 "options": {"contact_model": "closed-form", "compliance": "half-space"}}
JSON
    percuss query --request "$work/request.json" --json --timeout 20
}

impacts() {
    expect 0 percuss dents --specimen bar-1 --json
    field impacts
}

# hold SECONDS: another process writes to the store, and takes that long
hold() {
    : >"$work/held"
    "$peers/store_sql" "$store" "PRAGMA locking_mode = EXCLUSIVE; BEGIN EXCLUSIVE" "$1" >"$work/held" 2>&1 9>&- &
    others=$!
    wait_for 10 grep -q held "$work/held" || fail "nobody holds it: $(cat "$work/held")"
}

say "a daemon that runs keeps its store to itself, and answers whoever else tries"
start_daemon
expect 0 strike 1
for try in 1 2 3; do
    expect 1 "$peers/store_sql" "$store" "UPDATE specimens SET impacts = 7"
    says "database is locked"
    expect 0 strike $((try + 1))
done
[ "$(impacts)" = 4 ] || fail "$(cat "$out")"
stop_daemon

say "one that starts while it is held for a second waits"
hold 1
start_daemon
[ "$(impacts)" = 4 ] || fail "$(cat "$out")"
stop_daemon
wait "$others"

say "held for longer it ends, and says so; afterwards nothing is missing"
hold 60
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain"
says "specimens.db: is in use by another process"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" --check-config
says "specimens.db: is in use by another process ($others)"
kill "$others"
wait "$others" 2>/dev/null || true
others=
start_daemon
[ "$(impacts)" = 4 ] || fail "$(cat "$out")"
expect 0 strike 5
[ ! -e "$store-shm" ] || fail "it needs memory that processes share, which no network's file system has"
stop_daemon

if ! is_sanitized thread; then # which bears nothing in front of it
    say "on a network's file system: a warning at the start and before it, of what the second daemon is kept out by"
    interpose=$(preload "$build/tests/libinterpose.so")
    for kind in 0x6969:NFS 0xff534d42:CIFS 0x65735546:FUSE; do
        # the file alone, as a link to another volume is
        expect 0 env LD_PRELOAD="$interpose" PERCUSS_FAULT_PATH="$store" PERCUSS_FAULT_FILESYSTEM="${kind%:*}" \
            "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" --check-config
        says "warning: store: $store: lies on ${kind#*:}, which may be shared with other machines"
    done
    expect 0 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" --check-config
    grep -q 'lies on' "$err" && fail "a local disk is taken for a network's"
    printf '#!/bin/sh\nexec env LD_PRELOAD=%s PERCUSS_FAULT_PATH=%s PERCUSS_FAULT_FILESYSTEM=0x6969 %s "$@"\n' \
        "$interpose" "$work/" "$bin/percussd" >"$work/on-nfs"
    chmod +x "$work/on-nfs"
    PERCUSSD=$work/on-nfs
    start_daemon
    logged "warning store: $store: lies on NFS" || fail "the log does not say so"
    stop_daemon
fi
