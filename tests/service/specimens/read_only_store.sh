#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The volume of a store becomes read-only under the daemon, as a kernel makes it that has found an error on the disk:
# impacts on specimens are refused by name and change nothing, others are answered, and what was acknowledged is there
# when it can be written again. With a disk of its own, which takes root and a loop device; else with fault/interpose.c
# in place of the disk.
# a user other than root may mount no disk, not even in a namespace of his own
if [ -z "${PERCUSS_OWN_MOUNTS:-}" ] && [ "$(id -u)" = 0 ] && unshare --mount true 2>/dev/null; then
    PERCUSS_OWN_MOUNTS=yes exec unshare --mount sh "$0" "$@"
fi
. "$(dirname "$0")/../support/lib.sh"

volume=$work/volume
mkdir "$volume"
trap 'umount -l "$volume" 2>/dev/null || true; cleanup' EXIT
mount_disk() {
    mount -o loop,errors=remount-ro "$work/disk" "$volume"
}
head -c 16M /dev/zero >"$work/disk"
disk=no
: >"$err"
[ "${PERCUSS_OWN_MOUNTS:-}" != yes ] || ! mkfs.ext4 -q "$work/disk" 2>"$err" || ! mount_disk 2>"$err" || disk=yes
if [ "$disk" = no ]; then
    say "no disk can be mounted here: $(cat "$err")"
    if is_sanitized thread; then
        echo "the thread sanitizer bears nothing in front of it"
        exit 77
    fi
    interpose=$(preload "$build/tests/libinterpose.so")
    PERCUSSD=$work/percussd
    printf '#!/bin/sh\nexec env LD_PRELOAD=%s PERCUSS_FAULT_PATH=%s PERCUSS_FAULT_READ_ONLY=%s %s "$@"\n' \
        "$interpose" "$volume/" "$work/read-only" "$bin/percussd" >"$PERCUSSD"
    chmod +x "$PERCUSSD"
fi
settings "store: $volume/specimens.db"

# strike NUMBER: an impact with that number
strike() {
    cat >"$work/request.json" <<JSON
{"client": "00112233445566778899aabbccddeeff", "sequence": $1,
 "bodies": [{"id": "steel-sphere", "position": [0.515, 0, 0], "velocity": [-0.3, 0, 0]},
            {"id": "al-rod-1", "specimen": "bar-1"}],
 "contacts": [{"a": 0, "b": 1, "point": [0.5, 0, 0], "normal": [1, 0, 0]}],
 "options": {"contact_model": "closed-form", "compliance": "half-space"}}
JSON
    percuss query --request "$work/request.json" --json
}

impacts() {
    expect 0 percuss dents --specimen bar-1 --json
    field impacts
}

# break_disk: the kernel is told that it has found an error
break_disk() {
    [ "$disk" = yes ] || {
        : >"$work/read-only"
        return
    }
    device=$(losetup -j "$work/disk" | cut -d: -f1)
    echo 1 >"/sys/fs/ext4/${device##*/}/trigger_fs_error"
}

say "nobody makes it read-only while the store is open"
start_daemon
expect 0 strike 1
[ "$disk" = no ] || expect 32 mount -o remount,ro "$volume"
expect 0 strike 2
cp "$out" "$work/second"

say "but the kernel itself: impacts on specimens are refused by name, others are answered"
break_disk
for again in 1 2 3; do
    expect 5 strike 3
    shows '"INTERNAL"'
    grep -q "bodies\[1\].specimen: bar-1: cannot be stored: the store of specimens failed: $volume/specimens.db: the impact is not stored: .*: nothing has changed: mend the store and ask again" "$out" ||
        fail "not refused by name"
done
grep -q 'I/O error: Input/output error\|I/O error: Read-only file system' "$out" || fail "the system's reason is missing"
logged "error   store: an impact on bar-1 is refused: the store of specimens failed" || fail "not logged"
expect 0 query
expect 0 strike 2
cmp -s "$out" "$work/second" || fail "another reply"
[ "$(impacts)" = 2 ] || fail "$(cat "$out")"

say "it ends in good order; on a read-only volume it does not start, and says why"
stop_daemon
if [ "$disk" = yes ]; then
    umount "$volume"
    mount_disk
    mount -o remount,ro "$volume"
    for check in "" --check-config; do
        expect 1 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" $check
        says "specimens.db: cannot be written: Read-only file system"
    done
    mount -o remount,rw "$volume"
fi
rm -f "$work/read-only"

say "made writable again: what was acknowledged is there, what was refused is asked again and counted once"
start_daemon
[ "$(impacts)" = 2 ] || fail "$(cat "$out")"
expect 0 strike 2
cmp -s "$out" "$work/second" || fail "another reply"
expect 0 strike 3
expect 0 strike 3
[ "$(impacts)" = 3 ] || fail "$(cat "$out")"
stop_daemon
