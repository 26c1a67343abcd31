// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the machine can do at the most: bandwidth of arrays that a step passes over, and the
/// rate of multiply-adds in registers. Measured here, beside the steps, because the machine may be
/// shared and its clock unknown.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace rondo::bench {

/// Arrays of doubles that one pass goes over, once each.
struct Streams {
  std::size_t length = 0;     ///< of each array that is read and written in place
  int in_place = 2;           ///< number of these, 2 or 3
  std::size_t read_only = 0;  ///< length of what is only read, in all

  /// Moved by one pass: read once, and written once where in place.
  [[nodiscard]] double bytes() const noexcept {
    return 8.0 * (2.0 * in_place * static_cast<double>(length) + static_cast<double>(read_only));
  }
  bool operator==(const Streams&) const = default;
};

/// The arrays, each thread's part first touched by that thread.
class StreamArrays {
 public:
  StreamArrays(const Streams& streams, int threads);

  /// Best of several passes, measured for about `seconds` and at least three times [bytes/s].
  [[nodiscard]] double bandwidth(double seconds);
  [[nodiscard]] const Streams& streams() const noexcept { return streams_; }
  [[nodiscard]] int threads() const noexcept { return threads_; }

 private:
  /// What one thread has.
  struct Part {
    std::vector<double> u, v, w, read;
  };
  /// All threads, `passes` times over their parts. @return seconds
  double run(long passes);

  Streams streams_;
  int threads_;
  std::vector<Part> parts_;
  double sink_ = 0.0;  ///< keeps the sums of what is only read
};

/// Multiply-adds in registers on all threads at once, best of several [flop/s]. One multiply-add is
/// two flops; processors without such an instruction do the two one after the other.
[[nodiscard]] double peak_flops(int threads);

/// Instructions that peak_flops takes: "avx512", "avx2" or "baseline".
[[nodiscard]] std::string peak_level();

}  // namespace rondo::bench
