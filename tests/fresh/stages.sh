#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The stages of fresh.sh, which starts it in namespaces of its own.
# usage: stages.sh WORK STAGE...
set -eu
work=$1
shift
root=$work/root
log=$work/log
: "${HOME:=/root}"

fail() {
    tail -n 1000 "$log" >&2
    echo "fresh: FAILED: $*" >&2
    exit 1
}

# this machine's ways to packages: mirrors and proxies
sources() {
    grep -q '^VERSION_CODENAME=bookworm$' /etc/os-release || return 0
    find /etc/apt -path '/etc/apt/sources.list*' -type f \( -name '*.list' -o -name '*.sources' \) -size +0
}

make_base() {
    { apt-config dump | grep '^Acquire::' || true; } >"$work/apt.conf"
    # words are file names without blanks
    # shellcheck disable=SC2046
    mmdebstrap --variant=apt --include=git,ca-certificates --aptopt="$work/apt.conf" \
        --aptopt='Acquire::Retries "3"' bookworm "$work/base.tar" $(sources) >"$log" 2>&1 ||
        fail "mmdebstrap"
}

# of the environment, what leads to packages
kept_environment() {
    export -p | grep -iE '^export (PIP_[A-Z_]*|[A-Z]*_PROXY|SSL_CERT_(FILE|DIR)|REQUESTS_CA_BUNDLE|CURL_CA_BUNDLE)='
}

# with the configuration of apt and pip, and the certificates that both may need
configure_root() {
    rm -rf "$root/etc/apt"
    for file in /etc/apt /etc/pip.conf /etc/xdg/pip "$HOME/.config/pip" "$HOME/.pip" /etc/ssl/certs \
        /usr/local/share/ca-certificates $(kept_environment | sed -n "s/.*='\(\/.*\)'\$/\1/p"); do
        [ ! -e "$file" ] || cp -a --parents "$file" "$root"
    done
    cp -an --parents /usr/share/keyrings "$root"
    cp -L --parents /etc/resolv.conf /etc/hosts "$root"
    kept_environment >"$root/environment" || true
    # nothing of it outlives a crash: no need to wait for the disk
    echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/force-unsafe-io"
}

make_root() {
    [ ! -e "$root" ] || { umount -R "$root" && rm -rf --one-file-system "$root"; }
    mkdir "$root"
    # what mounts inside (ip netns) wants the root to be a mount itself
    mount --bind "$root" "$root"
    tar -C "$root" -xf "$work/base.tar"
    configure_root
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    # the network is this machine's, and so are the domains that its tests have taken
    mkdir "$root/run/domains"
    mount --bind "${PERCUSS_DOMAIN_LOCKS:-${TMPDIR:-/tmp}}" "$root/run/domains"
    mkdir -p "$root$HOME"
    git clone --quiet --no-hardlinks . "$root$HOME/percuss"
}

# inside COMMAND...: in the clone, with a user's environment
wrap=
inside() {
    # expanded there; the wrap is several words
    # shellcheck disable=SC2016,SC2086
    $wrap chroot "$root" /usr/bin/env -i HOME="$HOME" LANG=C.UTF-8 PERCUSS_NO_SKIPS=true \
        PERCUSS_DOMAIN_LOCKS=/run/domains \
        PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        sh -euc '. /environment; cd ~/percuss; exec "$@"' sh "$@" >>"$log" 2>&1
}

# apart COMMAND...: the same on a loopback of its own, where nobody else is in the default domain
apart() {
    # expanded there
    # shellcheck disable=SC2016
    echo 'ip link set lo up && exec "$@"' >"$work/loopback"
    ! command -v ip >/dev/null || wrap="unshare --net sh $work/loopback"
    inside "$@"
}

stage_quickstart() {
    inside sh -c 'sh deploy/quickstart.sh >~/answers' || fail "sh deploy/quickstart.sh"
    apart sh tests/fresh/first_minute.sh "$HOME/answers" || fail "README, the first minute"
}

stage_tests() {
    inside sh tests/run.sh || fail "sh tests/run.sh"
    inside sh deploy/quickstart.sh || fail "sh deploy/quickstart.sh after sh tests/run.sh"
    inside grep -q '^BUILD_TESTING:BOOL=ON$' build/CMakeCache.txt || fail "the quickstart has put the tests off"
}

stage_sanitize() {
    inside sh tests/sanitize.sh address -R '^unit/' || fail "sh tests/sanitize.sh address"
}

[ -z "$(git status --porcelain)" ] || echo "fresh: what is not committed is not tried" >&2
make_base
for stage; do
    began=$(date +%s)
    : >"$log"
    wrap=
    make_root
    "stage_$stage"
    grep -h 'tests passed\|^SKIPPED' "$log" || true
    echo "fresh: $stage passed in $(($(date +%s) - began)) s"
done
