#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The image of deploy/container built and run by the commands of docs/operating.md, asked from outside, stopped,
# killed and started again with its volume. Takes a quarter of an hour, most of it for the build,
# whose layers podman keeps for the next one.
# usage: container.sh    (PERCUSS_BUILD is the build folder: its percuss asks)
# Exit code 77: this machine does not let it, and the reason is said.
PERCUSS_SOURCE=$(cd "$(dirname "$0")/.." && pwd)
here=$PERCUSS_SOURCE/tests
# shellcheck source=tests/service/support/lib.sh
. "$here/service/support/lib.sh"
. "$here/documents.sh"
base=docker.io/library/debian:bookworm-slim
cd "$source_dir"

cannot() {
    echo "container: NOT TRIED: $*" >&2
    exit 77
}
command -v podman >/dev/null || cannot "podman is not installed"
! podman container exists percussd || cannot "there is a container percussd already"
! podman volume exists percuss-store || cannot "there is a volume percuss-store already"
! podman image exists localhost/percussd || cannot "there is an image percussd already"

made_base=
remove_all() {
    podman rm --force --time 5 percussd
    podman volume rm --force percuss-store
    podman image rm --force localhost/percussd
    [ -z "$made_base" ] || podman image rm --force "$base"
} >/dev/null 2>&1
trap 'remove_all || true; cleanup' EXIT

# the base image, or what is nearest to it where no registry is reached
if ! podman image exists "$base" && ! podman pull --quiet "$base" >"$err" 2>&1; then
    command -v mmdebstrap >/dev/null || cannot "$base cannot be had: $(tail -n 1 "$err")"
    say "no registry is reached: the base is made by mmdebstrap"
    mmdebstrap --variant=minbase --include=ca-certificates bookworm "$work/base.tar" >"$err" 2>&1 ||
        cannot "mmdebstrap: $(tail -n 1 "$err")"
    made_base=yes
    podman import --quiet "$work/base.tar" "$base" >"$out" 2>"$err" || fail "podman import"
    rm "$work/base.tar"
fi

# what lets a container run here: nothing special; else limits below this shell's, where higher ones must not be set,
# and the runtime that knows older control groups
limits="--ulimit nofile=$(ulimit -n):$(ulimit -n) --ulimit nproc=4096:4096"
runs=no
for allowances in "" "$limits" "--runtime runc $limits"; do
    # shellcheck disable=SC2086 # words
    ! podman run --rm --network host $allowances "$base" true >"$out" 2>"$err" || { runs=yes && break; }
done
[ "$runs" = yes ] || cannot "podman run: $(tail -n 1 "$err")"
building=
[ -z "$allowances" ] || building="--isolation chroot --network host"
# this machine's ways to packages
! grep -q '^VERSION_CODENAME=bookworm$' /etc/os-release ||
    building="$building -v /etc/apt:/etc/apt:ro -v /usr/share/keyrings:/usr/share/keyrings:ro"

# podman as documented, with what this machine needs, and in this test's domain
podman() {
    verb=$1
    shift
    # shellcheck disable=SC2086 # words
    case $verb in
    build) command podman build $building "$@" ;;
    run) command podman run $allowances -e PERCUSS_DOMAIN="$domain" "$@" ;;
    *) command podman "$verb" "$@" ;;
    esac
}

say "podman build"
revision=$(git rev-parse HEAD)
commands docs/operating.md "podman build" >"$work/commands" || fail "no commands in docs/operating.md"
sed '/^podman run/,$d' "$work/commands" >"$work/build"
sed -n '/^podman run/,$p' "$work/commands" >"$work/run"
. "$work/build" >"$out" 2>"$err" || fail "podman build"
! grep -i "is not supported" "$err" || fail "a part of the image was left out"

# run_as_documented [SED COMMAND]: until it answers
answers() {
    "$bin/percuss" ping --domain "$domain" --timeout 1 >"$out" 2>"$err"
}
run_as_documented() {
    sed "${1:-}" "$work/run" >"$work/this-run"
    . "$work/this-run" >"$out" 2>"$err" || fail "podman run"
    wait_for 30 answers || { podman logs percussd >"$log" 2>&1; fail "it does not answer"; }
}
impacts_are() {
    expect 0 percuss dents --specimen bar --json
    [ "$(field impacts)" = "$1" ] || fail "$(field impacts) impacts, not $1"
}
strike() {
    expect 0 percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --specimen-b bar
    shows "restitution  0."
}
# state FORMAT: of the container
state() {
    podman inspect --format "$1" percussd
}

say "podman run: it is asked from outside"
run_as_documented
strike
strike
impacts_are 2

say "it is what it is said to be"
[ "$(podman exec percussd id -u)" = 10001 ] || fail "another user"
[ "$(podman exec percussd sed -n 's/^CapEff:[[:space:]]*//p' /proc/1/status)" = 0000000000000000 ] || fail "capabilities"
[ "$(podman exec percussd sed -n 's/^NoNewPrivs:[[:space:]]*//p' /proc/1/status)" = 1 ] || fail "new privileges"
for place in /etc/percuss /usr/share/percuss /; do
    ! podman exec --user 0 percussd touch "$place/written" 2>"$err" || fail "$place can be written"
done
[ "$(state '{{index .Config.Labels "org.opencontainers.image.revision"}}')" = "$revision" ] ||
    fail "the label names another revision"

# where there is no systemd nobody asks by himself, and podman complains of it at each start and end
say "its health: good, bad while it stands still, good again"
expect 0 podman healthcheck run percussd
podman kill --signal STOP percussd >"$out" 2>"$err"
expect 1 podman healthcheck run percussd
podman kill --signal CONT percussd >"$out" 2>"$err"
expect 0 podman healthcheck run percussd

say "stopped in good order, and started again: the dents are there"
podman stop --time 60 percussd >"$out" 2>"$err"
[ "$(state '{{.State.ExitCode}}')" = 0 ] || fail "it ended with $(state '{{.State.ExitCode}}')"
podman logs percussd >"$log" 2>&1
logged '"message":"ended"' || fail "no good end"
podman start percussd >"$out" 2>"$err"
wait_for 30 answers || fail "it does not answer again"
impacts_are 2
strike

say "killed, and another container with the volume: the same"
podman kill --signal KILL percussd >"$out" 2>"$err"
podman wait percussd >"$out" 2>"$err"
podman rm percussd >"$out" 2>"$err"
run_as_documented
impacts_are 3

say "with settings of one's own"
podman rm --force --time 10 percussd >"$out" 2>"$err"
mkdir "$work/own"
cp -r "$source_dir/config/." "$work/own"
printf '%s\n' 'catalogue: catalogue.yaml' 'store: /var/lib/percussd/specimens.db' >"$work/own/percussd.yaml"
sed -i 's/^  al-rod-1:/  own-rod:/' "$work/own/catalogue.yaml"
chmod -R a+rX "$work"
run_as_documented "s|percussd\$|-v $work/own:/etc/percuss:ro &|"
expect 0 percuss bodies
shows own-rod
podman stop --time 60 percussd >"$out" 2>"$err"
[ "$(state '{{.State.ExitCode}}')" = 0 ] || fail "it ended with $(state '{{.State.ExitCode}}')"
