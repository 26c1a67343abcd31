// SPDX-License-Identifier: BSD-3-Clause
// A program against the installed library: reads a case and says its title.
#include <cstdio>

#include "rondo/case/case.hpp"
#include "rondo/core/version.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const rondo::study::Case read = rondo::study::read_case(argv[1], {});
  std::printf("consumer of rondo %s: %s\n", rondo::version, read.title.c_str());
}
