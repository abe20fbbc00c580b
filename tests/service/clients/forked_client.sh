#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# fork() in a program with a client: the child's client is dead, says so and can be freed; the parent's lives.
. "$(dirname "$0")/../support/lib.sh"

start_daemon
say "in C"
expect 0 "$peers/forked_client" "$domain"
shows ok
stop_daemon
