# SPDX-License-Identifier: BSD-3-Clause
# Packages for Debian (docs/install.md, docs/decisions/043): cmake --build BUILD --target package makes
# rondo_VERSION_ARCH.deb, the program with all that belongs to it, and rondo-dev_VERSION_ARCH.deb, the
# library. What install() names no component for goes into the first.
if(RONDO_SANITIZE OR RONDO_COVERAGE OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
  return()
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rondo)
set(RONDO_PACKAGE_CONTACT "the rondo authors <rondo@localhost>" CACHE STRING
    "Who answers for the packages: name <address>")
set(CPACK_PACKAGE_CONTACT "${RONDO_PACKAGE_CONTACT}")
set(CPACK_PACKAGE_VENDOR "the rondo authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "explicit non-smooth dynamics of rolling bodies")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
                                                GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian_layout.cmake)
set(CPACK_RONDO_SOURCES ${PROJECT_SOURCE_DIR})
set(CPACK_RONDO_PYTHON_DIR "${RONDO_PYTHON_DIR}")

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME rondo)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "Deformable disks, wheels and other bodies in large rotation, in exact
frictional contact with rigid ground and with each other: transient
rolling with an energy balance in each run, steady rolling,
crushing, modes, reduced wheels, parametric studies. With the package for
Python, example cases and pages of man.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS
    "python3-numpy, python3-h5py, python3-matplotlib, python3-pil")
if(RONDO_PYTHON_MODULE MATCHES "cpython-3([0-9]+)") # the module is for this one alone
  math(EXPR next "${CMAKE_MATCH_1} + 1")
  string(PREPEND CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS
         "python3 (>= 3.${CMAKE_MATCH_1}), python3 (<< 3.${next}), ")
else()
  string(PREPEND CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "python3 (>= 3.11), ")
endif()
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "ffmpeg, openmpi-bin")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "rondo-dev, paraview, python3-pandas, python3-xarray")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/scripts/debian/postinst
                                               ${PROJECT_SOURCE_DIR}/scripts/debian/prerm)

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME rondo-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "Headers, static archives and the configuration of CMake for programs in
C++ that are linked with the library of rondo: find_package(rondo).")
# As find_package(rondo) looks for them: cmake/dependencies.cmake; rondo has the reader of meshes.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "rondo (= ${PROJECT_VERSION}), libeigen3-dev, libfmt-dev, \
libspdlog-dev, nlohmann-json3-dev, libtomlplusplus-dev, libcli11-dev, libsuitesparse-dev, libspectra-dev, \
liblapacke-dev, libopenblas-dev, libfftw3-dev, libxxhash-dev, libhdf5-dev")
include(CPack)
