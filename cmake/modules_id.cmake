# SPDX-License-Identifier: BSD-3-Clause
# rondo_modules_id: what the program and the module of Python call their build (core/build_id.hpp),
# a hash of the modules that both are linked from: a run that one began the other goes on with.
# Run by the build with -DOUTPUT=... -DARCHIVES=..., it writes the source.
if(CMAKE_SCRIPT_MODE_FILE)
  set(sums "")
  foreach(archive ${ARCHIVES})
    file(SHA1 ${archive} sum)
    string(APPEND sums ${sum})
  endforeach()
  string(SHA1 id "${sums}")
  file(WRITE ${OUTPUT} "namespace rondo {\nextern const char* const modules_id;\n"
                       "const char* const modules_id = \"${id}\";\n}  // namespace rondo\n")
  return()
endif()

get_property(modules GLOBAL PROPERTY RONDO_MODULES)
set(archives "")
list(REMOVE_ITEM modules rondo_study) # the sum of its rooms
foreach(module ${modules})
  list(APPEND archives $<TARGET_FILE:${module}>)
endforeach()
set(source ${PROJECT_BINARY_DIR}/generated/modules_id.cpp)
add_custom_command(OUTPUT ${source}
                   COMMAND ${CMAKE_COMMAND} -DOUTPUT=${source} "-DARCHIVES=${archives}"
                           -P ${CMAKE_CURRENT_LIST_FILE}
                   DEPENDS ${modules} ${CMAKE_CURRENT_LIST_FILE} VERBATIM)
add_library(rondo_modules_id OBJECT ${source})
rondo_for_module_of_python(rondo_modules_id)
