# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Anneal6D authors
#
# `cmake --install` and `find_package(anneal6d)`.
include(CMakePackageConfigHelpers)

set(modules framework trackers capture visualizer)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/anneal6d)

foreach(module IN LISTS modules)
  install(TARGETS anneal6d_${module} EXPORT anneal6d
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
          RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY ${module}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
          FILES_MATCHING PATTERN "*.h")
endforeach()
install(EXPORT anneal6d FILE anneal6dTargets.cmake NAMESPACE anneal6d::
        DESTINATION ${package_folder})

configure_package_config_file(anneal6dConfig.cmake.in anneal6dConfig.cmake
  INSTALL_DESTINATION ${package_folder}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(anneal6dConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/anneal6dConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/anneal6dConfigVersion.cmake
        DESTINATION ${package_folder})
if(ANNEAL6D_HAS_DC1394)
  install(FILES capture/dc1394/60-anneal6d-firewire.rules
          DESTINATION ${CMAKE_INSTALL_DATADIR}/anneal6d)
endif()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

if(ANNEAL6D_BUILD_SAMPLES)
  install(TARGETS anneal6d_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
