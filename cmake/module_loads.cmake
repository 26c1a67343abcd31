# SPDX-License-Identifier: BSD-3-Clause
# A module of Python may be linked though a function of its own libraries is missing, for those of the
# interpreter are, too: nothing is said before it is loaded. So it is loaded once, by its own Python.
function(rondo_module_must_load target)
  add_custom_command(TARGET ${target} POST_BUILD VERBATIM
                     COMMENT "Loading $<TARGET_FILE_NAME:${target}>"
                     COMMAND ${Python_EXECUTABLE} -c "import ctypes, os, sys; ctypes.CDLL(sys.argv[1], os.RTLD_NOW)"
                             $<TARGET_FILE:${target}>)
endfunction()
