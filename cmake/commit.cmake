# SPDX-License-Identifier: BSD-3-Clause
# rondo_commit: which commit the sources are of, and whether they were changed since
# (core/build_record.hpp). Run by every build with -DSOURCE=... -DOUTPUT=... -DGIT=..., it writes a source
# of a few lines, and only where it says something else: a commit compiles nothing else anew.
if(CMAKE_SCRIPT_MODE_FILE)
  cmake_policy(VERSION 3.22)
  set(commit unknown)
  set(modified -1)
  if(GIT)
    # A copy without git within another repository is not of that one's commit.
    execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --show-prefix HEAD
                    OUTPUT_VARIABLE said RESULT_VARIABLE failed ERROR_QUIET)
    if(NOT failed AND said MATCHES "^\n([0-9a-f]+)\n$")
      set(commit ${CMAKE_MATCH_1})
      execute_process(COMMAND ${GIT} -C ${SOURCE} --no-optional-locks status --porcelain --untracked-files=no
                      OUTPUT_VARIABLE changes RESULT_VARIABLE failed ERROR_QUIET)
      if(NOT failed)
        string(COMPARE NOTEQUAL "${changes}" "" modified)
      endif()
    endif()
  endif()
  file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT
"namespace rondo {
extern const char* const built_commit;
extern const int built_modified;
const char* const built_commit = \"@commit@\";
const int built_modified = @modified@;
}  // namespace rondo
")
  return()
endif()

find_program(GIT git)
set(source ${PROJECT_BINARY_DIR}/generated/commit.cpp)
add_custom_target(rondo_look_at_commit BYPRODUCTS ${source}
                  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUTPUT=${source}
                          "-DGIT=$<$<BOOL:${GIT}>:${GIT}>" -P ${CMAKE_CURRENT_LIST_FILE}
                  COMMENT "Which commit this is" VERBATIM)
add_library(rondo_commit OBJECT ${source})
add_dependencies(rondo_commit rondo_look_at_commit)
rondo_for_module_of_python(rondo_commit)
