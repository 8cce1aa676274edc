# SPDX-License-Identifier: MIT
# What `cmake --install` lays down: the component `development`, libraries, headers and the CMake
# package, and with the command the component `command`, which has its configurations, too. The
# CMake package may be moved: it names no path of this machine.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(corvo_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/corvo)

# Each component is exported by itself, so that those who want one need not have what others need.
foreach(component IN ITEMS orb vo opencv)
  set_target_properties(corvo_${component} PROPERTIES EXPORT_NAME ${component})
  install(TARGETS corvo_${component} EXPORT corvo-${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${CMAKE_INSTALL_INCLUDEDIR}/corvo)
  install(EXPORT corvo-${component} NAMESPACE corvo:: DESTINATION ${corvo_package_dir}
    COMPONENT development)
endforeach()

include(${CMAKE_CURRENT_LIST_DIR}/public_headers.cmake)
foreach(header IN LISTS corvo_public_headers)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/corvo/${folder}
    COMPONENT development)
endforeach()

configure_package_config_file(cmake/corvo-config.cmake.in
  ${PROJECT_BINARY_DIR}/corvo-config.cmake
  INSTALL_DESTINATION ${corvo_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/corvo-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(
  FILES ${PROJECT_BINARY_DIR}/corvo-config.cmake ${PROJECT_BINARY_DIR}/corvo-config-version.cmake
  DESTINATION ${corvo_package_dir} COMPONENT development)
install(FILES LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licenses)

# The completions and manual pages are printed by the command itself.
if(TARGET corvo AND (NOT CMAKE_CROSSCOMPILING OR CMAKE_CROSSCOMPILING_EMULATOR))
  include(${CMAKE_CURRENT_LIST_DIR}/command_documentation.cmake)
endif()

if(TARGET corvo)
  install(TARGETS corvo RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
  install(TARGETS corvo_codecs_module LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/corvo/modules
    COMPONENT command)
  install(DIRECTORY configs DESTINATION ${CMAKE_INSTALL_DATADIR}/corvo COMPONENT command)
endif()
