// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/contract.hpp"

#include <cstdio>
#include <cstdlib>

namespace rondo {

void contract_failed(ContractSite site, const std::string& values) {
  fmt::print(stderr, "rondo: broken contract `{}` at {}:{};{}{}\n", site.condition, site.file,
             site.line, values.empty() ? "" : " values:", values);
  std::abort();
}

}  // namespace rondo
