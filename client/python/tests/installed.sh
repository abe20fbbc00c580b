#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# The package of an installed tree, where it lies, finds the library of that tree; pip takes it from there.
# Started by run.sh.
set -eu
cmake --install "$PERCUSS_BUILD" --prefix "$PWD/prefix" >log
unset PERCUSS_LIBRARY
package=$PWD/prefix/share/percuss/python
PYTHONPATH=$package python -c "
import percuss, percuss._abi
assert percuss.__file__.startswith('$package'), percuss.__file__
assert percuss._abi.library._name.startswith('$PWD/prefix/lib'), percuss._abi.library._name"
PYTHONPATH=$package python "$package/examples/speed_sweep.py" .
# so do the other libraries, and they the installed catalogue
PYTHONPATH=$package python "$package/examples/two_spheres.py"
pip install --no-index --no-deps --no-build-isolation --target "$PWD/target" "$package" >>log 2>&1 || {
    cat log >&2
    exit 1
}
# from where pip has put it, it finds the libraries of that tree too, and they the installed catalogue
PYTHONPATH=$PWD/target python -c "
import percuss, percuss._abi, percuss.measured
assert percuss.__file__.startswith('$PWD/target'), percuss.__file__
assert percuss._abi.library._name.startswith('$PWD/prefix/lib'), percuss._abi.library._name
with percuss.Local() as local:
    assert 'al-beam' in local.bodies()"
# where no library is, it says how to get one
! PERCUSS_LIBRARY=$PWD/none.so PYTHONPATH=$PWD/target python -c "import percuss" 2>said
grep -q "^ImportError: libpercuss.* was not found: .*deploy/wheel.sh.*deploy/quickstart.sh" said
grep -q "$PWD/none.so: cannot open" said
