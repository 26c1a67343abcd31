// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/massless/ring_arc.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/contact/residual.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

using contact::Block;
using contact::inverse, contact::minus, contact::sum, contact::times;
using contact::Status;

/// Changes of place below this are round-off [m].
constexpr double nothing = 1e-20;
constexpr int most_extensions = 30;
/// Sectors beside the first and the last candidate that are looked at with them.
constexpr std::size_t margin = 2;

double size_of(const Block& a) noexcept {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2]), std::abs(a[3])});
}

Eigen::MatrixXd matrix_of(const Block& a) {
  Eigen::MatrixXd m(2, 2);
  m << a[0], a[1], a[2], a[3];
  return m;
}

/// Step P past nodes on which nothing acts: x_{j+1} = P x_j with behind + here P + ahead P² = 0.
Block propagator(const Block& behind, const Block& here, const Block& ahead) {
  Block p{};
  constexpr int most = 200;
  for (int i = 0; i < most; ++i) {
    const Block next = minus(times(inverse(sum(here, times(ahead, p))), behind));
    const double moved = size_of(sum(next, minus(p)));
    p = next;
    if (moved == 0.0) break;
  }
  return p;
}

/// Entries of the sector's stiffness on the contact row, as 2×2 blocks by rows.
template <class Visit>
void for_entries(const fem::SectorStiffness& k, int row, Visit&& visit) {
  for (const fem::SectorStiffness::Entry& e : k.row(at(row)))
    visit(e.column, e.shift, Block{e.block[0], e.block[2], e.block[1], e.block[3]});
}

/// The one row of contact nodes, -1: there are more, or parts of one.
int contact_row(const Model& model) {
  const fem::SectorStiffness& k = *model.sector;
  if (model.contact->nodes.size() != at(k.n_sectors)) return -1;
  const int local = model.contact->nodes.front() % k.nodes_per_sector;
  for (const int node : model.contact->nodes)
    if (node % k.nodes_per_sector != local) return -1;
  const auto found = std::find(k.nodes.begin(), k.nodes.end(), local);
  return found == k.nodes.end() ? -1 : static_cast<int>(found - k.nodes.begin());
}

}  // namespace

bool RingArc::fits(const Model& model) {
  return model.sector && model.contact && contact_row(model) >= 0;
}

RingArc::RingArc(const Model& model, RingProduct product)
    : model_(model),
      n_(at(model.sector->n_sectors)),
      row_(contact_row(model)),
      lag_(model.stiffness_damping / model.dt),
      has_concave_corners_(model.contact->ground.has_concave_corners()),
      candidate_(n_),
      sector_of_(n_),
      product_(product),
      predicted_(n_),
      height_(n_),
      touch_(n_),
      load_(2, model.sector->n_sectors),
      is_candidate_(n_) {
  RONDO_DEMAND(row_ >= 0);
  RONDO_DEMAND(product && model.dt > 0.0 && !has_friction_law(model), n_, model.dt);
  for (std::size_t k = 0; k < n_; ++k) {
    const int j = model.contact->nodes[k] / model.sector->nodes_per_sector;
    candidate_[at(j)] = static_cast<int>(k);
    sector_of_[k] = j;
  }
  reference_ = model.reference[model.sector->node(at(row_), 0)];
  read_blocks(model);
  candidates_.reserve(n_);
  arc_.reserve(n_);
  eliminated_.reserve(n_);
  statuses_.reserve(n_);
}

void RingArc::read_blocks(const Model& model) {
  const fem::SectorStiffness& k = *model.sector;
  for_entries(k, row_, [&](int column, int, const Block&) {
    if (column != row_ && std::ranges::find(around_rows_, column) == around_rows_.end())
      around_rows_.push_back(column);
  });
  RONDO_DEMAND(!around_rows_.empty(), row_);  // the ring is joined to nodes with mass
  const auto n = static_cast<Eigen::Index>(around_rows_.size());
  around_left_ = around_here_ = around_right_ = Circulant::Matrix::Zero(2, 2 * n);
  for_entries(k, row_, [&](int column, int shift, const Block& block) {
    if (column == row_) {
      (shift == 0 ? here_ : shift > 0 ? right_ : left_) = block;
      return;
    }
    const Eigen::Index a = std::ranges::find(around_rows_, column) - around_rows_.begin();
    auto& matrix = shift == 0 ? around_here_ : shift > 0 ? around_right_ : around_left_;
    for (const Eigen::Index c : {Eigen::Index{0}, Eigen::Index{1}}) {
      matrix(c, a) = -block[at(2 * c)];
      matrix(c, n + a) = -block[at(2 * c + 1)];
    }
  });
  around_ = RingRows(static_cast<int>(2 * n), k.n_sectors);
  ring_.emplace(k.n_sectors, RingBlocks{matrix_of(left_), matrix_of(here_), matrix_of(right_)},
                product_);
  forward_ = propagator(left_, here_, right_);
  backward_ = propagator(right_, here_, left_);
  Block power = forward_, other = backward_;
  constexpr double round_off = 1e-17;
  for (reach_ = 1; std::max(size_of(power), size_of(other)) > round_off && at(reach_) < n_;
       ++reach_) {
    power = times(power, forward_);
    other = times(other, backward_);
  }
}

Vec2 RingArc::position(const ContactStep& step, std::size_t j) const noexcept {
  return step.center + step.dt * step.center_rate +
         step.rotation_next * (model_.sector->turn[j] * (reference_ + next_->at(j)));
}

/// The ring with the forces of t_{n+1}.
void RingArc::predict(const ContactStep& step, const RingContacts& now) {
  around_.wrap(1);
  product_({.rows = 2,
            .columns = static_cast<int>(2 * around_rows_.size()),
            .sectors = static_cast<int>(n_),
            .n_terms = 3,
            .with_self = false,
            .matrix = {around_left_.data(), around_here_.data(), around_right_.data()},
            .offset = {-1, 0, 1},
            .in = around_.row(0),
            .out = load_.row(0),
            .stride = around_.stride()});
  for (const RingContact& c : now.contacts) {
    const std::size_t j = at(sector_of_[at(c.node)]);
    const Vec2 force = conj(step.rotation_next * model_.sector->turn[j]) *
                       from_frame(c.normal, c.impulse) / step.dt;
    load_.row(0)[j] += force.x;
    load_.row(1)[j] += force.y;
  }
  ring_->solve(load_);
  const double scale = 1.0 / (1.0 + lag_), kept = lag_ * scale;
  const double *x = load_.row(0), *y = load_.row(1);
  for (std::size_t j = 0; j < n_; ++j) {
    predicted_.x[j] = kept * place_->x[j] + scale * x[j];
    predicted_.y[j] = kept * place_->y[j] + scale * y[j];
  }
}

/// Sectors that touch at the predicted place, or were pressed. False: there are none.
bool RingArc::find_candidates(const ContactStep& step, const RingContacts& now) {
  const contact::Ground& ground = model_.contact->ground;
  for (const int j : candidates_) is_candidate_[at(j)] = 0;
  candidates_.clear();
  for (const RingContact& c : now.contacts)
    if (c.impulse.x > 0.0) is_candidate_[at(sector_of_[at(c.node)])] = 1;
  const double center = step.center.y + step.dt * step.center_rate.y;
  const Complex r = step.rotation_next;
  const Complex* turn = model_.sector->turn.data();
  for (std::size_t j = 0; j < n_; ++j) {
    const double x = reference_.x + predicted_.x[j], y = reference_.y + predicted_.y[j];
    const double re = r.re * turn[j].re - r.im * turn[j].im;
    const double im = r.re * turn[j].im + r.im * turn[j].re;
    height_[j] = center + re * y + im * x;
  }
  for (std::size_t j = 0; j < n_; ++j) {
    if (height_[j] <= ground.top()) {
      touch_[j] = ground.facet_near(position(step, j));
      if (touch_[j].gap <= 0.0 || is_candidate_[j]) is_candidate_[j] = 2;
    }
    if (is_candidate_[j]) candidates_.push_back(static_cast<int>(j));
  }
  return !candidates_.empty();
}

/// The shortest arc with all candidates, and some beside them. False: it closes on itself.
bool RingArc::cut_arc() {
  RONDO_ASSERT(!candidates_.empty() && std::ranges::is_sorted(candidates_), candidates_.size());
  std::size_t longest = 0, begin = 0;
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    const std::size_t before = k > 0 ? k - 1 : candidates_.size() - 1;
    const std::size_t way = k > 0 ? at(candidates_[k] - candidates_[before])
                                  : n_ + at(candidates_[0]) - at(candidates_[before]);
    if (way <= longest) continue;
    longest = way;
    begin = at(candidates_[k]);
  }
  const std::size_t size = n_ - longest + 1 + 2 * margin;
  if (size + 2 * at(reach_) + 2 > n_) return false;  // both tails are apart
  first_ = (begin + n_ - margin) % n_;
  arc_.assign(size, Node{});
  eliminated_.resize(size);
  return true;
}

contact::Touch RingArc::touch_of(const ContactStep& step, std::size_t j) const noexcept {
  return is_candidate_[j] == 2 ? touch_[j] : model_.contact->ground.facet_near(position(step, j));
}

void RingArc::set_nodes(const ContactStep& step, const RingContacts& now) {
  const bool slides = model_.contact->law.friction.constant() == 0.0;
  for (std::size_t i = 0; i < arc_.size(); ++i) {
    Node& node = arc_[i];
    const std::size_t j = sector(i);
    const Complex to_fixed = step.rotation_next * model_.sector->turn[j];
    const Vec2 there = position(step, j);
    const contact::Touch touch = touch_of(step, j);
    const Vec2 here =
        step.center + step.rotation * (model_.sector->turn[j] * (reference_ + place_->at(j)));
    node.touched = touch.normal;
    node.normal = conj(to_fixed) * touch.normal;
    node.tangent = turn90(node.normal);
    node.gap = touch.gap;
    node.way = dot(turn90(touch.normal), there - here);
    if (touch.gap < closed) node.status = slides ? Status::slip : Status::stick;
  }
  for (const RingContact& c : now.contacts) {
    const std::size_t i = (at(sector_of_[at(c.node)]) + n_ - first_) % n_;
    if (i >= arc_.size()) continue;
    Node& node = arc_[i];
    const Complex to_fixed = step.rotation_next * model_.sector->turn[sector(i)];
    node.force_before = conj(to_fixed) * from_frame(c.normal, c.impulse) / step.dt;
    if (c.impulse.x <= 0.0) continue;
    node.status = slides ? Status::slip : c.status;
    node.side = c.impulse.y < 0.0 ? -1.0 : 1.0;
  }
}

/// Beyond an end of the arc each node follows the one before. False: one is pushed into the ground.
bool RingArc::move_on(const ContactStep& step, std::size_t from, int by, const Block& propagator) {
  Vec2 change = arc_[by > 0 ? arc_.size() - 1 : 0].change;
  const contact::Ground& ground = model_.contact->ground;
  std::size_t j = from;
  bool clear = true;
  for (int i = 0; i < reach_; ++i) {
    change = contact::apply(propagator, change);
    if (std::abs(change.x) + std::abs(change.y) < nothing) break;
    j = by > 0 ? (j + 1 == n_ ? 0 : j + 1) : (j == 0 ? n_ - 1 : j - 1);
    next_->put(j, predicted_.at(j) + change);
    if (height_[j] > ground.top() + std::abs(change.x) + std::abs(change.y)) continue;
    const contact::Touches touches = ground.touches(position(step, j));
    if (touches.count == 0 || touches.at[0].gap >= closed) continue;
    is_candidate_[j] = 1;
    candidates_.insert(std::ranges::lower_bound(candidates_, static_cast<int>(j)),
                       static_cast<int>(j));
    clear = false;
  }
  return clear;
}

/// The whole ring with the changes of the arc. False: nodes beyond it join.
bool RingArc::leave_arc(const ContactStep& step) {
  for (std::size_t i = 0; i < arc_.size(); ++i)
    next_->put(sector(i), predicted_.at(sector(i)) + arc_[i].change);
  const bool right = move_on(step, sector(arc_.size() - 1), 1, forward_);
  const bool left = move_on(step, first_, -1, backward_);
  return right && left;
}

void RingArc::give(const ContactStep& step, RingContacts& next) const {
  const double scale = step.dt * step.dt * (1.0 + lag_);
  for (std::size_t i = 0; i < arc_.size(); ++i) {
    const Node& node = arc_[i];
    if (node.status == Status::open) continue;
    RingContact c;
    c.node = candidate_[sector(i)];
    c.normal = node.touched;
    c.status = node.status;
    c.free = Vec2{node.gap + dot(node.normal, node.free), node.way + dot(node.tangent, node.free)} /
             step.dt;
    c.impulse = step.dt * Vec2{dot(node.normal, node.force), dot(node.tangent, node.force)};
    const Vec2 w =
        Vec2{node.gap + dot(node.normal, node.change), node.way + dot(node.tangent, node.change)} /
        step.dt;
    const double mass = scale * here_[0];
    c.gap = w.x * step.dt;
    c.residual =
        contact::law_residual(c.impulse, w, 0.0, model_.contact->law.friction.constant(), mass) /
        mass;
    if (has_concave_corners_ && c.impulse.x > 0.0 && !next.two_facets)
      next.two_facets = near_second_facet(model_.contact->ground, position(step, sector(i)),
                                          step.dt * std::abs(w.y));
    next.contacts.push_back(c);
  }
  std::ranges::sort(next.contacts, {}, [](const RingContact& c) { return c.node; });
}

bool RingArc::solve(const ContactStep& step, const PlaneField& place, const RingContacts& now,
                    Solution solution) {
  RONDO_ASSERT(place.size() >= n_ && solution.place.size() >= n_, place.size(),
               solution.place.size(), n_);
  RingContacts& next = solution.contacts;
  next.contacts.clear();
  next.iterations = next.extensions = 0;
  next.converged = true;
  next.two_facets = false;
  place_ = &place;
  next_ = &solution.place;
  iterations_ = 0;
  predict(step, now);
  std::copy_n(predicted_.x.begin(), n_, next_->x.begin());
  std::copy_n(predicted_.y.begin(), n_, next_->y.begin());
  if (!find_candidates(step, now)) return true;
  const double friction = model_.contact->law.friction.constant();
  for (int i = 0; i < most_extensions; ++i) {
    if (!cut_arc()) return false;
    set_nodes(step, now);
    find_free();
    if (!settle(friction)) return false;
    if (leave_arc(step)) {
      next.iterations = iterations_;
      next.extensions = i;
      give(step, next);
      return true;
    }
    std::copy_n(predicted_.x.begin(), n_, next_->x.begin());
    std::copy_n(predicted_.y.begin(), n_, next_->y.begin());
  }
  return false;
}

}  // namespace rondo::dynamics
