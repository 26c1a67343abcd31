// SPDX-License-Identifier: BSD-3-Clause
/// @file  Upper limits of the machine: bandwidth of arrays that a step passes over, and rate of
/// multiply-adds in registers. They are measured together with the steps, because the machine may
/// be shared and its clock rate is unknown.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace rondo::bench {

/// Arrays of doubles that one pass reads, once each.
struct Streams {
  std::size_t length = 0;     ///< of each array that is read and written in place
  int in_place = 2;           ///< number of these, 2 or 3
  std::size_t read_only = 0;  ///< total length of arrays that are only read

  /// Bytes moved by one pass: each number is read once, and written once if in place.
  [[nodiscard]] double bytes() const noexcept {
    return 8.0 * (2.0 * in_place * static_cast<double>(length) + static_cast<double>(read_only));
  }
  bool operator==(const Streams&) const = default;
};

/// The arrays; each thread is the first to touch its part.
class StreamArrays {
 public:
  StreamArrays(const Streams& streams, int threads);

  /// Best of several passes, measured for about `seconds` and at least three times [bytes/s].
  [[nodiscard]] double bandwidth(double seconds);
  [[nodiscard]] const Streams& streams() const noexcept { return streams_; }
  [[nodiscard]] int threads() const noexcept { return threads_; }

 private:
  /// The part of one thread.
  struct Part {
    std::vector<double> u, v, w, read;
  };
  /// Runs all threads `passes` times over their parts. @return seconds
  double run(long passes);

  Streams streams_;
  int threads_;
  std::vector<Part> parts_;
  double sink_ = 0.0;  ///< keeps the sums of read-only arrays
};

/// Multiply-adds in registers on all threads at once, best of several [flop/s]. One multiply-add is
/// two flops; processors without such an instruction execute the two one after the other.
[[nodiscard]] double peak_flops(int threads);

/// Instruction set of peak_flops(): "avx512", "avx2" or "baseline".
[[nodiscard]] std::string peak_level();

}  // namespace rondo::bench
