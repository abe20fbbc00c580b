#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A store on a volume without room: the daemon starts, answers impacts, refuses those on specimens by name and
# stores them when there is room and no other process has the file; the log beside it leaves room to be written back.
if [ "${PERCUSS_OWN_MOUNTS:-}" != yes ]; then
    # root needs no namespace of users, and has none in a root of its own (chroot)
    [ "$(id -u)" = 0 ] && own="unshare --mount" || own="unshare -rm"
    $own true 2>/dev/null || {
        echo "no volume can be mounted here"
        exit 77
    }
    PERCUSS_OWN_MOUNTS=yes exec $own sh "$0" "$@"
fi
. "$(dirname "$0")/../support/lib.sh"

volume=$work/volume
mkdir "$volume"
trap 'umount -l "$volume" 2>/dev/null; cleanup' EXIT
mount -t tmpfs -o size=6m none "$volume" || exit 77
settings "store: $volume/specimens.db"

# strike SPECIMEN NUMBER: an impact with that number
strike() {
    cat >"$work/request.json" <<JSON
{"client": "00112233445566778899aabbccddeeff", "sequence": $2,
 "bodies": [{"id": "steel-sphere", "position": [0.515, 0, 0], "velocity": [-0.3, 0, 0]},
            {"id": "al-rod-1", "specimen": "$1"}],
 "contacts": [{"a": 0, "b": 1, "point": [0.5, 0, 0], "normal": [1, 0, 0]}],
 "options": {"contact_model": "closed-form", "compliance": "half-space"}}
JSON
    percuss query --request "$work/request.json" --json
}

impacts() {
    expect 0 percuss dents --specimen "$1" --json
    field impacts
}

# fill: all the room that is left
fill() {
    dd if=/dev/zero of="$volume/other" bs=4k 2>/dev/null || true
}

# refused SPECIMEN NUMBER ROOM
refused() {
    expect 5 strike "$1" "$2"
    shows "\"INTERNAL\""
    grep -q "bodies\[1\].specimen: $1: cannot be stored: there is no room: $3 KiB are free in $volume/, and 2048 are needed: nothing has changed: make room there and ask again" "$out" ||
        fail "not refused by name"
}

say "no room to create the store: the daemon starts, and answers what names no specimen"
fill
expect 0 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" --check-config
says "warning: store: $volume/specimens.db: there is no room: 0 KiB are free in $volume/, and 2048 are needed"
start_daemon
logged "warning store: there is no room: 0 KiB are free in .*: requests that name specimens are refused meanwhile" || fail "not said"
expect 0 query
refused bar-1 1 0
kill -USR1 "$daemon"
wait_for 5 logged "store: not looked through: there is no room" || fail "not said"

say "it recovers when there is room and no other process has the store, without a restart"
rm "$volume/other"
: >"$volume/specimens.db"
: >"$work/held"
"$peers/store_sql" "$volume/specimens.db" "BEGIN EXCLUSIVE" 60 >"$work/held" 9>&- &
others=$!
wait_for 10 grep -q held "$work/held" || fail "nobody holds the store"
expect 5 strike bar-1 1
grep -q "bodies\[1\].specimen: bar-1: cannot be stored: $volume/specimens.db: is in use by another process: nothing has changed: mend the store and ask again" "$out" ||
    fail "not refused by name"
expect 0 query
kill "$others"
wait "$others" 2>/dev/null || true
others=
expect 0 strike bar-1 1
logged "info    store: .*specimens.db: there is room" || fail "not said"
[ "$(impacts bar-1)" = 1 ] || fail "$(cat "$out")"

say "room that goes while it runs, for some impacts or for all: nothing is counted that is not stored"
expect 0 strike bar-1 2
cp "$out" "$work/second"
fill
refused bar-1 3 0
expect 0 query
# what was stored is still told
expect 0 strike bar-1 2
cmp -s "$out" "$work/second" || fail "another reply"
[ "$(impacts bar-1)" = 2 ] || fail "$(cat "$out")"

say "a start with a store and no room"
stop_daemon
fill
start_daemon
logged "warning store: there is no room: 0 KiB are free" || fail "not said"
expect 1 percuss doctor
shows "warning  state: store: $volume/specimens.db: there is no room: 0 KiB are free in $volume/, and 2048 are needed"
expect 0 query
refused bar-1 3 0
[ "$(impacts bar-1)" = 2 ] || fail "$(cat "$out")"
rm "$volume/other"
expect 0 strike bar-1 3
[ "$(impacts bar-1)" = 3 ] || fail "$(cat "$out")"

say "the store's own volume is not filled by its log: it ends, starts and clears with what is left"
number=4
dd if=/dev/zero of="$volume/other" bs=1k count=2816 2>/dev/null
while strike "bar-$number" "$number" >"$out" 2>"$err"; do
    number=$((number + 1))
    [ "$number" -lt 400 ] || fail "the volume is never full"
done
grep -q "bar-$number: cannot be stored: there is no room" "$out" || fail "refused for something else"
[ "$number" -gt 60 ] || fail "only $number impacts"
[ "$(stat -c %s "$volume/specimens.db-wal")" -lt 1200000 ] || fail "$(ls -l "$volume")"
expect 0 percuss dents --specimen bar-5 --clear
logged "specimen bar-5: cleared" || wait_for 5 logged "specimen bar-5: cleared" || fail "not cleared"
stop_daemon
[ ! -e "$volume/specimens.db-wal" ] || fail "the log was not written back"
expect 0 "$bin/percussd" --check-store "$volume/specimens.db"
says "$((number - 4)) specimens, $((number - 1)) replies"
