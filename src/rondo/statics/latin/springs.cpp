// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/latin/springs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/stiffness_product.hpp"

namespace rondo::statics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double round_off = 1e-9;  ///< of a load over the largest of its field

/// K φ of one field.
std::vector<Vec2> load_of(const fem::BlockCsr& k, const MatrixXd& field, Index column) {
  std::vector<Vec2> u(k.n_rows()), load(k.n_rows());
  for (std::size_t i = 0; i < u.size(); ++i) {
    const auto row = static_cast<Index>(2 * i);
    u[i] = {field(row, column), field(row + 1, column)};
  }
  fem::apply(k, u, load, 1);
  return load;
}

double norm_of(const std::vector<Vec2>& v) {
  double squares = 0.0;
  for (const Vec2 p : v) squares += dot(p, p);
  return std::sqrt(squares);
}

}  // namespace

fem::BlockCsr with_springs(fem::BlockCsr k, std::span<const int> nodes, double direction) {
  for (const int node : nodes) {
    fem::BlockCsr::Block* block = fem::find_block(k, node, node);
    RONDO_DEMAND(block != nullptr, node);
    (*block)[0] += direction;
    (*block)[3] += direction;
  }
  return k;
}

std::vector<std::size_t> loaded_places(const fem::BlockCsr& k, std::span<const int> nodes,
                                       const MatrixXd& field) {
  std::vector<char> loaded(nodes.size(), 0);
  for (Index c = 0; c < field.cols(); ++c) {
    const std::vector<Vec2> load = load_of(k, field, c);
    double largest = 0.0;
    for (const Vec2 f : load) largest = std::max(largest, norm(f));
    for (std::size_t j = 0; j < nodes.size(); ++j)
      if (norm(load[at(nodes[j])]) > round_off * largest) loaded[j] = 1;
  }
  std::vector<std::size_t> places;
  for (std::size_t j = 0; j < nodes.size(); ++j)
    if (loaded[j]) places.push_back(j);
  return places;
}

Adopted adopt(const fem::BlockCsr& k, const std::vector<int>& nodes, double direction,
              MatrixXd field) {
  const auto rows = static_cast<Index>(2 * nodes.size());
  RONDO_DEMAND(field.rows() == static_cast<Index>(2 * k.n_rows()), field.rows(), k.n_rows());
  Adopted a;
  a.fields.contact.resize(rows, field.cols());
  a.fields.load.resize(rows, field.cols());
  for (Index c = 0; c < field.cols(); ++c) {
    std::vector<Vec2> load = load_of(k, field, c);
    const double whole = norm_of(load);
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      Vec2& f = load[at(nodes[j])];
      const auto row = static_cast<Index>(2 * j);
      const Index x = 2 * static_cast<Index>(nodes[j]);
      a.fields.contact.col(c).segment<2>(row) << field(x + 1, c), -field(x, c);
      a.fields.load.col(c).segment<2>(row) << f.y, -f.x;
      f = {};
    }
    a.foreign = std::max(a.foreign, whole > 0.0 ? norm_of(load) / whole : 1.0);
  }
  a.fields.load += direction * a.fields.contact;
  a.fields.field = std::move(field);
  return a;
}

}  // namespace rondo::statics
