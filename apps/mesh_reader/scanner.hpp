// SPDX-License-Identifier: BSD-3-Clause
/// @file  Numbers of a Gmsh file, text or binary, section by section; what does not fit is refused
/// with its line.
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

  /// Goes to the next "$Name"; false: there is none.
  bool next_section();
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Behind its "$EndName", whatever stands before it.
  void skip_section();
  /// To the line after the one in hand.
  void end_line();
  /// "$EndName" must follow.
  void end_section();

  /// The section in hand says that it has `n` things, and next_thing() counts them: for errors.
  void announce(std::uint64_t n, const char* what, std::uint64_t found = 0) {
    said_ = n, what_ = what, found_ = found;
  }
  void next_thing() { ++found_; }

  /// A word of a text.
  std::string_view word();
  /// The rest of the line in hand.
  std::string_view rest_of_line();
  /// A number as the file has its numbers.
  template <class Number>
  Number get() {
    return binary_ ? raw<Number>() : parsed<Number>();
  }
  /// A number in words, also in a binary file.
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
  /// In a text, what is read from here to end_record() must be one line.
  void begin_record() {
    if (!binary_) skip_space(), record_ = at_;
  }
  void end_record(const char* what) {
    if (!binary_) demand_one_line(what);
  }
  void skip_doubles(std::uint64_t n) {
    for (; n > 0; --n) get<double>();
  }

  /// Throws std::string, with the line.
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

/// "in quotation marks", cut where it is long.
std::string quoted(std::string_view text);

}  // namespace rondo::reader
