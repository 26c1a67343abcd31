// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>

#include "rondo/core/contract.hpp"

namespace rondo::fem {
namespace {

using Index = Eigen::Index;

/// A scalar of a sector's row, scaled by the masses.
struct Term {
  int row, column, shift;
  double value;
};

/// Of the lower triangle, column after column.
std::vector<Term> lower_terms(const SectorStiffness& k, const Eigen::VectorXd& root_mass) {
  std::vector<Term> terms;
  for (std::size_t a = 0; a < k.n_local(); ++a)
    for (const SectorStiffness::Entry& e : k.row(a))
      for (int c = 0; c < 4; ++c) {
        const int row = 2 * static_cast<int>(a) + c % 2, column = 2 * e.column + c / 2;
        if (row < column) continue;
        const double value = e.block[static_cast<std::size_t>(c)];
        terms.push_back({row, column, e.shift, value / (root_mass[row] * root_mass[column])});
      }
  std::sort(terms.begin(), terms.end(), [](const Term& a, const Term& b) {
    return std::tie(a.column, a.row, a.shift) < std::tie(b.column, b.row, b.shift);
  });
  return terms;
}

}  // namespace

Harmonics::Harmonics(const SectorStiffness& k, std::span<const double> mass)
    : n_sectors_(k.n_sectors), root_mass_(static_cast<Index>(2 * k.n_local())) {
  for (std::size_t a = 0; a < k.n_local(); ++a)
    root_mass_.segment<2>(static_cast<Index>(2 * a)).setConstant(std::sqrt(mass[k.node(a, 0)]));
  const std::vector<Term> terms = lower_terms(k, root_mass_);
  std::vector<Eigen::Triplet<std::complex<double>>> places;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Term& t = terms[i];
    if (i == 0 || t.row != terms[i - 1].row || t.column != terms[i - 1].column) {
      places.emplace_back(t.row, t.column);
      entries_.push_back({});
    }
    Entry& entry = entries_.back();
    (t.shift == 0 ? entry.constant : entry.even) += t.value;
    entry.odd += t.shift * t.value;
  }
  matrix_.resize(root_mass_.size(), root_mass_.size());
  matrix_.setFromTriplets(places.begin(), places.end());
}

const Harmonics::Matrix& Harmonics::lower(int harmonic, double factor, double shift) {
  RONDO_DEMAND(harmonic >= 0 && harmonic < count(), harmonic, n_sectors_);
  const double kappa = 2.0 * std::numbers::pi * harmonic / n_sectors_;
  const double even = factor * std::cos(kappa), odd = factor * std::sin(kappa);
  std::complex<double>* value = matrix_.valuePtr();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Entry& e = entries_[i];
    value[i] = {factor * e.constant + even * e.even, odd * e.odd};
  }
  for (Index j = 0; j < matrix_.cols(); ++j) value[matrix_.outerIndexPtr()[j]] += shift;
  return matrix_;
}

}  // namespace rondo::fem
