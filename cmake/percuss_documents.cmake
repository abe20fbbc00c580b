# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# The documents for an installed tree: its paths instead of the source's, in links and in text.
file(RELATIVE_PATH data_from_documents /${CMAKE_INSTALL_DOCDIR} /${CMAKE_INSTALL_DATADIR}/percuss)

# percuss_document(<file>): of the source folder into that of all documents, of docs/FOLDER into its FOLDER
function(percuss_document file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${file})
  string(REGEX REPLACE "^docs/" "" name ${name})
  get_filename_component(folder "${name}" DIRECTORY)
  set(up "")
  if(folder)
    set(up ../)
  endif()
  file(READ ${file} text)
  string(REGEX REPLACE "\\]\\((\\.\\./)*client/(examples|python|ros2)/" "](${up}${data_from_documents}/\\2/" text "${text}")
  string(REGEX REPLACE "\\]\\((\\.\\./)*(config|idl|deploy)/" "](${up}${data_from_documents}/" text "${text}")
  string(REPLACE "](docs/" "](" text "${text}")
  string(REGEX REPLACE "\\]\\((\\.\\./)+(README|SECURITY|CHANGELOG|CONTRIBUTING)\\.md" "](${up}\\2.md" text "${text}")
  string(REGEX REPLACE "client/(examples|python|ros2)" "${CMAKE_INSTALL_DATADIR}/percuss/\\1" text "${text}")
  string(REGEX REPLACE "([ `])config/" "\\1${CMAKE_INSTALL_DATADIR}/percuss/" text "${text}")
  string(REPLACE "build/bin/" "" text "${text}")
  file(WRITE ${PROJECT_BINARY_DIR}/docs/${name} "${text}")
  install(FILES ${PROJECT_BINARY_DIR}/docs/${name} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT documents)
endfunction()

file(GLOB documents CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/*.md ${PROJECT_SOURCE_DIR}/docs/*/*.md)
foreach(document ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/SECURITY.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md
  ${documents})
  percuss_document(${document})
endforeach()
install(DIRECTORY docs/figures DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)
if(BUILD_TESTING)
  add_test(NAME manual COMMAND sh ${PROJECT_SOURCE_DIR}/tests/site/manual.sh ${PROJECT_SOURCE_DIR})
endif()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)

# the site of all pages, in build/site: ninja site
find_program(SPHINX_BUILD sphinx-build)
if(SPHINX_BUILD AND NOT DEFINED PERCUSS_HAVE_MYST)
  # in the Python that Sphinx has, which need not be the first one here
  file(WRITE ${PROJECT_BINARY_DIR}/site.probe/index.md "# a page\n")
  execute_process(COMMAND ${SPHINX_BUILD} -q -C -D extensions=myst_parser -b dummy ${PROJECT_BINARY_DIR}/site.probe
                  ${PROJECT_BINARY_DIR}/site.probe/out RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  if(NOT failed)
    set(PERCUSS_HAVE_MYST ON CACHE INTERNAL "sphinx-build reads Markdown")
  endif()
endif()
if(SPHINX_BUILD AND PERCUSS_HAVE_MYST)
  # the Python package loads the libraries, and is asked for its docstrings
  add_custom_target(site VERBATIM COMMAND ${CMAKE_COMMAND} -E env PERCUSS_LIBRARY=$<TARGET_FILE:libpercuss> ${SPHINX_BUILD} -q -W --keep-going -n -b html
    -c ${PROJECT_SOURCE_DIR}/deploy/site -d ${PROJECT_BINARY_DIR}/site.trees ${PROJECT_SOURCE_DIR}
    ${PROJECT_BINARY_DIR}/site)
  add_dependencies(site libpercuss libpercuss-local slowscale libpercuss-measured)
  if(BUILD_TESTING)
    add_test(NAME site COMMAND sh ${PROJECT_SOURCE_DIR}/tests/site/site.sh ${PROJECT_SOURCE_DIR})
    set_tests_properties(site PROPERTIES ENVIRONMENT PERCUSS_LIBRARY=$<TARGET_FILE:libpercuss>)
  endif()
else()
  message(STATUS "without sphinx-build and MyST: no target site")
endif()

# the reference of the C interface, in build/reference
find_program(DOXYGEN doxygen)
if(DOXYGEN)
  add_custom_target(docs VERBATIM COMMAND sh ${PROJECT_SOURCE_DIR}/deploy/reference/make.sh ${PROJECT_SOURCE_DIR}
    ${PROJECT_BINARY_DIR}/reference)
  if(BUILD_TESTING)
    add_test(NAME c_reference COMMAND sh ${PROJECT_SOURCE_DIR}/tests/site/c_reference.sh ${PROJECT_SOURCE_DIR})
  endif()
else()
  message(STATUS "without doxygen: no target docs")
endif()
