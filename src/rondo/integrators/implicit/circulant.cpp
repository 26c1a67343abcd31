// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/implicit/circulant.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {
namespace {

constexpr int lanes = 8;  ///< lanes of the loop

}  // namespace

RingRows::RingRows(int rows, int sectors)
    : rows_(rows),
      sectors_(sectors),
      lead_((sectors + lanes - 1) / lanes * lanes),
      stride_(3 * lead_ + lanes),
      values_(static_cast<std::size_t>(rows * stride_ + lead_)) {
  RONDO_DEMAND(rows > 0 && sectors > 0, rows, sectors);
}

void RingRows::wrap(int by) noexcept {
  RONDO_ASSERT(by >= 0 && by <= sectors_, by, sectors_);
  for (int i = 0; i < rows_; ++i) {
    std::copy_n(row(i) + sectors_ - by, by, row(i) - by);
    std::copy_n(row(i), by, row(i) + sectors_);
  }
}

Circulant::Circulant(int sectors, const RingBlocks& blocks, RingProduct product)
    : rows_(static_cast<int>(blocks.here.rows())),
      sectors_(sectors),
      product_(product),
      work_(rows_, sectors) {
  RONDO_DEMAND(sectors >= 3, sectors);
  RONDO_DEMAND(product && blocks.left.rows() == rows_ && blocks.right.rows() == rows_ &&
                   blocks.here.cols() == rows_,
               rows_, blocks.left.rows(), blocks.right.rows(), blocks.here.cols());
  Eigen::MatrixXd left = blocks.left, here = blocks.here, right = blocks.right;
  constexpr double round_off = 1e-17;  // of a coupling: what it does is below that of a number
  constexpr int most_levels = 60;
  for (int shift = 1; static_cast<int>(levels_.size()) < most_levels; shift = 2 * shift % sectors) {
    const Eigen::MatrixXd inverse = here.inverse();
    const Eigen::MatrixXd by_left = left * inverse, by_right = right * inverse;
    if (std::max(by_left.cwiseAbs().maxCoeff(), by_right.cwiseAbs().maxCoeff()) < round_off) break;
    levels_.push_back({-by_left, -by_right, shift});
    here -= by_left * right + by_right * left;
    left = -by_left * left;
    right = -by_right * right;
  }
  inverse_ = here.inverse();
}

void Circulant::solve(RingRows& x) noexcept {
  RONDO_ASSERT(x.stride() == work_.stride(), x.stride(), work_.stride());
  RingRows *from = &x, *to = &work_;
  for (const Level& level : levels_) {
    from->wrap(level.shift);
    product_({.rows = rows_,
              .columns = rows_,
              .sectors = sectors_,
              .n_terms = 2,
              .with_self = true,
              .matrix = {level.left.data(), level.right.data(), nullptr},
              .offset = {-level.shift, level.shift, 0},
              .in = from->row(0),
              .out = to->row(0),
              .stride = x.stride()});
    std::swap(from, to);
  }
  product_({.rows = rows_,
            .columns = rows_,
            .sectors = sectors_,
            .n_terms = 1,
            .with_self = false,
            .matrix = {inverse_.data(), nullptr, nullptr},
            .offset = {0, 0, 0},
            .in = from->row(0),
            .out = to->row(0),
            .stride = x.stride()});
  if (to == &x) return;
  for (int i = 0; i < rows_; ++i) std::copy_n(to->row(i), sectors_, x.row(i));
}

}  // namespace rondo::dynamics
