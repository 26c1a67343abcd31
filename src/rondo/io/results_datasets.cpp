// SPDX-License-Identifier: BSD-3-Clause
/// The datasets of results.h5: names, shapes, units.
#include "rondo/io/results_impl.hpp"

namespace rondo::io {

using h5::Type;

void Results::Impl::create_frame() {
  const h5::Shape times = {c.times};
  h5::Label time = {
      "s", "of displacement, angle, centre, contact and fields; NaN: snapshot not written"};
  h5::Label time_velocity = {"s", "of velocity: half a step before /frame/time"};
  if (c.quasi_static) {
    time = {"1",
            "share of the depth, above 1 while the body slides, of displacement, centre, contact "
            "and fields; NaN: snapshot not written"};
    time_velocity = {"1", "of velocity: half an increment before /frame/time"};
  }
  d.time = file.create_rows("/frame/time", Type::float64, times, time);
  d.time_velocity = file.create_rows("/frame/time_velocity", Type::float64, times, time_velocity);
  d.angle = file.create_rows("/frame/angle", Type::float64, times,
                             {"rad", "angle of the turning frame, counter-clockwise"});
  d.angle_velocity =
      file.create_rows("/frame/angle_velocity", Type::float64, times,
                       {"rad", "angle of the turning frame at /frame/time_velocity"});
  d.center = file.create_rows("/frame/center", Type::float64, {c.times, 2},
                              {"m", "centre of the turning frame, x, y in the fixed frame"});
}

void Results::Impl::create_snapshots() {
  d.displacement =
      file.create_rows("/snapshots/displacement", Type::float64, {c.times, c.nodes, c.components},
                       {"m", "displacement u of each node, " + frame()});
  h5::Label velocity = {"m/s",
                        "velocity du/dt of each node, " + frame() + ", at /frame/time_velocity"};
  if (c.quasi_static)
    velocity = {"m",
                "rate of the displacement over the share of the depth, at /frame/time_velocity"};
  d.velocity = file.create_rows("/snapshots/velocity", Type::float64,
                                {c.times, c.nodes, c.components}, velocity);
  if (!c.contact) return;
  const h5::Shape shape = {c.times, c.candidates, c.components};
  d.force =
      file.create_rows("/contact/force", Type::float64, shape,
                       {"N/m", std::string("contact force on each node of /mesh/boundary: normal, "
                                           "tangential; ") +
                                   (c.quasi_static ? "of the equilibrium at /frame/time"
                                                   : "impulse of the step over its length")});
  d.traction = file.create_rows("/contact/traction", Type::float64, shape,
                                {"Pa", "/contact/force over /mesh/tributary: pressure, shear"});
}

void Results::Impl::create_fields() {
  const h5::Shape vector = {c.times, c.nodes, 3};
  d.position = file.create_rows("/fields/position", Type::float32, vector,
                                {"m", "current position of each node, fixed frame"});
  d.field_displacement =
      file.create_rows("/fields/displacement", Type::float32, vector,
                       {"m", "displacement u of each node along the fixed axes"});
  h5::Label velocity = {"m/s", "velocity du/dt of each node, " + frame() +
                                   ", along the fixed axes, at /frame/time_velocity"};
  if (c.quasi_static)
    velocity = {
        "m",
        "rate of the displacement of each node over the share of the depth, along the fixed "
        "axes, at /frame/time_velocity"};
  d.field_velocity = file.create_rows("/fields/velocity", Type::float32, vector, velocity);
  if (c.contact)
    d.field_force = file.create_rows("/fields/contact_force", Type::float32, vector,
                                     {"N/m", "contact force on each node along the fixed axes"});
  if (!c.stress) return;
  d.von_mises = file.create_rows("/fields/von_mises", Type::float32, {c.times, c.nodes},
                                 {"Pa", "von Mises stress at each node, with zz"});
  d.stress = file.create_rows("/fields/cauchy_stress", Type::float32, {c.times, c.nodes, 6},
                              {"Pa",
                               "Cauchy stress at each node along the fixed axes: "
                               "xx, xy, xz, yy, yz, zz"});
}

/// The curve of force over depth, a row for each snapshot.
void Results::Impl::create_crush() {
  const h5::Shape rows = {c.times};
  d.depth = file.create_rows("/crush/depth", Type::float64, rows,
                             {"m", "depth of the centre below first touch"});
  d.load = file.create_rows("/crush/force", Type::float64, {c.times, 2},
                            {"N/m", "force of the ground on the body: normal, tangential"});
  d.contact_length =
      file.create_rows("/crush/contact_length", Type::float64, rows,
                       {"m", "/mesh/tributary of the candidates in contact, summed"});
  d.pressure_max = file.create_rows("/crush/pressure_max", Type::float64, rows,
                                    {"Pa", "largest pressure of all candidates"});
}

}  // namespace rondo::io
