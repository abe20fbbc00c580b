#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A program that loads libpercuss while it runs may unload it again, as often as it likes.
. "$(dirname "$0")/../support/lib.sh"

start_daemon
expect 0 "$peers/unload_client" "$build/client/libpercuss.so" "$domain"
shows "4 times loaded and unloaded"
expect 0 query
stop_daemon
