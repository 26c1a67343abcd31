// SPDX-License-Identifier: BSD-3-Clause
/// In builds that count the lines the tests reach: processes that end by _exit, as those of jobs
/// do, write their counts first. Linked with --wrap=_exit.
extern "C" {
#include <gcov.h>  // has no linkage of its own

[[noreturn]] void __real__exit(int code);
[[noreturn]] void __wrap__exit(int code);

void __wrap__exit(int code) {
  __gcov_dump();
  __real__exit(code);
}
}
