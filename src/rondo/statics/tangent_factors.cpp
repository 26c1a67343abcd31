// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/tangent_factors.hpp"

#include <cholmod.h>

#include <Eigen/SparseCore>
#include <algorithm>
#include <new>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/process_wide.hpp"

namespace rondo::statics {

using Eigen::Index;
using Matrix = Eigen::SparseMatrix<double>;

struct TangentFactors::Part {
  Part() {
    cholmod_start(&common);
    common.print = 0;  // "not positive definite" is an answer here, not a message
    common.supernodal = CHOLMOD_SUPERNODAL;
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;
  ~Part() {
    cholmod_free_factor(&factors, &common);
    cholmod_finish(&common);
  }
  void find_order(cholmod_sparse& k);
  void analyse(cholmod_sparse& k);
  [[nodiscard]] Eigen::MatrixXd last_block(int size) const;

  std::vector<int> first;             ///< (n) unknown of a node's x; -1: it is held
  std::vector<std::size_t> nodes;     ///< that move
  std::vector<std::size_t> touching;  ///< are eliminated last
  std::vector<int> order;             ///< (3 nodes) that fills least
  std::vector<Eigen::Triplet<double>> entries;
  cholmod_common common{};
  cholmod_factor* factors = nullptr;
};

TangentFactors::TangentFactors(std::span<const char> moves, std::span<const std::size_t> touching,
                               std::vector<int> order)
    : part_(std::make_unique<Part>()) {
  for (std::size_t k = 0; k < moves.size(); ++k) {
    part_->first.push_back(moves[k] ? static_cast<int>(3 * part_->nodes.size()) : -1);
    if (moves[k]) part_->nodes.push_back(k);
  }
  part_->touching.assign(touching.begin(), touching.end());
  part_->order = std::move(order);
}
TangentFactors::TangentFactors(TangentFactors&&) noexcept = default;
TangentFactors& TangentFactors::operator=(TangentFactors&&) noexcept = default;
TangentFactors::~TangentFactors() = default;

void TangentFactors::take(std::size_t force, std::size_t move, const Eigen::Matrix3d& block) {
  const int row = part_->first[force], column = part_->first[move];
  if (row < 0 || column < 0 || row < column) return;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (row + i >= column + j) part_->entries.emplace_back(row + i, column + j, block(i, j));
}

void TangentFactors::Part::find_order(cholmod_sparse& k) {
  cholmod_factor* least = cholmod_analyze(&k, &common);
  if (!least) throw std::bad_alloc();
  const auto* rows = static_cast<const int*>(least->Perm);
  order.assign(rows, rows + k.nrow);
  cholmod_free_factor(&least, &common);
}

/// The last block of the factors is then that of the touching nodes.
void TangentFactors::Part::analyse(cholmod_sparse& k) {
  if (order.empty()) find_order(k);
  std::vector<char> is_last(k.nrow, 0);
  for (const std::size_t node : touching)
    for (int i = 0; i < 3; ++i) is_last[at(first[node] + i)] = 1;
  std::vector<int> given = order;
  std::stable_partition(given.begin(), given.end(), [&](int row) { return !is_last[at(row)]; });
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  common.postorder = 0;  // it would move touching nodes that have no neighbours but such
  factors = cholmod_analyze_p(&k, given.data(), nullptr, 0, &common);
}

/// CHOLMOD is kept on one thread: called from a loop over samples it would make threads for each of
/// its many small loops.
bool TangentFactors::factor() {
  const BorrowedBlas alone;
  const auto size = static_cast<Index>(3 * part_->nodes.size());
  Matrix k(size, size);
  k.setFromTriplets(part_->entries.begin(), part_->entries.end());
  part_->entries = {};
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(size);
  view.nzmax = static_cast<std::size_t>(k.nonZeros());
  view.p = k.outerIndexPtr();
  view.i = k.innerIndexPtr();
  view.x = k.valuePtr();
  view.stype = -1;  // the lower triangle
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  part_->analyse(view);
  return part_->factors && cholmod_factorize(&view, part_->factors, &part_->common) != 0 &&
         part_->common.status == CHOLMOD_OK;
}

const std::vector<int>& TangentFactors::order() const noexcept {
  return part_->order;
}

/// The lower triangle of the factors' last rows and columns, from their dense blocks of columns.
Eigen::MatrixXd TangentFactors::Part::last_block(int size) const {
  const cholmod_factor& l = *factors;
  const auto* begin = static_cast<const int*>(l.super);   // first column of a block
  const auto* rows_at = static_cast<const int*>(l.pi);    // where its rows begin
  const auto* values_at = static_cast<const int*>(l.px);  // where its values begin
  const auto* rows = static_cast<const int*>(l.s);
  const auto* values = static_cast<const double*>(l.x);
  const int before = static_cast<int>(l.n) - size;
  Eigen::MatrixXd last = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t s = 0; s < l.nsuper; ++s) {
    const int height = rows_at[s + 1] - rows_at[s];
    for (int c = std::max(begin[s], before); c < begin[s + 1]; ++c)
      for (int r = c - begin[s]; r < height; ++r)
        last(rows[rows_at[s] + r] - before, c - before) =
            values[values_at[s] + (c - begin[s]) * height + r];
  }
  return last;
}

/// The last block L of the factors is that of the stiffness after all else is eliminated, of which
/// the compliance is the inverse, L^-T L^-1.
Eigen::MatrixXd TangentFactors::compliance() const {
  const auto m = static_cast<int>(3 * part_->touching.size());
  const auto* unknown = static_cast<const int*>(part_->factors->Perm) + part_->factors->n - m;
  std::vector<int> place(3 * part_->nodes.size(), -1);  // of an unknown in the last block
  for (int r = 0; r < m; ++r) place[at(unknown[r])] = r;
  std::vector<int> sorted;
  for (const std::size_t node : part_->touching)
    for (int i = 0; i < 3; ++i) {
      sorted.push_back(place[at(part_->first[node] + i)]);
      RONDO_DEMAND(sorted.back() >= 0, node);
    }
  const Eigen::MatrixXd inverse =
      part_->last_block(m).triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(m, m));
  const Eigen::MatrixXd columns = inverse(Eigen::all, sorted);
  return columns.transpose() * columns;
}

void TangentFactors::move(std::span<const Vec3> force, std::span<Vec3> u) const {
  const BorrowedBlas alone;
  Eigen::VectorXd right(static_cast<Index>(3 * part_->nodes.size()));
  for (std::size_t a = 0; a < part_->nodes.size(); ++a) {
    const Vec3 f = force[part_->nodes[a]];
    right.segment<3>(static_cast<Index>(3 * a)) << f.x, f.y, f.z;
  }
  cholmod_dense view{};
  view.nrow = view.d = view.nzmax = static_cast<std::size_t>(right.size());
  view.ncol = 1;
  view.x = right.data();
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* way = cholmod_solve(CHOLMOD_A, part_->factors, &view, &part_->common);
  const auto* by = static_cast<const double*>(way->x);
  for (std::size_t a = 0; a < part_->nodes.size(); ++a)
    u[part_->nodes[a]] += Vec3{by[3 * a], by[3 * a + 1], by[3 * a + 2]};
  cholmod_free_dense(&way, &part_->common);
}

}  // namespace rondo::statics
