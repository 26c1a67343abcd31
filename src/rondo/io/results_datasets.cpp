// SPDX-License-Identifier: BSD-3-Clause
/// The datasets of results.h5: names, shapes, units.
#include <fmt/format.h>

#include "rondo/core/error.hpp"
#include "rondo/io/results.hpp"

namespace rondo::io {

using h5::Type;

namespace {

void demand_kept_rows(const h5::File& file, const std::string& name, std::size_t rows,
                      const std::string& hash) {
  const h5::Shape shape(file.dataset(name).shape().size(), h5::any);
  const h5::Dataset dataset = file.dataset(name, shape);
  if (shape.empty() || dataset.shape()[0] < rows)
    throw FileError(
        file.path(),
        fmt::format("{} holds fewer than the {} snapshots that were written: damaged", name, rows));
  if (dataset.hash_of_rows(rows) == hash) return;
  const std::optional<std::size_t> bad = dataset.first_not_finite(rows);
  throw FileError(file.path(),
                  bad ? fmt::format("{} holds a number that is not finite in snapshot {} (counted "
                                    "from 0): damaged",
                                    name, *bad)
                      : fmt::format("the first {} snapshots of {} are not what was written: "
                                    "damaged",
                                    rows, name));
}

}  // namespace

void demand_kept(const std::filesystem::path& results, const KeptSnapshots& kept) {
  const h5::File file = h5::File::open(results);
  for (const auto& [name, hash] : kept.hashes) demand_kept_rows(file, name, kept.count, hash);
}

void Results::add_rows(h5::Dataset& to, const std::string& name, Type type, const h5::Shape& shape,
                       const h5::Label& label) {
  to = file_.create_rows(name, type, shape, label);
  all_rows_.push_back(&to);
}

void Results::create_frame() {
  const h5::Shape times = {c_.times};
  const h5::Label time = {words_.time_unit, words_.time};
  const h5::Label time_velocity = {words_.time_unit, words_.velocity_time};
  add_rows(d_.time, "/frame/time", Type::float64, times, time);
  add_rows(d_.time_velocity, "/frame/time_velocity", Type::float64, times, time_velocity);
  add_rows(d_.angle, "/frame/angle", Type::float64, times,
           {"rad",
            "angle of the co-rotating frame, counter-clockwise, minus angle_rad of history.csv: "
            "position "
            "= center + R(angle) (X + u)"});
  add_rows(d_.angle_velocity, "/frame/angle_velocity", Type::float64, times,
           {"rad", "angle of the co-rotating frame at /frame/time_velocity, counter-clockwise"});
  add_rows(d_.center, "/frame/center", Type::float64, {c_.times, 2},
           {"m", c_.solid ? "center of the co-rotating frame, along t1 and the normal of the ground"
                          : "center of the co-rotating frame, x, y in the fixed frame"});
  if (c_.solid)
    add_rows(d_.lateral, "/frame/lateral", Type::float64, times,
             {"m", "center of the co-rotating frame, along t2, to the right of its heading"});
}

void Results::create_snapshots() {
  add_rows(d_.displacement, "/snapshots/displacement", Type::float64,
           {c_.times, c_.nodes, c_.components}, {"m", "displacement u of each node, " + frame()});
  const h5::Label velocity = {words_.velocity_unit, words_.velocity.empty()
                                                        ? "velocity du/dt of each node, " +
                                                              frame() + ", at /frame/time_velocity"
                                                        : words_.velocity};
  add_rows(d_.velocity, "/snapshots/velocity", Type::float64, {c_.times, c_.nodes, c_.components},
           velocity);
}

void Results::create_contact() {
  if (!c_.contact) return;
  const h5::Shape shape = {c_.times, c_.candidates, c_.components};
  const std::string components =
      c_.solid ? "normal, tangential, along t2; " : "normal, tangential; ";
  add_rows(d_.force, "/contact/force", Type::float64, shape,
           {c_.solid ? "N" : "N/m",
            "contact force on each node of /mesh/boundary: " + components + words_.force});
  add_rows(d_.traction, "/contact/traction", Type::float64, shape,
           {"Pa",
            c_.solid ? "/contact/force over the area of the deformed boundary that the node stands "
                       "for: pressure, two shears"
                     : "/contact/force over the length of the deformed boundary that the node "
                       "stands for: pressure, shear"});
}

void Results::create_fields() {
  const h5::Shape vector = {c_.times, c_.nodes, 3};
  add_rows(d_.position, "/fields/position", Type::float32, vector,
           {"m", "current position of each node, fixed frame"});
  add_rows(d_.field_displacement, "/fields/displacement", Type::float32, vector,
           {"m", "displacement u of each node along the fixed axes"});
  const h5::Label velocity = {words_.velocity_unit,
                              words_.field_velocity.empty()
                                  ? "velocity du/dt of each node, " + frame() +
                                        ", along the fixed axes, at /frame/time_velocity"
                                  : words_.field_velocity};
  add_rows(d_.field_velocity, "/fields/velocity", Type::float32, vector, velocity);
  if (c_.contact)
    add_rows(d_.field_force, "/fields/contact_force", Type::float32, vector,
             {c_.solid ? "N" : "N/m", "contact force on each node along the fixed axes"});
  if (!c_.stress) return;
  add_rows(d_.von_mises, "/fields/von_mises", Type::float32, {c_.times, c_.nodes},
           {"Pa", "von Mises stress at each node, with zz"});
  add_rows(d_.stress, "/fields/cauchy_stress", Type::float32, {c_.times, c_.nodes, 6},
           {"Pa",
            "Cauchy stress at each node along the fixed axes: "
            "xx, xy, xz, yy, yz, zz"});
}

void Results::create_series() {
  for (std::size_t k = 0; k < series_.size(); ++k) {
    h5::Shape shape = {c_.times};
    if (const std::size_t rows = series_[k].rows; rows > 0)
      shape.insert(shape.end(), {rows, series_[k].components / rows});
    else if (series_[k].components > 1)
      shape.push_back(series_[k].components);
    add_rows(series_rows_[k], series_[k].path, Type::float64, shape,
             {series_[k].unit, series_[k].meaning});
  }
}

}  // namespace rondo::io
