// SPDX-License-Identifier: BSD-3-Clause
/// Modes of a body of equal sectors, harmonic by harmonic (docs/theory.md, 8.2 to 8.5).
#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/core/contract.hpp"
#include "rondo/modal/free_disk.hpp"
#include "rondo/modal/harmonic_problem.hpp"
#include "rondo/modal/shapes.hpp"

namespace rondo::modal {
namespace {

/// A root with its harmonic, before its shape is made.
struct Candidate {
  HarmonicRoot root;
  int harmonic;
  bool partner;
  int modes;  ///< number of modes of this root: 2 at rest, if 0 < n < N/2

  [[nodiscard]] double omega() const noexcept { return std::abs(root.omega); }
};

/// The lowest roots so far.
class Lowest {
 public:
  explicit Lowest(int count) : count_(count) {}

  void add(Candidate c) {
    const auto place = std::upper_bound(
        found_.begin(), found_.end(), c,
        [](const Candidate& a, const Candidate& b) { return a.omega() < b.omega(); });
    found_.insert(place, std::move(c));
    int modes = 0;
    for (std::size_t i = 0; i < found_.size(); ++i) {
      modes += found_[i].modes;
      if (modes >= count_)
        return found_.erase(found_.begin() + static_cast<long>(i) + 1, found_.end()), full_ = true,
                                                                                      void();
    }
  }
  /// Roots above this are not needed.
  [[nodiscard]] double bound() const noexcept {
    return full_ ? found_.back().omega() : std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] const std::vector<Candidate>& found() const noexcept { return found_; }

 private:
  std::vector<Candidate> found_;
  int count_;
  bool full_ = false;
};

/// Number of negative eigenvalues of all K'(n); harmonic 0 of a free disk is left out (8.5).
template <int D>
int count_unstable(HarmonicProblem<D>& problem, bool free) {
  int unstable = 0;
  for (int n = free ? 1 : 0; n < problem.n_harmonics(); ++n) {
    problem.choose(n);
    unstable += problem.unstable() * (problem.has_partner() ? 2 : 1);
  }
  return unstable;
}

/// Adds the roots of harmonic n below the bound. False if fewer are found than were counted.
template <int D>
bool add_harmonic(HarmonicProblem<D>& problem, int n, double spin, int count, Lowest& lowest) {
  problem.choose(n);
  const double bound = lowest.bound();
  const double sigma = std::isfinite(bound) ? bound : problem.sigma_with(count);
  const RootCounts counts = problem.count_below(sigma);
  if (counts.positive + counts.negative == 0) return true;
  const std::vector<HarmonicRoot> roots = problem.roots_below(sigma, counts);
  const bool partner = problem.has_partner();
  for (const HarmonicRoot& root : roots)
    if (partner || root.omega > 0.0)  // else the root at -ω is the same motion
      lowest.add({root, n, partner, spin == 0.0 && partner ? 2 : 1});
  return static_cast<int>(roots.size()) == counts.positive + counts.negative;
}

/// Adds rigid-body motions. Translations of a spinning free disk have constant velocity in the
/// fixed frame: a double root with the single vector w (8.5).
void add_rigid(const CyclicBody<2>& body, HarmonicProblem<2>& problem, double spin,
               std::vector<Mode>& modes) {
  for (const int n : {0, 1}) {
    problem.choose(n);
    if (n == 0 && spin != 0.0) continue;  // they are among the vibrations of harmonic 0
    const HarmonicRoot root{spin, problem.rigid()};
    std::vector<Mode> rigid = modes_of(body, spin, n, problem.has_partner(), root);
    if (n == 1 && spin != 0.0) rigid.push_back(rigid.front());
    modes.insert(modes.end(), rigid.begin(), rigid.end());
  }
  for (Mode& mode : modes) mode.wave = Wave::rigid;
}

void add_rotational(const CyclicBody<2>& body, HarmonicProblem<2>& problem, double spin, Modes& out,
                    Lowest& lowest) {
  RONDO_DEMAND(static_cast<std::size_t>(problem.size()) <= most_dofs_of_free_sector,
               problem.size());
  RotationalRoots roots = rotational_roots(problem.dense_rotational(), spin);
  std::vector<Mode> rotation = modes_of(body, spin, 0, false, roots.rotation);
  rotation.front().wave = Wave::rigid;
  rotation.front().growth = roots.growth;
  out.modes.insert(out.modes.begin(), rotation.front());
  for (HarmonicRoot& root : roots.vibrations) lowest.add({std::move(root), 0, false, 1});
}

}  // namespace

template <int D>
Modes cyclic_modes(const CyclicBody<D>& body, double spin, int count) {
  HarmonicProblem<D> problem(body, spin);
  RONDO_DEMAND(problem.finite(), spin);
  const bool free = body.free();
  RONDO_DEMAND(D == 2 || !free, body.stiffness.n_local());
  Modes out;
  if (spin != 0.0) out.unstable = count_unstable(problem, free);
  if (out.unstable > 0) return out;
  if constexpr (D == 2)
    if (free) add_rigid(body, problem, spin, out.modes);
  Lowest lowest(count);
  out.counted = true;
  for (int n = 0; n < problem.n_harmonics(); ++n) {
    if constexpr (D == 2) {
      if (free && n == 0 && spin != 0.0) {
        add_rotational(body, problem, spin, out, lowest);
        continue;
      }
    }
    if (!add_harmonic(problem, n, spin, count, lowest)) out.counted = false;
  }
  for (const Candidate& c : lowest.found()) {
    std::vector<Mode> modes = modes_of(body, spin, c.harmonic, c.partner, c.root);
    for (Mode& mode : modes) out.modes.push_back(std::move(mode));
  }
  out.dimension = problem.dimension();
  return out;
}

template Modes cyclic_modes(const CyclicBody<2>&, double, int);
template Modes cyclic_modes(const CyclicBody<3>&, double, int);

}  // namespace rondo::modal
