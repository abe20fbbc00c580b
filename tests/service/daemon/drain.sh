#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# SIGTERM: what has been asked is answered, what comes later is refused.
. "$(dirname "$0")/../support/lib.sh"

# where others want the processor too, four of them by CVODE take longer than anybody waits by default
settings "workers: 1" "drain_seconds: 90"
start_daemon

say "requests that are being answered or wait when the signal comes are answered"
others=
for i in 1 2 3 4; do
    query --method cvode --json --timeout 90 >"$work/answer-$i" 2>&1 9>&- &
    others="$others $!"
done
sleep 0.8
kill -TERM "$daemon"
wait_for 5 logged "draining" || fail "the signal is not heard"

say "a new request is refused"
code=0
query >"$out" 2>"$err" || code=$?
case $code in
3) ;; # it has ended already
5) says "shutting down" ;;
*) fail "exit code $code" ;;
esac

for client in $others; do
    wait "$client" || fail "a client got no answer: $(cat "$work"/answer-*)"
done
others=
for i in 1 2 3 4; do
    [ "$(field status "$work/answer-$i")" = OK ] || fail "answer $i: $(cat "$work/answer-$i")"
done
wait_for 90 is_gone "$daemon" || fail "it does not end"
wait "$daemon" || fail "it ends with $?"
