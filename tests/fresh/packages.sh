#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The packages' life on an empty Debian 12: installed, used, upgraded, removed, purged. Run by stages.sh inside
# an empty root; systemd is not there, so that nothing is started.
# usage: packages.sh FIRST SECOND    (folders of packages, of one release and of the next)
set -eu
cd "$(dirname "$0")/../.."
. tests/documents.sh
first=$1
second=$2
export DEBIAN_FRONTEND=noninteractive
said=$(mktemp)
wanted=/etc/systemd/system/multi-user.target.wants/percussd.service

# a domain that no other test of this machine has taken; packages come by its network
while :; do
    PERCUSS_DOMAIN=$((20 + $(od -An -N2 -tu2 /dev/urandom) % 80))
    exec 9>"$PERCUSS_DOMAIN_LOCKS/percuss-domain-$PERCUSS_DOMAIN.lock"
    flock -n 9 && break
done
export PERCUSS_DOMAIN

fail() {
    cat "$said"
    echo "FAILED: $*"
    exit 1
}

# apt COMMAND...: what is edited stays
apt() {
    apt-get -y --no-install-recommends -o Dpkg::Options::=--force-confdef -o Dpkg::Options::=--force-confold "$@" \
        >"$said" 2>&1 || fail "apt-get $*"
}

check() {
    percussd --config /etc/percuss/percussd.yaml --check-config >"$said" 2>&1
}

# serve [SETTINGS]: as the unit would, in its folder, by a user who may write nowhere else
serve() {
    settings=${1:-/etc/percuss/percussd.yaml}
    log=$(mktemp)
    chmod 666 "$log"
    setpriv --reuid 65534 --regid 65534 --clear-groups --no-new-privs \
        percussd --config "$settings" --log-format json 2>"$log" 9>&- &
    daemon=$!
    waited=0
    until grep -q '"message":"ready: domain ' "$log"; do
        waited=$((waited + 1))
        { [ "$waited" -le 100 ] && kill -0 "$daemon" 2>/dev/null; } || { cp "$log" "$said"; fail "the daemon does not start"; }
        sleep 0.1
    done
}

end() {
    kill -TERM "$daemon"
    wait "$daemon" || fail "the daemon's end"
}

apt update
echo "- installed: the unit is enabled, and nothing runs"
apt install "$first"/*.deb
[ -e "$wanted" ] || fail "the unit is not enabled"
! pgrep -x percussd >/dev/null 2>&1 || fail "percussd was started"
[ "$(dpkg-query -W -f '${Conffiles}\n' percuss-daemon | grep -c '^ /etc/percuss/')" -eq 2 ] || fail "no conffiles"

echo "- what the unit calls is there, and so are an ordinary user's commands and the FMUs with their libraries"
for program in $(sed -n 's/^Exec[A-Za-z]*=\([^ ]*\).*/\1/p' /lib/systemd/system/percussd.service); do
    [ -x "$program" ] || fail "the unit calls $program"
done
for program in percuss percuss-tables; do
    PATH=/usr/local/bin:/usr/bin:/bin command -v $program >"$said" || fail "$program is not among a user's commands"
done
units=$(mktemp -d)
for unit in percuss_falling_body percuss_impact_law; do
    python3 -m zipfile -e "$(dpkg -L percuss-fmu | grep "/$unit.fmu\$")" "$units" >"$said" 2>&1 || fail "no $unit.fmu"
done
[ "$(find "$units" -name '*.so' | wc -l)" -eq 2 ] || fail "not two FMUs"
find "$units" -name '*.so' -exec ldd {} + >"$said" 2>&1
! grep 'not found' "$said" || fail "an FMU lacks a library"

echo "- without systemd a start names the folder that is missing, and the command that makes it"
! percussd >"$said" 2>&1 || fail "it starts without its folder"
! check || fail "a missing folder is not told"
grep -q 'store: /var/lib/percussd/specimens.db: cannot be made' "$said" || fail "the missing folder is not told"
! setpriv --reuid 65534 --regid 65534 --clear-groups percussd >"$said" 2>&1 || fail "it starts without its folder"
grep -qF 'its folder is missing: sudo install -d -o "$(id -un)" /var/lib/percussd makes it' "$said" ||
    fail "no command for a user"
! percussd >"$said" 2>&1 || fail "it starts without its folder"
made=$(sed -n 's/.*its folder is missing: \(.*\) makes it$/\1/p' "$said")
[ "$made" = "mkdir -p /var/lib/percussd" ] || fail "no command for root"
sh -euc "$made"
chown 65534:65534 /var/lib/percussd
check || fail "percussd --check-config"

echo "- daemon, command line, Python and C"
serve
percuss query --a steel-sphere --b al-beam --speed 0.2 --specimen-b rig-beam >"$said" 2>&1 || fail "percuss query"
grep -q '^  restitution  0\.' "$said" || fail "no answer"
python3 -c 'import percuss
with percuss.connect() as client:
    bodies = client.bodies()
    question = percuss.contact_pair(bodies["steel-sphere"], bodies["al-rod-1"], speed=0.2)
    print(client.solve(question).raise_for_status().contacts[0].restitution)' >"$said" 2>&1 || fail "Python"
grep -q '^0\.' "$said" || fail "no answer in Python"
apt install gcc libc6-dev pkg-config
(cd "$(mktemp -d)" && cp /usr/share/percuss/examples/query.c . &&
    cc query.c $(pkg-config --cflags --libs percuss) && ./a.out "$PERCUSS_DOMAIN") >"$said" 2>&1 || fail "the example in C"
grep -q '^e = ' "$said" || fail "the example prints no e"
end
percuss query --local --a steel-sphere --b al-beam --speed 0.2 >"$said" 2>&1 || fail "percuss query --local"
grep -q '^  restitution  0\.' "$said" || fail "no answer in process"
man=$(find /usr/share/man -name 'percuss*.gz' | wc -l)
[ "$man" -eq 7 ] || fail "$man manual pages"

echo "- secured, by the keys' script and the settings that docs/security.md names"
apt install openssl
keys=$(mktemp -d)
chmod 755 "$keys"
for add in "daemon serves" "rig asks" "dashboard observes"; do
    [ -d "$keys/keys" ] || sh /usr/share/percuss/security/percuss-keys.sh create "$keys/keys" >"$said" 2>&1 || fail "an authority"
    # shellcheck disable=SC2086
    sh /usr/share/percuss/security/percuss-keys.sh add "$keys/keys" $add >"$said" 2>&1 || fail "an identity"
done
chmod 755 "$keys/keys"
chown -R 65534:65534 "$keys/keys/daemon"
sed -E 's#^(catalogue|tables): *([^/])#\1: /etc/percuss/\2#' /etc/percuss/percussd.yaml >"$keys/percussd.yaml"
echo "security: $keys/keys/daemon" >>"$keys/percussd.yaml"
chmod 644 "$keys/percussd.yaml"
serve "$keys/percussd.yaml"
percuss query --security "$keys/keys/rig" --a steel-sphere --b al-beam --speed 0.2 >"$said" 2>&1 || fail "a secured query"
grep -q '^  restitution  0\.' "$said" || fail "no answer to an identity"
percuss dents --security "$keys/keys/dashboard" >"$said" 2>&1 || fail "a secured percuss dents"
grep -q '^rig-beam' "$said" || fail "who observes sees no specimen"
! percuss query --security "$keys/keys/dashboard" --a steel-sphere --b al-beam --speed 0.2 >"$said" 2>&1 ||
    fail "who observes is answered"
! percuss ping --timeout 5 >"$said" 2>&1 || fail "a stranger is answered"
end

echo "- upgraded: edited settings and the specimens' dents stay, a disabled unit stays disabled"
echo 'queue_capacity: 77' >>/etc/percuss/percussd.yaml
rm "$wanted"
apt install "$second"/*.deb
[ "$(dpkg-query -W -f '${Version}' percuss-daemon)" = "$(dpkg-deb -f "$second"/percuss-daemon_*.deb Version)" ] ||
    fail "it was not upgraded"
grep -q '^queue_capacity: 77$' /etc/percuss/percussd.yaml || fail "the edited settings are gone"
grep -q '^# changed in this release$' /etc/percuss/catalogue.yaml || fail "unedited settings are not renewed"
[ ! -e "$wanted" ] || fail "the unit is enabled again"
serve
percuss status >"$said" 2>&1 || fail "percuss status"
# 77 in each of five lanes
grep -q 'of 385 places' "$said" || fail "the settings are not in force"
percuss dents >"$said" 2>&1 || fail "percuss dents"
grep -q '^rig-beam' "$said" || fail "the specimen is gone"
end

echo "- dependencies.sh without root: the line for the administrator"
scripts=$(mktemp -d)
chmod 755 "$scripts"
cp deploy/dependencies.sh "$scripts"
as_user() {
    setpriv --reuid 65534 --regid 65534 --clear-groups env PATH="$scripts/bin:$PATH" \
        sh "$scripts/dependencies.sh" build >"$said" 2>&1
}
line='^  apt-get install --no-install-recommends .*cmake.*libsundials-dev'
! as_user || fail "nothing is missing"
grep -q 'there is no sudo; ask the administrator' "$said" || fail "a missing sudo is not told"
grep -q "$line" "$said" || fail "no line for the administrator"
mkdir "$scripts/bin"
printf '#!/bin/sh\necho "user is not in the sudoers file" >&2\nexit 1\n' >"$scripts/bin/sudo"
chmod 755 "$scripts/bin/sudo"
! as_user || fail "sudo refuses"
grep -q 'sudo refuses; ask the administrator' "$said" || fail "the refusal is not told"
grep -q "$line" "$said" || fail "no line for the administrator"

echo "- removed: settings and specimens stay; purged: only the specimens"
apt remove percuss-daemon percuss-tools percuss-fmu libpercuss1 libpercuss-local1 libpercuss-dev python3-percuss percuss-doc
[ -z "$(find /usr -path '*percuss*' ! -path "$PWD*" ! -name '*.pyc' -type f)" ] || {
    find /usr -path '*percuss*' >"$said"
    fail "files are left"
}
[ -e /etc/percuss/percussd.yaml ] || fail "the settings are gone"
apt purge percuss-daemon
[ ! -e /etc/percuss ] || fail "settings are left"
[ -s /var/lib/percussd/specimens.db ] || fail "the specimens are gone"
apt install "$second"/*.deb
[ -e "$wanted" ] || fail "the unit is not enabled after a purge"
serve
percuss dents >"$said" 2>&1 || fail "percuss dents"
grep -q '^rig-beam' "$said" || fail "the specimen is gone"
end
