// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_layers.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "rondo/statics/imaginary.hpp"

namespace rondo::statics {
namespace {

using Complexes = std::complex<double>;
using Eigen::Index;
using Layers = std::span<const RollingLayer>;

/// Of one harmonic, with blocks of a size that is known where all layers are of one row: a smooth
/// disk's are, and take a fifth of the time so.
template <int Size>
struct Blocks {
  using Block = Eigen::Matrix<Complexes, Size, Size>;

  const RollingOrder& order;

  [[nodiscard]] Block turned(const std::array<Eigen::MatrixXd, 3>& shifted) const {
    if constexpr (Size == 2) {
      Block b;
      for (Index n = 0; n < 4; ++n)
        b.data()[n] = order.turns[0] * shifted[0].data()[n] + shifted[1].data()[n] +
                      order.turns[2] * shifted[2].data()[n];
      return b;
    } else {
      return order.turns[0] * shifted[0] + shifted[1] + order.turns[2] * shifted[2];
    }
  }
  [[nodiscard]] Complexes elastic() const {
    return 1.0 + i * (order.rate * order.stiffness_damping);
  }
  [[nodiscard]] Block own(const RollingLayer& layer) const {
    Block z = elastic() * turned(layer.own);
    const Complexes straight =
        -order.rate * order.rate - order.spin * order.spin + i * (order.rate * order.mass_damping);
    const Complexes across = 2.0 * i * (order.rate * order.spin);
    for (std::size_t a = 0; a < layer.mass.size(); ++a) {
      const auto row = static_cast<Index>(2 * a);
      const double m = layer.mass[a];
      z(row, row) += m * straight;
      z(row + 1, row + 1) += m * straight;
      z(row, row + 1) -= m * across;
      z(row + 1, row) += m * across;
    }
    return z;
  }
  /// Times a matrix on the right.
  template <class Right>
  static auto solved(const Block& block, const Right& right) {
    if constexpr (Size == 2)
      return (block.inverse() * right).eval();
    else
      return block.partialPivLu().solve(right).eval();
  }

  /// What is left of each layer, once those below are gone, is given to `left`.
  template <class Take>
  Block last(Layers layers, Take&& take) const {
    Block here = own(layers[0]);
    for (std::size_t l = 1; l < layers.size(); ++l) {
      const Block up = turned(layers[l].up);
      const Block transfer = solved(here, (-elastic() * up.adjoint()).eval());
      take(l - 1, here, transfer);
      here = own(layers[l]);
      here.noalias() += elastic() * up * transfer;
    }
    return here;
  }
};

bool all_of_one_row(Layers layers) {
  return std::ranges::all_of(layers, [](const RollingLayer& l) { return l.size == 2; });
}

template <int Size>
Eigen::MatrixXcd eliminate_all(Layers layers, const RollingOrder& order,
                               std::span<Complexes> transfers) {
  using Block = typename Blocks<Size>::Block;
  Complexes* to = transfers.data();
  const Block last =
      Blocks<Size>{order}.last(layers, [&](std::size_t, const Block&, const Block& transfer) {
        to = std::copy_n(transfer.data(), transfer.size(), to);
      });
  return Blocks<Size>::solved(last, Eigen::MatrixXcd::Identity(last.rows(), last.cols()));
}

template <int Size>
void follow_all(Layers layers, std::span<const Complexes> transfers,
                Eigen::Map<Eigen::VectorXcd>& u) {
  using Block = typename Blocks<Size>::Block;
  const Complexes* from = transfers.data() + transfers.size();
  for (std::size_t l = layers.size() - 1; l-- > 0;) {
    const RollingLayer &here = layers[l], &next = layers[l + 1];
    from -= here.size * next.size;
    u.segment<Size>(here.first, here.size) = Eigen::Map<const Block>(from, here.size, next.size) *
                                             u.segment<Size>(next.first, next.size);
  }
}

/// Re xᴴ (e^{-iθ} B_-1 + B_0 + e^{iθ} B_1) y.
double form(const std::array<Eigen::MatrixXd, 3>& b, Complexes turn, const Complexes* x,
            const Complexes* y) {
  const double *less = b[0].data(), *same = b[1].data(), *more = b[2].data();
  const double cosine = turn.real(), sine = turn.imag();
  double sum = 0.0;
  for (Index c = 0, n = 0; c < b[1].cols(); ++c)
    for (Index r = 0; r < b[1].rows(); ++r, ++n) {
      const double re = x[r].real() * y[c].real() + x[r].imag() * y[c].imag();
      const double im = x[r].real() * y[c].imag() - x[r].imag() * y[c].real();
      sum += re * (same[n] + (less[n] + more[n]) * cosine) - im * ((more[n] - less[n]) * sine);
    }
  return sum;
}

}  // namespace

std::vector<RollingLayer> rolling_layers(const fem::SectorStiffness& k,
                                         std::span<const Vec2> reference,
                                         std::span<const double> mass) {
  std::vector<RollingLayer> layers;
  const auto radius = [&](std::size_t a) { return norm(reference[k.node(a, 0)]); };
  for (std::size_t a = 0; a < k.n_local(); ++a) {
    const bool next = a == 0 || std::abs(radius(a) - radius(a - 1)) > 1e-9 * radius(a);
    if (next) layers.emplace_back().first = static_cast<Index>(2 * a);
    layers.back().size += 2;
    layers.back().mass.push_back(mass[k.node(a, 0)]);
  }
  for (std::size_t l = 0; l < layers.size(); ++l) {
    RollingLayer& layer = layers[l];
    const RollingLayer none, &below = l > 0 ? layers[l - 1] : none;
    layer.own.fill(Eigen::MatrixXd::Zero(layer.size, layer.size));
    layer.up.fill(Eigen::MatrixXd::Zero(layer.size, below.size));
    for (Index row = 0; row < layer.size; row += 2)
      for (const auto& e : k.row(static_cast<std::size_t>((layer.first + row) / 2))) {
        const bool is_own = 2 * e.column >= layer.first;
        const Index column = 2 * e.column - (is_own ? layer.first : below.first);
        if (column < 0 || column >= (is_own ? layer.size : below.size)) continue;
        auto& to =
            (is_own ? layer.own : layer.up)[static_cast<std::size_t>(std::ptrdiff_t{e.shift} + 1)];
        to.block<2, 2>(row, column) += Eigen::Map<const Eigen::Matrix2d>(e.block.data());
      }
  }
  return layers;
}

std::size_t transfer_size(Layers layers) {
  Index size = 0;
  for (std::size_t l = 1; l < layers.size(); ++l) size += layers[l - 1].size * layers[l].size;
  return static_cast<std::size_t>(size);
}

Eigen::MatrixXcd eliminate(Layers layers, const RollingOrder& order,
                           std::span<Complexes> transfers) {
  return all_of_one_row(layers) ? eliminate_all<2>(layers, order, transfers)
                                : eliminate_all<Eigen::Dynamic>(layers, order, transfers);
}

Eigen::VectorXcd solve(Layers layers, const RollingOrder& order, const Eigen::VectorXcd& force) {
  using All = Blocks<Eigen::Dynamic>;
  const All of{order};
  std::vector<Complexes> transfers;
  Eigen::VectorXcd u = force;
  // From each layer to the next what acts on it; then back.
  const All::Block last =
      of.last(layers, [&](std::size_t l, const All::Block& here, const All::Block& transfer) {
        const RollingLayer &low = layers[l], &high = layers[l + 1];
        transfers.insert(transfers.end(), transfer.data(), transfer.data() + transfer.size());
        u.segment(low.first, low.size) = All::solved(here, u.segment(low.first, low.size).eval());
        u.segment(high.first, high.size) -=
            of.elastic() * of.turned(high.up) * u.segment(low.first, low.size);
      });
  const Eigen::VectorXcd alone = u;
  const RollingLayer& top = layers.back();
  u.segment(top.first, top.size) = All::solved(last, u.segment(top.first, top.size).eval());
  const Complexes* from = transfers.data() + transfers.size();
  for (std::size_t l = layers.size() - 1; l-- > 0;) {
    const RollingLayer &here = layers[l], &next = layers[l + 1];
    from -= here.size * next.size;
    u.segment(here.first, here.size) =
        alone.segment(here.first, here.size) +
        Eigen::Map<const All::Block>(from, here.size, next.size) * u.segment(next.first, next.size);
  }
  return u;
}

void follow(Layers layers, std::span<const Complexes> transfers, std::span<Complexes> all) {
  Eigen::Map<Eigen::VectorXcd> u(all.data(), std::ssize(all));
  if (all_of_one_row(layers))
    follow_all<2>(layers, transfers, u);
  else
    follow_all<Eigen::Dynamic>(layers, transfers, u);
}

RollingNorms norms_of(Layers layers, const RollingOrder& order,
                      const Eigen::Ref<const Eigen::VectorXcd>& u) {
  RollingNorms n;
  const Complexes turn = order.turns[2];
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const RollingLayer& layer = layers[l];
    const Complexes* here = u.data() + layer.first;
    for (std::size_t a = 0; a < layer.mass.size(); ++a)
      n.mass += layer.mass[a] * (std::norm(here[2 * a]) + std::norm(here[2 * a + 1]));
    n.stiffness += form(layer.own, turn, here, here);
    if (l > 0) n.stiffness += 2.0 * form(layer.up, turn, here, u.data() + layers[l - 1].first);
  }
  return n;
}

}  // namespace rondo::statics
