# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# percuss_layer(<folder of service/core/ or service/> LINKS <lower layers and libraries>): one static library a
# folder. A folder of the core sees the core alone.
function(percuss_layer name)
  cmake_parse_arguments(LAYER "" "" "LINKS" ${ARGN})
  set(door ${PROJECT_SOURCE_DIR}/service)
  if(EXISTS ${door}/core/${name})
    string(APPEND door /core)
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${door}/${name}/*.c ${door}/${name}/*/*.c)
  add_library(${name} STATIC ${sources})
  target_include_directories(${name} PUBLIC ${door} ${PROJECT_SOURCE_DIR}/idl)
  target_link_libraries(${name} PUBLIC ${LAYER_LINKS} m)
endfunction()

# percuss_tests(<folder below tests/> LINKS <libraries>): every test_*.c there is one cmocka program.
function(percuss_tests folder)
  cmake_parse_arguments(TESTS "" "" "LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${folder}/test_*.c)
  string(REPLACE "/" "_" prefix ${folder})
  foreach(source ${sources})
    get_filename_component(name ${source} NAME_WE)
    set(target ${prefix}_${name})
    add_executable(${target} ${source})
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    target_link_libraries(${target} PRIVATE ${TESTS_LINKS} cmocka)
    target_compile_definitions(${target} PRIVATE PERCUSS_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    add_test(NAME ${folder}/${name} COMMAND ${target})
    set_tests_properties(${folder}/${name} PROPERTIES TIMEOUT ${PERCUSS_TEST_SECONDS})
  endforeach()
endfunction()
