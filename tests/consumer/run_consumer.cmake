# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Anneal6D authors
#
# A script (cmake -P); CMakeLists.txt beside it says with what.

# run(COMMAND...): stops, showing the command and what it printed, unless it succeeds.
macro(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    string(JOIN " " command ${ARGN})
    message("${output}")
    message(FATAL_ERROR "ended with ${status}: ${command}")
  endif()
endmacro()

set(prefix ${scratch}/prefix)
file(REMOVE_RECURSE ${scratch})

run(${CMAKE_COMMAND} --install ${build} --config ${config} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${project} -B ${scratch}/build -G ${generator}
    -D CMAKE_BUILD_TYPE=${config} -D CMAKE_CXX_COMPILER=${compiler}
    -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_FIND_PACKAGE_NO_PACKAGE_REGISTRY=ON)
run(${CMAKE_COMMAND} --build ${scratch}/build --config ${config})

run(${CMAKE_CTEST_COMMAND} --test-dir ${scratch}/build -C ${config} --output-on-failure)

if(tool)
  run(${prefix}/${bindir}/anneal6d --version)
endif()
