# SPDX-License-Identifier: BSD-3-Clause
# ncsim_module(NAME SOURCES ... TESTS ... DEPS ... EXTERNAL ... INCLUDES ... DEFINITIONS ...): one static library and one
# test program a folder.
#   DEPS                    modules of this project (an arrow of docs/architecture.md each)
#   EXTERNAL                packaged libraries; used privately, so that their headers stay behind the module
#   INCLUDES, DEFINITIONS   of the sources, private
# With NCSIM_SANITIZE there is a second library NAME_watched of each, compiled with the sanitizers, and NAME_test_watched:
# the same objects of the tests, compiled once and unwatched, linked to what is watched.
add_library(ncsim_options INTERFACE)
target_include_directories(ncsim_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(ncsim_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wshadow -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # false positives of g++ 12 on std::string + (GCC bug 105651)
  -ffp-contract=off)
target_link_libraries(ncsim_options INTERFACE Eigen3::Eigen)

# Warnings are the plain build's: the sanitizers and precompiled headers make g++ 12 see what is not there. Of the
# behaviour that is undefined, what AddressSanitizer sees too, or costs most to compile, is left out.
add_library(ncsim_options_watched INTERFACE)
target_compile_options(ncsim_options_watched INTERFACE
  -O1 -g1 -UNDEBUG -fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr -fno-sanitize-recover=all
  -w)
target_link_options(ncsim_options_watched INTERFACE -fsanitize=address,undefined)
target_link_libraries(ncsim_options_watched INTERFACE ncsim_options)

set(ncsim_flavours "")
if(NCSIM_SANITIZE)
  set(ncsim_flavours _watched)
endif()

# Most of the time that a test or a watched module takes to compile is these headers. The modules themselves are built
# without, so that a header that is not included is seen; watched, and to be linted, eight sources at a time (a unity
# build), for which a name in an unnamed namespace belongs to one file of its folder.
set(ncsim_usual_headers <Eigen/Geometry> <algorithm> <cmath> <functional> <map> <optional> <string> <vector>)

# g++ 12 sees overflows in std::string that are none when headers are precompiled (GCC bugs 105329, 105651).
add_library(ncsim_test_options INTERFACE)
target_compile_options(ncsim_test_options INTERFACE
  -O1 $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread>)
target_link_libraries(ncsim_test_options INTERFACE ncsim_options GTest::gmock)
add_library(ncsim_test_headers OBJECT cmake/precompiled.cc)
target_link_libraries(ncsim_test_headers PRIVATE ncsim_test_options)
target_precompile_headers(ncsim_test_headers PRIVATE <gmock/gmock.h> <gtest/gtest.h> ${ncsim_usual_headers})

include(GoogleTest)

function(ncsim_test NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS;LABELS" ${ARGN})
  add_executable(${NAME} ${ARG_SOURCES})
  target_link_libraries(${NAME} PRIVATE ncsim_test_options ${ARG_DEPS} GTest::gtest_main)
  target_compile_definitions(${NAME} PRIVATE NCSIM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_precompile_headers(${NAME} REUSE_FROM ncsim_test_headers)
  gtest_discover_tests(${NAME} DISCOVERY_TIMEOUT 60 PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT 900)

  foreach(flavour ${ncsim_flavours})
    set(deps "")
    foreach(dep ${ARG_DEPS})
      list(APPEND deps $<IF:$<TARGET_EXISTS:${dep}${flavour}>,${dep}${flavour},${dep}>)
    endforeach()
    add_executable(${NAME}${flavour} EXCLUDE_FROM_ALL $<TARGET_OBJECTS:${NAME}>)
    target_link_libraries(${NAME}${flavour} PRIVATE ncsim_options${flavour} ${deps} GTest::gmock GTest::gtest_main)
  endforeach()
endfunction()

function(ncsim_module NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;TESTS;DEPS;EXTERNAL;INCLUDES;DEFINITIONS" ${ARGN})
  list(TRANSFORM ARG_DEPS PREPEND ncsim_)
  foreach(flavour "" ${ncsim_flavours})
    set(library ncsim_${NAME}${flavour})
    list(TRANSFORM ARG_DEPS APPEND "${flavour}" OUTPUT_VARIABLE deps)
    add_library(${library} STATIC ${ARG_SOURCES})
    target_include_directories(${library} PRIVATE ${ARG_INCLUDES})
    target_compile_definitions(${library} PRIVATE ${ARG_DEFINITIONS})
    target_link_libraries(${library} PUBLIC ncsim_options${flavour} ${deps} PRIVATE ${ARG_EXTERNAL})
    if(flavour)
      set_target_properties(${library} PROPERTIES EXCLUDE_FROM_ALL ON EXPORT_COMPILE_COMMANDS OFF UNITY_BUILD ON)
      if(NAME STREQUAL base)
        target_precompile_headers(${library} PRIVATE ${ncsim_usual_headers})
      else()
        target_precompile_headers(${library} REUSE_FROM ncsim_base${flavour})
      endif()
    endif()
  endforeach()
  if(ARG_TESTS)
    ncsim_test(${NAME}_test SOURCES ${ARG_TESTS} DEPS ncsim_${NAME} LABELS unit)
  endif()
endfunction()
