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

# the next release: the same program, but other defaults in a file that is there to be edited
next_release() {
    mkdir "$2"
    for package in "$1"/*.deb; do
        rm -rf "$work/unpacked"
        dpkg-deb -R "$package" "$work/unpacked" || return 1
        sed -i 's/^Version: .*/&.1/' "$work/unpacked/DEBIAN/control"
        for file in percussd catalogue; do
            [ ! -e "$work/unpacked/etc" ] || echo '# changed in this release' >>"$work/unpacked/etc/percuss/$file.yaml"
        done
        dpkg-deb --root-owner-group -b "$work/unpacked" "$2" || return 1
    done
}

# made here, of what is committed, and taken there
make_packages() {
    [ ! -e "$work/packages" ] || return 0
    git clone --quiet --no-hardlinks . "$work/clone"
    sh "$work/clone/deploy/packages.sh" "$work/packages" >>"$log" 2>&1 || fail "sh deploy/packages.sh"
}

stage_packages() {
    # what the unit leaves open, of 10.0: the network, mostly
    ! command -v systemd-analyze >/dev/null ||
        systemd-analyze security --offline=true --threshold=20 deploy/systemd/percussd.service >>"$log" 2>&1 ||
        fail "systemd-analyze security"
    make_packages
    lintian --fail-on error --allow-root "$work"/packages/*.deb >>"$log" 2>&1 || fail "lintian"
    next_release "$work/packages" "$work/next" >>"$log" 2>&1 || fail "the next release"
    cp -r "$work/packages" "$root/packages"
    cp -r "$work/next" "$root/next"
    inside sh tests/fresh/packages.sh /packages /next || fail "the life of the packages"
}

# with a systemd of its own, which few containers allow
stage_systemd() {
    make_packages
    cp -r "$work/packages" "$root/packages"
    cp tests/fresh/unit.sh "$root"
    inside apt-get update || fail "apt-get update"
    inside sh -c 'apt-get install -y --no-install-recommends systemd systemd-sysv dbus \
        /packages/percuss-daemon_*.deb /packages/percuss-tools_*.deb /packages/libpercuss1_*.deb' || fail "apt-get install"
    umount -R "$root/dev" "$root/proc" "$root/run/domains"
    timeout -s KILL 180 unshare --mount --pid --fork --kill-child --uts --ipc --net --cgroup \
        sh tests/fresh/boot.sh "$root" >>"$log" 2>&1 || true
    cat "$root/unit.said" >>"$log" 2>&1 || fail "systemd does not run here"
    grep -qx passed "$root/unit.said" || fail "the unit"
}

stage_sanitize() {
    inside sh tests/sanitize.sh address -R '^unit/' || fail "sh tests/sanitize.sh address"
}

make_wheel() {
    [ -e "$work/wheels" ] || sh deploy/wheel.sh build "$work/wheels" >>"$log" 2>&1 || fail "sh deploy/wheel.sh build"
}

# PERCUSS_WAYS: which; each in a root of its own, as what one installs another would find. Printed line by line
stage_newcomer() {
    echo '| way | installed in | on disk | first own answer after | lines written | answer |'
    for way in ${PERCUSS_WAYS:-source packages wheel rig author simulation mujoco fmpy gmsh}; do
        case $way in
        packages | fmpy)
            make_packages
            given=$work/packages
            ;;
        wheel | rig | simulation)
            make_wheel
            given=$(find "$work/wheels" -name '*.whl')
            ;;
        *) given= ;;
        esac
        make_root
        [ -z "$given" ] || { mkdir "$root/given" && cp -r "$given" "$root/given"; }
        inside sh tests/fresh/newcomer.sh "$way" ${given:+"/given/${given##*/}"} || fail "newcomer: $way"
        sed -n 's/^newcomer |/|/p' "$log" | tail -n 1
    done
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
