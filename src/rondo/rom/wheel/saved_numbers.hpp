// SPDX-License-Identifier: BSD-3-Clause
/// @file  The numbers from which a reduced wheel resumes, read and written one after the other.
#pragma once
#include <complex>
#include <span>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/core/vec3.hpp"

namespace rondo::rom {

template <class Amplitudes>
void put(const Amplitudes& from, std::vector<double>& to) {
  for (const std::complex<double>& x : from) to.insert(to.end(), {x.real(), x.imag()});
}

inline void put(Vec3 x, std::vector<double>& to) {
  to.insert(to.end(), {x.x, x.y, x.z});
}

class SavedNumbers {
 public:
  explicit SavedNumbers(std::span<const double> numbers) : left_(numbers) {}

  double next() { return take(1).front(); }
  Vec2 vec2() {
    const double x = next();
    return {x, next()};
  }
  Vec3 vec3() {
    const Vec2 plane = vec2();
    return {plane, next()};
  }
  template <class Amplitudes>
  void fill(Amplitudes&& to) {
    for (std::complex<double>& x : to) {
      const Vec2 parts = vec2();
      x = {parts.x, parts.y};
    }
  }
  std::span<const double> take(std::size_t count) {
    RONDO_DEMAND(count <= left_.size(), count, left_.size());
    const std::span<const double> taken = left_.first(count);
    left_ = left_.subspan(count);
    return taken;
  }

 private:
  std::span<const double> left_;
};

}  // namespace rondo::rom
