#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# CYCLONEDDS_URI and the shipped config/cyclonedds.xml go together with the built-in one.
. "$(dirname "$0")/../support/lib.sh"

say "a configured daemon serves clients with the built-in configuration"
CYCLONEDDS_URI=file://$source_dir/config/cyclonedds.xml
export CYCLONEDDS_URI
start_daemon
unset CYCLONEDDS_URI
expect 0 query

say "and clients with the same configuration"
CYCLONEDDS_URI=file://$source_dir/config/cyclonedds.xml
export CYCLONEDDS_URI
expect 0 query
stop_daemon
