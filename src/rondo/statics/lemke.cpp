// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/lemke.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::statics {
namespace {

using Eigen::Index;

// Against round-off: pivots below this share of their column are none, and ratios closer than
// this share of the largest number seen so far are equal.
constexpr double least_pivot = 1e-10, same = 1e-12;

/// x_B = D (x_N, 1). Variables are numbered: y_i is i, z_i is n + i, the artificial one 2n.
class Dictionary {
 public:
  explicit Dictionary(const Lcp& lcp)
      : n_(lcp.q.size()), d_(n_, n_ + 2), place_(static_cast<std::size_t>(2 * n_ + 1)) {
    d_.leftCols(n_) = lcp.matrix;
    d_.col(n_) = lcp.cover;
    d_.col(n_ + 1) = lcp.q;
    for (Index i = 0; i < n_; ++i) {
      row_of_.push_back(i);
      place(i) = {true, i};
      place(n_ + i) = {false, i};
    }
    place(artificial()) = {false, n_};
  }

  [[nodiscard]] Index artificial() const { return 2 * n_; }
  [[nodiscard]] Index complement(Index v) const { return v < n_ ? v + n_ : v - n_; }
  [[nodiscard]] Index basic(Index row) const { return row_of_[static_cast<std::size_t>(row)]; }
  [[nodiscard]] bool is_basic(Index v) const {
    return place_[static_cast<std::size_t>(v)].in_basis;
  }
  [[nodiscard]] double value(Index v) const {
    return is_basic(v) ? d_(place_[static_cast<std::size_t>(v)].at, n_ + 1) : 0.0;
  }
  [[nodiscard]] bool finite() const { return d_.col(n_ + 1).allFinite(); }

  /// Row where the artificial variable comes in: the lexicographically smallest.
  [[nodiscard]] Index first_row() const {
    Index best = 0;
    for (Index i = 1; i < n_; ++i)
      if (first(i) <= first(best)) best = i;  // of equal rows the last is smallest
    return best;
  }

  /// Row that first stops `entering` from growing, -1 where none does.
  [[nodiscard]] Index leaving_row(Index entering) const {
    const auto column = d_.col(place_[static_cast<std::size_t>(entering)].at);
    const double least = least_pivot * column.cwiseAbs().maxCoeff();
    std::vector<Index> rows;
    for (Index i = 0; i < n_; ++i)
      if (column[i] < -least) rows.push_back(i);
    keep_smallest(rows, column, d_.col(n_ + 1));
    for (const Index i : rows)
      if (basic(i) == artificial()) return i;  // the end, as good as any other
    for (Index k = 0; k < n_ && rows.size() > 1; ++k) keep_smallest(rows, column, lexical(k));
    return rows.empty() ? -1 : rows.front();
  }

  void exchange(Index row, Index entering) {
    const Index leaving = basic(row), at = place_[static_cast<std::size_t>(entering)].at;
    const double pivot = d_(row, at);
    Eigen::RowVectorXd scaled = -d_.row(row) / pivot;
    scaled[at] = 1.0 / pivot;
    Eigen::VectorXd column = d_.col(at);
    column[row] = 0.0;
    d_.col(at).setZero();
    d_.noalias() += column * scaled;
    d_.row(row) = scaled;
    row_of_[static_cast<std::size_t>(row)] = entering;
    place(entering) = {true, row};
    place(leaving) = {false, at};
  }

 private:
  struct Place {
    bool in_basis = false;
    Index at = 0;
  };

  Place& place(Index v) { return place_[static_cast<std::size_t>(v)]; }

  /// Column k of the inverse of the basis, the coefficients of the k-th power of a perturbation.
  [[nodiscard]] Eigen::VectorXd lexical(Index k) const {
    const Place p = place_[static_cast<std::size_t>(k)];
    return p.in_basis ? Eigen::VectorXd(Eigen::VectorXd::Unit(n_, p.at))
                      : Eigen::VectorXd(-d_.col(p.at));
  }

  static void keep_smallest(std::vector<Index>& rows, const Eigen::VectorXd& column,
                            const Eigen::VectorXd& values) {
    if (rows.empty()) return;
    const auto ratio = [&](Index i) { return -values[i] / column[i]; };
    double smallest = ratio(rows.front());
    for (const Index i : rows) smallest = std::min(smallest, ratio(i));
    // Equal to the round-off of the values, which a small pivot blows up.
    const double noise = same * std::max(1.0, values.cwiseAbs().maxCoeff());
    std::erase_if(rows, [&](Index i) { return ratio(i) > smallest - noise / column[i]; });
  }

  [[nodiscard]] double first(Index i) const { return d_(i, n_ + 1) / d_(i, n_); }

  Index n_;
  Eigen::MatrixXd d_;  ///< (n, n + 2) columns: not in the basis, then the values
  std::vector<Index> row_of_;
  std::vector<Place> place_;
};

void take_out(const Dictionary& d, Index n, LcpSolution& solution) {
  for (Index i = 0; i < n; ++i) {
    solution.basic[static_cast<std::size_t>(i)] = d.is_basic(n + i) ? 1 : 0;
    solution.z[i] = std::max(0.0, d.value(n + i));
  }
}

}  // namespace

LemkeReport solve_lemke(const Lcp& lcp, int max_pivots, LcpSolution& solution) {
  const Index n = lcp.q.size();
  RONDO_DEMAND(lcp.matrix.rows() == n && lcp.matrix.cols() == n && lcp.cover.size() == n,
               lcp.matrix.rows(), lcp.matrix.cols(), lcp.cover.size(), n);
  solution.z = Eigen::VectorXd::Zero(n);
  solution.basic.assign(static_cast<std::size_t>(n), 0);
  LemkeReport report;
  if (n == 0 || lcp.q.minCoeff() >= 0.0) {
    report.end = LemkeEnd::solved;
    return report;
  }
  Dictionary d(lcp);
  Index entering = d.artificial(), row = d.first_row();
  while (report.pivots < max_pivots && d.finite()) {
    const Index leaving = d.basic(row);
    d.exchange(row, entering);
    ++report.pivots;
    if (leaving == d.artificial()) {
      take_out(d, n, solution);
      report.end = LemkeEnd::solved;
      return report;
    }
    entering = d.complement(leaving);
    row = d.leaving_row(entering);
    if (row < 0) {
      report.end = LemkeEnd::ray;
      return report;
    }
  }
  return report;
}

}  // namespace rondo::statics
