// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady_solid/solid_layers.hpp"

#include <cblas.h>

#include <complex>
#define LAPACK_COMPLEX_CUSTOM  // else C's own, which C++ does not know
#define lapack_complex_float std::complex<float>
#define lapack_complex_double std::complex<double>
#include <lapacke.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/statics/imaginary.hpp"

namespace rondo::statics {
namespace {

using Complexes = std::complex<double>;
using Eigen::Index;
using Layers = std::span<const SolidLayer>;
constexpr Complexes no_number{std::numeric_limits<double>::quiet_NaN(), 0.0};

/// (n_local) elements between a row and the nearest candidate, across sectors too.
std::vector<int> distances(const fem::SolidSector& k, std::span<const int> candidates) {
  std::vector<int> distance(k.n_local(), -1), next(candidates.begin(), candidates.end());
  for (int d = 0; !next.empty(); ++d) {
    std::vector<int> reached;
    for (const int row : next) distance[static_cast<std::size_t>(row)] = d;
    for (const int row : next)
      for (const auto& e : k.row(static_cast<std::size_t>(row))) {
        int& of = distance[static_cast<std::size_t>(e.column)];
        if (of < 0) of = d + 1, reached.push_back(e.column);
      }
    next = std::move(reached);
  }
  return distance;
}

using Block = Eigen::MatrixXcd;

int size_of(const Block& m) {
  return static_cast<int>(m.rows());
}

/// c += a b. Eigen's own is for any processor, and slower.
void add_product(const Block& a, const Block& b, Block& c) {
  const Complexes one{1.0, 0.0};
  const auto m = static_cast<int>(a.rows()), n = static_cast<int>(b.cols()), k = size_of(b);
  cblas_zgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, n, k, &one, a.data(), m, b.data(), k,
              &one, c.data(), m);
}

}  // namespace

std::vector<SolidLayer> solid_layers(const fem::SolidSector& k, std::span<const int> candidates,
                                     std::span<const double> mass) {
  const std::vector<int> distance = distances(k, candidates);
  const int deepest = *std::ranges::max_element(distance);
  RONDO_DEMAND(*std::ranges::min_element(distance) >= 0, deepest);
  std::vector<SolidLayer> layers(static_cast<std::size_t>(deepest) + 1);
  std::vector<Index> place(k.n_local());
  const auto add = [&](int row) {
    const auto a = static_cast<std::size_t>(row);
    SolidLayer& layer = layers[static_cast<std::size_t>(deepest - distance[a])];
    place[a] = std::ssize(layer.rows);
    layer.rows.push_back(row);
    layer.mass.push_back(mass[k.node(a, 0)]);
  };
  for (const int row : candidates) add(row);
  for (std::size_t a = 0; a < k.n_local(); ++a)
    if (distance[a] > 0) add(static_cast<int>(a));
  for (SolidLayer& layer : layers)
    for (const int row : layer.rows)
      for (const auto& e : k.row(static_cast<std::size_t>(row))) {
        const auto a = static_cast<std::size_t>(row), b = static_cast<std::size_t>(e.column);
        if (distance[b] < distance[a]) continue;  // of the next layer, whose `up` has it
        SolidLayerEntry entry{place[a], place[b],
                              static_cast<std::size_t>(std::ptrdiff_t{e.shift} + 1),
                              Eigen::Map<const Eigen::Matrix3d>(e.block.data())};
        (distance[b] == distance[a] ? layer.own : layer.up).push_back(entry);
      }
  return layers;
}

SolidElimination::SolidElimination(Layers layers, const RollingOrder& order)
    : layers_(layers), order_(order), elastic_(1.0 + i * (order.rate * order.stiffness_damping)) {
  for (std::size_t l = 0; l < layers.size(); ++l) {
    Block here = own(layers[l]);
    if (l > 0) {
      const Block up = turned(l);
      // Z_(l-1, l) is the adjoint of Z_(l, l-1), but for the damping.
      Block transfer = solved(l - 1, -elastic_ / std::conj(elastic_) * up.adjoint());
      add_product(up, transfer, here);
      transfers_.push_back(std::move(transfer));
    }
    factorise(std::move(here));
  }
  surface_ = factors_.back().matrix;
  const lapack_int bad = LAPACKE_zgetri(LAPACK_COL_MAJOR, size_of(surface_), surface_.data(),
                                        size_of(surface_), factors_.back().pivots.data());
  if (bad != 0) surface_.setConstant(no_number);
}

/// The matrix need not be Hermitian. If it is singular or not finite, all that is solved with it is
/// NaN.
void SolidElimination::factorise(Block here) {
  Factor f{std::move(here), {}};
  const int n = size_of(f.matrix);
  f.pivots.resize(static_cast<std::size_t>(n));
  const lapack_int bad =
      LAPACKE_zgetrf(LAPACK_COL_MAJOR, n, n, f.matrix.data(), n, f.pivots.data());
  if (bad != 0) f.matrix.setConstant(no_number);
  factors_.push_back(std::move(f));
}

SolidElimination::Block SolidElimination::solved(std::size_t l, Block right) const {
  const Block& factor = factors_[l].matrix;
  const int n = size_of(factor);
  // It looks for NaN in either, and then does nothing.
  const lapack_int bad =
      LAPACKE_zgetrs(LAPACK_COL_MAJOR, 'N', n, static_cast<int>(right.cols()), factor.data(), n,
                     factors_[l].pivots.data(), right.data(), n);
  if (bad != 0) right.setConstant(no_number);
  return right;
}

/// Z_(l, l-1).
SolidElimination::Block SolidElimination::turned(std::size_t l) const {
  Block z = Block::Zero(layers_[l].size(), layers_[l - 1].size());
  for (const SolidLayerEntry& e : layers_[l].up)
    z.block<3, 3>(3 * e.row, 3 * e.column) += elastic_ * order_.turns[e.shift] * e.block;
  return z;
}

SolidElimination::Block SolidElimination::own(const SolidLayer& layer) const {
  Block z = Block::Zero(layer.size(), layer.size());
  for (const SolidLayerEntry& e : layer.own)
    z.block<3, 3>(3 * e.row, 3 * e.column) += elastic_ * order_.turns[e.shift] * e.block;
  const double rate = order_.rate, spin = order_.spin;
  const Complexes axial = -rate * rate + i * (rate * order_.mass_damping);
  const Complexes straight = axial - spin * spin, across = 2.0 * i * (rate * spin);
  for (std::size_t a = 0; a < layer.mass.size(); ++a) {
    const auto row = static_cast<Index>(3 * a);
    const double m = layer.mass[a];
    z(row, row) += m * straight;
    z(row + 1, row + 1) += m * straight;
    z(row + 2, row + 2) += m * axial;
    z(row, row + 1) -= m * across;
    z(row + 1, row) += m * across;
  }
  return z;
}

Eigen::VectorXcd SolidElimination::solve(const Eigen::VectorXcd& force) const {
  std::vector<Eigen::VectorXcd> left;  // of each layer, once those below are gone
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    Eigen::VectorXcd f(layers_[l].size());
    for (std::size_t a = 0; a < layers_[l].rows.size(); ++a)
      f.segment<3>(static_cast<Index>(3 * a)) = force.segment<3>(3 * layers_[l].rows[a]);
    if (l > 0) {
      const Block below = solved(l - 1, left[l - 1]);
      for (const SolidLayerEntry& e : layers_[l].up)
        f.segment<3>(3 * e.row) -=
            elastic_ * order_.turns[e.shift] * (e.block * below.block<3, 1>(3 * e.column, 0));
    }
    left.push_back(std::move(f));
  }
  Eigen::VectorXcd u(force.size()), next;
  for (std::size_t l = layers_.size(); l-- > 0;) {
    Eigen::VectorXcd here = solved(l, left[l]);
    if (l + 1 < layers_.size()) here += transfers_[l] * next;
    for (std::size_t a = 0; a < layers_[l].rows.size(); ++a)
      u.segment<3>(3 * layers_[l].rows[a]) = here.segment<3>(static_cast<Index>(3 * a));
    next = std::move(here);
  }
  return u;
}

void follow(Layers layers, std::span<const Eigen::MatrixXcd> transfers,
            Eigen::Ref<Eigen::VectorXcd> u) {
  Eigen::VectorXcd next(layers.back().size());
  for (std::size_t a = 0; a < layers.back().rows.size(); ++a)
    next.segment<3>(static_cast<Index>(3 * a)) = u.segment<3>(3 * layers.back().rows[a]);
  for (std::size_t l = layers.size() - 1; l-- > 0;) {
    Eigen::VectorXcd here = transfers[l] * next;
    for (std::size_t a = 0; a < layers[l].rows.size(); ++a)
      u.segment<3>(3 * layers[l].rows[a]) = here.segment<3>(static_cast<Index>(3 * a));
    next = std::move(here);
  }
}

RollingNorms norms_of(Layers layers, const RollingOrder& order,
                      const Eigen::Ref<const Eigen::VectorXcd>& u) {
  RollingNorms n;
  const auto form = [&](const SolidLayerEntry& e, int row, int column) {
    const Eigen::Vector3cd ku = order.turns[e.shift] * (e.block * u.segment<3>(3 * column));
    return u.segment<3>(3 * row).dot(ku).real();
  };
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const SolidLayer& layer = layers[l];
    const auto row = [&](Index a) { return layer.rows[static_cast<std::size_t>(a)]; };
    for (std::size_t a = 0; a < layer.rows.size(); ++a)
      n.mass += layer.mass[a] * u.segment<3>(3 * layer.rows[a]).squaredNorm();
    for (const SolidLayerEntry& e : layer.own) n.stiffness += form(e, row(e.row), row(e.column));
    for (const SolidLayerEntry& e : layer.up)
      n.stiffness +=
          2.0 * form(e, row(e.row), layers[l - 1].rows[static_cast<std::size_t>(e.column)]);
  }
  return n;
}

}  // namespace rondo::statics
