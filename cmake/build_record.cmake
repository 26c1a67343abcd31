# SPDX-License-Identifier: BSD-3-Clause
# RONDO_FLAGS and RONDO_LIBRARY_VERSIONS of core/build_record.hpp: what every module is compiled with, and
# "name version" of the libraries, of their headers or of what find_package() found.
string(TOUPPER "${CMAKE_BUILD_TYPE}" kind)
set(RONDO_FLAGS "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${kind}} -std=c++20 -ffp-contract=off")
if(RONDO_SANITIZE)
  string(APPEND RONDO_FLAGS " -fsanitize=${RONDO_SANITIZE}")
endif()
if(RONDO_COVERAGE)
  string(APPEND RONDO_FLAGS " --coverage")
endif()
string(REPLACE "\\" "\\\\" RONDO_FLAGS "${RONDO_FLAGS}")
string(REPLACE "\"" "\\\"" RONDO_FLAGS "${RONDO_FLAGS}")
string(STRIP "${RONDO_FLAGS}" RONDO_FLAGS)

# The number that a line of a file ends with, or that its first match holds; "" where there is none.
function(rondo_version_in file pattern result)
  set(found "")
  if(EXISTS "${file}")
    file(STRINGS "${file}" lines REGEX "${pattern}")
    if(lines)
      list(GET lines 0 line)
      string(REGEX REPLACE "${pattern}" "" line "${line}") # else digits of a macro's name
      string(REGEX MATCH "[0-9][0-9.]*" found "${line}")
    endif()
  endif()
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

# Of three macros.
function(rondo_version_of file prefix parts result)
  set(version "")
  foreach(part ${parts})
    rondo_version_in("${file}" "#define +${prefix}${part} " number)
    list(APPEND version "${number}")
  endforeach()
  list(JOIN version "." version)
  set(${result} "${version}" PARENT_SCOPE)
endfunction()

rondo_version_of("${CHOLMOD_INCLUDE_DIR}/cholmod_core.h" CHOLMOD_ "MAIN_VERSION;SUB_VERSION;SUBSUB_VERSION"
                 cholmod_version)
if(NOT cholmod_version MATCHES "^[0-9]") # one header from SuiteSparse 7 on
  rondo_version_of("${CHOLMOD_INCLUDE_DIR}/cholmod.h" CHOLMOD_ "MAIN_VERSION;SUB_VERSION;SUBSUB_VERSION"
                   cholmod_version)
endif()
rondo_version_of("${SPECTRA_INCLUDE_DIR}/Spectra/Util/Version.h" SPECTRA_
                 "MAJOR_VERSION;MINOR_VERSION;PATCH_VERSION" spectra_version)
rondo_version_in("${RONDO_HDF5_INCLUDE_DIR}/H5public.h" "#define H5_VERS_INFO +\"HDF5" hdf5_version)
rondo_version_in("${OPENBLAS_INCLUDE_DIR}/openblas_config.h" "#define OPENBLAS_VERSION " openblas_version)
get_filename_component(fftw_folder "${FFTW_LIBRARY}" DIRECTORY)
rondo_version_in("${fftw_folder}/pkgconfig/fftw3.pc" "^Version: " fftw_version)
find_path(GMSH_INCLUDE_DIR gmsh.h)
rondo_version_in("${GMSH_INCLUDE_DIR}/gmsh.h" "#define GMSH_API_VERSION +\"" gmsh_version)
set(RONDO_LIBRARY_VERSIONS "")
foreach(pair "Eigen ${Eigen3_VERSION}" "CHOLMOD ${cholmod_version}" "Spectra ${spectra_version}"
             "OpenBLAS ${openblas_version}" "FFTW ${fftw_version}" "HDF5 ${hdf5_version}"
             "Gmsh ${gmsh_version}" "fmt ${fmt_VERSION}" "nlohmann-json ${nlohmann_json_VERSION}"
             "toml++ ${tomlplusplus_VERSION}" "CLI11 ${CLI11_VERSION}" "spdlog ${spdlog_VERSION}")
  string(STRIP "${pair}" pair)
  list(APPEND RONDO_LIBRARY_VERSIONS "${pair}")
endforeach()
