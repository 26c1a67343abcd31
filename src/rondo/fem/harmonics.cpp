// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::fem {
namespace {

using Index = Eigen::Index;

/// A scalar entry in a sector's row, scaled by the masses.
struct Term {
  int row, column, shift;
  double value;
};

/// Entries of the lower triangle, column by column.
template <int C>
std::vector<Term> lower_terms(const SectorBlocks<C>& k, const Eigen::VectorXd& root_mass) {
  std::vector<Term> terms;
  for (std::size_t a = 0; a < k.n_local(); ++a)
    for (const auto& e : k.row(a))
      for (int c = 0; c < C * C; ++c) {
        const int row = C * static_cast<int>(a) + c % C, column = C * e.column + c / C;
        if (row < column) continue;
        const double value = e.block[at(c)];
        terms.push_back({row, column, e.shift, value / (root_mass[row] * root_mass[column])});
      }
  std::sort(terms.begin(), terms.end(), [](const Term& a, const Term& b) {
    return std::tie(a.column, a.row, a.shift) < std::tie(b.column, b.row, b.shift);
  });
  return terms;
}

}  // namespace

template <int C>
Harmonics::Harmonics(const SectorBlocks<C>& k, std::span<const double> mass)
    : n_sectors_(k.n_sectors), components_(C), root_mass_(static_cast<Index>(C * k.n_local())) {
  for (std::size_t a = 0; a < k.n_local(); ++a)
    root_mass_.segment<C>(static_cast<Index>(C * a)).setConstant(std::sqrt(mass[k.node(a, 0)]));
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

template Harmonics::Harmonics(const SectorBlocks<2>&, std::span<const double>);
template Harmonics::Harmonics(const SectorBlocks<3>&, std::span<const double>);

const Harmonics::Matrix& Harmonics::lower(int harmonic, double factor, double shift,
                                          double axial_shift) {
  RONDO_DEMAND(harmonic >= 0 && harmonic < count(), harmonic, n_sectors_);
  const double kappa = 2.0 * std::numbers::pi * harmonic / n_sectors_;
  const double even = factor * std::cos(kappa), odd = factor * std::sin(kappa);
  std::complex<double>* value = matrix_.valuePtr();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Entry& e = entries_[i];
    value[i] = {factor * e.constant + even * e.even, odd * e.odd};
  }
  for (Index j = 0; j < matrix_.cols(); ++j)
    value[matrix_.outerIndexPtr()[j]] += j % components_ == 2 ? axial_shift : shift;
  return matrix_;
}

}  // namespace rondo::fem
