// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/steady_remainder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/solid/solid_sector.hpp"

namespace rondo::study {

using Eigen::Index;
using statics::RollingPair;

namespace {

/// Turns the axes of sector 0 into those of another.
Eigen::Matrix3d turn_of(Complex r) noexcept {
  Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
  m.topLeftCorner<2, 2>() << r.re, -r.im, r.im, r.re;
  return m;
}

}  // namespace

SteadyRemainder::SteadyRemainder(const mesh::Mesh& mesh, const fem::SolidSector& sector,
                                 const dynamics::SweptPart& part, std::vector<int> candidates,
                                 int samples, double damped, int threads)
    : sector_(sector),
      of_rest_(damped / (1.0 + damped)),
      candidates_(std::move(candidates)),
      threads_(threads),
      moves_(mesh.n_nodes(), 0),
      touching_(candidates_.size(), sector.turn.size()) {
  std::vector<Vec3> x;
  for (std::size_t k = 0; k < mesh.n_nodes(); ++k)
    x.emplace_back(mesh.coordinates[k], mesh.axial[k]);
  for (std::size_t j = 0; j < sector.turn.size(); ++j)
    for (std::size_t a = 0; a < sector.n_local(); ++a) moves_[sector.node(a, j)] = 1;
  const std::vector<Vec3> none(x.size());
  for (int p = 0; p < samples; ++p)
    of_.push_back({dynamics::SweptWheel(part, x), none, none, none, touching_, {}, {}});
}

void SteadyRemainder::unroll(const Eigen::MatrixXd& field, std::size_t place,
                             std::span<Vec3> nodes) const {
  for (std::size_t j = 0; j < sector_.turn.size(); ++j)
    for (std::size_t a = 0; a < sector_.n_local(); ++a) {
      const auto of = field.col(static_cast<Index>(j * of_.size() + place))
                          .segment<3>(static_cast<Index>(3 * a));
      nodes[sector_.node(a, j)] = sector_.turn[j] * Vec3{of[0], of[1], of[2]};
    }
}

void SteadyRemainder::roll(std::span<const Vec3> nodes, std::size_t place,
                           Eigen::MatrixXd& field) const {
  for (std::size_t j = 0; j < sector_.turn.size(); ++j)
    for (std::size_t a = 0; a < sector_.n_local(); ++a) {
      const Vec3 f = conj(sector_.turn[j]) * nodes[sector_.node(a, j)];
      field.col(static_cast<Index>(j * of_.size() + place)).segment<3>(static_cast<Index>(3 * a))
          << f.x,
          f.y, f.z;
    }
}

double SteadyRemainder::angle(std::size_t place) const {
  return 2.0 * std::numbers::pi * static_cast<double>(place) /
         static_cast<double>(of_.size() * sector_.turn.size());
}

void SteadyRemainder::find_at(std::size_t place, const Eigen::MatrixXd& u, Eigen::MatrixXd& force) {
  Place& of = of_[place];
  unroll(u, place, of.u);
  of.energy = of.wheel.find(of.u, angle(place), of.force);
  fem::apply(sector_, of.u, of.linear);
  for (std::size_t k = 0; k < of.force.size(); ++k) of.force[k] -= of.linear[k];
  roll(of.force, place, force);
}

std::size_t SteadyRemainder::place_of(const RollingPair& pair) const {
  return at(wrapped(pair.sample, static_cast<int>(of_.size())));
}

std::size_t SteadyRemainder::sector_of(const RollingPair& pair) const {
  const int n = static_cast<int>(sector_.turn.size()), samples = static_cast<int>(of_.size());
  return at(wrapped(pair.sample - static_cast<int>(place_of(pair)), n * samples) / samples);
}

/// With the places of two samples before and after, whose ways the pairs have a part in.
void SteadyRemainder::include(std::span<const RollingPair> pairs) {
  for (const RollingPair& pair : pairs)
    for (int by = -2; by <= 2; ++by) {
      const RollingPair beside{pair.candidate, pair.sample + by};
      const std::size_t sector = sector_of(beside);
      const std::size_t node = sector_.node(at(candidates_[pair.candidate]), sector);
      touching_.include(pair.candidate, sector, node);
      of_[place_of(beside)].touching.include(pair.candidate, sector, node);
    }
}

std::optional<statics::TangentFactors> SteadyRemainder::tangent_at(
    Place& of, std::size_t place, const TouchingNodes& touching) const {
  statics::TangentFactors tangent(moves_, touching.nodes(), order_);
  const auto add = [&](std::span<const Vec3> u, double share) {
    of.wheel.tangent(u, angle(place),
                     [&](std::size_t force, std::size_t move, const Eigen::Matrix3d& block) {
                       tangent.take(force, move, share * block);
                     });
  };
  add(of.u, 1.0 - of_rest_);
  if (of_rest_ > 0.0) add(std::vector<Vec3>(of.u.size()), of_rest_);
  if (!tangent.factor()) return {};
  return tangent;
}

/// Where nothing is displaced the tangent is K at any place.
void SteadyRemainder::take_reference() {
  if (n_at_rest_ == touching_.nodes().size()) return;
  std::ranges::fill(of_[0].u, Vec3{});
  const std::optional<statics::TangentFactors> k = tangent_at(of_[0], 0, touching_);
  RONDO_DEMAND(k.has_value());
  order_ = k->order();
  at_rest_ = k->compliance();
  n_at_rest_ = touching_.nodes().size();
}

bool SteadyRemainder::take_tangent(const Eigen::MatrixXd& u, std::span<const RollingPair> pairs) {
  include(pairs);
  for (Place& of : of_) of.tangent.reset();
  take_reference();
  bool good = true;
#pragma omp parallel for num_threads(threads_) schedule(static) reduction(&& : good)
  for (std::size_t p = 0; p < of_.size(); ++p) {
    Place& of = of_[p];
    unroll(u, p, of.u);
    of.tangent = tangent_at(of, p, of.touching);
    if (of.tangent) of.compliance = of.tangent->compliance();
    good = good && of.tangent;
  }
  return good;
}

Eigen::Matrix3d SteadyRemainder::softness(const RollingPair& of, const RollingPair& by) const {
  if (place_of(of) != place_of(by)) return Eigen::Matrix3d::Zero();
  const std::size_t to = sector_of(of), from = sector_of(by);
  const Place& here = of_[place_of(of)];
  const Index row = 3 * here.touching.number(of.candidate, to),
              column = 3 * here.touching.number(by.candidate, from);
  if (row < 0 || column < 0) return Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d more = here.compliance.block<3, 3>(row, column) -
                               at_rest_.block<3, 3>(3 * touching_.number(of.candidate, to),
                                                    3 * touching_.number(by.candidate, from));
  return turn_of(sector_.turn[to]).transpose() * more * turn_of(sector_.turn[from]);
}

void SteadyRemainder::move(const Eigen::MatrixXd& force, Eigen::MatrixXd& u) {
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::size_t p = 0; p < of_.size(); ++p) {
    Place& of = of_[p];
    unroll(force, p, of.force);
    unroll(u, p, of.u);
    of.tangent->move(of.force, of.u);
    roll(of.u, p, u);
  }
}

Eigen::MatrixXd SteadyRemainder::linear(const Eigen::MatrixXd& u) {
  Eigen::MatrixXd force(u.rows(), u.cols());
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::size_t p = 0; p < of_.size(); ++p) {
    Place& of = of_[p];
    unroll(u, p, of.u);
    fem::apply(sector_, of.u, of.linear);
    roll(of.linear, p, force);
  }
  return force;
}

bool SteadyRemainder::find(const Eigen::MatrixXd& u, Eigen::MatrixXd& force) {
  force.resize(u.rows(), u.cols());
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::size_t p = 0; p < of_.size(); ++p) find_at(p, u, force);
  return force.allFinite();
}

}  // namespace rondo::study
