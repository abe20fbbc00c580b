#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A store that is damaged, of another version, read-only or on a full disk: it is said, nothing is counted
# wrongly, and a copy made while the daemon ran takes its place.
. "$(dirname "$0")/../support/lib.sh"

store=$work/specimens.db
copy=$work/copy.db
settings "store: specimens.db" "backup: copy.db" "metrics: percuss.prom"

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

kill_daemon() {
    kill -KILL "$daemon"
    wait "$daemon" 2>/dev/null || true
    daemon=
}

# back_up WORDS: what the log says after the signal
back_up() {
    : >"$log"
    kill -USR1 "$daemon"
    wait_for 10 logged "$1" || fail "the log does not say $1"
}

check_store() {
    expect "$1" "$bin/percussd" --check-store "$2"
}

say "looked through and copied while it is used"
start_daemon
logged "store: 0 specimens, 0 replies, 0 marks of clients: 0 damaged" || fail "not looked through at start"
expect 0 strike bar-1 1
expect 0 strike bar-2 2
expect 0 strike bar-1 3
cp "$out" "$work/third"
expect 0 percuss dents --json
cp "$out" "$work/dents"
back_up "store: copied to $copy"
logged "store: 2 specimens, 3 replies, 0 marks of clients: 0 damaged" || fail "not looked through"
check_store 0 "$copy"
says "2 specimens, 3 replies"
expect 0 strike bar-1 4
check_store 1 "$store"
says "is in use by another process"

say "a copy that cannot be written leaves the former one"
cp "$copy" "$work/before.db"
mkdir "$copy.part"
back_up "store: not copied: .*copy.db.part: cannot be written"
cmp -s "$copy" "$work/before.db" || fail "the former copy is gone"
rmdir "$copy.part"

say "links at the names of what is written lead to no other file"
echo precious >"$work/victim"
for name in "$copy.part" "$work/percuss.prom.part" "$work/percuss.prom"; do
    ln -sf "$work/victim" "$name"
done
sleep 2
back_up "store: copied to $copy"
[ "$(cat "$work/victim")" = precious ] || fail "a link was followed"
cp "$work/before.db" "$copy"
[ -s "$work/percuss.prom" ] && [ ! -L "$work/percuss.prom" ] || fail "no metrics"
stop_daemon
[ "$(ls "$work" | grep -c 'part\|-wal\|-journal')" -eq 0 ] || fail "left: $(ls "$work")"
cp "$store" "$work/whole.db"

say "dents that have changed on disk: their specimen is refused, the others are not"
expect 0 "$peers/store_sql" "$store" \
    "UPDATE dents SET residual = 2 * residual WHERE specimen = (SELECT id FROM specimens WHERE name = 'bar-1')"
check_store 1 "$store"
says "bar-1: what the store holds of it is damaged"
says "4 replies, 0 marks of clients: 1 damaged"
start_daemon
logged "error .*bar-1: what the store holds of it is damaged" || fail "not logged"
expect 5 strike bar-1 5
shows "bodies[1].specimen: bar-1: what the store holds of it is damaged"
expect 0 strike bar-2 6
expect 0 percuss dents
shows "bar-1  (damaged), 3 impacts, 0 dents"
shows "bar-2  al-rod-1, 2 impacts"
back_up "store: not copied: .*bar-1"
cmp -s "$copy" "$work/before.db" || fail "a damaged store has replaced the copy"
# cleared, the name is free again
expect 0 percuss dents --specimen bar-1 --clear
expect 0 strike bar-1 7
[ "$(impacts bar-1)" = 1 ] || fail "$(cat "$out")"
back_up "store: copied to"
cp "$work/before.db" "$copy"
stop_daemon

say "64 bytes anywhere: the daemon refuses the store, says what is damaged, or nothing differs"
size=$(wc -c <"$work/whole.db")
noticed=0
for i in $(seq 0 19); do
    cp "$work/whole.db" "$store"
    head -c 64 /dev/urandom | dd of="$store" bs=1 seek=$((size * i / 20 + i * 17 % 512)) conv=notrunc 2>/dev/null
    code=0
    "$bin/percussd" --check-store "$store" 2>"$err" || code=$?
    [ "$code" -le 1 ] || fail "exit code $code"
    [ "$code" -eq 0 ] || noticed=$((noticed + 1))
done
[ "$noticed" -gt 0 ] || fail "none of 20 was noticed"
echo "  $noticed of 20 noticed"

say "the copy in its place: dents and replies are those of its time"
cp "$copy" "$store"
start_daemon
expect 0 percuss dents --json
cmp -s "$out" "$work/dents" || fail "other dents: $(diff "$out" "$work/dents")"
expect 0 strike bar-1 3
cmp -s "$out" "$work/third" || fail "another reply"
[ "$(impacts bar-1)" = 2 ] || fail "$(cat "$out")"
stop_daemon

say "a store of a newer version is refused in words, one of an older version opens"
expect 0 "$peers/store_sql" "$store" "UPDATE specimens SET impacts = impacts; PRAGMA user_version = 9"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain"
says "specimens.db: is of version 9: must be of version 1 to 3"
expect 0 "$peers/store_sql" "$store" "UPDATE specimens SET impacts = impacts;
    ALTER TABLE replies DROP COLUMN checksum; ALTER TABLE specimens DROP COLUMN checksum;
    ALTER TABLE marks DROP COLUMN checksum; PRAGMA user_version = 1"
start_daemon
expect 0 percuss dents --json
cmp -s "$out" "$work/dents" || fail "other dents: $(diff "$out" "$work/dents")"
expect 0 strike bar-1 3
cmp -s "$out" "$work/third" || fail "another reply"
stop_daemon

say "a full disk: nothing changes, and it goes on when there is room"
cat >"$work/full.sh" <<'SH'
#!/bin/sh
# no file longer than 200 KiB, and no signal about it
ulimit -f 400
trap '' XFSZ
exec "$@"
SH
: >"$log"
sh "$work/full.sh" "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" 2>>"$log" 9>&- &
daemon=$!
wait_for 20 is_up_or_dead || fail "not ready"
number=10
while strike bar-1 "$number" >"$out" 2>"$err"; do
    number=$((number + 1))
    [ "$number" -lt 60 ] || fail "the disk is never full"
done
shows "bodies[1].specimen: bar-1: cannot be stored: the store of specimens failed: $store: the impact is not stored:"
shows "nothing has changed: mend the store and ask again"
expect 0 percuss query --a steel-sphere --b al-beam --speed 0.3
[ "$(impacts bar-1)" = $((number - 8)) ] || fail "$(field impacts) impacts, $((number - 8)) acknowledged"
# the log of a full disk does not fill it further
for again in $(seq 30); do
    ! strike bar-1 "$number" >/dev/null 2>&1 || fail "there is room"
done
stop_daemon
[ "$(grep -c 'error .*the impact is not stored' "$log")" -eq 21 ] || fail "not 20 lines and their sum"
logged "error   and 11 more in [0-9]* s: .*specimens.db: the impact is not stored" || fail "no sum"
start_daemon
expect 0 strike bar-1 "$number"
[ "$(impacts bar-1)" = $((number - 7)) ] || fail "$(field impacts) impacts of $((number - 7))"
stop_daemon

say "a store in a folder where nobody may write"
mkdir "$work/fixed"
cp "$store" "$work/fixed/specimens.db"
chmod 444 "$work/fixed/specimens.db"
chmod 555 "$work/fixed"
chmod 711 "$work"
if [ "$(id -u)" -ne 0 ]; then
    check_store 1 "$work/fixed/specimens.db"
    says "fixed/specimens.db: cannot be used: Permission denied"
elif setpriv --reuid 65534 --regid 65534 --clear-groups test -x "$bin/percussd" 2>/dev/null; then
    expect 1 setpriv --reuid 65534 --regid 65534 --clear-groups "$bin/percussd" --check-store "$work/fixed/specimens.db"
    says "fixed/specimens.db: cannot be used: Permission denied"
fi
