// SPDX-License-Identifier: BSD-3-Clause
/// @file  A hash of bytes: XXH3, 128 bits. It detects damage, not deliberate changes.
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <string>

struct XXH3_state_s;  // defined by the library

namespace rondo::io {

class Hash {
 public:
  Hash();
  void add(std::span<const std::byte> bytes);
  /// @pre no padding in T
  template <class T, std::size_t N>
  void add(std::span<T, N> values) {
    add(std::span<const std::byte>(std::as_bytes(values)));
  }
  /// Hash of all data added: 32 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  struct Free {
    void operator()(XXH3_state_s* state) const noexcept;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;
};

}  // namespace rondo::io
