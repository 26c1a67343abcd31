// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contracts: a violation is a bug in rondo. It prints the values given and aborts.
/// RONDO_DEMAND is always checked (O(1), at module borders); RONDO_ASSERT only without NDEBUG.
#pragma once
#include <fmt/format.h>

#include <string>

namespace rondo {

struct ContractSite {
  const char* condition;
  const char* file;
  int line;
};

[[noreturn]] void contract_failed(ContractSite site, const std::string& values);

template <class... Values>
std::string contract_values(const Values&... values) {
  std::string text;
  ((text += fmt::format(" {}", values)), ...);
  return text;
}

}  // namespace rondo

#define RONDO_DEMAND(condition, ...)                                   \
  do {                                                                 \
    if (!(condition)) [[unlikely]]                                     \
      ::rondo::contract_failed({#condition, __FILE__, __LINE__},       \
                               ::rondo::contract_values(__VA_ARGS__)); \
  } while (false)

#ifdef NDEBUG
#define RONDO_ASSERT(condition, ...) \
  do {                               \
  } while (false)
#else
#define RONDO_ASSERT(condition, ...) RONDO_DEMAND(condition, __VA_ARGS__)
#endif
