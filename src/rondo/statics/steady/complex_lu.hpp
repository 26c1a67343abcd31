// SPDX-License-Identifier: BSD-3-Clause
/// @file  Factors of a dense complex block of a layer, (statics/steady/rolling_layers.hpp). Blocks
/// of a wheel in space are large, and LAPACK is faster with them; those of the plane are small, and
/// have a size that is known where all layers are of one row, which takes a fifth of the time.
#pragma once
#include <Eigen/LU>
#include <complex>
#include <type_traits>
#include <vector>

namespace rondo::statics {

/// Size is that of the block, or Eigen::Dynamic.
template <int D, int Size>
class ComplexLu {
 public:
  using Block = Eigen::Matrix<std::complex<double>, Size, Size>;

  explicit ComplexLu(const Block& block) : factors_(factors_of(block)) {}

  template <class Right>
  [[nodiscard]] auto solved(const Right& right) const {
    if constexpr (Size == Eigen::Dynamic)
      return factors_.solve(right).eval();
    else
      return (factors_ * right).eval();
  }
  [[nodiscard]] Block inverse() const {
    if constexpr (Size == Eigen::Dynamic)
      return factors_.solve(Block::Identity(factors_.rows(), factors_.cols()));
    else
      return factors_;
  }
  /// c += a b.
  template <class A>
  static void add_product(const A& a, const Block& b, Block& c) {
    c.noalias() += a * b;
  }

 private:
  static auto factors_of(const Block& block) {
    if constexpr (Size == Eigen::Dynamic)
      return Eigen::PartialPivLU<Block>(block);
    else
      return Block(block.inverse());
  }
  std::conditional_t<Size == Eigen::Dynamic, Eigen::PartialPivLU<Block>, Block> factors_;
};

/// By LAPACK. If the block is singular or not finite, all that is solved with it is NaN.
template <>
class ComplexLu<3, Eigen::Dynamic> {
 public:
  using Block = Eigen::MatrixXcd;

  explicit ComplexLu(Block block);
  [[nodiscard]] Block solved(Block right) const;
  [[nodiscard]] Block inverse() const;
  static void add_product(const Block& a, const Block& b, Block& c);

 private:
  Block factors_;
  std::vector<int> pivots_;
};

}  // namespace rondo::statics
