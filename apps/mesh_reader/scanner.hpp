// SPDX-License-Identifier: BSD-3-Clause
/// @file  Reads numbers of a Gmsh file, text or binary, section by section; invalid contents are
/// refused with their line.
#pragma once
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace rondo::reader {

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  void set_binary(bool swapped) { binary_ = true, swapped_ = swapped; }
  [[nodiscard]] bool is_binary() const { return binary_; }

  /// Goes to the next "$Name"; returns false if there is none.
  bool next_section();
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Skips everything up to and including its "$EndName".
  void skip_section();
  /// Goes to the line after the current one.
  void end_line();
  /// Requires "$EndName" next.
  void end_section();

  /// For errors: the section announces `n` items, which next_thing() counts.
  void announce(std::uint64_t n, const char* what, std::uint64_t found = 0) {
    said_ = n, what_ = what, found_ = found;
  }
  void next_thing() { ++found_; }

  /// A word of a text file.
  std::string_view word();
  /// The rest of the current line.
  std::string_view rest_of_line();
  /// A number in the format of the file.
  template <class Number>
  Number get() {
    return binary_ ? raw<Number>() : parsed<Number>();
  }
  /// A number written as text, also in a binary file.
  template <class Number>
  Number parsed() {
    const std::string_view all = word();
    const std::string_view digits = all.starts_with('+') ? all.substr(1) : all;
    Number number{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error == std::errc::result_out_of_range && std::is_floating_point_v<Number>) return number;
    if (error != std::errc{} || end != digits.data() + digits.size()) fail_at_number(all);
    return number;
  }
  /// In a text file, everything read from here to end_record() must be on one line.
  void begin_record() {
    if (!binary_) skip_space(), record_ = at_;
  }
  void end_record(const char* what) {
    if (!binary_) demand_one_line(what);
  }
  void skip_doubles(std::uint64_t n) {
    for (; n > 0; --n) get<double>();
  }

  /// Throws std::string with the line number.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  template <class Number>
  Number raw() {
    if (text_.size() - at_ < sizeof(Number)) fail_cut();
    std::array<char, sizeof(Number)> bytes{};
    std::memcpy(bytes.data(), text_.data() + at_, bytes.size());
    at_ += bytes.size();
    if (swapped_) std::reverse(bytes.begin(), bytes.end());
    Number number{};
    std::memcpy(&number, bytes.data(), bytes.size());
    return number;
  }
  void skip_space();
  void demand_one_line(const char* what);
  [[noreturn]] void fail_cut() const;
  [[noreturn]] void fail_at_number(std::string_view found) const;

  std::string_view text_;
  std::size_t at_ = 0, record_ = 0;
  bool binary_ = false, swapped_ = false;
  std::string name_;
  std::uint64_t said_ = 0, found_ = 0;
  const char* what_ = nullptr;
};

/// "in quotation marks", shortened if it is long.
std::string quoted(std::string_view text);

}  // namespace rondo::reader
