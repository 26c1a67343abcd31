// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/node_to_segment.hpp"

namespace rondo::contact {
namespace {

/// Rows in the contact frame, carried to components of the fixed frame: H Q, Q with rows n, t.
Block in_fixed_frame(const Block& h, Vec2 n) noexcept {
  const Vec2 t = turn90(n);
  return {h[0] * n.x + h[1] * t.x, h[0] * n.y + h[1] * t.y, h[2] * n.x + h[3] * t.x,
          h[2] * n.y + h[3] * t.y};
}

}  // namespace

SegmentRows segment_rows(const SegmentTouch& touch, double length) noexcept {
  const double lever = touch.gap / length, at = touch.at;
  return {in_fixed_frame({1.0, 0.0, 0.0, 1.0}, touch.normal),
          in_fixed_frame({at - 1.0, 0.0, -lever, at - 1.0}, touch.normal),
          in_fixed_frame({-at, 0.0, lever, -at}, touch.normal)};
}

ContactRows node_rows(const SegmentTouch& touch, double length, int p, int a, int b) noexcept {
  const SegmentRows h = segment_rows(touch, length);
  return {3, {p, a, b}, {h.point, h.a, h.b}};
}

ContactRows corner_rows(const SegmentTouch& touch, double length, int a, int b) noexcept {
  const SegmentRows h = segment_rows(touch, length);
  return {2, {a, b, -1}, {h.a, h.b, Block{}}};
}

}  // namespace rondo::contact
