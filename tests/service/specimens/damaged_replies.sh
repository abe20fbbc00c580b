#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A durable reply that was damaged on disk: its client is told, the daemon lives on.
. "$(dirname "$0")/../support/lib.sh"

settings "store: specimens.db"
cat >"$work/request.json" <<'JSON'
{"client": "00112233445566778899aabbccddeeff", "sequence": 7,
 "bodies": [{"id": "steel-sphere", "position": [0.515, 0, 0], "velocity": [-0.3, 0, 0]},
            {"id": "al-rod-1", "specimen": "bar-1"}],
 "contacts": [{"a": 0, "b": 1, "point": [0.5, 0, 0], "normal": [1, 0, 0]}],
 "options": {"contact_model": "closed-form", "compliance": "half-space"}}
JSON
start_daemon
expect 0 percuss query --request "$work/request.json" --json
cp "$out" "$work/first"
stop_daemon
cp "$work/specimens.db" "$work/whole.db"

# the reply says that it ends behind its number: decoding that would be the end of the process
shorten="UPDATE replies SET reply = CAST(x'18000000' || substr(reply, 5) AS BLOB)"
flip="UPDATE replies SET reply = CAST(substr(reply, 1, 90) || x'2a' || substr(reply, 92) AS BLOB)"

# back to a store of version 1
back="ALTER TABLE replies DROP COLUMN checksum; ALTER TABLE specimens DROP COLUMN checksum;
    ALTER TABLE marks DROP COLUMN checksum; PRAGMA user_version = 1"

# repeat WHAT STATEMENTS: the question again after that change of the store; then another one
repeat() {
    say "$1"
    cp "$work/whole.db" "$work/specimens.db"
    expect 0 "$peers/store_sql" "$work/specimens.db" "$2"
    start_daemon
    for i in 1 2; do
        expect 5 percuss query --request "$work/request.json"
        says "INTERNAL: sequence: 7: was answered before, but the stored reply cannot be read any more"
    done
    logged "error .*the stored reply to request 7 is damaged" || fail "the log does not say so"
    sed 's/"sequence": 7/"sequence": 8/' "$work/request.json" >"$work/next.json"
    expect 0 percuss query --request "$work/next.json"
    expect 0 percuss dents --specimen bar-1 --json
    [ "$(field impacts)" = 2 ] || fail "$(field impacts) impacts are counted, not 2"
    stop_daemon
}
repeat "an octet has changed" "$flip"
repeat "it ends too soon" "$shorten"
repeat "it ends too soon, in a store from before there were checksums" \
    "$shorten; $back"

say "a whole reply of such a store is given as it was"
cp "$work/whole.db" "$work/specimens.db"
expect 0 "$peers/store_sql" "$work/specimens.db" \
    "UPDATE replies SET checksum = NULL; $back"
start_daemon
expect 0 percuss query --request "$work/request.json" --json
cmp -s "$out" "$work/first" || fail "another reply: $(diff "$out" "$work/first")"
stop_daemon
