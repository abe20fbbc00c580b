#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# From a fresh clone to answers: installs what is missing, builds into build/, starts the daemon on
# loopback, asks about the paper's rod and beam, stops what it started.
set -eu
cd "$(dirname "$0")/.."

sh deploy/dependencies.sh build
echo "building into build/ ..." >&2
configure() {
    cmake -S . -B build -DCMAKE_BUILD_TYPE=Release "$@" >build.log 2>&1
}
# a build that has tests keeps them; without what only tests need there are none
if [ -e build/CMakeCache.txt ] && configure; then
    :
else
    configure -DBUILD_TESTING=OFF
fi && cmake --build build --parallel "$(nproc)" >>build.log 2>&1 || {
    tail -n 30 build.log >&2
    exit 1
}
rm -f build.log

# a domain of its own, so that nothing else on the machine is met
domain=$((100 + $$ % 100))
log=$(mktemp)
build/bin/percussd --config config/percussd.yaml --domain "$domain" 2>"$log" &
daemon=$!
trap 'kill "$daemon" 2>/dev/null || true; wait "$daemon" 2>/dev/null || true; rm -f "$log"' EXIT
waited=0
until grep -q ready "$log"; do
    waited=$((waited + 1))
    if [ "$waited" -gt 100 ] || ! kill -0 "$daemon" 2>/dev/null; then
        cat "$log" >&2
        exit 1
    fi
    sleep 0.1
done

for body in al-rod al-beam; do
    for speed in 0.2 0.3; do
        echo
        echo "\$ percuss query --a steel-sphere --b $body --speed $speed"
        build/bin/percuss query --a steel-sphere --b "$body" --speed "$speed" --domain "$domain"
    done
done

cat <<EOT

Next: a part of your own needs some lines in a file and no daemon ("Your own part" in README.md)
  build/bin/percuss query --local --catalogue bench.yaml --a ball --b arm --speed 300mm/s
For several programs start the daemon, and ask it
  build/bin/percussd &
  build/bin/percuss query --a steel-sphere --b al-beam --speed 0.276
  build/bin/percuss sweep --a steel-sphere --b al-beam --speed 0.1:0.4:31
EOT
