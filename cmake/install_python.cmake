# SPDX-License-Identifier: BSD-3-Clause
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
# plotly.js, which draws the curves of `rondo report`: scripts/setup.sh installs it by npm. It goes
# beside the build and into the installed package.
find_file(RONDO_PLOTLY plotly-basic.min.js DOC "plotly-basic.min.js of npm's plotly.js-basic-dist-min"
          PATHS /usr/local/lib/node_modules /usr/lib/node_modules PATH_SUFFIXES plotly.js-basic-dist-min)
if(RONDO_PLOTLY)
  file(COPY_FILE ${RONDO_PLOTLY} ${PROJECT_BINARY_DIR}/python/plotly-basic.min.js ONLY_IF_DIFFERENT)
  cmake_path(GET RONDO_PLOTLY PARENT_PATH plotly_folder)
  if(EXISTS ${plotly_folder}/LICENSE)
    file(COPY_FILE ${plotly_folder}/LICENSE ${PROJECT_BINARY_DIR}/python/plotly-LICENSE ONLY_IF_DIFFERENT)
  endif()
else()
  message(STATUS "plotly.js is not there: rondo report will say so (npm install -g plotly.js-basic-dist-min@4.1.1, or -DRONDO_PLOTLY=FILE)")
endif()
set(RONDO_PYTHON_DIR "${python_dir}" CACHE STRING
    "Where the Python package is installed, relative to the prefix; empty: nowhere")
if(RONDO_PYTHON_DIR)
  set(package ${RONDO_PYTHON_DIR}/rondo)
  install(DIRECTORY python/rondo DESTINATION ${RONDO_PYTHON_DIR}
          FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN "reports/assets/*" PATTERN "__pycache__" EXCLUDE)
  if(RONDO_PLOTLY)
    install(FILES ${PROJECT_BINARY_DIR}/python/plotly-basic.min.js ${PROJECT_BINARY_DIR}/python/plotly-LICENSE
            DESTINATION ${package}/reports/assets OPTIONAL)
  endif()
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
