# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# CPack runs it between installing the components and making packages of them: what Debian has otherwise than
# an installed tree.
set(share ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*/usr/share)
file(GLOB pages ${share}/man/*/*)
foreach(page ${pages})
  execute_process(COMMAND gzip -9 -n ${page} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
# the Python package is in dist-packages, and the licence where all are
file(GLOB doubles ${share}/percuss/python/percuss ${share}/percuss/python/pyproject.toml ${share}/doc/percuss/LICENSE)
file(REMOVE_RECURSE ${doubles})
