#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The log for people, for the journal of systemd and as JSON; at debug it names every request.
. "$(dirname "$0")/../support/lib.sh"

# json PROGRAM [ARGUMENT...]: the program sees the list `lines` of what each line of the log holds
json() {
    program=$1
    shift
    python3 -c "import json, sys
lines = [json.loads(line) for line in sys.stdin]
assert lines
$program" "$@" <"$log" || fail "the log is another one"
}

say "JSON: an object a line, each with time, level and message"
settings "log_level: debug" "log_format: text"
start_daemon --log-format json
expect 0 query --json
client=$(field client)
sequence=$(field sequence)
expect 5 percuss query --a steel-sphere --b 'no "such\ body' --speed 0.3 --json
refused=$(field client)
stop_daemon
json 'assert all({"time", "level", "message"} <= line.keys() for line in lines)
assert all(line["time"].endswith("Z") and len(line["time"]) == 24 for line in lines)
assert lines[-1]["message"] == "ended" and lines[-1]["level"] == "info"'

say "at debug whose request it was, what it got and how long it took"
json 'mine = [line for line in lines if line.get("client") == sys.argv[1] and line["sequence"] == int(sys.argv[2])]
assert len(mine) == 1 and mine[0]["level"] == "debug"
assert mine[0]["message"].startswith("request: OK; waited ") and " ms, solved in " in mine[0]["message"]' \
    "$client" "$sequence"
json 'mine = [line for line in lines if line.get("client") == sys.argv[1] and line.get("sequence")]
assert len(mine) == 1
assert mine[0]["message"].startswith("request: UNKNOWN_BODY: ") and "no \"such\\ body" in mine[0]["message"]' "$refused"

say "batches and ensembles have their lines"
start_daemon --log-format json
expect 0 "$peers/wire_exchanges" "$domain"
expect 0 percuss ensemble --a steel-sphere --b al-rod --speed uniform:0.1:0.2 --samples 100
expect 5 percuss ensemble --a steel-sphere --b al-rod --speed uniform:0.2:0.1 --samples 100
stop_daemon
json 'said = [line["message"] for line in lines if "client" in line]
assert any(message.startswith("batch of ") and message.endswith(": OK") for message in said), said
assert "ensemble: OK" in said, said
assert any(message.startswith("ensemble: BAD_REQUEST: ") for message in said), said'

say "without debug none of this is there"
settings "log_format: json"
start_daemon
expect 0 query
stop_daemon
json 'assert not any("client" in line for line in lines)'

say "the journal has its own clock, and takes the level as a prefix"
start_daemon --log-format journal
stop_daemon
logged '^<6>ready: domain ' || fail "no such line"
grep -v '^<[3-7]>' "$log" >"$out" && fail "a line without a level"

say "other formats are refused"
expect 2 "$bin/percussd" --config "$work/percussd.yaml" --log-format xml
says "--log-format: xml: must be text, journal or json"
