# SPDX-License-Identifier: BSD-3-Clause
# rondo_module(NAME [FOLDERS a ...] [SOURCES b.cpp ...] [PUBLIC libs] [PRIVATE libs])
# One static library for a room of src/rondo: all sources of the folders (its own where none is
# named), and those that are named. rondo::NAME is its alias, inside and after install.
function(rondo_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Wpedantic
                                           $<$<NOT:$<BOOL:${RONDO_UNITY}>>:-Wshadow>
                                           $<$<BOOL:${RONDO_WERROR}>:-Werror>)
endfunction()

function(rondo_compile_options target)
  rondo_warnings(${target})
  # No contraction: the same source gives the same bits at every optimisation level.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  if(RONDO_SANITIZE)
    rondo_sanitize(${target} ${RONDO_SANITIZE})
  endif()
  if(RONDO_COVERAGE)
    rondo_count_lines(${target})
  endif()
endfunction()

# Atomic: steps have threads. _exit: that of tests/support/coverage_exit.cpp.
function(rondo_count_lines target)
  target_compile_options(${target} PRIVATE --coverage -fprofile-update=atomic)
  target_link_options(${target} PUBLIC --coverage -Wl,--wrap=_exit)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE")
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support/coverage_exit.cpp)
  endif()
endfunction()

# Whatever a sanitizer finds ends the program. Left out: what tests each pointer before its use, or
# each sum of a pointer and an index. That takes as long to compile as all the rest, and what it finds,
# the address sanitizer or the processor (aligned loads of the kernels) finds too.
function(rondo_sanitize target sanitizers)
  target_compile_options(${target} PRIVATE -fsanitize=${sanitizers}
                                           -fno-sanitize=null,alignment,object-size,vptr,pointer-overflow
                                           -fno-sanitize-recover=all
                                           -fno-omit-frame-pointer)
  target_link_options(${target} PUBLIC -fsanitize=${sanitizers})
endfunction()

# The same objects make the program and the module of Python (docs/decisions/039). Hidden: a call
# between them goes as straight as in a program. What is shipped names no folder of the build, but where
# a condition broke by the file's name in the project.
function(rondo_for_module_of_python target)
  target_compile_options(${target} PRIVATE -fPIC -fvisibility=hidden -fvisibility-inlines-hidden
                         $<$<CONFIG:Release>:-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=>)
endfunction()

function(rondo_module name)
  cmake_parse_arguments(ARG "" "" "FOLDERS;SOURCES;PUBLIC;PRIVATE" ${ARGN})
  if(NOT ARG_FOLDERS)
    set(ARG_FOLDERS .)
  endif()
  list(TRANSFORM ARG_FOLDERS APPEND /*.cpp)
  file(GLOB sources CONFIGURE_DEPENDS ${ARG_FOLDERS})
  set(target rondo_${name})
  add_library(${target} STATIC ${sources} ${ARG_SOURCES})
  add_library(rondo::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                                              $<INSTALL_INTERFACE:include>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  rondo_compile_options(${target})
  rondo_for_module_of_python(${target})
  rondo_compile_together(${target})
  set_property(GLOBAL APPEND PROPERTY RONDO_MODULES ${target})
endfunction()
