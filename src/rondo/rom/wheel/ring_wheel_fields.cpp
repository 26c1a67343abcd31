// SPDX-License-Identifier: BSD-3-Clause
/// Fields of all nodes: the start of a run from them, and those after a step.
#include "rondo/rom/wheel/ring_wheel.hpp"

#include <vector>

#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index;

}  // namespace

void RingWheel::begin(const WheelMotion& m) {
  WheelMotion still = m;
  still.angle = m.angle_next - m.spin_next * settings_.dt;
  still.spin_rate = 0.0;
  use_spin(still);
  for (Memory& memory : memory_) memory = {};
  active_.clear();
  for (Modes& s : modes_) {
    s.state.setZero();
    s.force.setZero();
  }
}

/// Places of the nodes near the ground at the start.
void RingWheel::look_at_start(const WheelMotion& m) {
  for (std::size_t h = 0; h < modes_.size(); ++h)
    modes_[h].contact.noalias() =
        harmonics_[h].contact * modes_[h].state.head(harmonics_[h].squares.size());
  find_near(m, 0.0);
  solved_.clear();
  contacts_.clear();
  law_.clear();
  remember(m);
}

void RingWheel::start(const WheelMotion& m) {
  begin(m);
  for (std::size_t h = 0; h < modes_.size(); ++h)
    if (harmonics_[h].k == 0)
      for (Index j = 0; j < harmonics_[h].squares.size(); ++j)
        modes_[h].state[j] = m.spin_next * m.spin_next * harmonics_[h].reference[j] /
                             (harmonics_[h].squares[j] - m.spin_next * m.spin_next);
  look_at_start(m);
}

void RingWheel::start(const WheelMotion& m, std::span<const Vec2> u, std::span<const Vec2> v) {
  begin(m);
  project(m.angle_next, u, false);
  project(m.angle_next, v, true);
  look_at_start(m);
}

/// φᴴ M of a field, harmonic by harmonic.
void RingWheel::project(double angle, std::span<const Vec2> field, bool velocity) {
  const Complex rotation = turned_by(angle);
  for (int j = 0; j < ring_.n_sectors(); ++j) {
    const Complex turn = ring_.stiffness.turn[at(j)];
    for_waves(harmonics_, conj(rotation * turn), [&](std::size_t h, Complex back) {
      const Matrix& shapes = harmonics_[h].shapes;
      const Index r = shapes.cols();
      const Complexes part = Complexes(back.re, back.im) / static_cast<double>(ring_.n_sectors());
      for (Index a = 0; a < ring_.n_rows(); a += 2) {
        const Vec2 x = conj(turn) * field[ring_.stiffness.node(at(a / 2), at(j))];
        const double mass = ring_.mass[at(a / 2)];
        for (Index c = 0; c < r; ++c)
          modes_[h].state[(velocity ? r : 0) + c] +=
              part * mass * (std::conj(shapes(a, c)) * x.x + std::conj(shapes(a + 1, c)) * x.y);
      }
    });
  }
}

/// Rows of a sector whose field is asked for: all, or those of the contact nodes.
struct RingWheel::Rows {
  bool contact;

  [[nodiscard]] const Matrix& shapes(const RingHarmonic& h) const noexcept {
    return contact ? h.contact : h.shapes;
  }
  [[nodiscard]] const std::vector<double>& table(const RingResidual& r) const noexcept {
    return contact ? r.blocks : r.fields;
  }
  [[nodiscard]] Index size(const Ring& ring) const noexcept {
    return contact ? ring.n_contact() : ring.n_rows();
  }
  [[nodiscard]] std::size_t row(const Ring& ring, Index a) const noexcept {
    return contact ? at(ring.contact[at(a / 2)]) : at(a / 2);
  }
};

/// Writes a field of the rows, in the co-rotating frame.
/// @param constant (all rows) part that is the same in all sectors
template <class Coefficients, class Filtered>
void RingWheel::write_field(Rows rows, double angle, const Eigen::VectorXd& constant,
                            Coefficients&& coefficients, Filtered&& filtered,
                            std::span<Vec2> field) const {
  const Index n_rows = rows.size(ring_), size = table_.size;
  Eigen::VectorXd u(n_rows);
  std::vector<Vector> amplitudes;
  for (std::size_t h = 0; h < modes_.size(); ++h)
    amplitudes.emplace_back(harmonics_[h].weight() *
                            (rows.shapes(harmonics_[h]) * coefficients(h)));
  const Complex rotation = turned_by(angle);
  const int n = ring_.n_sectors();
  for (int j = 0; j < n; ++j) {
    const Complex turn = ring_.stiffness.turn[at(j)];
    for (Index a = 0; a < n_rows; ++a)
      u[a] = constant[static_cast<Index>(2 * rows.row(ring_, a)) + a % 2];
    for_waves(harmonics_, rotation * turn, [&](std::size_t h, Complex wave) {
      u += wave.re * amplitudes[h].real() - wave.im * amplitudes[h].imag();
    });
    for (const int node : active_) {
      const Vec2 le = filtered(memory_of(node));
      const int d = (j - sector(node) + n) % n, c = 2 * (node % n_contact_);
      for (std::size_t a = 0; a < model_.residuals.size(); ++a) {
        const Eigen::Map<const Eigen::MatrixXd> all(
            rows.table(model_.residuals[a]).data() + d * size * n_rows, n_rows, size);
        u += shares_[a] * (le.x * all.col(c) + le.y * all.col(c + 1));
      }
    }
    for (Index a = 0; a < n_rows; a += 2)
      field[ring_.stiffness.node(rows.row(ring_, a), at(j))] = turn * Vec2{u[a], u[a + 1]};
  }
}

void RingWheel::displacement(double angle, bool contact_alone, std::span<Vec2> u) const {
  write_field(
      {contact_alone}, angle, table_.centrifugal,
      [&](std::size_t h) { return modes_[h].state.head(harmonics_[h].squares.size()); },
      [](const Memory& memory) { return memory.filtered; }, u);
}

void RingWheel::velocity(double angle, std::span<Vec2> v) const {
  write_field(
      {false}, angle, Eigen::VectorXd::Zero(ring_.n_rows()),
      [&](std::size_t h) {
        const Index r = harmonics_[h].squares.size();
        return Vector(0.5 * (modes_[h].before.tail(r) + modes_[h].state.tail(r)));
      },
      [&](const Memory& memory) {
        return (memory.filtered - memory.filtered_before) / settings_.dt;
      },
      v);
}

}  // namespace rondo::rom
