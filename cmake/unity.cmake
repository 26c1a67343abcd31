# SPDX-License-Identifier: BSD-3-Clause
# Most of a compilation is reading headers, so sources of one target are compiled several at a time.
# Names in their anonymous namespaces must therefore differ. Kernels have flags of their own, and one
# file for each instruction set: each is compiled alone. The presets `dev` and `clang`, and clang-tidy,
# compile every file alone; these warn of shadowed names too (-Wshadow), which would here be those of
# another file.
option(RONDO_UNITY "Compile several sources as one: a first build takes half of the time" ON)
set(CMAKE_UNITY_BUILD ${RONDO_UNITY})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 10 CACHE STRING "Sources compiled as one; 0: all of a target")
