// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/steady_remainder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "rondo/core/index.hpp"
#include "rondo/fem/solid/solid_sector.hpp"

namespace rondo::study {

using Eigen::Index;

/// Beyond what is pressed, so much more to each side is corrected [rad].
constexpr double beside = 0.7;

SteadyRemainder::SteadyRemainder(const mesh::Mesh& mesh, const fem::SolidSector& sector,
                                 const dynamics::SweptPart& part, std::vector<int> candidates,
                                 int samples, int threads)
    : sector_(sector), candidates_(std::move(candidates)), threads_(threads) {
  std::vector<Vec3> x;
  for (std::size_t k = 0; k < mesh.n_nodes(); ++k)
    x.emplace_back(mesh.coordinates[k], mesh.axial[k]);
  const std::vector<Vec3> none(x.size());
  for (int p = 0; p < samples; ++p)
    of_.push_back({dynamics::SweptWheel(part, x), none, none, none, {}});
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

/// What a place of the pass corrects: sectors from low to high.
struct SteadyRemainder::Near {
  int low = 0, high = 0;
};

int SteadyRemainder::sector_of(const statics::RollingPair& pair) const {
  const auto n = static_cast<int>(sector_.turn.size());
  const int samples = static_cast<int>(of_.size());
  return wrapped(pair.sample - place_of(pair), n * samples) / samples;
}

int SteadyRemainder::place_of(const statics::RollingPair& pair) const {
  return wrapped(pair.sample, static_cast<int>(of_.size()));
}

void SteadyRemainder::take_stiffness(const Eigen::MatrixXd& u,
                                     std::span<const statics::RollingPair> pressed) {
  const auto n = static_cast<int>(sector_.turn.size());
  Near near;
  for (const statics::RollingPair& p : pressed) {
    const int from_lowest = (sector_of(p) + n / 2) % n - n / 2;
    near.low = std::min(near.low, from_lowest);
    near.high = std::max(near.high, from_lowest);
  }
  const int more = static_cast<int>(std::ceil(beside * n / (2.0 * std::numbers::pi)));
  near.low = std::max(near.low - more, -n / 2);
  near.high = std::min(near.high + more, near.low + n - 1);
  bool good = true;
#pragma omp parallel for num_threads(threads_) schedule(static) reduction(&& : good)
  for (std::size_t p = 0; p < of_.size(); ++p)
    good = take_stiffness_at(p, u, pressed, near) && good;
  has_stiffness_ = good;
}

bool SteadyRemainder::take_stiffness_at(std::size_t place, const Eigen::MatrixXd& u,
                                        std::span<const statics::RollingPair> pressed,
                                        const Near& near) {
  Place& of = of_[place];
  const auto n = static_cast<int>(sector_.turn.size());
  std::vector<char> moves(of.u.size(), 0);
  std::vector<double> columns(at(n), 0.0);
  for (int j = near.low - 1; j <= near.high; ++j) columns[at(wrapped(j, n))] = 1.0;
  for (int j = near.low; j <= near.high; ++j)
    for (std::size_t a = 0; a < sector_.n_local(); ++a)
      moves[sector_.node(a, at(wrapped(j, n)))] = 1;
  for (const statics::RollingPair& p : pressed)
    if (at(place_of(p)) == place)
      moves[sector_.node(at(candidates_[p.candidate]), at(sector_of(p)))] = 0;
  unroll(u, place, of.u);
  statics::LocalStiffness& stiffness = of.stiffness.emplace(moves);
  of.wheel.tangent(of.u, angle(place), columns,
                   [&](std::size_t force, std::size_t move, const Eigen::Matrix3d& block) {
                     stiffness.take(force, move, block);
                   });
  return stiffness.factor();
}

void SteadyRemainder::correct(const Eigen::MatrixXd& left, Eigen::MatrixXd& u) {
  if (!has_stiffness_) return;
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::size_t p = 0; p < of_.size(); ++p) {
    Place& of = of_[p];
    unroll(left, p, of.force);
    unroll(u, p, of.u);
    of.stiffness->correct(of.force, of.u);
    roll(of.u, p, u);
  }
}

bool SteadyRemainder::find(const Eigen::MatrixXd& u, Eigen::MatrixXd& force) {
  force.resize(u.rows(), u.cols());
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::size_t p = 0; p < of_.size(); ++p) find_at(p, u, force);
  return force.allFinite();
}

}  // namespace rondo::study
