#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Packets of running daemons and clients come again with bytes changed or missing. Such a peer can take
# anybody's part, so what is asked meanwhile may stay without an answer; but nobody ends of it, and
# when it is over everything is as before. PERCUSS_DAMAGED: how many packets.
. "$(dirname "$0")/../support/lib.sh"

start_daemon
expect 0 query --json
numbers "$out" >"$work/true"

python3 "$support/mutate.py" "$domain" "${PERCUSS_DAMAGED:-20000}" "$work/listens" 2>"$err" 9>&- &
attacker=$!
others=$attacker
listens_or_dead() {
    [ -s "$work/listens" ] || is_gone "$attacker"
}
wait_for 10 listens_or_dead || fail "nobody listens"
if ! [ -s "$work/listens" ] && grep -q PermissionError "$err"; then
    say "packets cannot be listened to (it takes root): skipped"
    exit 77
fi
[ -s "$work/listens" ] || fail "nobody listens"

answered=0
unanswered=0
# asks COMMAND...: an answer, or none; a signal (128 and more) or a sanitizer's word is neither
asks() {
    code=0
    "$@" >"$out" 2>"$err" 9>&- || code=$?
    case $code in
    0 | 1) answered=$((answered + 1)) ;;
    3 | 4 | 5) unanswered=$((unanswered + 1)) ;;
    *) fail "exit code $code: $*" ;;
    esac
    if grep -q "Sanitizer\|runtime error" "$err" "$log"; then fail "a sanitizer complains: $*"; fi
    if is_gone "$daemon"; then fail "the daemon has ended: $*"; fi
}
turns=0
while ! is_gone "$attacker" && [ "$turns" -lt 200 ]; do
    asks query --timeout 1
    asks percuss sweep --a steel-sphere --b al-beam --speed 0.1:0.4:4 --timeout 1
    asks percuss bodies --timeout 1
    asks percuss status --timeout 1
    turns=$((turns + 1))
done
is_gone "$attacker" || fail "the damaged packets are not sent after $turns turns"
say "$answered answered, $unanswered not"

# leases of participants that never were run out
able() {
    query --json --timeout 5 >"$out" 2>"$err" 9>&-
}
wait_for 20 able || fail "no answer after it"
numbers "$out" | cmp - "$work/true" || fail "another answer"
stop_daemon
