# SPDX-License-Identifier: BSD-3-Clause
# Everything comes from Debian packages (scripts/setup.sh). Used by the build and by the installed
# package's configuration, so that both name the same targets.
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt 9 REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json 3 REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(CLI11 REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)

if(NOT TARGET rondo_cholmod)
  find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
  find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
  add_library(rondo_cholmod INTERFACE IMPORTED)
  target_link_libraries(rondo_cholmod INTERFACE ${CHOLMOD_LIBRARY})
  target_include_directories(rondo_cholmod SYSTEM INTERFACE ${CHOLMOD_INCLUDE_DIR})

  find_path(SPECTRA_INCLUDE_DIR Spectra/SymEigsSolver.h REQUIRED)
  add_library(rondo_spectra INTERFACE IMPORTED)
  target_include_directories(rondo_spectra SYSTEM INTERFACE ${SPECTRA_INCLUDE_DIR})

  # OpenBLAS holds LAPACK too; LAPACKE is its C interface.
  find_library(LAPACKE_LIBRARY lapacke REQUIRED)
  find_path(LAPACKE_INCLUDE_DIR lapacke.h PATH_SUFFIXES lapacke REQUIRED)
  find_library(OPENBLAS_LIBRARY openblas REQUIRED)
  find_path(OPENBLAS_INCLUDE_DIR cblas.h PATH_SUFFIXES openblas-pthread openblas REQUIRED)
  add_library(rondo_lapack INTERFACE IMPORTED)
  target_link_libraries(rondo_lapack INTERFACE ${LAPACKE_LIBRARY} ${OPENBLAS_LIBRARY})
  target_include_directories(rondo_lapack SYSTEM INTERFACE ${LAPACKE_INCLUDE_DIR}
                                                           ${OPENBLAS_INCLUDE_DIR})

  find_library(FFTW_LIBRARY fftw3 REQUIRED)
  find_path(FFTW_INCLUDE_DIR fftw3.h REQUIRED)
  add_library(rondo_fftw INTERFACE IMPORTED)
  target_link_libraries(rondo_fftw INTERFACE ${FFTW_LIBRARY})
  target_include_directories(rondo_fftw SYSTEM INTERFACE ${FFTW_INCLUDE_DIR})

  find_library(MINIZIP_LIBRARY minizip REQUIRED)
  find_path(MINIZIP_INCLUDE_DIR minizip/zip.h REQUIRED)
  add_library(rondo_minizip INTERFACE IMPORTED)
  target_link_libraries(rondo_minizip INTERFACE ${MINIZIP_LIBRARY})
  target_include_directories(rondo_minizip SYSTEM INTERFACE ${MINIZIP_INCLUDE_DIR})

  find_library(XXHASH_LIBRARY xxhash REQUIRED)
  find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED)
  add_library(rondo_xxhash INTERFACE IMPORTED)
  target_link_libraries(rondo_xxhash INTERFACE ${XXHASH_LIBRARY})
  target_include_directories(rondo_xxhash SYSTEM INTERFACE ${XXHASH_INCLUDE_DIR})

  # By itself: FindHDF5 asks for a project with C. The serial library comes first, as Debian has it.
  find_library(RONDO_HDF5_LIBRARY NAMES hdf5_serial hdf5 HINTS ENV HDF5_ROOT REQUIRED)
  find_path(RONDO_HDF5_INCLUDE_DIR hdf5.h HINTS ENV HDF5_ROOT
            PATH_SUFFIXES include include/hdf5/serial hdf5/serial REQUIRED)
  add_library(rondo_hdf5 INTERFACE IMPORTED)
  target_link_libraries(rondo_hdf5 INTERFACE ${RONDO_HDF5_LIBRARY})
  target_include_directories(rondo_hdf5 SYSTEM INTERFACE ${RONDO_HDF5_INCLUDE_DIR})
endif()
