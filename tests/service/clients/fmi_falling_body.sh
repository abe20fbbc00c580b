#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The FMU of a falling body in programs that simulate FMUs, and in one that loads and unloads it.
. "$(dirname "$0")/../support/lib.sh"

venv=$build/fmi-venv
[ -e "$venv/wanted" ] || {
    echo "skipped: no virtual environment; see the test service/clients/fmi_environment" >&2
    exit 77
}
export TMPDIR="$work" PYTHONPATH="$support" PYTHONDONTWRITEBYTECODE=1
fmu=$build/client/fmi/percuss_falling_body.fmu
tree=$build/client/fmi/percuss_falling_body
binary=$(echo "$tree"/binaries/*/percuss_falling_body.so)

say "FMPy and CasADi"
expect 0 "$venv/bin/fmpy" validate "$fmu"
shows "No problems found."
expect 0 "$venv/bin/python" "$support/fmi_falling_body.py" "$fmu" "$bin/percuss"
shows "e = 0.2771"

say "instances and threads, loaded and unloaded"
token=$(sed -n 's/.* instantiationToken="\([^"]*\)".*/\1/p' "$tree/modelDescription.xml")
expect 0 "$peers/fmu_unload" "$binary" "$tree/resources" "$token"
shows "100 instances, 5 times unloaded"

say "the functions of the standard, all of them and nothing else"
headers=$(echo "$venv"/lib/python3*/site-packages/fmpy/c-code)
grep -o 'fmi3[A-Z][A-Za-z0-9]*TYPE' "$headers/fmi3FunctionTypes.h" | sed 's/TYPE$//' | sort -u >"$work/wanted"
nm -D --defined-only "$binary" | sed 's/.* //' | sort >"$work/found"
diff "$work/wanted" "$work/found" >"$out" || fail "not the functions of the standard"
[ "$(wc -l <"$work/found")" -gt 60 ] || fail "too few functions"
for source in "$source_dir"/client/fmi/*.c; do
    # with the standard's declarations in place of ours
    expect 0 cc -std=gnu17 -fsyntax-only -Werror=incompatible-pointer-types -DPERCUSS_FMI3_H -DPERCUSS_FMI3_TYPES_H \
        -D_GNU_SOURCE -DPERCUSS_VERSION='""' -DPERCUSS_SOVERSION='""' -I"$headers" -include fmi3Functions.h \
        -DFMI3_PLAIN_TYPES= -I"$source_dir/client/include" -I"$source_dir/idl" "$source"
done
