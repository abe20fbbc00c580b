#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A stranger has the installed tree and nothing else: its documents are followed to the letter, its
# settings answer as those of the source, and nothing points to where it was built.
. "$(dirname "$0")/../support/lib.sh"
. "$source_dir/tests/documents.sh"
prefix=$work/prefix
documents=$prefix/share/doc/percuss
# found by nobody who does not look into the prefix
unset PKG_CONFIG_PATH LD_LIBRARY_PATH PERCUSS_LIBRARY

# in_tree FILE TEXT: the installed document's commands with that text, in this domain, where we are
in_tree() {
    commands "$documents/$1" "$2" | sed "s|PREFIX|$prefix|g" | in_domain "$domain" >"$work/commands"
    [ -s "$work/commands" ] || fail "$1 has no commands with $2"
    expect 0 follow <"$work/commands"
}

say "installing"
cmake --install "$build" --prefix "$prefix" >"$work/install.log"
for file in bin/percuss share/man/man1/percuss.1 share/man/man8/percussd.8 share/man/man8/percuss-tables.8 \
    share/man/man5/percuss-catalogue.5 share/man/man5/percussd.yaml.5 share/man/man8/percuss-reduce.8 sbin/percuss-reduce \
    include/percuss/percuss.h include/percuss/vocabulary.h include/percuss/slowscale.h \
    include/percuss/slow_equations.h include/percuss/measured.h lib/pkgconfig/percuss-measured.pc share/percuss/percuss_wire.idl share/percuss/catalogue.yaml \
    share/percuss/percussd.yaml share/percuss/bodies/half-plate-20.h5 share/percuss/examples/query.c share/percuss/python/pyproject.toml \
    share/percuss/python/percuss/__init__.py share/percuss/python/examples/speed_sweep.py \
    share/doc/percuss/README.md share/doc/percuss/integrating.md share/doc/percuss/LICENSE; do
    [ -f "$prefix/$file" ] || fail "$file is not installed"
done
for name in percussd.yaml catalogue.yaml; do
    [ "$(find "$prefix" -path "$prefix/share/percuss/examples" -prune -o -name $name -print | wc -l)" -eq 1 ] ||
        fail "$name is there more than once"
done
"$prefix/bin/percuss" --version
expect 0 "$prefix"/sbin/percussd --config "$prefix/share/percuss/percussd.yaml" --check-config
# a copy of the catalogue has left its bodies' files behind
expect 0 "$prefix"/sbin/percussd --config "$prefix/share/percuss/percussd.yaml" \
    --catalogue "$work/catalogue.yaml" --check-config

say "the documents' links and files are there"
dead_links "$prefix" >"$out"
[ ! -s "$out" ] || fail "dead links"
if grep -rlF -e "$source_dir" -e "$build" -e build/bin "$documents" "$prefix/bin" "$prefix/sbin" \
    "$prefix/lib" >"$out"; then
    fail "the tree points to where it was built"
fi

say "nothing but percuss_ leaves the libraries, and their headers do not need those of DDS"
libraries=$prefix/lib
for library in libpercuss libpercuss-local libpercuss-measured libpercuss-slowscale; do
    if nm -D --defined-only "$libraries/$library.so" | awk '{print $3}' | grep -v '^percuss_' ||
        nm -D --defined-only "$libraries/$library.so" | grep ' percuss_v1_'; then
        fail "$library exports symbols of its inside"
    fi
done
if ldd "$libraries/libpercuss-slowscale.so" | grep -E 'dds|lapack|blas|sundials'; then
    fail "libpercuss-slowscale needs more than the C library"
fi
! ldd "$libraries/libpercuss-local.so" | grep dds || fail "libpercuss-local needs DDS"
! grep -rl 'dds/' "$prefix/include/percuss" || fail "a public header includes DDS"

say "README: a program, compiled and run"
mkdir "$work/program" && cd "$work/program"
in_tree README.md 'cc query.c'
grep '^e = ' "$out" >"$work/by-pkg-config"
cmake -S "$prefix/share/percuss/examples" -B "$work/by-cmake" -DCMAKE_PREFIX_PATH="$prefix" >"$work/log.cmake"
cmake --build "$work/by-cmake" >>"$work/log.cmake"

say "in process: the installed catalogue, from the command line and a program"
cp "$prefix/share/percuss/examples/local.c" .
PKG_CONFIG_PATH=$libraries/pkgconfig sh -euc "cc local.c \$(pkg-config --cflags --libs percuss-local) -o local"
expect 0 ./local
grep '^0.1 m/s: e = 0.72' "$out" || fail "no e in process"
cp "$out" "$work/by-itself"
expect 0 "$work/by-cmake/local"
cmp "$out" "$work/by-itself" || fail "by-cmake/local"
expect 0 "$prefix/bin/percuss" query --local --a steel-sphere --b al-rod --speed 0.1
shows "restitution  0.72"

say "integrating: an engine, compiled and run, with a daemon and without; the MuJoCo example, run"
PERCUSS_DOMAIN=$domain
export PERCUSS_DOMAIN
in_tree integrating.md 'cc engine.c'
[ "$(grep -c '^sphere 0.1' "$out")" = 2 ] && [ "$(sort -u "$out" | wc -l)" = 2 ] ||
    fail "a daemon's engine and that in process do not end alike"
unset PERCUSS_DOMAIN
ldd ./engine | grep -F "$prefix" | grep -q slowscale || fail "the engine does not find libpercuss-slowscale"
ldd ./engine-in-process | grep -q dds && fail "the engine in process needs DDS"
run=$(sed -n 's|.*`\(sh share/percuss/examples/mujoco/run.sh\)`.*|\1|p' "$documents/integrating.md")
cd "$prefix"
# the words of a command
# shellcheck disable=SC2086
expect 0 ${run:-false}
shows "MuJoCo alone, default contact: e = 0.13"

say "without a server: the command that is advised starts one"
expect 3 "$prefix/bin/percuss" ping --domain "$domain" --timeout 0.5
sed -n 's/.*start one with: //p' "$err" >"$work/advised"
[ -s "$work/advised" ] || fail "no advice"
sh -c "exec $(cat "$work/advised")" 2>"$log" 9>&- &
daemon=$!
wait_for 20 is_up_or_dead || fail "the daemon is not ready after 20 s"
logged 'ready: domain' || fail "the daemon did not start"
# the suite may run as root, which the log does not like
! grep -v 'runs as root' "$log" | grep -q warning || fail "it starts with a warning"

say "its settings have their tables: the answer is that of the source's settings"
rod() {
    expect 0 "$1" query --a steel-sphere --b al-rod-1 --speed 0.276 --domain "$domain" --json
    field restitution
}
installed=$(rod "$prefix/bin/percuss")
"$work/by-cmake/query" "$domain" | grep '^e = ' | cmp - "$work/by-pkg-config" || fail "by-cmake/query"
stop_daemon
settings "tables: $source_dir/config/tables"
start_daemon
[ "$installed" = "$(rod "$bin/percuss")" ] || fail "$installed is not the source's $(field restitution)"
# the paper's rod 1 by its table; without one it is 0.48486
echo "$installed" | awk '{ exit !($1 > 0.4982 && $1 < 0.4992) }' || fail "$installed is not 0.4987"
stop_daemon

say "README: the commands of the first minute"
PATH=$prefix/bin:$prefix/sbin:$PATH
in_tree README.md 'impact.png'
file=$prefix/impact.png
[ "$(head -c 4 "$file" | tail -c 3)" = PNG ] || fail "no picture"
