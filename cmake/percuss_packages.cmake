# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# Debian packages by CPack, one a component; deploy/packages.sh makes them. What is here is not installed
# otherwise.
set(packaging ${PROJECT_SOURCE_DIR}/deploy/debian)
set(made ${PROJECT_BINARY_DIR}/packages)

# settings, which an upgrade leaves as they were edited; what the daemon writes is in the unit's folder
file(READ config/percussd.yaml settings)
string(REGEX REPLACE "\n# Settings of percussd[^\n]*" "" settings "${settings}")
# beside their schemas in /usr/share they would be by a path that is relative
file(READ config/catalogue.yaml bodies)
foreach(text settings bodies)
  string(REPLACE "\$schema=" "\$schema=/usr/share/percuss/" ${text} "${${text}}")
endforeach()
foreach(change
    "tables: tables=>tables: /usr/share/percuss/tables"
    "# bodies: /var/lib/percussd/bodies=>bodies: /var/lib/percussd/bodies"
    "# store: /var/lib/percussd/specimens.db=>store: /var/lib/percussd/specimens.db")
  string(REPLACE "=>" ";" change "${change}")
  list(GET change 0 shipped)
  list(GET change 1 packaged)
  string(FIND "${settings}" "\n${shipped}\n" found)
  if(found LESS 0)
    message(FATAL_ERROR "config/percussd.yaml: no line '${shipped}'")
  endif()
  string(REPLACE "\n${shipped}\n" "\n${packaged}\n" settings "${settings}")
endforeach()
file(WRITE ${made}/percussd.yaml "${settings}")
file(WRITE ${made}/catalogue.yaml "${bodies}")
install(FILES ${made}/percussd.yaml ${made}/catalogue.yaml
        DESTINATION ${CMAKE_INSTALL_FULL_SYSCONFDIR}/percuss COMPONENT daemon)
install(FILES deploy/systemd/percussd.service DESTINATION lib/systemd/system COMPONENT daemon)
install(DIRECTORY client/python/percuss DESTINATION lib/python3/dist-packages COMPONENT python
        PATTERN __pycache__ EXCLUDE)
install(FILES ${PROJECT_BINARY_DIR}/client/page.html DESTINATION lib/python3/dist-packages/percuss COMPONENT python)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME percuss)
set(CPACK_PACKAGE_VENDOR "The percuss authors")
set(CPACK_PACKAGE_CONTACT "The percuss authors <percuss@percuss.invalid>")
set(CPACK_SET_DESTDIR ON) # for what is in /etc
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/percuss_pack.cmake)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL daemon tools library local fmi development python documents)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/client)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

# percuss_package(<component> <name> <section> SUMMARY <line> TEXT <paragraph> [DEPENDS ...] [RECOMMENDS ...]
#                 [ANY_MACHINE] [CONTROL <file>...])
macro(percuss_package component name section)
  cmake_parse_arguments(P "ANY_MACHINE" "SUMMARY;TEXT" "DEPENDS;RECOMMENDS;CONTROL" ${ARGN})
  string(TOUPPER ${component} C)
  set(CPACK_DEBIAN_${C}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${C}_PACKAGE_SECTION ${section})
  set(CPACK_COMPONENT_${C}_DESCRIPTION "${P_SUMMARY}\n${P_TEXT}")
  string(JOIN ", " CPACK_DEBIAN_${C}_PACKAGE_DEPENDS ${P_DEPENDS})
  string(JOIN ", " CPACK_DEBIAN_${C}_PACKAGE_RECOMMENDS ${P_RECOMMENDS})
  set(CPACK_DEBIAN_${C}_PACKAGE_CONTROL_EXTRA ${P_CONTROL})
  if(P_ANY_MACHINE)
    set(CPACK_DEBIAN_${C}_PACKAGE_ARCHITECTURE all)
    set(CPACK_DEBIAN_${C}_PACKAGE_SHLIBDEPS OFF)
  endif()
  # each has its licence and its changes
  install(FILES ${packaging}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component})
  install(FILES ${made}/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component})
endmacro()

file(MAKE_DIRECTORY ${made})
execute_process(COMMAND gzip -9 -n -c ${packaging}/changelog OUTPUT_FILE ${made}/changelog.Debian.gz
                COMMAND_ERROR_IS_FATAL ANY)
set(alike "(>= ${PROJECT_VERSION})")
percuss_package(daemon percuss-daemon science
  SUMMARY "daemon that computes what impacts do"
  TEXT "percussd answers requests of multibody simulators and test rigs on DDS:
the impulse of an impact, its coefficient of restitution, and the list of
its sub-impacts, from a modal model of the bodies that meet."
  DEPENDS "init-system-helpers (>= 1.54~)"
  RECOMMENDS "percuss-tools ${alike}"
  CONTROL ${packaging}/conffiles ${packaging}/daemon/postinst ${packaging}/daemon/prerm ${packaging}/daemon/postrm)
percuss_package(tools percuss-tools science
  SUMMARY "questions about impacts on the command line"
  TEXT "percuss asks a percussd about impacts, percuss-reduce makes bodies from
meshes, and percuss-tables computes contact tables ahead of time."
  DEPENDS "libpercuss${PERCUSS_SOVERSION} ${alike}"
  RECOMMENDS "percuss-daemon ${alike}" "libpercuss-local${PERCUSS_SOVERSION} ${alike}" "gnuplot-nox | gnuplot")
percuss_package(library libpercuss${PERCUSS_SOVERSION} libs
  SUMMARY "asking what an impact does, from C"
  TEXT "libpercuss asks a percussd over DDS, which it hides,
libpercuss-slowscale applies the answers in a multibody engine, and
libpercuss-measured puts measured impacts beside simulated ones."
  CONTROL ${packaging}/library/triggers)
percuss_package(local libpercuss-local${PERCUSS_SOVERSION} libs
  SUMMARY "what an impact does, computed in a program's own process"
  TEXT "libpercuss-local answers as percussd does, without one: the solver is in the
library. Its default catalogue and contact tables are those of percuss-daemon."
  RECOMMENDS "percuss-daemon ${alike}"
  CONTROL ${packaging}/library/triggers)
percuss_package(fmi percuss-fmu science
  SUMMARY "what an impact does, for simulators that import FMUs"
  TEXT "Two Functional Mock-up Units of FMI 3.0 in /usr/lib/*/percuss: a law of
impact, and a body that falls. Each has the solver, the shipped bodies and
their contact tables in it; the libraries of algebra come with
libpercuss-local${PERCUSS_SOVERSION}."
  DEPENDS "libpercuss-local${PERCUSS_SOVERSION} ${alike}")
percuss_package(development libpercuss-dev libdevel
  SUMMARY "asking what an impact does, from C: headers"
  TEXT "Headers, pkg-config and CMake files of libpercuss, libpercuss-local,
libpercuss-slowscale and libpercuss-measured, the IDL of what percussd reads and writes, and examples."
  DEPENDS "libpercuss${PERCUSS_SOVERSION} ${alike}" "libpercuss-local${PERCUSS_SOVERSION} ${alike}")
percuss_package(python python3-percuss python ANY_MACHINE
  SUMMARY "asking what an impact does, from Python"
  TEXT "A package around libpercuss: requests and replies as dataclasses, arrays
by numpy."
  DEPENDS "libpercuss${PERCUSS_SOVERSION} ${alike}" "python3:any" "python3-numpy"
  CONTROL ${packaging}/python/postinst ${packaging}/python/prerm)
percuss_package(documents percuss-doc doc ANY_MACHINE
  SUMMARY "what percuss computes and how it is used"
  TEXT "How a multibody engine uses percuss, its contact models, bodies from
meshes, uncertainty, what its numbers are checked against, and how the daemon
is operated.")
include(CPack)
