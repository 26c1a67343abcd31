// SPDX-License-Identifier: BSD-3-Clause
/// For builds that count the lines reached by tests: processes that end by _exit, like those of
/// jobs, first write their counts. Linked with --wrap=_exit.
extern "C" {
#include <gcov.h>  // declares no linkage itself

[[noreturn]] void __real__exit(int code);
[[noreturn]] void __wrap__exit(int code);

void __wrap__exit(int code) {
  __gcov_dump();
  __real__exit(code);
}
}
