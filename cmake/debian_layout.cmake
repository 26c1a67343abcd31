# SPDX-License-Identifier: BSD-3-Clause
# Run by CPack between installation and packing: what Debian has elsewhere than a prefix, and what it
# wants of every package. Modules for Python are in python3/dist-packages; pages of man are compressed.
cmake_minimum_required(VERSION 3.22)

function(pack_up file)
  execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Debian's changelog says the version and its day; ours what is new.
function(write_changelog file package)
  file(STRINGS ${CPACK_RONDO_SOURCES}/CHANGELOG.md heading REGEX "^## .*- [0-9-]+$" LIMIT_COUNT 1)
  string(REGEX MATCH "[0-9-]+$" day "${heading}")
  execute_process(COMMAND date -u -R -d "${day}" OUTPUT_VARIABLE day OUTPUT_STRIP_TRAILING_WHITESPACE
                  COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE ${file} "${package} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n"
                     "  * Version ${CPACK_PACKAGE_VERSION}: /usr/share/doc/rondo/NEWS.gz.\n\n"
                     " -- ${CPACK_PACKAGE_CONTACT}  ${day}\n")
endfunction()

function(write_documents root package)
  set(folder ${root}/usr/share/doc/${package})
  configure_file(${CPACK_RONDO_SOURCES}/scripts/debian/copyright ${folder}/copyright COPYONLY)
  write_changelog(${folder}/changelog ${package})
  if(package STREQUAL rondo)
    configure_file(${CPACK_RONDO_SOURCES}/CHANGELOG.md ${folder}/NEWS COPYONLY)
  endif()
  foreach(text copyright changelog NEWS)
    if(EXISTS ${folder}/${text})
      file(CHMOD ${folder}/${text} PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
      if(NOT text STREQUAL copyright)
        pack_up(${folder}/${text})
      endif()
    endif()
  endforeach()
endfunction()

set(runtime ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/runtime)
set(python ${runtime}/usr/${CPACK_RONDO_PYTHON_DIR})
if(CPACK_RONDO_PYTHON_DIR AND IS_DIRECTORY ${python})
  file(MAKE_DIRECTORY ${runtime}/usr/lib/python3)
  file(RENAME ${python} ${runtime}/usr/lib/python3/dist-packages)
  cmake_path(GET python PARENT_PATH folder) # no more in it
  file(REMOVE_RECURSE ${folder})
endif()
file(GLOB_RECURSE pages ${runtime}/usr/share/man/*.[1-8])
foreach(page ${pages})
  pack_up(${page})
endforeach()
write_documents(${runtime} rondo)
write_documents(${CPACK_TEMPORARY_INSTALL_DIRECTORY}/development rondo-dev)
# A folder that a script has made has the modes of whoever packs.
file(GLOB_RECURSE found LIST_DIRECTORIES true ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*)
foreach(path ${found})
  if(IS_DIRECTORY ${path} AND NOT IS_SYMLINK ${path})
    file(CHMOD ${path} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                   WORLD_EXECUTE)
  endif()
endforeach()
