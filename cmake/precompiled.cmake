# SPDX-License-Identifier: BSD-3-Clause
# What most sources include of other libraries is read once: by rondo_precompiled for the library and
# the programs, with the test framework by rondo_precompiled_tests. Every source still names what it
# includes: the presets of clang, and clang-tidy, compile without (CMAKE_DISABLE_PRECOMPILE_HEADERS).
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/precompiled.cpp CONTENT "// only to have a target\n")
function(rondo_precompiled_headers target)
  add_library(${target} OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/generated/precompiled.cpp)
  target_link_libraries(${target} PRIVATE fmt::fmt Eigen3::Eigen OpenMP::OpenMP_CXX)
  target_compile_definitions(${target} PRIVATE EIGEN_DONT_PARALLELIZE)
  target_precompile_headers(${target} PRIVATE ${ARGN}
    <Eigen/Core> <Eigen/SparseCore> <fmt/format.h> <algorithm> <array> <cmath> <filesystem>
    <functional> <map> <memory> <optional> <span> <string> <vector>)
  rondo_compile_options(${target})
endfunction()
rondo_precompiled_headers(rondo_precompiled)
rondo_for_module_of_python(rondo_precompiled)

# Files with flags of their own (instruction sets) are compiled without.
function(rondo_use_precompiled target headers)
  target_precompile_headers(${target} REUSE_FROM ${headers})
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    get_source_file_property(flags ${source} COMPILE_OPTIONS)
    if(flags)
      set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endfunction()
