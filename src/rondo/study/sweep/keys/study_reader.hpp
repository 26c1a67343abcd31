// SPDX-License-Identifier: BSD-3-Clause
/// @file  Reads the values of a study file one by one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rondo/case/case_keys.hpp"
#include "rondo/case/case_source.hpp"
#include "rondo/case/case_values.hpp"

namespace rondo::study {

/// @throws InputError: it is not TOML
[[nodiscard]] CaseSource load_study(const std::filesystem::path& file);
[[nodiscard]] CaseSource load_study_text(const std::filesystem::path& file, std::string text);

/// Paths are those of study_keys(), with the numbers of tables in lists. Allowed values are those
/// of the key.
class StudyReader : public CaseValues {
 public:
  explicit StudyReader(CaseSource source);

  void fault(std::string_view path, std::string message);
  void fault(std::string_view path, std::string message, std::string allowed) {
    CaseValues::fault(path, std::move(message), std::move(allowed));
  }
  /// Reads a value; a text must not be empty.
  void read(const std::string& path, const CaseMember& field) {
    CaseValues::read(Allowed{}, true, path, field);
  }

  // The functions return null or nothing if the value is absent or, with a fault, of another type.
  const CaseValue* typed(const std::string& path, ValueType type);
  std::vector<std::string> texts(const std::string& path);
  std::optional<std::int64_t> integer(const std::string& path, const Range& range);
  /// Reads `n` finite numbers.
  const CaseValue* numbers(const std::string& path, std::size_t n);
};

}  // namespace rondo::study
