# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# For the stories of secured deployments, beside lib.sh: keys, and one process with several clients.
# shellcheck shell=sh

command -v openssl >/dev/null || {
    say "no openssl: skipped"
    exit 77
}
keys=$work/keys

make_keys() {
    sh "$source_dir/deploy/security/percuss-keys.sh" "$@"
}

# clients_begin: a process of identities_client, which act tells what to do until clients_end
clients_begin() {
    mkfifo "$work/acts"
    "$peers/identities_client" "$domain" <"$work/acts" >"$work/told" 2>&1 9>&- &
    clients=$!
    others="${others:-} $clients"
    exec 8>"$work/acts"
}
# act ANSWER ACT
act() {
    echo "$2" >&8
    wait_for 40 grep -q "^$1\$" "$work/told" || fail "$2: $(cat "$work/told")"
}
clients_end() {
    exec 8>&-
    wait "$clients" || fail "the clients failed: $(cat "$work/told")"
}
