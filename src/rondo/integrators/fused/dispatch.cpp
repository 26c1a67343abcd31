// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/dispatch.hpp"

#include <cstdlib>
#include <string>
#include <string_view>

#include "rondo/core/error.hpp"

namespace rondo::dynamics {
namespace {

bool machine_has(std::string_view level) noexcept {
#ifdef RONDO_X86_KERNELS
  if (level == "avx512")
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("fma");
  if (level == "avx2") return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#endif
  return level == "baseline";
}

/// Best first.
constexpr const kernels::Table* all_tables[] = {
#ifdef RONDO_X86_KERNELS
    &kernels::avx512_table, &kernels::avx2_table,
#endif
    &kernels::baseline_table};

const kernels::Table& choose() {
  const char* asked = std::getenv("RONDO_DISPATCH");
  const std::string_view name = asked ? asked : "";
  std::string allowed;
  for (const kernels::Table* table : kernel_tables()) {
    if (name.empty() || name == table->name) return *table;
    allowed += (allowed.empty() ? "" : ", ") + std::string(table->name);
  }
  Fault fault;
  fault.file = "environment";
  fault.key = "RONDO_DISPATCH";
  fault.found = name;
  fault.message = "no such instruction set, or this machine does not have it";
  fault.allowed = allowed;
  throw InputError(fault);
}

}  // namespace

std::span<const kernels::Table* const> kernel_tables() noexcept {
  // A machine that has a level has those after it.
  std::span<const kernels::Table* const> tables(all_tables);
  while (!machine_has(tables.front()->name)) tables = tables.subspan(1);
  return tables;
}

const kernels::Table& kernel_table() {
  static const kernels::Table& chosen = choose();
  return chosen;
}

}  // namespace rondo::dynamics
