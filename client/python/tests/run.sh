#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# Runs a command of the tests' virtual environment beside a daemon of its own, whose domain it finds in
# PERCUSS_DOMAIN. usage: run.sh COMMAND [ARGUMENT...], with PERCUSS_BUILD, PERCUSS_SOURCE, PERCUSS_VENV.
set -eu
[ -e "$PERCUSS_VENV/wanted" ] || {
    echo "skipped: no virtual environment; see the test python/environment" >&2
    exit 77
}
. "$PERCUSS_SOURCE/tests/service/support/lib.sh"
PATH=$PERCUSS_VENV/bin:$PATH
PERCUSS_DOMAIN=$domain
PERCUSS_LIBRARY=$build/client/libpercuss.so
export PATH PERCUSS_DOMAIN PERCUSS_LIBRARY

start_daemon
# outside the source tree, where only the installed package can be imported
cd "$work"
"$@" 9>&- || fail "$*"
stop_daemon
