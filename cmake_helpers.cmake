# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Anneal6D authors
#
# Shared by the folders' CMakeLists.txt.

# anneal6d_add_module(NAME SOURCES...): a library anneal6d::NAME with its public headers in include/.
function(anneal6d_add_module name)
  add_library(anneal6d_${name} ${ARGN})
  add_library(anneal6d::${name} ALIAS anneal6d_${name})
  set_target_properties(anneal6d_${name} PROPERTIES EXPORT_NAME ${name}
                        POSITION_INDEPENDENT_CODE ON)
  target_compile_features(anneal6d_${name} PUBLIC cxx_std_20)
  target_include_directories(anneal6d_${name}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  anneal6d_warnings(anneal6d_${name})
endfunction()

# The project's warnings, for its own code only, which is UTF-8.
function(anneal6d_warnings target)
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall -Wextra -Wpedantic -Wshadow>
    # GCC 12 takes joined strings for overlapping ones (its bug 105651).
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
    $<$<CXX_COMPILER_ID:MSVC>:/W4 /utf-8>)
endfunction()
