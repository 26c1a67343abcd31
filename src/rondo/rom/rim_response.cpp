// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/rim_response.hpp"

namespace rondo::rom {
namespace {

using Rows = Eigen::Matrix<double, 2, 3>;

/// The velocity of a point of a rigid body: ċ + s J a.
Rows rigid(Vec2 arm) {
  Rows rows;
  rows << 1.0, 0.0, -arm.y, 0.0, 1.0, arm.x;
  return rows;
}

}  // namespace

Eigen::Vector3d RimResponse::change(const VectorXd& modes, const Eigen::Vector3d& direct) const {
  Eigen::Vector3d felt;
  for (std::size_t k = 0; k < 3; ++k) felt[static_cast<Index>(k)] = back[k].dot(modes);
  return inverse * (direct.cwiseProduct(free) - felt);
}

PointResponse point_response(const RimResponse& rim, const ContactTable& table, int point, Vec2 arm,
                             Vec2 push_arm, double spin) {
  PointResponse out;
  const Rows whole = rigid(arm);
  Rows moved, slid, felt;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto column = static_cast<Index>(k);
    const Vec2 v = table.at(point, rim.velocity[k]), u = table.at(point, rim.displacement[k]);
    const Vec2 slip = v + spin * turn90(u);
    const Vec2 way =
        table.stands_still() ? v + spin * table.carried(point, rim.displacement[k]) : slip;
    const Vec2 f = table.at(point, rim.back[k]);
    moved.col(column) << way.x, way.y;
    slid.col(column) << slip.x, slip.y;
    felt.col(column) << f.x, f.y;
  }
  out.tangential = whole - slid;
  out.normal = whole - moved;
  if (table.stands_still()) out.normal.col(2) = -moved.col(2);  // a fixed point does not turn
  const Rows direct = rigid(push_arm) * rim.free.asDiagonal();
  out.push = rim.inverse * (direct - felt).transpose();
  return out;
}

}  // namespace rondo::rom
