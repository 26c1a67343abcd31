# The Python package with the library as its module, where Debian's python3 looks when the prefix is
# /usr/local; of another Python (-DPython_EXECUTABLE), where that one looks.
if(Python_EXECUTABLE)
  set(python_of_package ${Python_EXECUTABLE})
else()
  set(python_of_package ${SYSTEM_PYTHON})
endif()
if(python_of_package AND NOT DEFINED RONDO_PYTHON_DIR)
  execute_process(COMMAND ${python_of_package} -c "import sys, sysconfig as s; print('lib/python%d.%d/' %
sys.version_info[:2] + s.get_path('purelib').rsplit('/', 1)[1])"
                  OUTPUT_VARIABLE python_dir OUTPUT_STRIP_TRAILING_WHITESPACE
                  COMMAND_ERROR_IS_FATAL ANY)
endif()
set(RONDO_PYTHON_DIR "${python_dir}" CACHE STRING
    "Where the Python package is installed, relative to the prefix; empty: nowhere")
if(RONDO_PYTHON_DIR)
  set(package ${RONDO_PYTHON_DIR}/rondo)
  install(DIRECTORY python/rondo DESTINATION ${RONDO_PYTHON_DIR}
          FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
  if(TARGET rondo_python)
    install(TARGETS rondo_python LIBRARY DESTINATION ${package})
  else()
    install(CODE "message(STATUS \"The Python package goes without the library (rondo._core), it reads and draws only: ${RONDO_PYTHON_MODULE_MISSING}\")")
  endif()
  # Where the package finds the programs: links, which still hold when the prefix is moved.
  configure_file(cmake/link_programs.cmake.in ${PROJECT_BINARY_DIR}/link_programs.cmake @ONLY)
  install(SCRIPT ${PROJECT_BINARY_DIR}/link_programs.cmake)
else()
  message(STATUS "RONDO_PYTHON_DIR is empty: the Python package will not be installed")
endif()

# What python/build_wheel.py takes: cmake --install BUILD --component wheel --prefix FOLDER
install(TARGETS rondo rondo-mesh-reader RUNTIME DESTINATION rondo/bin COMPONENT wheel EXCLUDE_FROM_ALL)
install(TARGETS rondo_fmu_binary LIBRARY DESTINATION rondo/bin COMPONENT wheel EXCLUDE_FROM_ALL)
if(TARGET rondo_python)
  install(TARGETS rondo_python LIBRARY DESTINATION rondo COMPONENT wheel EXCLUDE_FROM_ALL)
endif()
