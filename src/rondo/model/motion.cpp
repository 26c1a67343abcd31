// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {

namespace {

using Points = std::vector<std::array<double, 2>>;

/// Number of points at or before t.
std::size_t points_until(const Points& points, double t) noexcept {
  const auto after = std::upper_bound(points.begin(), points.end(), t,
                                      [](double x, const auto& p) { return x < p[0]; });
  return static_cast<std::size_t>(after - points.begin());
}

/// Calls piece(from, length) for each part of [from, from + length] without a knot inside.
template <class Piece>
void for_pieces(const Points& points, double from, double length, Piece&& piece) noexcept {
  const double sense = length < 0.0 ? -1.0 : 1.0;
  const double begin = std::min(from, from + length), whole = std::abs(length);
  double done = 0.0;
  for (std::size_t k = points_until(points, begin); k < points.size(); ++k) {
    const double knot = points[k][0] - begin;
    if (knot >= whole) break;
    piece(begin + done, sense * (knot - done));
    done = knot;
  }
  piece(begin + done, sense * (whole - done));
}

}  // namespace

Table::Table(std::vector<std::array<double, 2>> points) : points_(std::move(points)) {
  RONDO_DEMAND(!points_.empty());
  for (std::size_t i = 1; i < points_.size(); ++i)
    RONDO_DEMAND(points_[i - 1][0] < points_[i][0], points_[i - 1][0], points_[i][0]);
  from_start_.assign(points_.size(), 0.0);
  double sum = 0.0, done = 0.0;
  for (std::size_t k = points_until(points_, 0.0); k < points_.size(); ++k) {
    sum += piece(done, points_[k][0] - done);
    from_start_[k] = sum;
    done = points_[k][0];
  }
}

double Table::at(double t) const noexcept {
  const std::size_t k = points_until(points_, t);
  if (k == 0) return points_.front()[1];
  if (k == points_.size()) return points_.back()[1];
  return points_[k - 1][1] + slope(t) * (t - points_[k - 1][0]);
}

double Table::slope(double t) const noexcept {
  const std::size_t k = points_until(points_, t);
  if (k == 0 || k == points_.size()) return 0.0;
  return (points_[k][1] - points_[k - 1][1]) / (points_[k][0] - points_[k - 1][0]);
}

/// ∫ over [begin, begin + length], or backwards from there, without a knot inside.
double Table::piece(double begin, double length) const noexcept {
  return length * (at(begin) + 0.5 * slope(begin) * std::abs(length));
}

/// integral() from 0, piece by piece, but from stored sums: the same bits.
double Table::integral_from_start(double end) const noexcept {
  const auto knot = std::lower_bound(points_.begin(), points_.end(), end,
                                     [](const auto& p, double x) { return p[0] < x; });
  const auto k = static_cast<std::size_t>(knot - points_.begin());
  if (k == 0 || points_[k - 1][0] <= 0.0) return piece(0.0, end);
  return from_start_[k - 1] + piece(points_[k - 1][0], end - points_[k - 1][0]);
}

double Table::integral(double from, double length) const noexcept {
  if (from == 0.0 && length > 0.0) return integral_from_start(length);
  double sum = 0.0;
  for_pieces(points_, from, length, [&](double begin, double part) { sum += piece(begin, part); });
  return sum;
}

double Table::change(double from, double length) const noexcept {
  double sum = 0.0;
  for_pieces(points_, from, length, [&](double begin, double part) { sum += slope(begin) * part; });
  return sum;
}

double Table::largest() const noexcept {
  double largest = 0.0;
  for (const auto& point : points_) largest = std::max(largest, std::abs(point[1]));
  return largest;
}

namespace {

/// ∫ of a table that is extended before t = 0 with its first slope, from `from` < 0.
double prolonged_integral(const Table& table, double from, double length) noexcept {
  return length * (table.at(0.0) + (from + 0.5 * length) * table.slope(0.0));
}

}  // namespace

Vec2 Motion::gravity_at(double t) const noexcept {
  const double g = gravity.at(t);
  return slope == 0.0 ? Vec2{0.0, -g} : Vec2{g * std::sin(slope), -g * std::cos(slope)};
}

double Motion::turn(double from, double length) const noexcept {
  return from < 0.0 ? -prolonged_integral(angular_velocity, from, length)
                    : -angular_velocity.integral(from, length);
}

namespace {

bool is_zero(const Table& table) noexcept {
  return table.largest() == 0.0;
}

/// ∫ (a + b t) e^{i (c + d t)} dt over [0, length], without cancellation where d is small.
Complex wave_integral(double a, double b, double c, double d, double length) noexcept {
  const double turn = d * length;
  Complex mean, moment;  // ∫ e^{i turn x} dx and ∫ x e^{i turn x} dx over [0, 1]
  if (std::abs(turn) < 0.5) {
    Complex term{1.0, 0.0};  // (i turn)^k / k!
    for (int k = 0; k < 16; ++k) {
      mean += term / (k + 1.0);
      moment += term / (k + 2.0);
      term = Complex{0.0, turn / (k + 1.0)} * term;
    }
  } else {
    const Complex end = rotation(turn);
    mean = rotation_minus_one(turn) / Complex{0.0, turn};
    moment = (end - mean) / Complex{0.0, turn};
  }
  return length * (rotation(c) * (a * mean + b * length * moment));
}

/// ∫ V e^{iα} over [from, from + length]: real part along t1, imaginary part along t2. Exact,
/// because speed and slip angle are linear on each piece.
Complex travel(const Table& speed, const Table& angle, double from, double length) noexcept {
  Complex sum;
  for_pieces(speed.points(), from, length, [&](double begin, double part) {
    const double sense = part < 0.0 ? -1.0 : 1.0;
    for_pieces(angle.points(), begin, std::abs(part), [&](double b, double p) {
      sum += sense * wave_integral(speed.at(b), speed.slope(b), angle.at(b), angle.slope(b), p);
    });
  });
  return sum;
}

/// The travel for `from` < 0: speed and slip angle are extended before t = 0.
Complex prolonged_travel(const Table& speed, const Table& angle, double from,
                         double length) noexcept {
  const double v = speed.slope(0.0), a = angle.slope(0.0);
  return wave_integral(speed.at(0.0) + v * from, v, angle.at(0.0) + a * from, a, length);
}

Complex travel_of(const Motion& m, double from, double length) noexcept {
  return from < 0.0 ? prolonged_travel(m.speed, m.slip_angle, from, length)
                    : travel(m.speed, m.slip_angle, from, length);
}

}  // namespace

Vec3 Motion::advance(double from, double length) const noexcept {
  const double climb = from < 0.0 ? length * height.slope(0.0) : height.change(from, length);
  if (!is_zero(slip_angle)) {
    const Complex along = travel_of(*this, from, length);
    return {along.re, climb, along.im};
  }
  return {from < 0.0 ? prolonged_integral(speed, from, length) : speed.integral(from, length),
          climb, 0.0};
}

namespace {

/// The frame at t, one step after `before`.
FrameStep frame_at(const Motion& motion, double before, double t, double dt) noexcept {
  FrameStep f;
  f.time = t;
  f.spin = -motion.angular_velocity.at(t);
  f.angle = motion.angle(t);
  f.turn = motion.turn(t, dt);
  f.turn_before = motion.turn(before, dt);
  f.spin_rate = (f.turn - f.turn_before) / (dt * dt);
  f.rotation = rotation(f.angle);
  f.center = motion.center(t);
  f.advance = motion.advance(t, dt);
  f.advance_before = motion.advance(before, dt);
  f.slip_angle = motion.slip_angle.at(t);
  const Vec3 acceleration = (f.advance - f.advance_before) / (dt * dt);
  f.pull = conj(f.rotation) *
           GroundFrame(motion.camber).to_wheel(acceleration - Vec3(motion.gravity_at(t)));
  return f;
}

}  // namespace

FrameStep frame_step(const Motion& motion, long long n, double dt) noexcept {
  return frame_at(motion, static_cast<double>(n - 1) * dt, static_cast<double>(n) * dt, dt);
}

FrameStep middle_frame_step(const Motion& motion, long long n, double dt) noexcept {
  const double t = static_cast<double>(n) - 0.5;
  return frame_at(motion, (t - 1.0) * dt, t * dt, dt);
}

double slip_ratio(double rim_speed, double speed) noexcept {
  const double scale = std::max(std::abs(speed), std::abs(rim_speed));
  return scale > 0.0 ? (rim_speed - speed) / scale : 0.0;
}

}  // namespace rondo::dynamics
