// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/bytes.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

namespace rondo {

std::optional<std::size_t> bytes_in(const std::string& text) {
  double amount = 0.0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, amount);
  if (error != std::errc() || !(amount > 0.0)) return std::nullopt;
  std::string unit;
  for (const char c : std::string_view(rest, static_cast<std::size_t>(end - rest)))
    if (c != ' ') unit += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (!unit.empty() && unit.back() == 'b') unit.pop_back();
  const double kilo = unit.ends_with("i") ? 1024.0 : 1000.0;
  if (unit.ends_with("i")) unit.pop_back();
  constexpr std::string_view prefixes = "kmgt";
  const auto power = unit.size() == 1 ? prefixes.find(unit[0]) : std::string_view::npos;
  if (!unit.empty() && power == std::string_view::npos) return std::nullopt;
  if (!unit.empty()) amount *= std::pow(kilo, static_cast<double>(power + 1));
  constexpr double most = 1e18;  // an exabyte; larger numbers are not meant as bytes
  if (!(amount >= 1.0 && amount <= most)) return std::nullopt;
  return static_cast<std::size_t>(amount);
}

std::string readable_bytes(std::size_t bytes) {
  double amount = static_cast<double>(bytes);
  if (amount < 1e3) return fmt::format("{} B", bytes);
  const char* unit = "kB";
  amount /= 1e3;
  for (const char* larger : {"MB", "GB", "TB", "PB", "EB"}) {
    if (amount < 1e3) break;
    amount /= 1e3;
    unit = larger;
  }
  return fmt::format("{:.3g} {}", amount, unit);
}

}  // namespace rondo
