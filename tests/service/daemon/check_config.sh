#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Settings and catalogues are checked before a daemon starts.
. "$(dirname "$0")/../support/lib.sh"

check() {
    "$bin/percussd" --config "$work/percussd.yaml" --check-config "$@"
}

# refused LINE TEXT SETTING...
refused() {
    line=$1
    text=$2
    shift 2
    settings "$@"
    expect 1 check
    says "percussd.yaml:$line: $text"
    [ ! -s "$out" ] || fail "it prints something on stdout"
}

say "what is shipped is good"
expect 0 "$bin/percussd" --config "$source_dir/config/percussd.yaml" --check-config
shows "ok"
! grep -v "^percussd: materials.[a-z0-9-]*.yield: not stated" "$err" || fail "it says something else on stderr"

say "every setting is understood"
mkdir "$work/somewhere"
settings "domain: 7" "partition: gears" "workers: 3" "queue_capacity: 10" "inline_solves: false" \
    "tokens: {count: 10, megabytes: 1, minutes: 0.5}" "replies: {per_client: 10, megabytes: 1}" \
    "session_minutes: 1" "drain_seconds: 0" "log_level: debug" "tables: somewhere" "bodies_days: 2.5" \
    "store: dents.db" "stored_replies: 10" "bodies: reduced" "log_format: json" \
    "limits: {seconds: 10, samples: 1000, clients: 64}"
expect 0 check
[ "$(ls "$work")" = "$(printf '%s\n' catalogue.yaml err log out percussd.yaml somewhere)" ] || fail "it leaves files"

say "bad settings are refused with file, line and what is allowed"
refused 2 "wrokers: unknown key: must be one of catalogue, domain, partition, workers" "wrokers: 3"
refused 2 "workers: 0: must be a whole number, 1 to 256" "workers: 0"
refused 2 "workers: 2.5: must be a whole number, 1 to 256" "workers: 2.5"
refused 2 "domain: 231: must be a whole number, 0 to 230" "domain: 231"
refused 2 "partition: a/b: must be 1 to 63 letters, digits" "partition: a/b"
refused 3 "inline_solves: maybe: must be true or false" "domain: 1" "inline_solves: maybe"
refused 2 "log_level: loud: must be error, warning, info or debug" "log_level: loud"
refused 2 "log_format: xml: must be text, journal or json" "log_format: xml"
refused 2 "tokens: 5: must be a mapping of keys" "tokens: 5"
refused 2 "limits.samples: 2000001: must be a whole number, 1 to 2000000" "limits: {samples: 2000001}"
refused 2 "tokens.size: unknown key" "tokens: {size: 5}"
refused 2 "session_minutes: long: must be a number" "session_minutes: long"
refused 3 "workers: stands twice" "workers: 1" "workers: 2"
refused 3 "must be valid YAML" "tokens: {"

say "a missing file"
expect 1 "$bin/percussd" --config "$work/none.yaml" --check-config
says "none.yaml: cannot be read"

say "a bad catalogue is refused, by --check-config and by a daemon that should start"
settings
sed -i 's/^  al-beam: {shape: beam/  al-beam: {shape: beem/' "$work/catalogue.yaml"
expect 1 check
says "catalogue.yaml:"
says "beem"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain"
says "beem"

say "the command line goes before the settings"
expect 0 check --catalogue "$source_dir/config/catalogue.yaml"
cp "$source_dir/config/catalogue.yaml" "$work/catalogue.yaml"

say "everything that would stop a start is found at once"
settings "tables: no-tables" "store: no-folder/dents.db" "bodies: no-folder/bodies" \
    "standby: no-folder/standby.lock"
expect 1 check
says "tables: $work/no-tables: cannot be read: No such file or directory"
says "store: $work/no-folder/dents.db: cannot be made: No such file or directory"
says "bodies: $work/no-folder/bodies: cannot be made: No such file or directory"
says "standby: $work/no-folder/standby.lock: cannot be made: No such file or directory"
[ ! -s "$out" ] || fail "it prints something on stdout"

say "a start names the missing folder and the command that makes it, with which it starts"
settings "store: no-folder/dents.db"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain"
sed -n 's/.*its folder is missing: \(.*\) makes it$/\1/p' "$err" >"$work/made"
[ -s "$work/made" ] || fail "no command"
sh -euc "$(cat "$work/made")"
start_daemon
stop_daemon
settings "store: catalogue.yaml"
expect 1 check
says "catalogue.yaml: cannot be used as a store of specimens: file is not a database"

say "tables that are none are told, and the daemon does without"
echo '{}' >"$work/somewhere/0123456789abcdef0123456789abcdef.json"
settings "tables: somewhere"
expect 0 check
says "0123456789abcdef0123456789abcdef.json"

say "a domain that cannot be joined"
settings
export CYCLONEDDS_URI='<CycloneDDS><Domain><General><Interfaces><NetworkInterface name="none0"/></Interfaces></General></Domain></CycloneDDS>'
expect 1 check --domain "$domain"
says "percussd: domain: $domain: "
unset CYCLONEDDS_URI

say "a store that a daemon has open, which goes on undisturbed"
settings "store: dents.db"
expect 0 check
start_daemon
expect 1 check
says "dents.db: is in use by another process ($daemon)"
expect 0 query --specimen-b plate-1
stop_daemon
expect 0 check
