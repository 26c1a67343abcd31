// SPDX-License-Identifier: BSD-3-Clause
#include "baseline.hpp"

#include <array>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/core/threads.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/model/contact_node.hpp"

namespace rondo::bench {
namespace {

using dynamics::Model;
using dynamics::State;
using Eigen::Index;
using Eigen::VectorXd;

Vec2 at(const VectorXd& x, std::size_t node) noexcept {
  const auto i = static_cast<Index>(2 * node);
  return {x[i], x[i + 1]};
}

void set(VectorXd& x, std::size_t node, Vec2 value) noexcept {
  const auto i = static_cast<Index>(2 * node);
  x[i] = value.x;
  x[i + 1] = value.y;
}

/// Data that all nodes of a step share.
struct Constants {
  Constants(const Model& model, const dynamics::FrameStep& frame,
            const dynamics::VelocityUpdate& update) noexcept
      : spin{-frame.spin * frame.spin, frame.spin_rate},
        pull(frame.pull.plane()),
        inverse(Complex{1.0, 0.0} / update.a),
        drag(update.drag),
        dt(model.dt),
        inverse_dt(1.0 / model.dt),
        alpha(model.mass_damping),
        beta(model.stiffness_damping) {}

  Complex spin;
  Vec2 pull;
  Complex inverse, drag;
  double dt, inverse_dt, alpha, beta;
};

/// Acceleration of the frame (3.1) and K v⁻ at a node.
struct Forces {
  Vec2 frame, stiffness_rate;
};

/// v⁺ without contact (3.4).
Vec2 free_velocity(const Constants& c, const Forces& f, Vec2 force, double inverse_mass,
                   Vec2 v) noexcept {
  const Vec2 acceleration = -(inverse_mass * (force + c.beta * f.stiffness_rate)) - f.frame;
  return v + c.inverse * (c.dt * acceleration - c.drag * v);
}

/// Works of a step at a node (5.3) [J/m].
struct NodeWorks {
  double frame, mass, stiffness;
};

NodeWorks works_of(const Constants& c, const Forces& f, double mass, Vec2 v, Vec2 next) noexcept {
  const Vec2 mean = 0.5 * (v + next);
  return {-c.dt * mass * dot(mean, f.frame), c.dt * c.alpha * mass * dot(mean, mean),
          c.dt * c.beta * dot(mean, f.stiffness_rate)};
}

class CsrSteps final : public dynamics::Integrator {
 public:
  CsrSteps(const Model& model, const CsrMatrix& k, const State& start)
      : model_(model), k_(k), n_(model.free.size()), partial_(n_blocks(n_)), step_(start.step) {
    RONDO_DEMAND(model.scheme == dynamics::Scheme::symplectic);
    for (VectorXd* x : {&reference_, &u_, &v_, &v_next_, &force_, &force_before_})
      x->resize(static_cast<Index>(2 * n_));
    mass_.resize(static_cast<Index>(n_));
    inverse_mass_.resize(static_cast<Index>(n_));
    std::vector<std::size_t> place(model.n_nodes());
    for (std::size_t i = 0; i < n_; ++i) {
      const auto node = static_cast<std::size_t>(model.free[i]);
      place[node] = i;
      set(reference_, i, model.reference[node]);
      set(u_, i, start.u.plane()[node]);
      set(v_, i, start.v.plane()[node]);
      set(v_next_, i, start.v_next.plane()[node]);
      mass_[static_cast<Index>(i)] = model.mass[node];
      inverse_mass_[static_cast<Index>(i)] = 1.0 / model.mass[node];
    }
    multiply(k_, u_, force_, model.threads);
    if (!model.contact) return;
    for (const int node : model.contact->nodes)
      candidates_.push_back(place[static_cast<std::size_t>(node)]);
    active_.reserve(2 * candidates_.size());
  }

  void advance(std::span<dynamics::StepReport> reports, State* last) noexcept override {
    for (dynamics::StepReport& report : reports) report = one_step();
    if (!last) return;
    last->step = step_;
    last->frame = frame_;
    last->active = active_;
    fields(*last);
    for (std::size_t i = 0; i < n_; ++i)
      last->v.plane()[static_cast<std::size_t>(model_.free[i])] = at(v_, i);
  }

  void fields(State& state) const noexcept override {
    for (std::size_t i = 0; i < n_; ++i) {
      const auto k = static_cast<std::size_t>(model_.free[i]);
      state.u.plane()[k] = at(u_, i);
      state.v_next.plane()[k] = at(v_next_, i);
    }
  }

 private:
  dynamics::StepReport one_step() noexcept {
    v_.swap(v_next_);
    frame_ = dynamics::frame_step(model_.motion, ++step_, model_.dt);
    dynamics::StepEnergy energy = displace();
    force_.swap(force_before_);
    multiply(k_, u_, force_, model_.threads);
    const dynamics::VelocityUpdate update =
        dynamics::velocity_update(model_.scheme, model_.dt, model_.mass_damping, frame_.spin);
    const Constants c(model_, frame_, update);
    update_velocities(c, energy.works);
    dynamics::StepReport report;
    report.step = step_;
    report.frame = frame_;
    if (model_.contact) report.contact = solve_contact(c, update, energy.works);
    set_contact_works(report.contact, energy.works);
    ledger_.add(energy);
    report.balance = ledger_.last();
    return report;
  }

  /// Computes u_{n+1} and the energy before the step (5.1).
  dynamics::StepEnergy displace() noexcept {
    double* u = u_.data();
    const double *v = v_.data(), *force = force_.data(), *mass = mass_.data();
    for_blocks(n_, model_.threads, [&](std::size_t begin, std::size_t end, std::size_t block) {
      double kinetic = 0.0, strain = 0.0;
      const double dt = model_.dt;
#pragma omp simd reduction(+ : kinetic, strain)
      for (std::size_t i = begin; i < end; ++i) {
        const double vx = v[2 * i], vy = v[2 * i + 1];
        const double ux = u[2 * i] + dt * vx, uy = u[2 * i + 1] + dt * vy;
        u[2 * i] = ux;
        u[2 * i + 1] = uy;
        kinetic += mass[i] * (vx * vx + vy * vy);
        strain += ux * force[2 * i] + uy * force[2 * i + 1];
      }
      partial_[block] = {0.5 * kinetic, 0.5 * strain, 0.0};
    });
    const auto sum = total();
    dynamics::StepEnergy energy;
    energy.kinetic = sum[0];
    energy.strain = sum[1];
    return energy;
  }

  [[nodiscard]] Forces forces(const Constants& c, std::size_t i) const noexcept {
    return {c.spin * (at(reference_, i) + at(u_, i)) + c.pull,
            c.inverse_dt * (at(force_, i) - at(force_before_, i))};
  }

  /// Computes v_{n+3/2} without contact, and its works.
  void update_velocities(const Constants& shared, dynamics::Works& works) noexcept {
    for_blocks(n_, model_.threads, [&](std::size_t begin, std::size_t end, std::size_t block) {
      const Constants c = shared;
      const double *mass = mass_.data(), *inverse_mass = inverse_mass_.data();
      double frame = 0.0, dissipated = 0.0, stiffness = 0.0;
#pragma omp simd reduction(+ : frame, dissipated, stiffness)
      for (std::size_t i = begin; i < end; ++i) {
        const Forces f = forces(c, i);
        const Vec2 v = at(v_, i);
        const Vec2 next = free_velocity(c, f, at(force_, i), inverse_mass[i], v);
        set(v_next_, i, next);
        const NodeWorks w = works_of(c, f, mass[i], v, next);
        frame += w.frame;
        dissipated += w.mass;
        stiffness += w.stiffness;
      }
      partial_[block] = {frame, dissipated, stiffness};
    });
    const auto sum = total();
    works.frame = sum[0];
    works.dissipation_mass = sum[1];
    works.dissipation_stiffness = sum[2];
  }

  /// Corrects the nodes in contact and their works.
  dynamics::ContactReport solve_contact(const Constants& c, const dynamics::VelocityUpdate& update,
                                        dynamics::Works& works) noexcept {
    dynamics::ContactReport report;
    active_.clear();
    const dynamics::ContactModel& contact = *model_.contact;
    const dynamics::ContactStep step(model_, frame_, update);
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      const std::size_t i = candidates_[k];
      const Vec2 arm = at(reference_, i) + at(u_, i);
      const auto touches = contact.ground.touches(frame_.center.plane() + frame_.rotation * arm);
      if (touches.count == 0) continue;
      const std::size_t first = active_.size();
      active_.resize(first + static_cast<std::size_t>(touches.count));
      const double mass = mass_[static_cast<Index>(i)];
      const Vec2 v = at(v_, i), free = at(v_next_, i);
      const Vec2 next = solve_contacts(step, {k, mass, contact.tributary[k], arm, v, free}, touches,
                                       std::span(active_).subspan(first), report);
      set(v_next_, i, next);
      const Forces f = forces(c, i);
      const NodeWorks wrong = works_of(c, f, mass, v, free), right = works_of(c, f, mass, v, next);
      works.frame += right.frame - wrong.frame;
      works.dissipation_mass += right.mass - wrong.mass;
      works.dissipation_stiffness += right.stiffness - wrong.stiffness;
    }
    return report;
  }

  [[nodiscard]] std::array<double, 3> total() const noexcept {
    std::array<double, 3> sum{};
    for (const auto& p : partial_)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += p[k];
    return sum;
  }

  const Model& model_;
  const CsrMatrix& k_;
  std::size_t n_;                                               ///< free nodes
  VectorXd mass_, inverse_mass_;                                ///< (n)
  VectorXd reference_, u_, v_, v_next_, force_, force_before_;  ///< (2n)
  std::vector<std::size_t> candidates_;                         ///< numbers of the candidates
  std::vector<dynamics::ActiveContact> active_;
  std::vector<std::array<double, 3>> partial_;  ///< sums of each block
  long long step_;
  dynamics::FrameStep frame_;
  dynamics::Ledger ledger_;
};

}  // namespace

CsrMatrix csr_matrix(const fem::BlockCsr& k, std::span<const int> free) {
  std::vector<int> place(k.n_rows(), -1);
  for (std::size_t i = 0; i < free.size(); ++i)
    place[static_cast<std::size_t>(free[i])] = static_cast<int>(i);
  const auto n = static_cast<Index>(2 * free.size());
  CsrMatrix matrix(n, n);
  matrix.resizeNonZeros(static_cast<Index>(4 * k.values.size()));
  int entry = 0;
  for (std::size_t row = 0; row < free.size(); ++row) {
    const auto node = static_cast<std::size_t>(free[row]);
    for (int component = 0; component < 2; ++component) {
      matrix.outerIndexPtr()[2 * row + static_cast<std::size_t>(component)] = entry;
      for (auto b = k.row_start[node]; b < k.row_start[node + 1]; ++b) {
        const auto block = static_cast<std::size_t>(b);
        const int column = place[static_cast<std::size_t>(k.column[block])];
        for (int c = 0; c < 2; ++c, ++entry) {
          matrix.innerIndexPtr()[entry] = 2 * column + c;
          matrix.valuePtr()[entry] = k.values[block][static_cast<std::size_t>(2 * c + component)];
        }
      }
    }
  }
  matrix.outerIndexPtr()[n] = entry;
  return matrix;
}

void multiply(const CsrMatrix& k, const VectorXd& u, VectorXd& out, int threads) {
  if (threads == 1) {
    out.noalias() = k * u;
    return;
  }
#pragma omp parallel for schedule(static) num_threads(threads)
  for (int part = 0; part < threads; ++part) {
    const Index begin = k.rows() * part / threads, end = k.rows() * (part + 1) / threads;
    out.segment(begin, end - begin).noalias() = k.middleRows(begin, end - begin) * u;
  }
}

std::unique_ptr<dynamics::Integrator> make_csr_steps(const Model& model, const CsrMatrix& k,
                                                     const State& start) {
  return std::make_unique<CsrSteps>(model, k, start);
}

}  // namespace rondo::bench
