#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The campaigns of tests/fault in small: packets are lost and overtaken and the daemon is killed, and dents and answers
# are those of a run without; clients come and vanish.
set -eu
fault=$(cd "$(dirname "$0")/../../fault" && pwd)

echo "- 16000 requests of 16 clients, 10 % of the packets lost, a quarter held back, the daemon killed four times"
sh "$fault/losses.sh" 16000 16 4

echo "- 80 clients come and vanish"
sh "$fault/passers.sh" 80 4 8000
