#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The reference of the C interface as pages, by Doxygen from the public headers. Fails for a public function
# without a comment, and for whatever else Doxygen does not understand.
# usage: make.sh SOURCE_DIR FOLDER
set -eu
mkdir -p "$2"
folder=$(cd "$2" && pwd)
cd "$1"
warnings=$folder/warnings.txt
{ cat deploy/reference/Doxyfile && echo "OUTPUT_DIRECTORY = \"$folder\"" && echo "WARN_LOGFILE = \"$warnings\""; } |
    doxygen -
# structs, constants and members may speak for themselves
if grep -v -e '(variable) of .* is not documented' -e '(enumeration) of .* is not documented' \
    -e '(enumvalue) of .* is not documented' -e '(macro definition) of .* is not documented' \
    -e 'Compound .* is not documented' "$warnings"; then
    echo "reference: what is above is missing or not understood" >&2
    exit 1
fi
echo "reference: $folder/index.html"
