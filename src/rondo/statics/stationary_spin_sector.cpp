// SPDX-License-Identifier: BSD-3-Clause
/// Stationary spin of a body of equal sectors, harmonic by harmonic (docs/theory.md, 6.1).
#include <Eigen/CholmodSupport>

#include "rondo/core/process_wide.hpp"
#include "rondo/fem/harmonics.hpp"
#include "rondo/statics/stationary_spin.hpp"

namespace rondo::statics {
namespace {

using Eigen::Index;

/// Cholesky of A(k) - shift P, P = 1 but for 0 on axial components, one harmonic after another.
class HarmonicFactor {
 public:
  HarmonicFactor(fem::Harmonics& harmonics, double shift) : harmonics_(harmonics), shift_(shift) {
    solver_.setMode(Eigen::CholmodAuto);  // narrow bands by columns, others by dense blocks
    solver_.cholmod().final_ll = 1;       // not LDLᵀ, which would not see a negative pivot
    solver_.cholmod().print = 0;          // "not positive definite" is an answer, not a message
    solver_.analyzePattern(matrix(0));
  }

  const fem::Harmonics::Matrix& matrix(int harmonic) {
    return harmonics_.lower(harmonic, 1.0, -shift_, 0.0);
  }
  /// False where the matrix is not positive definite.
  bool compute(int harmonic) {
    solver_.factorize(matrix(harmonic));
    return solver_.info() == Eigen::Success;
  }
  /// Harmonics first … N/2.
  bool positive_from(int first) {
    for (int k = first; k < harmonics_.count(); ++k)
      if (!compute(k)) return false;
    return true;
  }
  /// Solves harmonic 0, which is real. @pre compute(0)
  Eigen::VectorXd solve(const Eigen::VectorXd& load) const {
    const Eigen::VectorXcd x = solver_.solve(Eigen::VectorXcd(load.cast<std::complex<double>>()));
    return x.real();
  }

 private:
  fem::Harmonics& harmonics_;
  double shift_;
  Eigen::CholmodDecomposition<fem::Harmonics::Matrix, Eigen::Lower> solver_;
};

/// pull M^½ P X of sector 0, whose polar frame is that of X.
template <int C>
Eigen::VectorXd scaled_load(const fem::SectorBlocks<C>& k, const Eigen::VectorXd& root_mass,
                            std::span<const Vec2> reference, double pull) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(root_mass.size());
  for (std::size_t a = 0; a < k.n_local(); ++a) {
    const Vec2 x = reference[k.node(a, 0)];
    load.segment<2>(static_cast<Index>(C * a)) = Eigen::Vector2d(x.x, x.y);
  }
  return pull * load.cwiseProduct(root_mass);
}

/// No displacement of n nodes.
template <int C>
StationarySpin nothing(std::size_t n) {
  StationarySpin none;
  none.u = Field(n, C);
  return none;
}

/// Copies the polar components of one sector into every sector.
template <int C>
void spread(const fem::SectorBlocks<C>& k, const Eigen::VectorXd& polar, StationarySpin& out) {
  for (std::size_t j = 0; j < k.turn.size(); ++j)
    for (std::size_t a = 0; a < k.n_local(); ++a) {
      const auto at = static_cast<Index>(C * a);
      const Vec2 plane = k.turn[j] * Vec2{polar[at], polar[at + 1]};
      if constexpr (C == 3)
        out.u.space()[k.node(a, j)] = {plane, polar[at + 2]};
      else
        out.u.plane()[k.node(a, j)] = plane;
    }
}

/// (K - softening M P) u = pull M P X by harmonic 0; `unstable` where that is not positive
/// definite.
template <int C>
StationarySpin solve(const fem::SectorBlocks<C>& k, HarmonicFactor& factor,
                     const Eigen::VectorXd& root_mass, std::span<const Vec2> reference,
                     double pull) {
  StationarySpin out = nothing<C>(reference.size());
  if (!factor.compute(0)) return out;
  // (A(0) - softening P) w = pull M^½ P X with w = M^½ u
  const Eigen::VectorXd load = scaled_load(k, root_mass, reference, pull);
  const Eigen::SparseMatrix<double> a = factor.matrix(0).real();
  const auto remainder = [&](const Eigen::VectorXd& w) -> Eigen::VectorXd {
    return load - a.selfadjointView<Eigen::Lower>() * w;
  };
  Eigen::VectorXd w = factor.solve(load);
  w += factor.solve(remainder(w));  // one refinement, as for the assembled stiffness
  out.status = SpinStatus::solved;
  const double scale = load.cwiseProduct(root_mass).norm();
  out.residual = scale > 0.0 ? remainder(w).cwiseProduct(root_mass).norm() / scale : 0.0;
  spread(k, w.cwiseQuotient(root_mass), out);
  return out;
}

template <int C>
StationarySpin find(const fem::SectorBlocks<C>& k, std::span<const double> mass,
                    std::span<const Vec2> reference, double spin, double rest_spin) {
  fem::Harmonics harmonics(k, mass);
  const OneBlasThread one_thread;
  HarmonicFactor factor(harmonics, spin * spin);
  const double pull = spin * spin - rest_spin * rest_spin;
  StationarySpin out = solve(k, factor, harmonics.root_mass(), reference, pull);
  if (out.status != SpinStatus::solved || factor.positive_from(1)) return out;
  return nothing<C>(reference.size());
}

template <int C>
bool all_above(const fem::SectorBlocks<C>& k, std::span<const double> mass, double shift) {
  fem::Harmonics harmonics(k, mass);
  const OneBlasThread one_thread;
  return HarmonicFactor(harmonics, shift).positive_from(0);
}

}  // namespace

StationarySpin stationary_spin(const fem::SectorStiffness& k, std::span<const double> mass,
                               std::span<const Vec2> reference, double spin) {
  return find(k, mass, reference, spin, 0.0);
}

StationarySpin stationary_spin(const fem::SolidSector& k, std::span<const double> mass,
                               std::span<const Vec2> reference, double spin, double rest_spin) {
  return find(k, mass, reference, spin, rest_spin);
}

StationarySpin centrifugal_prestress(const fem::SectorStiffness& k, std::span<const double> mass,
                                     std::span<const Vec2> reference, double spin) {
  fem::Harmonics harmonics(k, mass);
  const OneBlasThread one_thread;
  HarmonicFactor factor(harmonics, 0.0);
  return solve(k, factor, harmonics.root_mass(), reference, spin * spin);
}

bool eigenvalues_above(const fem::SectorStiffness& k, std::span<const double> mass, double shift) {
  return all_above(k, mass, shift);
}

bool eigenvalues_above(const fem::SolidSector& k, std::span<const double> mass, double shift) {
  return all_above(k, mass, shift);
}

}  // namespace rondo::statics
