#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Someone reads the documents and types what they say is to be typed. (tutorial.sh follows the tutorial.)
. "$(dirname "$0")/../support/lib.sh"
. "$source_dir/tests/documents.sh"
settings "tables: $source_dir/config/tables" "store: $work/specimens.db"
PERCUSS_DOMAIN=$domain
PATH=$bin:$PATH
# for the page that asks from Python, where that has what it needs
python=$build/python-venv
[ ! -e "$python/wanted" ] || PATH=$python/bin:$PATH
export PERCUSS_DOMAIN PATH

# read_page FILE: all of its commands, in a folder with what the source has, where nothing else is lost
read_page() {
    runnable "$source_dir/$1" | sed -e '/&$/s|$|\nsleep 1|' >"$work/script"
    say "$1: $(grep -c '^[^ ]*percuss' "$work/script") commands"
    mkdir -p "$work/desk/docs/figures"
    ln -s "$source_dir/client" "$source_dir/config" "$source_dir/idl" "$work/desk"
    ln -s "$build" "$work/desk/build"
    cd "$work/desk"
    grep -q '^[^ ]*percussd' "$work/script" || start_daemon
    expect 0 follow <"$work/script"
    [ -s "$out" ] || fail "nothing is printed"
    # pictures and tables that it says are written
    for file in $(grep -o '\(--plot\|--csv\|>\) *[^ -][^ ]*\.[a-z]*' "$work/script" | sed 's/^[^ >]*[ >]*//'); do
        [ -s "$file" ] || fail "$file is not written"
    done
    [ -z "$daemon" ] || stop_daemon
    cd "$work"
    rm -rf "$work/desk"
}

count=0
for page in README.md $(cd "$source_dir" && echo docs/*.md docs/*/*.md); do
    [ "$page" != docs/tutorial.md ] && runnable "$source_dir/$page" >/dev/null || continue
    [ "$page" != docs/dds.md ] || [ -e "$python/wanted" ] || {
        say "$page: no virtual environment (see the test python/environment): left out"
        continue
    }
    read_page "$page"
    count=$((count + 1))
done
[ "$count" -ge 6 ] || fail "only $count pages have commands"
