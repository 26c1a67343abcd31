// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/spatial_coupled.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "rondo/contact/coupled/cholesky.hpp"
#include "rondo/contact/coupled/spatial_squares.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/keep_larger.hpp"

namespace rondo::contact {
namespace {

/// Iterates that are combined.
constexpr std::size_t depth = 6;

double dot_of(std::span<const Vec3> a, std::span<const Vec3> b) noexcept {
  double sum = 0.0;
  for (std::size_t j = 0; j < a.size(); ++j) sum += dot(a[j], b[j]);
  return sum;
}

Vec3 velocity_at(const SpatialCoupled& p, std::size_t j, std::span<const Vec3> impulse) noexcept {
  Vec3 w = p.free[j];
  for (std::size_t l = 0; l < p.size(); ++l) w += apply(p.block(j, l), impulse[l]);
  return w;
}

constexpr int few_sweeps = 20, many_sweeps = 400;
/// Larger problems are left to sweeps: least squares cost the cube of the contacts.
constexpr std::size_t most_in_squares = 12;

/// Contacts that may press, a bit each.
using Subset = std::uint32_t;
constexpr Subset all_contacts = ~Subset{0};

/// One sweep of block Gauss–Seidel; the contacts that are not of the subset stay open.
void sweep(const SpatialCoupled& p, Subset subset, std::span<Vec3> impulse,
           std::span<Status> status) noexcept {
  for (std::size_t j = 0; j < p.size(); ++j) {
    if (subset != all_contacts && (subset >> j & 1U) == 0) {
      impulse[j] = {};
      status[j] = Status::open;
      continue;
    }
    const Vec3 alone = velocity_at(p, j, impulse) - apply(p.block(j, j), impulse[j]);
    const auto solution = solve_spatial({alone, p.block(j, j), p.bounce[j]}, p.friction[j]);
    impulse[j] = solution.impulse;
    status[j] = solution.status;
  }
}

double residual_of(const SpatialCoupled& p, std::span<const Vec3> impulse) noexcept {
  double worst = 0.0, scale = 0.0;
  for (std::size_t j = 0; j < p.size(); ++j) {
    const double mass = p.mass(j);
    worst = keep_larger(worst, law_residual(impulse[j], velocity_at(p, j, impulse), p.bounce[j],
                                            p.friction[j], mass));
    scale = std::max(scale, mass * norm(p.free[j]));
  }
  return scale > 0.0 ? worst / scale : worst;
}

/// Anderson's acceleration: the combination of the iterates whose changes cancel best.
class Mixer {
 public:
  Mixer(std::size_t contacts, SpatialWorkspace& work) : n_(contacts), work_(work) {
    work.of_change.resize(depth * n_);
    work.of_found.resize(depth * n_);
    work.change_before.resize(n_);
    work.found_before.resize(n_);
  }

  /// Sets work.from from what one sweep made of it.
  void next() noexcept {
    SpatialWorkspace& w = work_;
    const double size = dot_of(w.change, w.change);
    if (has_before_) {
      if (size > 2.25 * size_before_)
        kept_ = 0;
      else
        remember();
    }
    std::ranges::copy(w.change, w.change_before.begin());
    std::ranges::copy(w.found, w.found_before.begin());
    size_before_ = size;
    has_before_ = true;
    std::ranges::copy(w.found, w.from.begin());
    mix();
  }

 private:
  [[nodiscard]] std::span<Vec3> part(std::vector<Vec3>& of, std::size_t i) const noexcept {
    return std::span(of).subspan(i * n_, n_);
  }

  void remember() noexcept {
    const std::size_t place = next_++ % depth;
    kept_ = std::min(kept_ + 1, depth);
    for (std::size_t j = 0; j < n_; ++j) {
      part(work_.of_change, place)[j] = work_.change[j] - work_.change_before[j];
      part(work_.of_found, place)[j] = work_.found[j] - work_.found_before[j];
    }
  }

  /// The i-th newest difference.
  [[nodiscard]] std::size_t place(std::size_t i) const noexcept { return (next_ - 1 - i) % depth; }

  void mix() noexcept {
    if (kept_ == 0) return;
    std::array<double, depth * depth> gram{};
    std::array<double, depth> gamma{};
    for (std::size_t i = 0; i < kept_; ++i) {
      const auto one = part(work_.of_change, place(i));
      gamma[i] = dot_of(one, work_.change);
      for (std::size_t k = 0; k <= i; ++k)
        gram[i * kept_ + k] = dot_of(one, part(work_.of_change, place(k)));
      gram[i * kept_ + i] *= 1.0 + 1e-10;
    }
    constexpr double most = 20.0;  // larger factors are those of nearly equal differences
    double sum = 0.0;
    const bool solved =
        solve_cholesky(std::span(gram).first(kept_ * kept_), std::span(gamma).first(kept_));
    for (const double g : gamma) sum += std::abs(g);
    if (!solved || !(sum < most)) {
      kept_ = 0;
      return;
    }
    for (std::size_t i = 0; i < kept_; ++i)
      for (std::size_t j = 0; j < n_; ++j)
        work_.from[j] -= gamma[i] * part(work_.of_found, place(i))[j];
  }

  std::size_t n_, kept_ = 0, next_ = 0;
  bool has_before_ = false;
  double size_before_ = 0.0;
  SpatialWorkspace& work_;
};

/// Sweeps, least squares followed by a sweep, and the best of what they gave.
class Solution {
 public:
  Solution(const SpatialCoupled& problem, const CoupledLimits& limits, std::span<Vec3> impulse,
           std::span<Status> status, SpatialWorkspace& work)
      : p_(problem), limits_(limits), best_(impulse), status_(status), work_(work) {
    work.from.assign(impulse.begin(), impulse.end());
    work.found.resize(p_.size());
    work.change.resize(p_.size());
    work.status.assign(p_.size(), Status::open);
  }

  [[nodiscard]] const CoupledResult& result() const noexcept { return result_; }
  [[nodiscard]] bool finished() const noexcept {
    return result_.converged || result_.iterations >= limits_.most_iterations;
  }
  /// To round-off: where W is nearly singular, velocities are much less exact than the law.
  [[nodiscard]] bool exact() const noexcept {
    constexpr double share = 0.01;
    return (result_.iterations > 0 && result_.residual <= share * limits_.tolerance) ||
           result_.iterations >= limits_.most_iterations;
  }

  void sweeps(int most, Subset subset = all_contacts) {
    subset_ = subset;
    Mixer mixer(p_.size(), work_);
    for (int i = 0; i < most && !exact(); ++i) {
      make_sweep();
      for (std::size_t j = 0; j < p_.size(); ++j) work_.change[j] = work_.found[j] - work_.from[j];
      mixer.next();
    }
  }

  /// Least squares from the best so far.
  void squares() {
    std::ranges::copy(best_, work_.from.begin());
    improve(1.0);
  }

  /// Sweeps of some contacts, for every choice of them, fewest first: contacts that hold the same
  /// are then not all there, and those that are there are not slow.
  void subsets() {
    constexpr std::size_t most_contacts = 8;
    const std::size_t n = p_.size();
    if (n > most_contacts) return;
    for (int count = 1; count < static_cast<int>(n); ++count)
      for (Subset subset = 1; subset < (Subset{1} << n) && !finished(); ++subset) {
        if (std::popcount(subset) != count) continue;
        std::ranges::fill(work_.from, Vec3{});
        sweeps(few_sweeps, subset);
      }
    subset_ = all_contacts;
    squares();
  }

  /// Least squares without friction, then with more and more of it, each from the solution before.
  /// @param pressed normal impulses at the beginning, over m |free|
  void squares_by_friction(double pressed) {
    constexpr int parts = 16;
    for (std::size_t j = 0; j < p_.size(); ++j)
      work_.from[j] = {pressed * p_.mass(j) * norm(p_.free[j]), 0.0, 0.0};
    for (int i = 0; i <= parts && !finished(); ++i) improve(static_cast<double>(i) / parts);
  }

  /// Least squares from a random place in the cones, another one in each call.
  void squares_from_anywhere() {
    for (std::size_t j = 0; j < p_.size(); ++j) {
      const double most = 2.0 * p_.mass(j) * norm(p_.free[j]), n = most * fraction();
      const double y = 2.0 * fraction() - 1.0, z = 2.0 * fraction() - 1.0;
      work_.from[j] = {n, most * p_.friction[j] * y, most * p_.friction[j] * z};
    }
    improve(1.0);
  }

 private:
  /// In [0, 1), by a linear congruential generator: the same in every run (Knuth, MMIX).
  [[nodiscard]] double fraction() noexcept {
    seed_ = seed_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(seed_ >> 11U) * 0x1p-53;
  }

  /// @param share of friction
  void improve(double share) {
    result_.iterations += least_squares(p_, share, work_.from, work_);
    if (share == 1.0) make_sweep();
  }

  /// Makes one sweep from work.from into work.found, and keeps what it found if it is the best.
  void make_sweep() {
    std::ranges::copy(work_.from, work_.found.begin());
    sweep(p_, subset_, work_.found, work_.status);
    const double residual = residual_of(p_, work_.found);
    ++result_.iterations;
    if (result_.iterations > 1 && !(residual < result_.residual)) return;
    result_.residual = residual;
    result_.converged = residual <= limits_.tolerance;
    std::ranges::copy(work_.found, best_.begin());
    std::ranges::copy(work_.status, status_.begin());
  }

  const SpatialCoupled& p_;
  const CoupledLimits& limits_;
  std::span<Vec3> best_;
  std::span<Status> status_;
  SpatialWorkspace& work_;
  CoupledResult result_;
  Subset subset_ = all_contacts;
  std::uint64_t seed_ = 1;
};

}  // namespace

CoupledResult solve_coupled(const SpatialCoupled& p, const CoupledLimits& limits,
                            std::span<Vec3> impulse, std::span<Status> status,
                            SpatialWorkspace& work) {
  const std::size_t n = p.size();
  RONDO_DEMAND(p.blocks.size() == n * n && impulse.size() == n && status.size() == n,
               p.blocks.size(), impulse.size(), status.size(), n);
  Solution solution(p, limits, impulse, status, work);
  if (n > most_in_squares) {
    solution.sweeps(many_sweeps);
    return solution.result();
  }
  solution.sweeps(few_sweeps);
  if (!solution.exact()) solution.squares();
  if (!solution.finished()) solution.subsets();
  for (const double pressed : {0.0, 1.0})
    if (!solution.finished()) solution.squares_by_friction(pressed);
  while (!solution.finished()) solution.squares_from_anywhere();
  if (!solution.exact()) solution.squares();
  return solution.result();
}

}  // namespace rondo::contact
