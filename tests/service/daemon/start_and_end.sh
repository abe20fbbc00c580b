#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A daemon starts, says so, is seen, and ends when asked.
. "$(dirname "$0")/../support/lib.sh"

say "percussd says what it is and how it is used"
expect 0 "$bin/percussd" --version
shows "percussd "
expect 0 "$bin/percussd" --help
shows "--check-config"
expect 2 "$bin/percussd" --config "$work/percussd.yaml" --domain 231
says "must be a whole number, 0 to 230"
expect 2 "$bin/percussd" --config "$work/percussd.yaml" left-over

say "it announces that it is ready"
start_daemon
logged "ready: domain $domain, [0-9]* bodies, catalogue revision [0-9a-f]" ||
    fail "the line of readiness is another one"

say "its status and its bodies can be seen"
expect 0 percuss status
shows "ready"
shows "$work/catalogue.yaml"
expect 0 percuss bodies
shows "steel-sphere"
shows "al-rod-1"
expect 0 percuss ping

say "it ends on SIGTERM and on SIGINT"
stop_daemon
logged "ended" || fail "it does not say that it ended"
start_daemon
kill -INT "$daemon"
wait_for 20 is_gone "$daemon" || fail "SIGINT does not end it"
