#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# README to the letter, after its first command has been given. Run by stages.sh inside an empty root.
# usage: first_minute.sh ANSWERS    (what the quickstart printed)
set -eu
cd "$(dirname "$0")/../.."
. tests/documents.sh
answers=$1
said=$(mktemp)

fail() {
    cat "$said"
    echo "FAILED: $*"
    exit 1
}

# the answer shown in README is one of those printed, to the last digit
question='percuss query --a steel-sphere --b al-beam --speed 0.2'
transcript README.md "$question" >"$said"
grep -A "$(wc -l <"$said")" -Fx "\$ $question" "$answers" | sed 1d | diff "$said" - ||
    fail "the quickstart does not print what README shows"
[ "$(grep -c '^  restitution ' "$answers")" -eq 4 ] || fail "the quickstart has not four answers"

# a part of one's own, without a daemon
began=$(date +%s)
commands README.md 'bench.yaml' | follow >"$said" || fail "the part of one's own"
grep -Fx "$(sed -n '/^ball on arm/,/^```/p' README.md | grep '^  restitution')" "$said" ||
    fail "the answer about one's own part is not README's"
[ -s arm.svg ] || fail "no picture of one's own part"
echo "one's own part: $(($(date +%s) - began)) s"

commands README.md 'build/bin/percussd' | follow >"$said" || fail "the commands of the first minute"
grep -q '^  restitution  0\.' "$said" || fail "no answer"
[ "$(head -c 4 impact.png | tail -c 3)" = PNG ] || fail "no picture"

# the example against an installed tree, in an empty folder
prefix=$(mktemp -d)
cmake --install build --prefix "$prefix" >/dev/null
commands README.md 'cc query.c' | sed "s|PREFIX|$prefix|g" |
    { cd "$(mktemp -d)" && follow; } >"$said" || fail "the example"
grep '^e = ' "$said" || fail "the example prints no e"

# a build that asks for tests that cannot be had here: the quickstart does without
! cmake -S . -B build -DBUILD_TESTING=ON >"$said" 2>&1 || fail "tests are configured without their packages"
sh deploy/quickstart.sh >"$said" 2>&1 || fail "the quickstart over a build that wants tests"
