# SPDX-License-Identifier: BSD-3-Clause
# ncsim_module(NAME SOURCES ... TESTS ... DEPS ... EXTERNAL ...): one static library and one test program a folder.
#   DEPS      modules of this project (an arrow of docs/architecture.md each)
#   EXTERNAL  packaged libraries; used privately, so that their headers stay behind the module
add_library(ncsim_options INTERFACE)
target_include_directories(ncsim_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(ncsim_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wshadow -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # false positives of g++ 12 on std::string + (GCC bug 105651)
  -ffp-contract=off)
target_link_libraries(ncsim_options INTERFACE Eigen3::Eigen)
if(NCSIM_SANITIZE)
  # The modules are watched, the tests that drive them are not: half of the time that the gate takes to build.
  # The sanitizers make g++ 12 see uninitialised variables in <regex>.
  set(watched $<NOT:$<BOOL:$<TARGET_PROPERTY:NCSIM_IS_TEST>>>)
  target_compile_options(ncsim_options INTERFACE
    $<${watched}:-fsanitize=address,undefined> $<${watched}:-fno-sanitize-recover=all> -Wno-maybe-uninitialized)
  target_link_options(ncsim_options INTERFACE -fsanitize=address,undefined)
endif()

include(GoogleTest)

function(ncsim_test NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS;LABELS" ${ARGN})
  add_executable(${NAME} ${ARG_SOURCES})
  target_link_libraries(${NAME} PRIVATE ncsim_options ${ARG_DEPS} GTest::gmock GTest::gtest_main)
  target_compile_definitions(${NAME} PRIVATE NCSIM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  set_target_properties(${NAME} PROPERTIES NCSIM_IS_TEST ON)
  gtest_discover_tests(${NAME} DISCOVERY_TIMEOUT 60 PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT 900)
endfunction()

function(ncsim_module NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;TESTS;DEPS;EXTERNAL" ${ARGN})
  add_library(ncsim_${NAME} STATIC ${ARG_SOURCES})
  list(TRANSFORM ARG_DEPS PREPEND ncsim_)
  target_link_libraries(ncsim_${NAME} PUBLIC ncsim_options ${ARG_DEPS} PRIVATE ${ARG_EXTERNAL})
  if(ARG_TESTS)
    ncsim_test(${NAME}_test SOURCES ${ARG_TESTS} DEPS ncsim_${NAME} LABELS unit)
  endif()
endfunction()
