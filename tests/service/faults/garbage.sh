#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Raw garbage in the shape of RTPS, at the daemon and at clients while they ask: from nobody, from a participant
# of its own, in the name of others. They may lose what they ask (anybody who takes another's part can see to
# that); but nobody ends of it, nothing grows without bound, and when it is over everything is as before.
# PERCUSS_DAMAGED: how many packets.
. "$(dirname "$0")/../support/lib.sh"

python3 "$support/garbage.py" "$domain" "${PERCUSS_DAMAGED:-150000}" "$work/listens" \
    >"$work/garbage" 2>&1 9>&- &
attacker=$!
others=$attacker
listens_or_dead() {
    [ -s "$work/listens" ] || is_gone "$attacker"
}
wait_for 10 listens_or_dead || fail "nobody listens"
[ -s "$work/listens" ] || { cat "$work/garbage" >&2 && fail "the attacker does not begin"; }
start_daemon
resident() {
    sed -n 's/^VmRSS:[[:space:]]*\([0-9]*\) kB/\1/p' "/proc/$daemon/status"
}
before=$(resident)

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
while ! is_gone "$attacker" && [ "$turns" -lt 400 ]; do
    asks query --timeout 1
    asks percuss sweep --a steel-sphere --b al-beam --speed 0.1:0.4:4 --timeout 1
    asks percuss ensemble --a steel-sphere --b al-beam --speed uniform:0.1:0.4 --samples 64 --timeout 1
    asks percuss bodies --timeout 1
    turns=$((turns + 1))
done
is_gone "$attacker" || fail "the garbage is not sent after $turns turns"
wait "$attacker" || { cat "$work/garbage" >&2 && fail "the attacker ended by itself"; }
others=
say "$answered answered, $unanswered not; $(cat "$work/garbage")"

# leases of participants that never were run out
able() {
    query --json --timeout 5 >"$out" 2>"$err" 9>&-
}
wait_for 20 able || fail "no answer after it"
grown=$((($(resident) - before) / 1024))
say "the daemon has grown by $grown MiB"
# kept answers, buffers of DDS and what was learned of participants take some: 16 MiB after 20,000 packets, 40 to 48
# after 150,000, and 50 after 450,000: they are bounded. Each packet kept would take 60 more.
# A sanitizer keeps what was given back
[ "$grown" -lt 60 ] || is_sanitized || [ -n "${PERCUSS_SOAK_PATIENCE:-}" ] || fail "the daemon has grown by $grown MiB"
# the server's id is another one each time
numbers "$out" | grep -v '^  "server":' >"$work/after"
stop_daemon
start_daemon
expect 0 query --json
numbers "$out" | grep -v '^  "server":' | cmp - "$work/after" || fail "another answer than of a daemon that has heard none of it"
stop_daemon
