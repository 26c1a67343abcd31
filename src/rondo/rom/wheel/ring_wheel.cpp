// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/ring_wheel.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::rom {
namespace {

using contact::Status;
using Eigen::Index;

constexpr double near_share = 0.05;        ///< of the radius, above the ground: looked at
constexpr double candidate_share = 0.013;  ///< contact is solved
constexpr double closed = -1e-14;          ///< gaps above it are closed to round-off       [m]
constexpr double nothing = 1e-9;           ///< filtered forces below it are 0            [N/m]
constexpr int most_turns = 3;              ///< of the normals, on ground that is not flat

Complex turned_by(double angle) noexcept {
  return {std::cos(angle), std::sin(angle)};
}
Vec2 tangent_of(Vec2 normal) noexcept {
  return {normal.y, -normal.x};
}

/// Re(a b).
double real_product(Complex a, const std::complex<double>& b) noexcept {
  return a.re * b.real() - a.im * b.imag();
}

/// Calls work(harmonic, e^{ikψ}) for all harmonics, whose k ascend.
template <class Work>
void for_waves(std::span<const RingHarmonic> harmonics, Complex turn, Work&& work) {
  Complex wave{1.0, 0.0};
  int k = 0;
  for (std::size_t h = 0; h < harmonics.size(); ++h) {
    for (; k < harmonics[h].k; ++k) wave = wave * turn;
    work(h, wave);
  }
}

/// Smallest root in [0, 1] of g + b τ + a τ² = 0 with g > 0, a >= 0; 1: there is none.
double landing(double g, double b, double a) noexcept {
  if (b >= 0.0) return 1.0;
  const double inside = b * b - 4.0 * a * g;
  if (inside < 0.0) return 1.0;
  return std::min(1.0, 2.0 * g / (-b + std::sqrt(inside)));
}

}  // namespace

RingWheel::RingWheel(const Ring& ring, std::vector<RingHarmonic> harmonics,
                     std::vector<RingResidual> residuals, std::vector<double> squares,
                     const contact::Ground& ground, double radius, const WheelSettings& settings)
    : ring_(ring),
      harmonics_(std::move(harmonics)),
      residuals_(std::move(residuals)),
      squares_(std::move(squares)),
      ground_(ground),
      radius_(radius),
      settings_(settings),
      n_contact_(static_cast<int>(ring.contact.size())),
      flat_(ground.bends().empty() && !ground.has_concave_corners()),
      gap_law_(ring.contact.size() * at(ring.n_sectors())) {
  RONDO_DEMAND(
      residuals_.size() == squares_.size() && (residuals_.size() == 1 || residuals_.size() == 3),
      residuals_.size(), squares_.size());
  RONDO_DEMAND(settings.dt > 0.0 && radius > 0.0 && settings.theta >= 0.5, settings.dt, radius,
               settings.theta);
  const std::size_t n = ring.contact.size() * at(ring.n_sectors());
  table_.n_sectors = residuals_.front().n_sectors;
  table_.size = residuals_.front().size;
  table_.blocks = residuals_.front().blocks;
  table_.centrifugal = residuals_.front().centrifugal;
  table_before_ = table_;
  compliance_.resize(table_.blocks.size());
  memory_.resize(n);
  active_.reserve(n);
  near_.reserve(n);
  solved_.reserve(n);
  touch_.reserve(n);
  law_.reserve(n);
  before_.reserve(n);
  contacts_.reserve(n);
  for (const RingHarmonic& h : harmonics_) {
    const Index r = h.squares.size(), c = h.contact.rows();
    const auto zero = [](Index size) { return Vector(Vector::Zero(size)); };
    modes_.push_back({zero(2 * r), zero(2 * r), zero(r), zero(r), Matrix::Zero(2 * r, 2 * r),
                      Matrix::Zero(2 * r, r), zero(c), zero(c), zero(2 * r)});
  }
}

/// The residual of a spin.
void RingWheel::set_table(double spin) {
  const double square = spin * spin;
  std::fill(table_.blocks.begin(), table_.blocks.end(), 0.0);
  table_.centrifugal.setZero();
  for (std::size_t a = 0; a < residuals_.size(); ++a) {
    double share = 1.0;
    for (std::size_t b = 0; b < residuals_.size(); ++b)
      if (b != a) share *= (square - squares_[b]) / (squares_[a] - squares_[b]);
    for (std::size_t e = 0; e < table_.blocks.size(); ++e)
      table_.blocks[e] += share * residuals_[a].blocks[e];
    shares_[a] = share;
    table_.centrifugal += share * residuals_[a].centrifugal;
  }
}

/// The matrices of a step, and the answers of the contact nodes at its end.
void RingWheel::use_spin(const WheelMotion& m) {
  const std::array now{m.angle_next - m.angle, m.spin_rate, m.spin_next};
  const bool steady =
      std::abs(m.spin_rate) == 0.0 && has_matrices_ && used_[1] == 0.0 && used_[2] == m.spin_next;
  if (steady) return;
  std::swap(table_before_, table_);
  used_ = now;
  has_matrices_ = true;
  const double dt = settings_.dt;
  const double spin = m.spin_rate == 0.0 ? m.spin_next : now[0] / dt;
  set_table(m.spin_next);
  for (std::size_t h = 0; h < harmonics_.size(); ++h) {
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    const Complexes wander(0.0, -of.k * spin);
    Matrix a = Matrix::Zero(2 * r, 2 * r);
    a.topRightCorner(r, r).setIdentity();
    a.bottomLeftCorner(r, r) = -m.spin_rate * of.coriolis;
    a.bottomRightCorner(r, r) = -2.0 * spin * of.coriolis;
    for (Index j = 0; j < r; ++j) {
      a(j, j) += wander;
      a(r + j, j) -= of.squares[j] - spin * spin;
      a(r + j, r + j) +=
          wander - settings_.mass_damping - settings_.stiffness_damping * of.squares[j];
    }
    const Matrix one = Matrix::Identity(2 * r, 2 * r);
    const Matrix inverse = (one - 0.5 * dt * a).partialPivLu().inverse();
    modes_[h].carry = inverse * (one + 0.5 * dt * a);
    modes_[h].push = dt * inverse.rightCols(r);
  }
  fill_compliance();
}

/// W[lag] = G[lag]/(1 + β/Δt) + the modes' answer.
void RingWheel::fill_compliance() {
  const double lag = settings_.stiffness_damping / settings_.dt;
  const Index size = table_.size;
  for (std::size_t e = 0; e < compliance_.size(); ++e)
    compliance_[e] = table_.blocks[e] / (1.0 + lag);
  const int n = ring_.n_sectors();
  for (std::size_t h = 0; h < harmonics_.size(); ++h) {
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    const Matrix g = settings_.theta * of.weight() / n *
                     (of.contact * modes_[h].push.topRows(r) * of.contact.adjoint());
    for (int d = 0; d < n; ++d) {
      const Complex turn = ring_.stiffness.turn[at(of.k * d % n)];
      Eigen::Map<Eigen::MatrixXd>(compliance_.data() + d * size * size, size, size) +=
          turn.re * g.real() - turn.im * g.imag();
    }
  }
}

Eigen::Map<const Eigen::MatrixXd> RingWheel::compliance(int lag) const noexcept {
  const int d = (lag % ring_.n_sectors() + ring_.n_sectors()) % ring_.n_sectors();
  return {compliance_.data() + d * table_.size * table_.size, table_.size, table_.size};
}
Eigen::Map<const Eigen::MatrixXd> RingWheel::residual(int lag) const noexcept {
  return table_.block(lag);
}

/// 2 × 2 block of a table between two nodes.
RingWheel::Block RingWheel::answer(const double* table, int to, int from) const noexcept {
  const int lag = sector(to) - sector(from);
  const Index size = table_.size, d = lag < 0 ? lag + ring_.n_sectors() : lag;
  const double* block =
      table + d * size * size + 2 * (from % n_contact_) * size + 2 * (to % n_contact_);
  return {block[0], block[size], block[1], block[size + 1]};
}

/// The modes at the end of the step without new forces.
void RingWheel::move_modes(const WheelMotion& m) {
  const double spin = (m.angle_next - m.angle) / settings_.dt;
  const Complexes back(m.pull.x, -m.pull.y);  // conj
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    Modes& s = modes_[h];
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    s.outside.setZero();
    if (of.k == 0) s.outside = spin * spin * of.reference - m.spin_rate * of.turned;
    if (of.k == 1) s.outside -= 0.5 * back * of.translation.conjugate();
    s.before = s.state;
    s.work.head(r) = s.outside + (1.0 - settings_.theta) * s.force;
    s.state.noalias() = s.carry * s.before;
    s.state.noalias() += s.push * s.work.head(r);
    s.contact.noalias() = of.contact * s.state.head(r);
  }
}

/// Displacement of a contact node, in the frame of its sector. @param filter share of the filtered
/// forces that is left at the end of the step
Vec2 RingWheel::displacement(int node, Complex turn, double filter) const {
  const Index c = Index{2} * (node % n_contact_);
  const Index row = Index{2} * ring_.contact[at(node % n_contact_)];
  Vec2 u{table_.centrifugal[row], table_.centrifugal[row + 1]};
  for_waves(harmonics_, turn, [&](std::size_t h, Complex wave) {
    const std::complex<double>* amplitude = modes_[h].contact.data() + c;
    const double weight = harmonics_[h].weight();
    u += weight * Vec2{real_product(wave, amplitude[0]), real_product(wave, amplitude[1])};
  });
  for (const int j : active_)
    u += contact::apply(answer(table_.blocks.data(), node, j), filter * memory_of(j).filtered);
  return u;
}

/// Nodes that are or may come near the ground, and their places without new forces.
void RingWheel::find_near(const WheelMotion& m, double filter) {
  near_.clear();
  const double limit = ground_.top() + near_share * radius_ - m.center_next.y;
  const Complex rotation = turned_by(m.angle_next);
  for (int j = 0; j < ring_.n_sectors(); ++j) {
    const Complex turn = rotation * ring_.stiffness.turn[at(j)];
    for (int c = 0; c < n_contact_; ++c) {
      const int node = j * n_contact_ + c;
      if ((turn * arm(node)).y > limit && memory_of(node).status == Status::open) continue;
      Near near;
      near.node = node;
      near.turn = turn;
      near.free = near.place = turn * (arm(node) + displacement(node, turn, filter));
      near_.push_back(near);
    }
  }
}

/// The distance that a node slides, as a vector, were it at its place without new forces.
Vec2 RingWheel::distance(const Near& near, const WheelMotion& m) const {
  const Memory& was = memory_of(near.node);
  const Vec2 way = m.center_next - m.center;
  if (was.known == 0)  // it comes into sight: as if it only turned
    return way + near.free - conj(turned_by(m.angle_next - m.angle)) * near.free;
  const Vec2 x = was.place[0];
  if (was.known < 2) return way + near.free - x;
  if (settings_.slip == SlipRule::bdf2)
    return (2.0 / 3.0) * (way + 1.5 * near.free - 2.0 * x + 0.5 * was.place[1]);
  if (was.status != Status::open || was.gap[0] <= 0.0) return way + near.free - x;
  const double bend = 0.5 * m.spin_next * m.spin_next * radius_ * settings_.dt * settings_.dt;
  const double tau = landing(was.gap[0], was.gap[0] - was.gap[1] + bend, bend);
  const Vec2 change = x - was.place[1];
  const Vec2 second = was.known < 3 ? Vec2{} : x - 2.0 * was.place[1] + was.place[2];
  const Vec2 before = tau * (change + 0.5 * second) + 0.5 * tau * tau * second;
  return (1.0 - tau) * way + near.free - x - before;
}

/// Nodes that are low enough, or were pressed.
void RingWheel::add_candidates(const WheelMotion& m) {
  solved_.clear();
  touch_.clear();
  for (std::size_t i = 0; i < near_.size(); ++i) {
    Near& near = near_[i];
    const contact::Touch touch = ground_.facet_near(m.center_next + near.place);
    near.candidate |=
        touch.gap < candidate_share * radius_ || memory_of(near.node).status != Status::open;
    if (!near.candidate) continue;
    solved_.push_back(i);
    touch_.push_back(touch);
  }
}

/// The law of the candidates, with the facets that are nearest to their places.
void RingWheel::fill_law(const WheelMotion& m) {
  const std::size_t n = solved_.size();
  law_.resize(n);
  auto w = gap_law_.compliance(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Near& near = near_[solved_[i]];
    const Memory& was = memory_of(near.node);
    const Vec2 normal = touch_[i].normal, tangent = tangent_of(normal);
    GapContact& c = law_[i];
    c = {};
    c.free_gap = touch_[i].gap + dot(normal, near.free - near.place);
    c.free_slip = dot(tangent, distance(near, m));
    c.status = was.status;
    c.side = was.side;
    const Vec2 to_normal = conj(near.turn) * normal, to_tangent = conj(near.turn) * tangent;
    const auto row = static_cast<Index>(2 * i);
    for (std::size_t j = 0; j < n; ++j) {
      const Near& other = near_[solved_[j]];
      const Block g = answer(compliance_.data(), near.node, other.node);
      const Vec2 pushed = contact::apply(g, conj(other.turn) * touch_[j].normal),
                 pulled = contact::apply(g, conj(other.turn) * tangent_of(touch_[j].normal));
      const auto column = static_cast<Index>(2 * j);
      w(row, column) = dot(to_normal, pushed);
      w(row + 1, column) = dot(to_tangent, pushed);
      w(row, column + 1) = dot(to_normal, pulled);
      w(row + 1, column + 1) = dot(to_tangent, pulled);
    }
  }
}

/// Places of all near nodes under the forces.
void RingWheel::place_all() {
  for (Near& near : near_) near.place = near.free;
  for (std::size_t j = 0; j < solved_.size(); ++j) {
    if (law_[j].normal == 0.0 && law_[j].shear == 0.0) continue;
    const Near& from = near_[solved_[j]];
    const Vec2 normal = touch_[j].normal;
    const Vec2 force =
        conj(from.turn) * (law_[j].normal * normal + law_[j].shear * tangent_of(normal));
    for (Near& near : near_) {
      near.place +=
          near.turn * contact::apply(answer(compliance_.data(), near.node, from.node), force);
    }
  }
}

/// Nodes that were left out and are now in the ground become candidates. False: there are none.
bool RingWheel::join(const WheelMotion& m) {
  bool joined = false;
  for (Near& near : near_)
    if (!near.candidate && ground_.facet_near(m.center_next + near.place).gap < closed)
      joined = near.candidate = true;
  return joined;
}

/// Whether a candidate is now at another facet, or elsewhere on an arc.
bool RingWheel::turn_normals(const WheelMotion& m) const {
  bool turned = false;
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const contact::Touch touch = ground_.facet_near(m.center_next + near_[solved_[i]].place);
    const Vec2 change = touch.normal - touch_[i].normal;
    turned |= dot(change, change) > 1e-20;
  }
  return turned;
}

void RingWheel::solve(const WheelMotion& m, double friction, WheelReport& report) {
  if (!flat_) {  // the forces of before tell where nodes about are
    law_.clear();
    touch_.clear();
    solved_.clear();
    for (std::size_t i = 0; i < near_.size(); ++i) {
      const Vec2 force = near_[i].turn * memory_of(near_[i].node).force;
      if (force == Vec2{}) continue;
      solved_.push_back(i);
      touch_.push_back({0.0, force});
      law_.push_back({});
      law_.back().normal = 1.0;
    }
    place_all();
  }
  for (int turn = 0; turn < most_turns; ++turn) {
    add_candidates(m);
    report.candidates = static_cast<int>(solved_.size());
    if (solved_.empty()) return;
    fill_law(m);
    const GapLaw::Report solved = gap_law_.solve(law_, friction);
    report.iterations += solved.iterations;
    report.pivoted |= solved.pivoted;
    report.law_residual = solved.residual;
    report.free = 0.0;
    for (const GapContact& c : law_)
      report.free = std::max(report.free, std::hypot(std::min(0.0, c.free_gap), c.free_slip));
    place_all();
    if (join(m)) {
      turn = -1;  // as many nodes can join as there are
      continue;
    }
    if (flat_ || !turn_normals(m)) return;
  }
}

/// Forces of the ground, and what they do to the modes and to the residual.
void RingWheel::take_forces(WheelReport& report) {
  const double lag = settings_.stiffness_damping / settings_.dt;
  for (const int node : active_) {
    Memory& memory = memory_of(node);
    memory.filtered_before = memory.filtered;
    memory.filtered = lag / (1.0 + lag) * memory.filtered;
  }
  contacts_.clear();
  for (Modes& s : modes_) s.force.setZero();
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const GapContact& c = law_[i];
    if (c.normal == 0.0 && c.shear == 0.0) continue;
    const Near& near = near_[solved_[i]];
    const Vec2 normal = touch_[i].normal;
    const Vec2 force = c.normal * normal + c.shear * tangent_of(normal);
    contacts_.push_back({near.node, normal, force, c.gap, c.slip, c.status});
    report.force += force;
    report.torque += cross(near.place, force);
    const Vec2 own = conj(near.turn) * force;
    Memory& memory = memory_of(near.node);
    if (memory.filtered == Vec2{} && memory.filtered_before == Vec2{})
      active_.insert(std::ranges::lower_bound(active_, near.node), near.node);
    memory.filtered += 1.0 / (1.0 + lag) * own;
    const Index row = Index{2} * (near.node % n_contact_);
    const Vec2 part = own / static_cast<double>(ring_.n_sectors());
    for_waves(harmonics_, near.turn, [&](std::size_t h, Complex wave) {
      const Matrix& shape = harmonics_[h].contact;
      for (Index j = 0; j < shape.cols(); ++j) {
        const std::complex<double> x = shape(row, j) * part.x + shape(row + 1, j) * part.y;
        // conj(e^{ikψ} x)
        modes_[h].force[j] +=
            Complexes(real_product(wave, x), -(wave.re * x.imag() + wave.im * x.real()));
      }
    });
  }
  for (Modes& s : modes_) s.state.noalias() += settings_.theta * (s.push * s.force);
  report.contacts = contacts_;
}

/// Σ aᵀ G b of the filtered forces at both ends of the step.
RingWheel::Products RingWheel::products(const RingResidual& table) const {
  Products sum;
  for (const int i : active_)
    for (const int j : active_) {
      const Memory &to = memory_of(i), &from = memory_of(j);
      const Block g = answer(table.blocks.data(), i, j);
      const Vec2 now = contact::apply(g, from.filtered),
                 before = contact::apply(g, from.filtered_before);
      sum.end += dot(to.filtered, now);
      sum.across += dot(to.filtered, before);
      sum.start += dot(to.filtered_before, before);
    }
  return sum;
}

/// Work of the forces at one end of a step on the mean velocity of the modes, over Δt.
double RingWheel::work_on_modes(double angle, bool at_end) const {
  const Complex rotation = turned_by(angle);
  double power = 0.0;
  const auto add = [&](int node, Vec2 force) {
    const Complex turn = rotation * ring_.stiffness.turn[at(sector(node))];
    const Index c = Index{2} * (node % n_contact_);
    for_waves(harmonics_, turn, [&](std::size_t h, Complex wave) {
      const std::complex<double>* rate = modes_[h].middle.data() + c;
      power += harmonics_[h].weight() *
               (real_product(wave, rate[0]) * force.x + real_product(wave, rate[1]) * force.y);
    });
  };
  if (at_end) {
    for (const WheelContact& c : contacts_)
      add(c.node, conj(rotation * ring_.stiffness.turn[at(sector(c.node))]) * c.force);
  } else {
    for (const Near& near : near_)
      if (memory_of(near.node).force != Vec2{}) add(near.node, memory_of(near.node).force);
  }
  return power;
}

/// Energy of the modes and what is done to them, but for the forces of the ground.
void RingWheel::account_modes(const WheelMotion& m, WheelEnergy& e) const {
  const double dt = settings_.dt, spin = (m.angle_next - m.angle) / dt;
  const double softened = m.spin_next * m.spin_next;
  const double before = m.spin_next - dt * m.spin_rate;
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const Modes& s = modes_[h];
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    const double n = of.weight() * ring_.n_sectors();
    for (Index j = 0; j < r; ++j) {
      const Complexes p = 0.5 * (s.before[r + j] + s.state[r + j]);
      const double middle = std::norm(p);
      e.kinetic += 0.5 * n * std::norm(s.state[r + j]);
      e.elastic += 0.5 * n * (of.squares[j] - softened) * std::norm(s.state[j]);
      e.by_mass += n * dt * settings_.mass_damping * middle;
      e.by_stiffness += n * dt * settings_.stiffness_damping * of.squares[j] * middle;
      e.frame += n * dt * (std::conj(p) * s.outside[j]).real();
      if (m.spin_rate == 0.0) continue;
      e.frame -= 0.5 * n *
                 ((softened - spin * spin) * std::norm(s.state[j]) +
                  (spin * spin - before * before) * std::norm(s.before[j]));
      for (Index l = 0; l < r; ++l)
        e.frame -= n * dt * m.spin_rate *
                   (std::conj(p) * of.coriolis(j, l) * 0.5 * (s.before[l] + s.state[l])).real();
    }
  }
}

void RingWheel::account(const WheelMotion& m, WheelReport& report) {
  const double dt = settings_.dt;
  WheelEnergy& e = report.energy;
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    Modes& s = modes_[h];
    const Index r = harmonics_[h].squares.size();
    s.work.head(r) = 0.5 * (s.before.tail(r) + s.state.tail(r));
    s.middle.noalias() = harmonics_[h].contact * s.work.head(r);
  }
  account_modes(m, e);
  const Products of = products(table_);
  e.residual = 0.5 * of.end;
  if (m.spin_rate != 0.0) e.frame += 0.5 * (of.start - products(table_before_).start);
  e.by_residual = settings_.stiffness_damping / dt * (of.end - 2.0 * of.across + of.start);
  const double slides = settings_.slip == SlipRule::bdf2 ? 1.5 : 1.0;
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const Near& near = near_[solved_[i]];
    const GapContact& c = law_[i];
    const Memory& was = memory_of(near.node);
    const double before = dot(tangent_of(touch_[i].normal), near.turn * was.force);
    e.friction -= 0.5 * slides * (before + c.shear) * c.slip;
    if (was.known > 0) e.arrival += c.normal * (was.gap[0] - c.gap);
  }
  e.rim = dot(report.force, m.center_next - m.center) + (m.angle_next - m.angle) * report.torque;
  const double work = dt * (settings_.theta * work_on_modes(m.angle_next, true) +
                            (1.0 - settings_.theta) * work_on_modes(m.angle, false));
  e.scheme = work + 0.5 * (of.end - of.start) + e.by_residual + e.friction + e.arrival + e.rim;
}

/// Places, gaps, statuses and forces at the end of the step.
void RingWheel::remember() {
  std::erase_if(active_, [&](int node) {
    Memory& memory = memory_of(node);
    const bool gone = dot(memory.filtered, memory.filtered) < nothing * nothing;
    if (gone) memory.filtered = memory.filtered_before = {};
    return gone;
  });
  std::size_t i = 0, c = 0, l = 0;
  for (std::size_t node = 0; node < memory_.size(); ++node) {
    Memory& memory = memory_[node];
    memory.force = {};
    memory.side = 0.0;
    memory.status = Status::open;
    if (i == near_.size() || at(near_[i].node) != node) {
      memory.known = 0;
      continue;
    }
    const Near& near = near_[i];
    memory.place = {near.place, memory.place[0], memory.place[1]};
    memory.gap[1] = memory.gap[0];
    memory.known = std::min(3, memory.known + 1);
    if (l < solved_.size() && solved_[l] == i) {
      memory.status = law_[l].status;
      memory.side = law_[l].side;
      ++l;
    }
    if (c < contacts_.size() && at(contacts_[c].node) == node)
      memory.force = conj(near.turn) * contacts_[c++].force;
    ++i;
  }
}

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
  remember();
  for (const Near& near : near_)
    memory_of(near.node).gap[0] = ground_.facet_near(m.center_next + near.place).gap;
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

WheelEnergy RingWheel::energy_at_start() const {
  WheelEnergy e;
  for (std::size_t h = 0; h < modes_.size(); ++h)
    for (Index j = 0; j < harmonics_[h].squares.size(); ++j)
      e.elastic += 0.5 * harmonics_[h].weight() * ring_.n_sectors() *
                   (harmonics_[h].squares[j] - used_[2] * used_[2]) * std::norm(modes_[h].state[j]);
  return e;
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
      for (std::size_t a = 0; a < residuals_.size(); ++a) {
        const Eigen::Map<const Eigen::MatrixXd> all(
            rows.table(residuals_[a]).data() + d * size * n_rows, n_rows, size);
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

WheelReport RingWheel::step(const WheelMotion& m) {
  const double lag = settings_.stiffness_damping / settings_.dt;
  WheelReport report;
  use_spin(m);
  move_modes(m);
  find_near(m, lag / (1.0 + lag));
  solved_.clear();
  law_.clear();
  solve(m, settings_.friction, report);
  take_forces(report);
  account(m, report);
  remember();
  for (const Near& near : near_)
    memory_of(near.node).gap[0] = ground_.facet_near(m.center_next + near.place).gap;
  return report;
}

namespace {

void put(const Eigen::VectorXcd& from, std::vector<double>& to) {
  for (const std::complex<double>& x : from) to.insert(to.end(), {x.real(), x.imag()});
}

/// Reads numbers one after the other.
class Reader {
 public:
  explicit Reader(std::span<const double> numbers) : left_(numbers) {}
  double next() {
    RONDO_DEMAND(!left_.empty());
    const double x = left_.front();
    left_ = left_.subspan(1);
    return x;
  }
  Vec2 vec() {
    const double x = next();
    return {x, next()};
  }
  void fill(Eigen::VectorXcd& to) {
    for (std::complex<double>& x : to) {
      const Vec2 parts = vec();
      x = {parts.x, parts.y};
    }
  }

 private:
  std::span<const double> left_;
};

}  // namespace

std::size_t RingWheel::n_numbers() const noexcept {
  Index n = 1;
  for (const Modes& s : modes_) n += 2 * (s.state.size() + s.force.size());
  return static_cast<std::size_t>(n) + numbers_of_node * memory_.size();
}

std::vector<double> RingWheel::save() const {
  std::vector<double> out{used_[2]};
  out.reserve(n_numbers());
  for (const Modes& s : modes_) {
    put(s.state, out);
    put(s.force, out);
  }
  for (const Memory& m : memory_) {
    for (const Vec2 x : {m.force, m.filtered, m.place[0], m.place[1], m.place[2]})
      out.insert(out.end(), {x.x, x.y});
    out.insert(out.end(), {m.gap[0], m.gap[1], static_cast<double>(m.known),
                           static_cast<double>(m.status), m.side});
  }
  return out;
}

void RingWheel::restore(std::span<const double> numbers) {
  RONDO_DEMAND(numbers.size() == n_numbers(), numbers.size(), n_numbers());
  Reader from(numbers);
  used_[2] = from.next();
  set_table(used_[2]);
  has_matrices_ = false;
  for (Modes& s : modes_) {
    from.fill(s.state);
    from.fill(s.force);
  }
  active_.clear();
  for (std::size_t node = 0; node < memory_.size(); ++node) {
    Memory& m = memory_[node];
    m = {};
    m.force = from.vec();
    m.filtered = m.filtered_before = from.vec();
    for (Vec2& place : m.place) place = from.vec();
    for (double& gap : m.gap) gap = from.next();
    m.known = static_cast<int>(from.next());
    m.status = static_cast<Status>(static_cast<int>(from.next()));
    m.side = from.next();
    if (m.filtered != Vec2{}) active_.push_back(static_cast<int>(node));
  }
}

}  // namespace rondo::rom
