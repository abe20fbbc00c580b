#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A user types what he types everywhere.
. "$(dirname "$0")/lib.sh"

commands=$("$bin/percuss" help | sed -n '/^Commands:$/,/^$/s/^  \([a-z]*\) .*/\1/p')
[ "$(echo "$commands" | wc -w)" -ge 10 ] || fail "the commands are not listed"

say "-h, help COMMAND and --help say the same, without a server"
for name in $commands; do
    "$bin/percuss" "$name" --help >"$work/help"
    grep -q "^Usage: percuss $name" "$work/help" || fail "$name --help is not about it"
    expect 0 "$bin/percuss" "$name" -h
    cmp -s "$out" "$work/help" || fail "$name -h"
    expect 0 "$bin/percuss" help "$name"
    cmp -s "$out" "$work/help" || fail "help $name"
    grep -q "^\.Cm $name$" "$source_dir/client/man/percuss.1" || fail "the man page lacks $name"
done
"$bin/percuss" --help >"$work/help"
for arguments in -h help "help help" "help --help"; do
    # words
    # shellcheck disable=SC2086
    expect 0 "$bin/percuss" $arguments
    cmp -s "$out" "$work/help" || fail "$arguments"
done
expect 2 "$bin/percuss" help qury
says "'qury' is not a command"

say "-v and --version"
"$bin/percuss" --version >"$work/version"
grep -q '^percuss [0-9]' "$work/version" || fail "no version"
for arguments in -v -V "query -v"; do
    # shellcheck disable=SC2086
    expect 0 "$bin/percuss" $arguments
    cmp -s "$out" "$work/version" || fail "$arguments"
done
