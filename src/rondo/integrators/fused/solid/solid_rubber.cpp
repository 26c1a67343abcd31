// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/solid/solid_rubber.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/finite/rubber_hexahedron.hpp"

namespace rondo::dynamics {
namespace {

using Eigen::Index;
using fem::finite::SweptRubber;
using kernels::n_solid_modes;
using kernels::SolidRubberElement;

using kernels::lanes;

/// Corners in the order of the hexahedron, and which coordinates are in the product of a mode.
constexpr std::array<std::array<int, 3>, 8> corner_signs{{{-1, -1, -1},
                                                          {1, -1, -1},
                                                          {1, 1, -1},
                                                          {-1, 1, -1},
                                                          {-1, -1, 1},
                                                          {1, -1, 1},
                                                          {1, 1, 1},
                                                          {-1, 1, 1}}};
constexpr std::array<std::array<bool, 3>, n_solid_modes> coordinates{{{true, false, false},
                                                                      {false, true, false},
                                                                      {false, false, true},
                                                                      {true, true, false},
                                                                      {false, true, true},
                                                                      {true, false, true},
                                                                      {true, true, true}}};

/// The points are at ξ = ±1/√3: each coordinate but that of the derivative gives a 1/√3.
const kernels::SolidModeShares shares{0.125, 0.125 / std::sqrt(3.0), 0.125 / 3.0};

double share_of(std::size_t mode) noexcept {
  const auto n = std::ranges::count(coordinates[mode], true);
  return n == 1 ? shares.one : n == 2 ? shares.two : shares.three;
}

double sign_of(std::size_t mode, std::size_t corner) noexcept {
  int sign = 1;
  for (std::size_t i = 0; i < 3; ++i)
    if (coordinates[mode][i]) sign *= corner_signs[corner][i];
  return sign;
}

void write_modes(const fem::HexahedronCorners& x, double* to) noexcept {
  for (std::size_t m = 0; m < n_solid_modes; ++m) {
    Vec3 sum;
    for (std::size_t a = 0; a < 8; ++a) sum += sign_of(m, a) * x[a];
    sum = share_of(m) * sum;
    to[3 * m] = sum.x, to[3 * m + 1] = sum.y, to[3 * m + 2] = sum.z;
  }
}

/// With v = share Σ sign u: u = Σ sign v / (8 share) and a mean, on which no force depends.
void write_stiffness(const Eigen::Matrix<double, 24, 24>& k, double* to) {
  constexpr Index n = 3 * n_solid_modes;
  Eigen::Matrix<double, 24, n> by = Eigen::Matrix<double, 24, n>::Zero();
  for (std::size_t m = 0; m < n_solid_modes; ++m)
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t i = 0; i < 3; ++i)
        by(static_cast<Index>(3 * a + i), static_cast<Index>(3 * m + i)) =
            sign_of(m, a) / (8.0 * share_of(m));
  const Eigen::Matrix<double, n, n> of_modes = by.transpose() * k * by;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) to[n * i + j] = 0.5 * (of_modes(i, j) + of_modes(j, i));
}

void write(const Eigen::Matrix3d& a, double (&to)[6]) noexcept {
  to[0] = a(0, 0), to[1] = a(1, 1), to[2] = a(2, 2);
  to[3] = a(0, 1), to[4] = a(1, 2), to[5] = a(2, 0);
}

/// ∂ξ_i/∂X_j at a point: the coordinates of the corners are those of the element.
Eigen::Matrix3d inverse_tangents(const fem::HexahedronPoints& points, std::size_t q) noexcept {
  Eigen::Matrix3d of = Eigen::Matrix3d::Zero();
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        of(static_cast<Index>(i), static_cast<Index>(j)) +=
            corner_signs[a][i] * points.gradient[a][j][q];
  return of;
}

void write_points(const fem::HexahedronPoints& points, SolidRubberElement& e) {
  e.whole_volume = 0.0;
  for (std::size_t q = 0; q < 8; ++q) {
    const auto& s = corner_signs[q];  // the points have the order of the corners
    const std::size_t to = (s[0] > 0 ? 1U : 0U) + (s[1] > 0 ? 2U : 0U) + (s[2] > 0 ? 4U : 0U);
    const Eigen::Matrix3d slope = inverse_tangents(points, q);
    const Eigen::Matrix3d metric = slope * slope.transpose();
    write(metric, e.metric[to]);
    write(metric.determinant() * metric.inverse(), e.cometric[to]);
    e.volume[to] = points.volume[q];
  }
  for (const double volume : e.volume) e.whole_volume += volume;
}

class ElementMaker {
 public:
  ElementMaker(const Model& model, const RingLayout& layout)
      : model_(model),
        layout_(layout),
        row_of_(rows_of_nodes(layout)),
        axes_(model.solid->sector.turn[0] * Complex{0.0, -1.0}),
        next_(conj(model.solid->sector.turn[0]) * model.solid->sector.turn[1]) {}

  SolidRubberElement element(const SweptRubber& rubber, std::size_t k) const {
    const fem::Rubber& law = rubber.rubbers[at(rubber.rubber[k])];
    RONDO_DEMAND(law.law != fem::RubberLaw::ogden, k);
    SolidRubberElement e{};
    fem::HexahedronCorners x, u;
    for (std::size_t a = 0; a < 8; ++a) {
      const std::size_t node = at(rubber.corner[k][a % 4]);
      const Complex turn = a >= 4 ? next_ : Complex{1.0, 0.0};
      x[a] = turn * (conj(axes_) * Vec3(model_.reference[node], model_.solid->axial[node]));
      u[a] = turn * rubber.u[node];
      e.corner[a] = corner(row_of_[node], a >= 4, turn);
    }
    write_modes(x, e.rest);
    write_points(rubber.points[k], e);
    write_stiffness(fem::finite::rubber_hexahedron(rubber.points[k], u, law).stiffness,
                    e.stiffness);
    e.bulk = law.bulk_modulus;
    e.c10 = law.c10, e.c20 = law.c20, e.c30 = law.c30, e.c01 = law.c01;
    return e;
  }

 private:
  [[nodiscard]] kernels::SolidFaceCorner corner(int row, bool next, Complex turn) const noexcept {
    if (row < 0) return {-1, -1, 1.0, 0.0};
    const Complex frame = turn * Complex{0.0, 1.0} * layout_.frame[at(row)];
    return {row * layout_.row_size() + (next ? 1 : 0),
            SolidRubberPlan::place(row, layout_) + (next ? 3 : 0) * layout_.stride, frame.re,
            frame.im};
  }

  const Model& model_;
  const RingLayout& layout_;
  std::vector<int> row_of_;
  Complex axes_;  ///< of sector 0: outwards, around
  Complex next_;
};

}  // namespace

SolidRubberPlan make_rubber_plan(const Model& model, const RingLayout& layout,
                                 const kernels::SolidTable& table) {
  RONDO_DEMAND(model.solid && model.solid->swept && model.solid->swept->rubber, layout.stride);
  const SweptRubber& rubber = *model.solid->swept->rubber;
  SolidRubberPlan plan;
  plan.window = model.solid->swept->window;
  const ElementMaker maker(model, layout);
  for (std::size_t k = 0; k < rubber.corner.size(); ++k) {
    plan.elements.push_back(maker.element(rubber, k));
    table.rubber_state(plan.elements.back());
  }
  return plan;
}

SolidWindow::SolidWindow(const SolidRubberPlan& plan, const RingLayout& layout,
                         const CyclicChunkRange& range)
    : plan_(plan),
      layout_(layout),
      range_(range),
      own_packs_((range.columns + lanes - 1) / lanes),
      alone_(layout.cut.halo == Halo::ring),
      force_(static_cast<std::size_t>(RingLayout::lead + 6 * layout.n_local * layout.stride +
                                      halo_columns)),
      of_wheel_(at(layout.n_sectors)),
      weight_(at((own_packs_ + 1) * lanes)),
      mask_(weight_.size()),
      energy_(weight_.size()),
      weight_before_(at(range.columns)),
      energy_before_(at(range.columns)),
      shown_(at(own_packs_)) {
  packs_.reserve(at(own_packs_ + 1));
  cleared_.reserve(at(own_packs_ + 1));
}

bool SolidWindow::has_weight(int pack) const noexcept {
  if (pack < (alone_ ? 0 : -1) || pack >= own_packs_) return false;
  const auto first = weight_.begin() + (pack + 1) * lanes;
  return std::any_of(first, first + lanes, [](double w) { return w != 0.0; });
}

/// A node takes from its own column and from that before.
void SolidWindow::find_packs() noexcept {
  packs_.clear();
  cleared_.clear();
  for (int pack = alone_ ? 0 : -1; pack < own_packs_; ++pack) {
    const bool here = has_weight(pack),
               last = pack == 0 ? weight_[lanes - 1] != 0.0 : has_weight(pack - 1);
    if (here) packs_.push_back(pack);
    if (here || last || has_weight(pack + 1)) cleared_.push_back(pack);
    if (pack >= 0) shown_[at(pack)] = here || last ? 1 : 0;
  }
}

void SolidWindow::find(const kernels::SolidTable& table, const double* now, double angle) noexcept {
  for (std::size_t c = 0; c < weight_before_.size(); ++c) {
    weight_before_[c] = weight_[c + lanes];
    energy_before_[c] = energy_[c + lanes];
  }
  plan_.window.find(angle, of_wheel_);
  const int n = layout_.n_sectors;
  for (int c = -1; c < range_.columns; ++c) {
    const double w = of_wheel_[at((range_.first + c + n) % n)];
    weight_[at(c + lanes)] = w;
    mask_[at(c + lanes)] = w != 0.0 ? 1.0 : 0.0;
  }
  find_packs();
  std::ranges::fill(energy_, 0.0);
  kernels::SolidRubber s{};
  s.elements = plan_.elements.data();
  s.n_elements = static_cast<int>(plan_.elements.size());
  s.shares = shares;
  s.packs = packs_.data();
  s.n_packs = static_cast<int>(packs_.size());
  s.cleared = cleared_.data();
  s.n_cleared = static_cast<int>(cleared_.size());
  s.weight = weight_.data() + lanes;
  s.mask = mask_.data() + lanes;
  s.now = now;
  s.force = force_.data() + RingLayout::lead;
  s.n_rows = 6 * layout_.n_local;
  s.stride = layout_.stride;
  s.energy = energy_.data() + lanes;
  table.rubber(s);
  if (alone_) close_ring();
}

/// Before the first column there is the last.
void SolidWindow::close_ring() noexcept {
  if (shown_.front() == 0) return;
  const bool is_there = weight_[lanes - 1] != 0.0;
  double* before = force_.data() + RingLayout::lead - 1;
  for (int k = 0; k < 6 * layout_.n_local; ++k, before += layout_.stride)
    *before = is_there ? before[range_.columns] : 0.0;
}

void SolidWindow::add_sums(double* sums, int of_energy, int of_window) const noexcept {
  for (int c = 0; c < range_.columns; ++c) {
    const double w = weight_[at(c + lanes)], e = energy_[at(c + lanes)];
    double* const to = sums + c / layout_.group_columns * layout_.n_sums * lanes + c % lanes;
    to[of_energy * lanes] += 2.0 * w * e;
    to[of_window * lanes] += (w - weight_before_[at(c)]) * (e + energy_before_[at(c)]);
  }
}

void SolidWindow::save(std::span<double> numbers) const noexcept {
  for (int c = 0; c < range_.columns; ++c) {
    const std::size_t of = at(range_.first + c);
    numbers[of] = weight_[at(c + lanes)];
    numbers[of + of_wheel_.size()] = energy_[at(c + lanes)];
  }
}

void SolidWindow::restore(std::span<const double> numbers) noexcept {
  for (int c = 0; c < range_.columns; ++c) {
    const std::size_t of = at(range_.first + c);
    weight_[at(c + lanes)] = numbers[of];
    energy_[at(c + lanes)] = numbers[of + of_wheel_.size()];
  }
}

}  // namespace rondo::dynamics
