// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_layers.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/statics/imaginary.hpp"
#include "rondo/statics/steady/complex_lu.hpp"

namespace rondo::statics {
namespace {

using Complexes = std::complex<double>;
using Eigen::Index;

/// (n_local) elements between a row and the nearest candidate, across sectors too.
template <int D>
std::vector<int> distances(const fem::SectorBlocks<D>& k, std::span<const int> candidates) {
  std::vector<int> distance(k.n_local(), -1), next(candidates.begin(), candidates.end());
  for (int d = 0; !next.empty(); ++d) {
    std::vector<int> reached;
    for (const int row : next) distance[at(row)] = d;
    for (const int row : next)
      for (const auto& e : k.row(static_cast<std::size_t>(row))) {
        int& of = distance[at(e.column)];
        if (of < 0) of = d + 1, reached.push_back(e.column);
      }
    next = std::move(reached);
  }
  return distance;
}

/// The blocks of a layer's rows, but for those of the next layer, whose `up` has them.
/// @param distance of each row from the candidates. @param place of each row in its layer
template <int D>
RollingEntries<D> entries_of(const fem::SectorBlocks<D>& k, std::span<const int> rows,
                             std::span<const int> distance, std::span<const Index> place) {
  RollingEntries<D> entries;
  for (const int row : rows)
    for (const auto& e : k.row(static_cast<std::size_t>(row))) {
      const auto a = static_cast<std::size_t>(row), b = static_cast<std::size_t>(e.column);
      if (distance[b] < distance[a]) continue;
      RONDO_DEMAND(distance[b] <= distance[a] + 1, distance[a], distance[b]);
      if (std::ranges::all_of(e.block, [](double value) { return value == 0.0; })) continue;
      RollingEntry<D> entry{place[a], place[b],
                            static_cast<std::size_t>(std::ptrdiff_t{e.shift} + 1),
                            Eigen::Map<const NodeMatrix<D>>(e.block.data())};
      (distance[b] == distance[a] ? entries.own : entries.up).push_back(entry);
    }
  return entries;
}

/// One harmonic, whose blocks have Size rows in each layer, or any number if it is Eigen::Dynamic.
template <int D, int Size>
struct Harmonic {
  using Lu = ComplexLu<D, Size>;
  using Block = typename Lu::Block;
  using Vector = Eigen::Matrix<Complexes, Size, 1>;

  const RollingLayers<D>& layers;
  const RollingOrder& order;

  [[nodiscard]] Complexes elastic() const {
    return 1.0 + i * (order.rate * order.stiffness_damping);
  }
  /// Without viscous parts all of K has one factor, which in the plane, where entries are many
  /// beside the block, multiplies the block.
  [[nodiscard]] bool is_uniform() const { return order.viscous.empty(); }
  void add(const std::vector<RollingEntry<D>>& entries, Complexes factor, Block& z) const {
    std::array<Complexes, 3> turns = order.turns;
    for (Complexes& turn : turns) turn *= factor;
    for (const RollingEntry<D>& e : entries)
      z.template block<D, D>(D * e.row, D * e.column) += turns[e.shift] * e.block;
  }
  /// Calls with K and each viscous part of a layer, and its factor.
  template <class Call>
  void for_parts(const RollingLayer<D>& layer, Call&& call) const {
    call(layer.elastic, elastic());
    for (std::size_t p = 0; p < order.viscous.size(); ++p) call(layer.viscous[p], order.viscous[p]);
  }
  /// Adds all parts of the entries of a layer. @param of those of K or of a viscous part
  /// @param conjugate the factors of the parts are conjugate ones
  template <class Of>
  void add_parts(const RollingLayer<D>& layer, Of&& of, bool conjugate, Block& z) const {
    for_parts(layer, [&](const RollingEntries<D>& part, Complexes factor) {
      add(of(part), conjugate ? std::conj(factor) : factor, z);
    });
  }
  [[nodiscard]] Block own(const RollingLayer<D>& layer) const {
    Block z = Block::Zero(layer.size(), layer.size());
    if (D == 3 || !is_uniform()) {
      add_parts(
          layer, [](const auto& part) -> auto& { return part.own; }, false, z);
    } else {
      add(layer.elastic.own, 1.0, z);
      z = elastic() * z;
    }
    const double rate = order.inertia ? order.rate : 0.0;
    const Complexes drag = i * (rate * order.mass_damping);
    const Complexes axial = -rate * rate + drag;
    const Complexes straight = -rate * rate - order.spin * order.spin + drag;
    const Complexes across = 2.0 * i * (rate * order.spin);
    for (std::size_t a = 0; a < layer.mass.size(); ++a) {
      const auto row = static_cast<Index>(D * a);
      const double m = layer.mass[a];
      for (Index c = 0; c < D; ++c) z(row + c, row + c) += m * (c < 2 ? straight : axial);
      z(row, row + 1) -= m * across;
      z(row + 1, row) += m * across;
    }
    return z;
  }
  /// Z_(l, l-1), in the plane without the damping of a uniform K.
  [[nodiscard]] Block up(std::size_t l) const { return up(l, false); }
  [[nodiscard]] Block up(std::size_t l, bool conjugate) const {
    Block z = Block::Zero(layers[l].size(), layers[l - 1].size());
    if (D == 3 || !is_uniform())
      add_parts(
          layers[l], [](const auto& part) -> auto& { return part.up; }, conjugate, z);
    else
      add(layers[l].elastic.up, 1.0, z);
    return z;
  }
  /// -Z_(l-1, l), the adjoint of Z_(l, l-1) but for the factors of its parts.
  [[nodiscard]] Block minus_down(std::size_t l, const Block& up_of_l) const {
    if (!is_uniform()) return -up(l, true).adjoint();
    const Complexes back = D == 3 ? elastic() / std::conj(elastic()) : elastic();
    return -back * up_of_l.adjoint();
  }

  /// Factors of the last layer, once those below are gone; those of the others, and T_l, are given
  /// to `take`.
  template <class Take>
  [[nodiscard]] Lu last(Take&& take) const {
    Block here = own(layers[0]);
    for (std::size_t l = 1; l < layers.size(); ++l) {
      const Block next = up(l);
      const Lu lu(std::move(here));
      const Block transfer = lu.solved(minus_down(l, next));
      take(l - 1, lu, transfer);
      here = own(layers[l]);
      if (D == 3 || !is_uniform())
        Lu::add_product(next, transfer, here);
      else
        Lu::add_product(elastic() * next, transfer, here);
    }
    return Lu(std::move(here));
  }

  [[nodiscard]] Vector part(const RollingLayer<D>& layer, const auto& all) const {
    Vector some(layer.size());
    for (std::size_t a = 0; a < layer.rows.size(); ++a)
      some.template segment<D>(static_cast<Index>(D * a)) =
          all.template segment<D>(D * layer.rows[a]);
    return some;
  }
  void put(const RollingLayer<D>& layer, const Vector& some, auto& all) const {
    for (std::size_t a = 0; a < layer.rows.size(); ++a)
      all.template segment<D>(D * layer.rows[a]) =
          some.template segment<D>(static_cast<Index>(D * a));
  }

  /// Takes from the forces on a layer what the displacement of the layer before needs.
  void take_above(std::size_t l, const Eigen::VectorXcd& u, Eigen::VectorXcd& force) const {
    const auto take = [&](const RollingEntries<D>& part, Complexes factor) {
      for (const RollingEntry<D>& e : part.up)
        force.segment<D>(D * layers[l].rows[at(e.row)]) -=
            factor * order.turns[e.shift] *
            (e.block * u.segment<D>(D * layers[l - 1].rows[at(e.column)]));
    };
    for_parts(layers[l], take);
  }
  /// Takes from them what the displacement of the layer after needs.
  void take_below(std::size_t l, const Eigen::VectorXcd& u, Eigen::VectorXcd& force) const {
    const auto take = [&](const RollingEntries<D>& part, Complexes factor) {
      for (const RollingEntry<D>& e : part.up)
        force.segment<D>(D * layers[l].rows[at(e.column)]) -=
            factor * std::conj(order.turns[e.shift]) *
            (e.block.transpose() * u.segment<D>(D * layers[l + 1].rows[at(e.row)]));
    };
    for_parts(layers[l + 1], take);
  }

  [[nodiscard]] Eigen::MatrixXcd eliminate(std::span<Complexes> transfers) const {
    Complexes* to = transfers.data();
    return last([&](std::size_t, const Lu&, const Block& transfer) {
             to = std::copy_n(transfer.data(), transfer.size(), to);
           })
        .inverse();
  }
  void follow(std::span<const Complexes> transfers, Eigen::Ref<Eigen::VectorXcd> u) const {
    const Complexes* from = transfers.data() + transfers.size();
    Vector next = part(layers.back(), u);
    for (std::size_t l = layers.size() - 1; l-- > 0;) {
      const Index rows = layers[l].size(), columns = layers[l + 1].size();
      from -= rows * columns;
      const Vector here = Eigen::Map<const Block>(from, rows, columns) * next;
      put(layers[l], here, u);
      next = here;
    }
  }
};

/// Calls with a Harmonic whose blocks have a size that is known where all layers are of one row, as
/// those of a smooth disk are.
template <int D, class Call>
auto with_harmonic(const RollingLayers<D>& layers, const RollingOrder& order, Call&& call) {
  if constexpr (D == 2)
    if (std::ranges::all_of(layers, [](const auto& l) { return l.rows.size() == 1; }))
      return call(Harmonic<D, D>{layers, order});
  return call(Harmonic<D, Eigen::Dynamic>{layers, order});
}

}  // namespace

template <int D>
RollingLayers<D> rolling_layers(const fem::SectorBlocks<D>& k, std::span<const int> candidates,
                                std::span<const double> mass,
                                std::span<const fem::ViscousPart<fem::SectorBlocks<D>>> viscous) {
  const std::vector<int> distance = distances(k, candidates);
  const int deepest = *std::ranges::max_element(distance);
  RONDO_DEMAND(*std::ranges::min_element(distance) >= 0, deepest);
  RollingLayers<D> layers(static_cast<std::size_t>(deepest) + 1);
  std::vector<Index> place(k.n_local());
  const auto add = [&](int row) {
    const auto a = static_cast<std::size_t>(row);
    RollingLayer<D>& layer = layers[at(deepest - distance[a])];
    place[a] = std::ssize(layer.rows);
    layer.rows.push_back(row);
    layer.mass.push_back(mass[k.node(a, 0)]);
  };
  for (const int row : candidates) add(row);
  for (std::size_t a = 0; a < k.n_local(); ++a)
    if (distance[a] > 0) add(static_cast<int>(a));
  for (RollingLayer<D>& layer : layers) {
    layer.elastic = entries_of(k, layer.rows, distance, place);
    for (const fem::ViscousPart<fem::SectorBlocks<D>>& part : viscous) {
      RONDO_DEMAND(part.stiffness.nodes == k.nodes, part.stiffness.n_local(), k.n_local());
      layer.viscous.push_back(entries_of(part.stiffness, layer.rows, distance, place));
    }
  }
  return layers;
}

template <int D>
std::size_t transfer_size(const RollingLayers<D>& layers) {
  Index size = 0;
  for (std::size_t l = 1; l < layers.size(); ++l) size += layers[l - 1].size() * layers[l].size();
  return static_cast<std::size_t>(size);
}

template <int D>
Eigen::MatrixXcd eliminate(const RollingLayers<D>& layers, const RollingOrder& order,
                           std::span<Complexes> transfers) {
  return with_harmonic(layers, order, [&](const auto& h) { return h.eliminate(transfers); });
}

template <int D>
void follow(const RollingLayers<D>& layers, std::span<const Complexes> transfers,
            Eigen::Ref<Eigen::VectorXcd> u) {
  with_harmonic(layers, RollingOrder{}, [&](const auto& h) { h.follow(transfers, u); });
}

template <int D>
RollingFactors<D>::RollingFactors(const RollingLayers<D>& layers, const RollingOrder& order)
    : order_(order) {
  factors_.push_back(Harmonic<D, Eigen::Dynamic>{layers, order_}.last(
      [&](std::size_t, const auto& lu, const auto&) { factors_.push_back(lu); }));
}

/// From each layer to the next what acts on it; then back.
template <int D>
Eigen::VectorXcd RollingFactors<D>::solve(const RollingLayers<D>& layers,
                                          const Eigen::VectorXcd& force) const {
  const Harmonic<D, Eigen::Dynamic> of{layers, order_};
  Eigen::VectorXcd left = force, u(force.size());
  for (std::size_t l = 0; l < layers.size(); ++l) {
    of.put(layers[l], factors_[l].solved(of.part(layers[l], left)).col(0), u);
    if (l + 1 < layers.size()) of.take_above(l + 1, u, left);
  }
  for (std::size_t l = layers.size() - 1; l-- > 0;) {
    of.take_below(l, u, left);
    of.put(layers[l], factors_[l].solved(of.part(layers[l], left)).col(0), u);
  }
  return u;
}

template <int D>
std::size_t factors_size(const RollingLayers<D>& layers) {
  Index size = 0;
  for (const RollingLayer<D>& layer : layers) size += layer.size() * layer.size();
  return static_cast<std::size_t>(size);
}

/// Re xᴴ (e^{iθ} B) y is, with B real, that of xᴴ B y turned by θ.
template <int D>
RollingNorms norms_of(const RollingLayers<D>& layers, const RollingOrder& order,
                      const Eigen::Ref<const Eigen::VectorXcd>& u) {
  RollingNorms n;
  n.viscous.resize(order.viscous.size());
  const auto form = [&](const RollingEntry<D>& e, int row, int column) {
    const Complexes *x = u.data() + D * row, *y = u.data() + D * column,
                    turn = order.turns[e.shift];
    double re = 0.0, im = 0.0;
    for (Index c = 0; c < D; ++c)
      for (Index r = 0; r < D; ++r) {
        re += e.block(r, c) * (x[r].real() * y[c].real() + x[r].imag() * y[c].imag());
        im += e.block(r, c) * (x[r].real() * y[c].imag() - x[r].imag() * y[c].real());
      }
    return re * turn.real() - im * turn.imag();
  };
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const RollingLayer<D>& layer = layers[l];
    for (std::size_t a = 0; a < layer.rows.size(); ++a)
      n.mass += layer.mass[a] * u.template segment<D>(D * layer.rows[a]).squaredNorm();
    const auto sum = [&](const auto& entries, const std::vector<int>& columns) {
      double all = 0.0;
      for (const RollingEntry<D>& e : entries)
        all += form(e, layer.rows[at(e.row)], columns[at(e.column)]);
      return all;
    };
    const auto add = [&](const RollingEntries<D>& part, double& to) {
      to += sum(part.own, layer.rows);
      if (l > 0) to += 2.0 * sum(part.up, layers[l - 1].rows);
    };
    add(layer.elastic, n.stiffness);
    for (std::size_t p = 0; p < n.viscous.size(); ++p) add(layer.viscous[p], n.viscous[p]);
  }
  return n;
}

template RollingLayers<2> rolling_layers(const fem::SectorBlocks<2>&, std::span<const int>,
                                         std::span<const double>,
                                         std::span<const fem::ViscousPart<fem::SectorBlocks<2>>>);
template std::size_t transfer_size(const RollingLayers<2>&);
template Eigen::MatrixXcd eliminate(const RollingLayers<2>&, const RollingOrder&,
                                    std::span<Complexes>);
template class RollingFactors<2>;
template std::size_t factors_size(const RollingLayers<2>&);
template void follow(const RollingLayers<2>&, std::span<const Complexes>,
                     Eigen::Ref<Eigen::VectorXcd>);
template RollingNorms norms_of(const RollingLayers<2>&, const RollingOrder&,
                               const Eigen::Ref<const Eigen::VectorXcd>&);
template RollingLayers<3> rolling_layers(const fem::SectorBlocks<3>&, std::span<const int>,
                                         std::span<const double>,
                                         std::span<const fem::ViscousPart<fem::SectorBlocks<3>>>);
template std::size_t transfer_size(const RollingLayers<3>&);
template Eigen::MatrixXcd eliminate(const RollingLayers<3>&, const RollingOrder&,
                                    std::span<Complexes>);
template class RollingFactors<3>;
template std::size_t factors_size(const RollingLayers<3>&);
template void follow(const RollingLayers<3>&, std::span<const Complexes>,
                     Eigen::Ref<Eigen::VectorXcd>);
template RollingNorms norms_of(const RollingLayers<3>&, const RollingOrder&,
                               const Eigen::Ref<const Eigen::VectorXcd>&);

}  // namespace rondo::statics
