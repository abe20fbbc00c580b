#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Requests of which none is of use to the next: what the daemon keeps of them comes to a plateau, which the
# setting limits.megabytes says.
. "$(dirname "$0")/../support/lib.sh"

most=64
metrics=$work/percuss.prom
cat >"$work/catalogue.yaml" <<'YAML'
materials:
  steel:     {young: 210e9, poisson: 0.30, density: 7800}
  aluminium: {young: 70e9, poisson: 0.33, density: 2700}
bodies:
  steel-sphere: {shape: sphere, material: steel, radius: 0.015}
  al-rod:       {shape: rod, material: aluminium, radius: 0.010, length: 1.0}
  al-beam:      {shape: beam, material: aluminium, radius: 0.010, length: 1.0, damping: 0.001}
  block:        {shape: block, material: aluminium, size: [0.1, 0.02, 0.02]}
YAML
settings "metrics: $metrics" "workers: 2" "limits: {megabytes: $most}" "replies: {per_client: 65536}"
start_daemon
logged "memory: .* $most MiB by limits.megabytes: tokens.megabytes 16 of 256, replies.megabytes 16 of 256" ||
    fail "the log does not say the shares"

# kept [WHAT]: bytes, of all or one
kept() {
    awk -v what="${1:-}" '/^percuss_kept_bytes/ && (!what || index($0, "\"" what "\"")) { sum += $2 }
        END { printf "%d\n", sum }' "$metrics"
}
resident() {
    awk '/^VmRSS/ { print 1024 * $2 }' "/proc/$daemon/status"
}

# hoard COUNT SEED, and the metrics that are written a second later
hoard() {
    expect 0 "$peers/wire_hoard" "$domain" "$1" "$2"
    shows "$1 of $1 solved"
    sleep 1.5
    echo "$1 requests: kept $(kept) bytes: states $(kept states), replies $(kept replies)," \
        "vibrations $(kept vibrations), bodies $(kept bodies); resident $(resident)"
}

say "all four parts fill"
hoard 1000 1
filled=$(kept)
first=$(resident)
for what in states replies vibrations bodies; do
    [ "$(kept $what)" -gt 0 ] || fail "no $what"
done

say "and stay within the sum, however many come"
for seed in 2 3 4; do
    hoard 1000 $seed
    # a solve's own needs come on top, of the threads that are solving
    [ "$(kept)" -le $((most * 1048576)) ] || fail "$(kept) bytes"
done
[ "$filled" -gt $((most * 1048576 / 4)) ] || fail "$filled bytes are no test of a limit of $most MiB"

# what one of them leaves besides is some KiB: 3000 more would be some hundred MiB
say "so does the process: what it has besides is the allocator's slack"
# sanitizers keep what is freed
if ! is_sanitized; then
    [ "$(resident)" -le $((first + 48 * 1048576)) ] || fail "$first bytes, then $(resident)"
fi
expect 0 percuss query --a steel-sphere --b al-beam --speed 0.2
stop_daemon
