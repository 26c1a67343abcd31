// SPDX-License-Identifier: BSD-3-Clause
/// The numbers from which a wheel resumes.
#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/solid/solid_wheel.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index;

constexpr std::size_t own_numbers = 8;  ///< spin, first sector, forces at the end

void put(const Eigen::VectorXcd& from, std::vector<double>& to) {
  for (const std::complex<double>& x : from) to.insert(to.end(), {x.real(), x.imag()});
}
void put(Vec3 x, std::vector<double>& to) {
  to.insert(to.end(), {x.x, x.y, x.z});
}

/// Reads numbers one after the other.
class Numbers {
 public:
  explicit Numbers(std::span<const double> numbers) : left_(numbers) {}
  double next() {
    RONDO_DEMAND(!left_.empty());
    const double x = left_.front();
    left_ = left_.subspan(1);
    return x;
  }
  Vec3 vec() {
    const double x = next(), y = next();
    return {x, y, next()};
  }
  void fill(Eigen::VectorXcd& to) {
    for (std::complex<double>& x : to) {
      const double re = next();
      x = {re, next()};
    }
  }

 private:
  std::span<const double> left_;
};

}  // namespace

std::size_t SolidWheel::n_numbers(const SolidRing& ring, const WheelModel& model) noexcept {
  Index n = 0;
  for (const RingHarmonic& h : model.harmonics) n += 6 * h.squares.size();
  return own_numbers + at(n) + numbers_of_node * ring.contact.size() * at(ring.n_sectors());
}

/// Modes take any finite numbers; nodes have a count among theirs, which is checked.
bool SolidWheel::is_saved(const SolidRing& ring, const WheelModel& model,
                          std::span<const double> numbers) noexcept {
  if (numbers.size() != n_numbers(ring, model)) return false;
  const double first = numbers[1];
  if (!(first >= 0.0 && first < ring.n_sectors() && first == std::floor(first))) return false;
  const std::size_t nodes = numbers_of_node * ring.contact.size() * at(ring.n_sectors());
  for (std::span left = numbers.last(nodes); !left.empty(); left = left.subspan(numbers_of_node)) {
    const double known = left[numbers_of_node - 1];
    if (known != 0.0 && known != 1.0 && known != 2.0 && known != 3.0) return false;
  }
  return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

std::vector<double> SolidWheel::save() const {
  std::vector<double> out{spin_, static_cast<double>(first_)};
  out.reserve(n_numbers(ring_, model_));
  put(last_.force, out);
  put(last_.moment, out);
  for (const Modes& s : modes_) {
    put(s.state, out);
    put(s.force, out);
  }
  for (const Memory& m : memory_) {
    for (const Vec3 x : {m.force, m.filtered, m.residual, m.place[0], m.place[1], m.place[2]})
      put(x, out);
    out.insert(out.end(), {m.gap[0], m.gap[1], m.slip, static_cast<double>(m.known)});
  }
  return out;
}

void SolidWheel::restore(std::span<const double> numbers) {
  RONDO_DEMAND(is_saved(ring_, model_, numbers), numbers.size());
  Numbers from(numbers);
  const double spin = from.next();
  first_ = static_cast<int>(from.next());
  if (!has_matrices_ || spin_rate_ != 0.0 || spin_ != spin) {
    spin_ = spin;
    set_residual(spin_);
    has_matrices_ = false;
  }
  last_.force = from.vec();
  last_.moment = from.vec();
  for (Modes& s : modes_) {
    from.fill(s.state);
    from.fill(s.force);
  }
  seen_.clear();
  for (Memory& m : memory_) {
    m = {};
    for (Vec3* x : {&m.force, &m.filtered, &m.residual, &m.place[0], &m.place[1], &m.place[2]})
      *x = from.vec();
    for (double* x : {&m.gap[0], &m.gap[1], &m.slip}) *x = from.next();
    m.known = static_cast<int>(from.next());
    m.filtered_before = m.filtered;
    m.residual_before = m.residual;
  }
  // In the order of the window, as remember() has them.
  for (int d = 0; d < ring_.n_sectors(); ++d)
    for (int c = 0; c < n_contact_; ++c) {
      const int node = wrapped(first_ + d) * n_contact_ + c;
      if (memory_of(node).known > 0) seen_.push_back(node);
    }
  move_contact();
}

}  // namespace rondo::rom
