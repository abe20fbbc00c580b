# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# find_package(percuss) gives the target percuss::percuss. DDS is inside the library; a program that
# uses it needs nothing else. percuss::local answers itself; percuss::measured
# puts measured impacts beside simulated ones; percuss::slowscale applies impacts in a multibody engine.
include(${CMAKE_CURRENT_LIST_DIR}/percussTargets.cmake)
