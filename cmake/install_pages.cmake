# SPDX-License-Identifier: BSD-3-Clause
# Pages of man and the completion of bash, written by scripts/pages from what the program says of itself:
# by the target `pages` into man/ and completions/ of the build, and by each installation where they belong.
set(write_pages ${PROJECT_SOURCE_DIR}/scripts/pages/write.py)
if(RONDO_SANITIZE OR RONDO_COVERAGE OR CMAKE_CROSSCOMPILING OR NOT SYSTEM_PYTHON OR NOT EXISTS ${write_pages})
  return() # no program that is shipped, or that can be asked
endif()
add_custom_target(pages VERBATIM COMMENT "Writing pages of man and the completion of bash"
                  COMMAND ${SYSTEM_PYTHON} -B ${write_pages} $<TARGET_FILE:rondo>
                          --changelog ${PROJECT_SOURCE_DIR}/CHANGELOG.md --man ${PROJECT_BINARY_DIR}/man
                          --bash ${PROJECT_BINARY_DIR}/completions/rondo)
add_dependencies(pages rondo)

install(CODE "
set(share \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}\")
execute_process(COMMAND \"${SYSTEM_PYTHON}\" -B \"${write_pages}\" \"$<TARGET_FILE:rondo>\"
                        --changelog \"${PROJECT_SOURCE_DIR}/CHANGELOG.md\" --man \"\${share}/man\"
                        --bash \"\${share}/bash-completion/completions/rondo\"
                OUTPUT_VARIABLE written COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE \"\n\" \";\" written \"\${written}\")
foreach(file \${written})
  file(CHMOD \"\${file}\" PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  cmake_path(RELATIVE_PATH file BASE_DIRECTORY \"\$ENV{DESTDIR}/\" OUTPUT_VARIABLE installed)
  message(STATUS \"Installing: \${file}\")
  list(APPEND CMAKE_INSTALL_MANIFEST_FILES \"/\${installed}\")
endforeach()")
