// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/reduced/reduced_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <sstream>
#include <utility>

#include "rondo/core/error.hpp"
#include "rondo/io/checkpoint_file.hpp"
#include "rondo/io/mesh_files.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using io::h5::File;

constexpr const char* format = "rondo reduced model 2";

using rom::ContactForm;
using rom::ModelFrame;

std::size_t size(Index n) {
  return static_cast<std::size_t>(n);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Columns lie in memory as rows do in the file.
void write_columns(File& file, const std::string& name, const MatrixXd& m,
                   const io::h5::Shape& shape, const io::h5::Label& label) {
  file.write(name, shape, std::span<const double>(m.data(), size(m.size())), label);
}

MatrixXd read_columns(const File& file, const std::string& name, Index rows, Index columns,
                      const io::h5::Shape& shape) {
  const std::vector<double> numbers = file.dataset(name, shape).read<double>();
  return Eigen::Map<const MatrixXd>(numbers.data(), rows, columns);
}

using NamedRange = std::pair<const char*, ModelRange*>;

std::array<NamedRange, 5> ranges_of(ModelRanges& r) {
  return {NamedRange{"friction", &r.friction}, NamedRange{"angular_velocity", &r.angular_velocity},
          NamedRange{"speed", &r.speed}, NamedRange{"height", &r.height},
          NamedRange{"slip_ratio", &r.slip_ratio}};
}

void write_numbers(File& file, const ReducedFile& content) {
  const rom::ReducedModel& m = content.model;
  const std::size_t r = size(m.size()), n = size(m.basis.rows() / 2);
  write_columns(file, "/model/basis", m.basis, {r, n, 2},
                {"kg^(-1/2)", "modes of the rectified frame, node: x, y; orthonormal in the mass"});
  write_columns(file, "/model/stiffness", m.stiffness, {r, r}, {"1/s2", "stiffness of the modes"});
  write_columns(file, "/model/generator", m.generator.transpose(), {r, r},
                {"1", "row i, column j: mode i · M · derivative of mode j by the angle"});
  write_columns(file, "/model/turn", m.turn.transpose(), {r, r},
                {"1", "row i, column j: mode i · M · mode j turned by 90 degrees"});
  write_columns(file, "/model/reference", m.reference, {r}, {"kg^(1/2) m", "modes · M · X"});
  write_columns(file, "/model/turned_reference", m.turned_reference, {r},
                {"kg^(1/2) m", "modes · M · X turned by 90 degrees"});
  write_columns(file, "/model/translation", m.translation, {2, r},
                {"kg^(1/2)", "modes · M · unit fields along x and y"});
}

void read_numbers(const File& file, ReducedFile& content) {
  rom::ReducedModel& m = content.model;
  const std::size_t n = content.mesh.n_nodes();
  const io::h5::Dataset basis = file.dataset("/model/basis", {io::h5::any, n, 2});
  const std::size_t modes = basis.shape()[0];
  const auto r = static_cast<Index>(modes);
  m.basis = read_columns(file, "/model/basis", static_cast<Index>(2 * n), r, {modes, n, 2});
  m.stiffness = read_columns(file, "/model/stiffness", r, r, {modes, modes});
  m.generator = read_columns(file, "/model/generator", r, r, {modes, modes}).transpose().eval();
  m.turn = read_columns(file, "/model/turn", r, r, {modes, modes}).transpose().eval();
  m.reference = read_columns(file, "/model/reference", r, 1, {modes});
  m.turned_reference = read_columns(file, "/model/turned_reference", r, 1, {modes});
  m.translation = read_columns(file, "/model/translation", r, 2, {2, modes});
}

void demand_finite(const rom::ReducedModel& m, const std::string& path) {
  const bool finite = m.size() > 0 && m.basis.allFinite() && m.stiffness.allFinite() &&
                      m.generator.allFinite() && m.turn.allFinite() && m.reference.allFinite() &&
                      m.turned_reference.allFinite() && m.translation.allFinite();
  if (!finite) throw FileError(path, "has no modes, or numbers that are not finite");
}

void write_counts(File& file, const ReducedFile& content) {
  const std::array<std::int64_t, 2> counts{content.displacement_modes, content.velocity_modes};
  file.write("/model/counts", {2}, std::span<const std::int64_t>(counts),
             {"1", "modes of the POD of displacements, of velocities"});
}

void write_contact(File& file, const rom::ReducedModel& m) {
  if (m.form == ContactForm::nodes) return;
  write_columns(file, "/model/contact_weights", m.weights,
                {size(m.weights.cols()), size(m.weights.rows())},
                {"1", "row i: shares of the sectors' places in contact point i, of sum 1"});
}

template <class Value, std::size_t n>
Value named(const std::array<std::pair<const char*, Value>, n>& names, const std::string& name,
            const std::string& path) {
  for (const auto& [text, value] : names)
    if (name == text) return value;
  throw FileError(path, fmt::format("has a frame or contact \"{}\" that is not known", name));
}

void read_contact(const File& file, const std::string& path, ReducedFile& content) {
  rom::ReducedModel& m = content.model;
  m.n_sectors = content.mesh.n_sectors;
  m.frame = named(frame_names, file.attribute("/", "frame"), path);
  m.form = named(contact_names, file.attribute("/", "contact"), path);
  if (m.n_sectors < 1 || pod::node_rings(content.mesh).n_sectors < 1)
    throw FileError(path, "its mesh has no equal sectors");
  if (m.form == ContactForm::nodes) return;
  const std::size_t sectors = static_cast<std::size_t>(m.n_sectors);
  const auto shape = file.dataset("/model/contact_weights", {io::h5::any, sectors}).shape();
  const MatrixXd weights = read_columns(file, "/model/contact_weights", static_cast<Index>(sectors),
                                        static_cast<Index>(shape[0]), {shape[0], sectors});
  const bool fits = pod::boundary_rings(content.mesh).n_rings() == 1 &&
                    m.frame == ModelFrame::rectified && weights.cols() > 0 &&
                    (weights.cols() <= m.n_sectors || weights.cols() % m.n_sectors == 0) &&
                    weights.allFinite() && (weights.array() >= 0.0).all() &&
                    ((weights.colwise().sum().array() - 1.0).abs() < 1e-9).all();
  if (!fits) throw FileError(path, "its contact points do not fit its mesh");
  rom::set_contact(content.mesh, m.form, weights, m);
}

void write_ranges(File& file, ModelRanges ranges) {
  for (const auto& [name, range] : ranges_of(ranges)) {
    const std::array<double, 2> ends{range->low, range->high};
    file.write(std::string("/ranges/") + name, {2}, std::span<const double>(ends),
               {"SI", "smallest and largest of the snapshots; none where they are the other way"});
  }
}

/// Column by column: F_x, F_y of each run.
void write_estimate(File& file, const ErrorEstimate& estimate) {
  file.set_attribute("/", "no_error_estimate", estimate.none);
  std::string runs;
  for (const std::string& run : estimate.runs) runs += run + "\n";
  file.set_attribute("/", "estimate_runs", runs);
  const std::array<std::int64_t, 1> count{static_cast<std::int64_t>(estimate.errors.size())};
  file.write("/errors/runs", {1}, std::span<const std::int64_t>(count),
             {"1", "runs that were left out in turn; 0: no error is estimated"});
  if (estimate.errors.empty()) return;
  std::vector<double> numbers;
  for (const ForceErrors& e : estimate.errors) numbers.insert(numbers.end(), {e.x, e.y});
  file.write("/errors/force", {estimate.errors.size(), 2}, std::span<const double>(numbers),
             {"1",
              "run: F_x, F_y as predicted from the other runs less the run's own, means over "
              "its last quarter, over its mean F_y"});
  numbers.clear();
  for (const ForceErrors& e : estimate.errors)
    numbers.insert(numbers.end(), {e.x_of_itself, e.friction_power});
  file.write("/errors/of_themselves", {estimate.errors.size(), 2}, std::span<const double>(numbers),
             {"1",
              "run: F_x, power of friction likewise, over the run's own mean of each; NaN: next to "
              "none of it"});
}

/// A file of an earlier version has none.
ErrorEstimate read_estimate(const File& file, const std::string& path) {
  ErrorEstimate estimate;
  estimate.none = "the model is of an earlier version";
  if (file.contains("/errors/runs")) estimate.none = file.attribute("/", "no_error_estimate");
  if (!file.contains("/errors/force")) return estimate;
  estimate.runs = lines_of(file.attribute("/", "estimate_runs"));
  const std::vector<double> numbers =
      file.dataset("/errors/force", {estimate.runs.size(), 2}).read<double>();
  for (std::size_t k = 0; k < numbers.size(); k += 2) {
    if (!std::isfinite(numbers[k]) || !std::isfinite(numbers[k + 1]))
      throw FileError(path, "its error estimate holds numbers that are not finite");
    estimate.errors.push_back({numbers[k], numbers[k + 1]});
  }
  if (!file.contains("/errors/of_themselves")) return estimate;
  const std::vector<double> own =
      file.dataset("/errors/of_themselves", {estimate.runs.size(), 2}).read<double>();
  for (std::size_t k = 0; k < estimate.errors.size(); ++k) {
    estimate.errors[k].x_of_itself = own[2 * k];
    estimate.errors[k].friction_power = own[2 * k + 1];
  }
  return estimate;
}

void write_all(File& file, const ReducedFile& content) {
  file.set_attribute("/", "format", format);
  file.set_attribute("/", "frame", name_in(frame_names, content.model.frame));
  file.set_attribute("/", "contact", name_in(contact_names, content.model.form));
  file.set_attribute("/", "body", content.body);
  std::string runs;
  for (const std::string& run : content.runs) runs += run + "\n";
  file.set_attribute("/", "runs", runs);
  file.set_attribute("/", "build_record", build_record_json().dump());
  io::write_mesh(file, content.mesh, content.mass);
  write_numbers(file, content);
  write_counts(file, content);
  write_contact(file, content.model);
  write_ranges(file, content.ranges);
  write_estimate(file, content.estimate);
}

}  // namespace

void ModelRange::take(double value) noexcept {
  const bool first = empty();
  low = first ? value : std::min(low, value);
  high = first ? value : std::max(high, value);
}

std::string outside(const char* what, const ModelRange& built, const ModelRange& wanted,
                    double scale) {
  if (built.empty() || wanted.empty()) return {};
  const double margin =
      1e-3 * std::max({scale, built.high - built.low, std::abs(built.low), std::abs(built.high)});
  if (wanted.low >= built.low - margin && wanted.high <= built.high + margin) return {};
  return fmt::format(
      "{} is {:.6g} to {:.6g} in this case, and was {:.6g} to {:.6g} in the runs that "
      "the model was built from: what it says beyond is not known to be right",
      what, wanted.low, wanted.high, built.low, built.high);
}

ForceErrors ErrorEstimate::estimate() const noexcept {
  ForceErrors most;
  for (const ForceErrors& e : errors)
    most = {std::max(most.x, std::abs(e.x)), std::max(most.y, std::abs(e.y)),
            std::fmax(most.x_of_itself, std::abs(e.x_of_itself)),
            std::fmax(most.friction_power, std::abs(e.friction_power))};
  for (double* const part : {&most.x, &most.y, &most.x_of_itself, &most.friction_power})
    *part *= estimate_over_largest;
  return most;
}

std::string in_words(const ErrorEstimate& estimate) {
  if (estimate.errors.empty()) return "none: " + estimate.none;
  const ForceErrors most = estimate.estimate();
  const auto percent = [](double error) {
    return std::isnan(error) ? std::string("not known") : fmt::format("{:.2g} %", 100.0 * error);
  };
  return fmt::format(
      "F_x {:.2g} %, F_y {:.2g} % of F_y (twice the largest of {} runs, each predicted from "
      "the others); over themselves F_x {}, friction power {}",
      100.0 * most.x, 100.0 * most.y, estimate.errors.size(), percent(most.x_of_itself),
      percent(most.friction_power));
}

std::string body_text(const Case& c) {
  Case body;
  body.disk = c.disk;
  body.free_rim = c.free_rim;
  body.mesh = c.mesh;
  body.material = c.material;
  body.law = c.law;
  body.regions = c.regions;
  body.stress_stiffening = c.stress_stiffening;
  if (c.stress_stiffening != StressStiffening::none)
    body.motion.angular_velocity = dynamics::Table(c.motion.angular_velocity.at(0.0));
  return write_case(body);
}

std::string body_difference(const std::string& of_case, const std::string& of_model) {
  if (of_case == of_model) return {};
  const std::vector<std::string> a = lines_of(of_case), b = lines_of(of_model);
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (a[i] != b[i]) return fmt::format("{} against {}", a[i], b[i]);
  return "one has settings that the other has not";
}

double slip_ratio_at(const Case& c, double time) {
  return dynamics::slip_ratio(c.motion.angular_velocity.at(time) * c.disk.outer_radius,
                              c.motion.speed.at(time));
}

void write_reduced_file(const std::filesystem::path& file, const ReducedFile& content) {
  io::write_checkpoint_file(file, [&](File& h5) { write_all(h5, content); });
}

ReducedFile read_reduced_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw InputError(Fault{path.string(), 0, 0, "", "", "no such file",
                           "a model that `rondo reduce RUN... -o MODEL.h5` has written"});
  const File file = io::open_checkpoint_file(path);
  if (file.attribute("/", "format") != format)
    throw FileError(path.string(), fmt::format("is not a reduced model (\"{}\")", format));
  if (file.attribute("/", "contact") == "patterns")
    throw FileError(path.string(),
                    "represents the contact by patterns, which lose the friction and are not "
                    "supported: build the model again with rondo reduce RUN... -o MODEL.h5");
  ReducedFile content;
  content.body = file.attribute("/", "body");
  content.runs = lines_of(file.attribute("/", "runs"));
  io::MeshWithMass body = io::read_mesh(file);
  content.mesh = std::move(body.mesh);
  content.mass = std::move(body.mass);
  read_numbers(file, content);
  demand_finite(content.model, path.string());
  const auto counts = file.dataset("/model/counts", {2}).read<std::int64_t>();
  content.displacement_modes = counts[0];
  content.velocity_modes = counts[1];
  read_contact(file, path.string(), content);
  content.estimate = read_estimate(file, path.string());
  for (const auto& [name, range] : ranges_of(content.ranges)) {
    const auto ends = file.dataset(std::string("/ranges/") + name, {2}).read<double>();
    *range = {ends[0], ends[1]};
  }
  return content;
}

}  // namespace rondo::study
