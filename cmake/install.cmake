include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY RONDO_MODULES)
install(TARGETS ${modules} EXPORT rondo-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS rondo rondo-mesh-reader RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
include(cmake/public_headers.cmake)
foreach(header ${RONDO_PUBLIC_HEADERS} ${RONDO_INCLUDED_HEADERS})
  get_filename_component(folder ${header} DIRECTORY)
  set(file ${PROJECT_SOURCE_DIR}/src/rondo/${header})
  if(header STREQUAL "core/version.hpp")
    set(file ${PROJECT_BINARY_DIR}/generated/rondo/${header})
  endif()
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rondo/${folder})
endforeach()
install(EXPORT rondo-targets NAMESPACE rondo:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/rondo)
configure_package_config_file(cmake/rondo-config.cmake.in
                              ${PROJECT_BINARY_DIR}/rondo-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/rondo)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/rondo-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/rondo-config.cmake
              ${PROJECT_BINARY_DIR}/rondo-config-version.cmake cmake/dependencies.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/rondo)
install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/rondo)

# The Python package, where Debian's python3 looks when the prefix is /usr/local.
find_program(SYSTEM_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(SYSTEM_PYTHON AND NOT DEFINED RONDO_PYTHON_DIR)
  execute_process(COMMAND ${SYSTEM_PYTHON} -c "import sys; print('%d.%d' % sys.version_info[:2])"
                  OUTPUT_VARIABLE python_version OUTPUT_STRIP_TRAILING_WHITESPACE
                  COMMAND_ERROR_IS_FATAL ANY)
  set(python_dir lib/python${python_version}/dist-packages)
endif()
set(RONDO_PYTHON_DIR "${python_dir}" CACHE STRING
    "Where the Python package is installed, relative to the prefix; empty: nowhere")
if(RONDO_PYTHON_DIR)
  install(DIRECTORY python/rondo DESTINATION ${RONDO_PYTHON_DIR}
          FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
else()
  message(STATUS "RONDO_PYTHON_DIR is empty: the Python package will not be installed")
endif()
