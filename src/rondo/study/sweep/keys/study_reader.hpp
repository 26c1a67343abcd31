// SPDX-License-Identifier: BSD-3-Clause
/// @file  Reads the values of a study file one by one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rondo/case/case_keys.hpp"
#include "rondo/case/case_source.hpp"

namespace rondo::study {

/// @throws InputError: it is no TOML
[[nodiscard]] CaseSource load_study(const std::filesystem::path& file);
[[nodiscard]] CaseSource load_study_text(const std::filesystem::path& file, std::string text);

/// Gathers all faults. Paths are those of study_keys(), with the numbers of tables in lists.
class StudyReader {
 public:
  /// Keys that no study has are faults.
  explicit StudyReader(CaseSource source);

  /// Null: it is not there.
  [[nodiscard]] const CaseValue* find(const std::string& path) const;
  [[nodiscard]] bool has_table(const std::string& path) const;
  /// Number of tables [[vary]].
  [[nodiscard]] std::size_t n_vary() const;
  [[nodiscard]] int line_of(const std::string& path) const;

  /// What is allowed is that of the key.
  void fault(const std::string& path, std::string message);
  void fault(const std::string& path, std::string message, std::string allowed);

  // Null or none where it is not there, and with a fault where it is something else.
  const CaseValue* typed(const std::string& path, ValueType type);
  std::string text(const std::string& path);
  std::vector<std::string> texts(const std::string& path);
  std::optional<double> number(const std::string& path);
  std::optional<std::int64_t> integer(const std::string& path, const Range& range);
  /// `n` finite numbers.
  const CaseValue* numbers(const std::string& path, std::size_t n);

  /// @throws InputError: there were faults
  void finish();

 private:
  CaseSource source_;
  std::vector<Fault> faults_;
};

}  // namespace rondo::study
