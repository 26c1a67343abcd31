// SPDX-License-Identifier: BSD-3-Clause
/// Largest eigenvalue over all harmonics of a body of equal sectors (docs/theory.md, 3.8). All
/// eigenvalues of harmonic k are below σ if and only if σI - A(k) is positive definite, which its
/// Cholesky factorisation shows.
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "rondo/fem/harmonics.hpp"
#include "rondo/model/stability/critical_step.hpp"
#include "rondo/model/stability/lanczos.hpp"

namespace rondo::dynamics {
namespace {

using Eigen::Index;
using Matrix = fem::Harmonics::Matrix;

/// Relative width of the interval that encloses the largest eigenvalue: three factorisations for
/// each digit, of the few harmonics that raise it.
constexpr double enclosure_width = 1e-6;
/// Limit for all factorisations, some seconds; above it Lanczos is used, several times as fast.
constexpr double most_operations = 1e10;

/// All harmonics in an order from the last on, in which successive ones are far apart: the first
/// few nearly reach the largest eigenvalue, and few of the following raise it.
std::vector<int> scattered(int count) {
  int stride = std::max(1, static_cast<int>(std::lround(0.618 * count)));
  while (std::gcd(stride, count) != 1) ++stride;
  std::vector<int> order;
  for (long long i = 0; i < count; ++i)
    order.push_back(count - 1 - static_cast<int>(i * stride % count));
  return order;
}

/// Upper bound of all eigenvalues of the harmonics that were included.
class Enclosure {
 public:
  /// @param limit a bound known in advance.
  Enclosure(fem::Harmonics& harmonics, double limit) : harmonics_(harmonics), limit_(limit) {
    cholesky_.compute(harmonics.lower(0, 0.0, 1.0));  // the identity, in the common pattern
    rounding_ = cholesky_rounding(longest(cholesky_.matrixL().nestedExpression()));
  }

  void include(int harmonic) {
    if (upper_ > 0.0 && all_below(harmonic, upper_)) return;
    // A diagonal entry is a Rayleigh quotient, hence a lower bound.
    const double first = lower_ = std::max(upper_, largest_diagonal(harmonic));
    upper_ = limit_;
    for (double reach = enclosure_width; reach < 1.0; reach *= 4.0) {
      const double trial = first * (1.0 + reach);
      if (trial >= limit_) break;
      if (all_below(harmonic, trial)) {
        upper_ = trial;
        break;
      }
      lower_ = trial;
    }
    while (upper_ - lower_ > enclosure_width * upper_) {
      const double middle = 0.5 * (lower_ + upper_);
      (all_below(harmonic, middle) ? upper_ : lower_) = middle;
    }
  }

  /// The bound, including what rounding may have hidden from the factorisations.
  [[nodiscard]] double upper() const noexcept { return upper_ * (1.0 + rounding_); }
  [[nodiscard]] double width() const noexcept { return (upper_ - lower_) / upper_; }

 private:
  /// Largest number of entries in a row or column. Unknowns are ordered as in the factorisation.
  static Index longest(const Matrix& factor) {
    std::vector<Index> row(static_cast<std::size_t>(factor.rows()));
    Index most = 0;
    for (Index j = 0; j < factor.outerSize(); ++j) {
      Index column = 0;
      for (Matrix::InnerIterator at(factor, j); at; ++at, ++column)
        most = std::max(most, ++row[static_cast<std::size_t>(at.row())]);
      most = std::max(most, column);
    }
    return most;
  }
  double largest_diagonal(int harmonic) const {
    return harmonics_.lower(harmonic, 1.0, 0.0).diagonal().real().maxCoeff();
  }
  bool all_below(int harmonic, double sigma) {
    cholesky_.factorize(harmonics_.lower(harmonic, -1.0, sigma));
    return cholesky_.info() == Eigen::Success;
  }

  fem::Harmonics& harmonics_;
  double limit_;
  double upper_ = 0.0, lower_ = 0.0;
  double rounding_ = 0.0;
  Eigen::SimplicialLLT<Matrix, Eigen::Lower> cholesky_;
};

/// Approximate floating-point operations of the enclosure, as for factorisations of bands.
/// @param included harmonics
double operations(fem::Harmonics& harmonics, int included) {
  const Matrix& a = harmonics.lower(0, 0.0, 1.0);
  Index band = 1;
  for (Index j = 0; j < a.cols(); ++j)
    band = std::max(band, Index{a.innerIndexPtr()[a.outerIndexPtr()[j + 1] - 1]} - j);
  const double count = included, b = static_cast<double>(band);
  const double factorisations = count + 20.0 * std::log2(count);
  return factorisations * 4.0 * static_cast<double>(a.rows()) * b * b;
}

/// Largest Ritz pair of one harmonic, by the real form of the matrix, which has eigenvalues twice.
std::optional<RitzPair> largest_of(fem::Harmonics& harmonics, int harmonic) {
  using Vector = Eigen::VectorXcd;
  const Matrix& a = harmonics.lower(harmonic, 1.0, 0.0);
  const auto product = [&](const double* x, double* y) {
    const auto* from = reinterpret_cast<const std::complex<double>*>(x);
    Eigen::Map<Vector>(reinterpret_cast<std::complex<double>*>(y), a.rows()).noalias() =
        a.selfadjointView<Eigen::Lower>() * Eigen::Map<const Vector>(from, a.rows());
  };
  return largest_ritz_pair({2 * a.rows(), product});
}

/// Largest sum of Ritz value and residual over all harmonics.
std::optional<RitzPair> largest_of_all(fem::Harmonics& harmonics) {
  RitzPair largest;
  for (int k = 0; k < harmonics.count(); ++k) {
    const auto pair = largest_of(harmonics, k);
    if (!pair) return std::nullopt;
    if (pair->value + pair->residual > largest.value + largest.residual) largest = *pair;
  }
  return largest;
}

/// Whether the bound is positive and finite and the entries are finite.
bool in_range(fem::Harmonics& harmonics, double element_eigenvalue_bound) {
  return element_eigenvalue_bound > 0.0 && std::isfinite(element_eigenvalue_bound) &&
         std::isfinite(harmonics.lower(0, 1.0, 0.0).norm());
}

}  // namespace

double cholesky_rounding(std::ptrdiff_t m) noexcept {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  return std::max(1e-8, std::sqrt(2.0) * epsilon * std::pow(static_cast<double>(m), 2.5));
}

template <int C>
CriticalStep critical_step(const fem::SectorBlocks<C>& k, std::span<const double> mass,
                           LaggedDamping damping, double element_eigenvalue_bound) {
  CriticalStep out;
  out.element_bound = std::sqrt(element_eigenvalue_bound);
  out.omega = out.element_bound;
  out.step = critical_step_of(out.omega, damping);
  fem::Harmonics harmonics(k, mass);
  if (!in_range(harmonics, element_eigenvalue_bound)) return out;
  if (operations(harmonics, harmonics.count()) <= most_operations) {
    Enclosure largest(harmonics, element_eigenvalue_bound);
    for (const int harmonic : scattered(harmonics.count())) largest.include(harmonic);
    out.omega = std::min(out.element_bound, std::sqrt(largest.upper()));
    out.uncertainty = largest.width();
    out.converged = out.proven = true;
  } else if (const auto pair = largest_of_all(harmonics)) {
    out.omega = std::min(out.element_bound, std::sqrt(pair->value + pair->residual));
    out.uncertainty = pair->residual / pair->value;
    out.converged = true;
  }
  out.step = critical_step_of(out.omega, damping);
  return out;
}

template <int C>
double harmonic_eigenvalue_bound(const fem::SectorBlocks<C>& k, std::span<const double> mass,
                                 int harmonic, double element_eigenvalue_bound) {
  fem::Harmonics harmonics(k, mass);
  if (!in_range(harmonics, element_eigenvalue_bound)) return element_eigenvalue_bound;
  if (operations(harmonics, 1) <= most_operations) {
    Enclosure largest(harmonics, element_eigenvalue_bound);
    largest.include(harmonic);
    return std::min(element_eigenvalue_bound, largest.upper());
  }
  const auto pair = largest_of(harmonics, harmonic);
  return pair ? std::min(element_eigenvalue_bound, pair->value + pair->residual)
              : element_eigenvalue_bound;
}

template CriticalStep critical_step(const fem::SectorBlocks<2>&, std::span<const double>,
                                    LaggedDamping, double);
template CriticalStep critical_step(const fem::SectorBlocks<3>&, std::span<const double>,
                                    LaggedDamping, double);
template double harmonic_eigenvalue_bound(const fem::SectorBlocks<2>&, std::span<const double>, int,
                                          double);
template double harmonic_eigenvalue_bound(const fem::SectorBlocks<3>&, std::span<const double>, int,
                                          double);

}  // namespace rondo::dynamics
