# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# The documents for an installed tree: its paths instead of the source's, in links and in text.
file(RELATIVE_PATH data_from_documents /${CMAKE_INSTALL_DOCDIR} /${CMAKE_INSTALL_DATADIR}/percuss)

# percuss_document(<file>): of README.md or docs/, into the folder of all documents
function(percuss_document file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  get_filename_component(name ${file} NAME)
  file(READ ${file} text)
  string(REGEX REPLACE "\\]\\((\\.\\./)?client/(examples|python)/" "](${data_from_documents}/\\2/" text "${text}")
  string(REGEX REPLACE "\\]\\((\\.\\./)?(config|idl)/" "](${data_from_documents}/" text "${text}")
  string(REPLACE "](docs/" "](" text "${text}")
  string(REPLACE "](../SECURITY.md" "](SECURITY.md" text "${text}")
  string(REPLACE "](../deploy/" "](${data_from_documents}/" text "${text}")
  string(REGEX REPLACE "client/(examples|python)" "${CMAKE_INSTALL_DATADIR}/percuss/\\1" text "${text}")
  string(REGEX REPLACE "([ `])config/" "\\1${CMAKE_INSTALL_DATADIR}/percuss/" text "${text}")
  string(REPLACE "build/bin/" "" text "${text}")
  file(WRITE ${PROJECT_BINARY_DIR}/docs/${name} "${text}")
  install(FILES ${PROJECT_BINARY_DIR}/docs/${name} DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)
endfunction()

file(GLOB documents CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/*.md)
foreach(document ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/SECURITY.md ${documents})
  percuss_document(${document})
endforeach()
install(DIRECTORY docs/figures DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)
