# SPDX-License-Identifier: BSD-3-Clause
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY RONDO_MODULES)
install(TARGETS ${modules} EXPORT rondo-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(TARGETS rondo rondo-mesh-reader RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS rondo_fmu_binary LIBRARY DESTINATION lib/rondo) # for FMUs, found by the program
include(cmake/public_headers.cmake)
foreach(header ${RONDO_PUBLIC_HEADERS} ${RONDO_INCLUDED_HEADERS})
  get_filename_component(folder ${header} DIRECTORY)
  set(file ${PROJECT_SOURCE_DIR}/src/rondo/${header})
  if(header STREQUAL "core/version.hpp")
    set(file ${PROJECT_BINARY_DIR}/generated/rondo/${header})
  endif()
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rondo/${folder}
          COMPONENT development)
endforeach()
install(EXPORT rondo-targets NAMESPACE rondo:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/rondo
        COMPONENT development)
configure_package_config_file(cmake/rondo-config.cmake.in
                              ${PROJECT_BINARY_DIR}/rondo-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/rondo)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/rondo-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/rondo-config.cmake
              ${PROJECT_BINARY_DIR}/rondo-config-version.cmake cmake/dependencies.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/rondo COMPONENT development)
install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/rondo PATTERN "*.sh" EXCLUDE)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
include(cmake/install_python.cmake)
include(cmake/install_pages.cmake)
