// SPDX-License-Identifier: BSD-3-Clause
/// The datasets of results.h5: names, shapes, units.
#include "rondo/io/results_impl.hpp"

namespace rondo::io {

using h5::Type;

void Results::Impl::create_frame() {
  const h5::Shape times = {c.times};
  const h5::Label time = {words.time_unit, words.time};
  const h5::Label time_velocity = {words.time_unit, words.velocity_time};
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
  const h5::Label velocity = {words.velocity_unit, words.velocity.empty()
                                                       ? "velocity du/dt of each node, " + frame() +
                                                             ", at /frame/time_velocity"
                                                       : words.velocity};
  d.velocity = file.create_rows("/snapshots/velocity", Type::float64,
                                {c.times, c.nodes, c.components}, velocity);
  if (!c.contact) return;
  const h5::Shape shape = {c.times, c.candidates, c.components};
  d.force = file.create_rows(
      "/contact/force", Type::float64, shape,
      {"N/m", "contact force on each node of /mesh/boundary: normal, tangential; " + words.force});
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
  const h5::Label velocity = {words.velocity_unit,
                              words.field_velocity.empty()
                                  ? "velocity du/dt of each node, " + frame() +
                                        ", along the fixed axes, at /frame/time_velocity"
                                  : words.field_velocity};
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

void Results::Impl::create_series() {
  for (std::size_t k = 0; k < series.size(); ++k) {
    h5::Shape shape = {c.times};
    if (series[k].components > 1) shape.push_back(series[k].components);
    series_rows[k] =
        file.create_rows(series[k].path, Type::float64, shape, {series[k].unit, series[k].meaning});
  }
}

}  // namespace rondo::io
