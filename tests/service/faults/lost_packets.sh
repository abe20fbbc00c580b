#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The campaigns of tests/fault in small: packets are lost and the daemon is killed; clients come and vanish.
set -eu
fault=$(cd "$(dirname "$0")/../../fault" && pwd)

echo "- 20000 requests of 4 clients with 10 % loss, the daemon killed twice"
sh "$fault/losses.sh" 20000 4 2 100 1

echo "- 80 clients come and vanish"
sh "$fault/passers.sh" 80 4 8000
