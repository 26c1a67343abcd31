# SPDX-License-Identifier: BSD-3-Clause
# Most of a compilation is reading headers, so sources of one target are compiled several at a time.
# Names in their anonymous namespaces must therefore differ. The presets `dev` and `clang`, and
# clang-tidy, compile every file alone; these warn of shadowed names too (-Wshadow), which would here
# be those of another file.
#
# CMake can do this by itself (CMAKE_UNITY_BUILD), but its batches name their sources by absolute
# paths: a compiler cache then finds nothing in another clone.
option(RONDO_UNITY "Compile several sources as one: a first build takes half of the time" ON)
set(RONDO_BATCH 20 CACHE STRING "How many sources are compiled as one")

# Sets RESULT to true where the source can be compiled with others: it is a file of the project, and it
# has no flags or definitions of its own (kernels have one file for each instruction set).
function(rondo_goes_with_others result target source)
  set(${result} FALSE PARENT_SCOPE)
  if(source MATCHES "\\.cpp$" AND NOT source MATCHES "\\$<" AND NOT source MATCHES "^${PROJECT_BINARY_DIR}")
    foreach(property COMPILE_OPTIONS COMPILE_DEFINITIONS RONDO_ALONE)
      get_source_file_property(value ${source} ${property})
      if(value)
        return()
      endif()
    endforeach()
    set(${result} TRUE PARENT_SCOPE)
  endif()
endfunction()

# Replaces the sources of a target by batches that include them.
function(rondo_compile_together target)
  if(NOT RONDO_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  set(alone "")
  set(batch "")
  set(n_batches 0)
  foreach(source IN LISTS sources ITEMS "")
    rondo_goes_with_others(together ${target} "${source}")
    if(together)
      get_filename_component(path ${source} ABSOLUTE)
      file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR} ${path})
      list(APPEND batch "#include \"${path}\"")
    elseif(source)
      list(APPEND alone ${source})
    endif()
    list(LENGTH batch n)
    if(n EQUAL RONDO_BATCH OR (n GREATER 0 AND NOT source))
      set(file ${CMAKE_CURRENT_BINARY_DIR}/${target}_${n_batches}.cpp)
      list(JOIN batch "\n" text)
      file(CONFIGURE OUTPUT ${file} CONTENT "${text}\n" @ONLY)
      list(APPEND alone ${file})
      set(batch "")
      math(EXPR n_batches "${n_batches} + 1")
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES SOURCES "${alone}")
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
endfunction()
