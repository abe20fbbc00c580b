#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# What is longer than a reader keeps in mind: fails on a C source of more than 1,000 lines, and on a function of
# more than 60 with its head.
# usage: lengths.sh SOURCE_DIR
set -eu
cd "${1:?"usage: lengths.sh SOURCE_DIR"}"

find service client idl tests -name '*.c' | sort | xargs awk '
    function complain(what) {
        print "lengths: " what | "cat >&2"
        bad = 1
    }
    function end_file() {
        if (lines > 1000)
            complain(file ": " lines " lines: at most 1000 are allowed")
    }
    FNR == 1 { end_file(); file = FILENAME; files++; head = 0 }
    { lines = FNR }
    # a head begins in the first column behind what is blank, ends or is a comment, and may go on over lines
    /^[A-Za-z_]/ && !head { head = FNR; name = $0 }
    /^\{$/ && head { body = head }
    /^\}$/ && body {
        functions++
        if (FNR - body + 1 > 60)
            complain(file ":" body ": " FNR - body + 1 " lines: at most 60 are allowed: " name)
        body = 0
    }
    /^\}/ || (!body && (/^$/ || /;$/)) { head = 0 }
    END {
        end_file()
        if (!functions)
            complain("no function was found")
        if (!bad)
            print "lengths: " functions " functions in " files " files"
        exit bad
    }'
