// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/local_stiffness.hpp"

#include <Eigen/CholmodSupport>

#include "rondo/core/index.hpp"

namespace rondo::statics {

using Matrix = Eigen::SparseMatrix<double>;
using Eigen::Index;

struct LocalStiffness::Part {
  std::vector<int> first;          ///< (n) unknown of a node's x; -1: it is held
  std::vector<std::size_t> nodes;  ///< that move
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::CholmodDecomposition<Matrix, Eigen::Lower> factors;
};

LocalStiffness::LocalStiffness(std::span<const char> moves) : part_(std::make_unique<Part>()) {
  for (std::size_t k = 0; k < moves.size(); ++k) {
    part_->first.push_back(moves[k] ? static_cast<int>(3 * part_->nodes.size()) : -1);
    if (moves[k]) part_->nodes.push_back(k);
  }
  part_->factors.setMode(Eigen::CholmodSupernodalLLt);
  part_->factors.cholmod().print = 0;  // "not positive definite" is an answer here, not a message
}
LocalStiffness::LocalStiffness(LocalStiffness&&) noexcept = default;
LocalStiffness& LocalStiffness::operator=(LocalStiffness&&) noexcept = default;
LocalStiffness::~LocalStiffness() = default;

void LocalStiffness::take(std::size_t force, std::size_t move, const Eigen::Matrix3d& block) {
  const int row = part_->first[force], column = part_->first[move];
  if (row < 0 || column < 0 || row < column) return;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (row + i >= column + j) part_->entries.emplace_back(row + i, column + j, block(i, j));
}

bool LocalStiffness::factor() {
  const auto size = static_cast<Index>(3 * part_->nodes.size());
  Matrix k(size, size);
  k.setFromTriplets(part_->entries.begin(), part_->entries.end());
  part_->entries = {};
  part_->factors.compute(k);
  return part_->factors.info() == Eigen::Success;
}

void LocalStiffness::correct(std::span<const Vec3> force, std::span<Vec3> u) const {
  Eigen::VectorXd right(static_cast<Index>(3 * part_->nodes.size()));
  for (std::size_t a = 0; a < part_->nodes.size(); ++a) {
    const Vec3 f = force[part_->nodes[a]];
    right.segment<3>(static_cast<Index>(3 * a)) << f.x, f.y, f.z;
  }
  const Eigen::VectorXd way = part_->factors.solve(right);
  for (std::size_t a = 0; a < part_->nodes.size(); ++a) {
    const auto of = way.segment<3>(static_cast<Index>(3 * a));
    u[part_->nodes[a]] -= Vec3{of[0], of[1], of[2]};
  }
}

}  // namespace rondo::statics
