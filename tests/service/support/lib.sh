# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# For the stories: a daemon of their own in a domain of their own, stopped whatever happens.
# Sourced; PERCUSS_BUILD is the build folder, PERCUSS_SOURCE the source folder.
set -eu
unset CYCLONEDDS_URI
# whatever tables a developer has of his own
export PERCUSS_TABLES=
here=$(cd "$(dirname "$0")" && pwd)
source_dir=${PERCUSS_SOURCE:-${here%/tests/*}}
support=$source_dir/tests/service/support
build=$(cd "${PERCUSS_BUILD:-$source_dir/build}" && pwd)
bin=$build/bin
peers=$build/tests/service
work=$(mktemp -d)
log=$work/log
out=$work/out
err=$work/err
daemon=

# a random domain that no other story uses: the lock lives as long as this shell. Below 100 no port of
# the domain is one that the system hands out by itself, and quickstart.sh keeps to 100 and above
while :; do
    domain=$((20 + $(od -An -N2 -tu2 /dev/urandom) % 80))
    exec 9>"${PERCUSS_DOMAIN_LOCKS:-${TMPDIR:-/tmp}}/percuss-domain-$domain.lock"
    flock -n 9 && break
done

# is_sanitized [WHICH]: whether what is tested was built with a sanitizer, which keeps what is unloaded
is_sanitized() {
    grep -q "^PERCUSS_SANITIZE:[A-Z]*=.*${1:-.}" "$build/CMakeCache.txt" 2>/dev/null
}
# its dlopen does not look where the program would, and it bears what preload puts in front of it
if is_sanitized; then
    LD_LIBRARY_PATH=$build/client${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
    ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}verify_asan_link_order=0
    export LD_LIBRARY_PATH ASAN_OPTIONS
fi
# preload LIBRARY: what LD_PRELOAD is for it; the address sanitizer has to come before the C library as well
preload() {
    echo "$1$(ldd "$bin/percuss" | awk '/libasan/ { print ":" $3 }')"
}

say() {
    echo "- $*"
}

fail() {
    echo "FAILED: $*" >&2
    for file in "$out" "$err" "$log"; do
        [ ! -s "$file" ] || { echo "--- ${file##*/}" && tail -n 30 "$file"; } >&2
    done
    exit 1
}

cleanup() {
    for child in $daemon ${others:-}; do
        kill -KILL "$child" 2>/dev/null || true
    done
    wait
    rm -rf "$work"
}
trap cleanup EXIT
trap 'exit 1' INT TERM

# settings for this story: the shipped catalogue and what is given, one "key: value" an argument
settings() {
    printf '%s\n' "catalogue: $work/catalogue.yaml" "$@" >"$work/percussd.yaml"
}
cp "$source_dir/config/catalogue.yaml" "$work/catalogue.yaml"
settings
: >"$log"

# wait_for SECONDS COMMAND...: until the command succeeds
wait_for() {
    left=$(($1 * 20))
    shift
    until "$@"; do
        left=$((left - 1))
        [ "$left" -gt 0 ] || return 1
        sleep 0.05
    done
}

logged() {
    grep -q -- "$1" "$log"
}

is_up_or_dead() {
    logged 'ready: domain' || ! kill -0 "$daemon" 2>/dev/null
}

# start_daemon [ARGUMENT...]; the log begins anew
start_daemon() {
    : >"$log"
    "${PERCUSSD:-$bin/percussd}" --config "$work/percussd.yaml" --domain "$domain" "$@" 2>>"$log" 9>&- &
    daemon=$!
    wait_for 20 is_up_or_dead || fail "the daemon is not ready after 20 s"
    logged 'ready: domain' || fail "the daemon did not start"
}

is_gone() {
    ! kill -0 "$1" 2>/dev/null
}

# stop_daemon [EXIT_CODE]: asks it to end and compares how it did
stop_daemon() {
    kill -TERM "$daemon"
    wait_for 20 is_gone "$daemon" || fail "the daemon does not end within 20 s"
    code=0
    wait "$daemon" || code=$?
    daemon=
    [ "$code" -eq "${1:-0}" ] || fail "the daemon ended with $code, not ${1:-0}"
}

# expect EXIT_CODE COMMAND...: output in $out and $err
expect() {
    expected=$1
    shift
    code=0
    "$@" >"$out" 2>"$err" 9>&- || code=$?
    [ "$code" -eq "$expected" ] || fail "exit code $code, not $expected: $*"
}

# percuss COMMAND [ARGUMENT...] in this story's domain. Under a sanitizer it has 30 s to find the daemon in place of 3:
# beside a dozen other processes it takes longer than that to begin
percuss() {
    command=$1
    shift
    case " $* " in
    *" --timeout"*) ;;
    *) ! is_sanitized || set -- "$@" --timeout 30 ;;
    esac
    "$bin/percuss" "$command" --domain "$domain" "$@"
}

# says TEXT: on stderr of the last command; shows TEXT: on its stdout
says() {
    grep -qF -- "$1" "$err" || fail "stderr does not say: $1"
}

shows() {
    grep -qF -- "$1" "$out" || fail "stdout does not show: $1"
}

# field NAME [FILE]: its first value in a reply printed as JSON
field() {
    sed -n 's/^ *"'"$1"'": "\{0,1\}\([^",]*\)"\{0,1\},\{0,1\}$/\1/p' "${2:-$out}" | head -n 1
}

# numbers FILE: a reply without what differs from one asking to the next
numbers() {
    sed -e '/^  "client":/d' -e '/^  "sequence":/d' -e '/^  "timing": {/,/^  }/d' "$1"
}

query() {
    percuss query --a steel-sphere --b al-beam --speed 0.3 "$@"
}
