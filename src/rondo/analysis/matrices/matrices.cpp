// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/matrices/matrices.hpp"

#include <array>
#include <optional>
#include <span>
#include <system_error>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/matrices/contact_rows.hpp"
#include "rondo/analysis/matrices/operators.hpp"
#include "rondo/case/case_source.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/checkpoint_file.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {
namespace {

using io::h5::File;
using io::h5::Label;

struct Content {
  const Case& c;
  const Setup& setup;
  const Operators& operators;
  const std::optional<ContactRows>& contact;
  FramePlace frame;
  double time;
};

/// data, indices, indptr and shape, as scipy.sparse.csr_matrix takes them.
void write_csr(File& file, const std::string& name, const Csr& m, const Label& label) {
  const auto entries = static_cast<std::size_t>(m.nonZeros());
  const auto rows = static_cast<std::size_t>(m.rows());
  const std::array<std::int64_t, 2> shape{m.rows(), m.cols()};
  file.write(name + "/data", {entries}, std::span<const double>(m.valuePtr(), entries), label);
  file.write(name + "/indices", {entries}, std::span<const int>(m.innerIndexPtr(), entries),
             {"1", "column of each number"});
  file.write(name + "/indptr", {rows + 1}, std::span<const int>(m.outerIndexPtr(), rows + 1),
             {"1", "first number of each row, and the number of all"});
  file.write(name + "/shape", {2}, std::span<const std::int64_t>(shape), {"1", "rows, columns"});
}

void write_operators(File& file, const Operators& o) {
  const bool solid = o.components == 3;
  const std::string mass = solid ? "kg" : "kg/m";
  write_csr(file, "/mass", o.mass, {mass, "M, diagonal, as it moves"});
  write_csr(file, "/damping", o.damping, {solid ? "N s/m" : "N s/m2", "C = alpha M + beta K"});
  write_csr(file, "/stiffness", o.stiffness, {solid ? "N/m" : "N/m2", "K"});
  write_csr(file, "/gyroscopic", o.gyroscopic, {mass, "G = 2 M J, J turns by +90 degrees"});
  write_csr(file, "/centrifugal", o.centrifugal, {mass, "Z: M without the axial components"});
  file.write("/nodes", {o.nodes.size()}, o.nodes,
             {"1",
              "nodes of the mesh that are not clamped; each has as many unknowns as "
              "components, one after the other"});
  file.write("/reference", {o.nodes.size(), o.components}, o.reference, {"m", "X of the nodes"});
}

void write_contact(File& file, const Content& of) {
  const std::vector<int>& nodes = of.setup.model.contact->nodes;
  const io::h5::Shape vectors{nodes.size(), of.operators.components};
  write_csr(file, "/contact/rows", of.contact->rows,
            {"1",
             "H: of each contact node the rows along the normal n, the tangent J n and, in "
             "three dimensions, t2"});
  file.write("/contact/nodes", {nodes.size()}, nodes, {"1", "nodes that may touch the ground"});
  file.write("/contact/normal", vectors, of.contact->normal, {"1", "n, fixed frame"});
  file.write("/contact/normal_corotating", vectors, of.contact->normal_corotating,
             {"1", "n, co-rotating frame"});
  file.write("/contact/gap", {nodes.size()}, of.contact->gap,
             {"m", "distance of the undeformed node from the ground, > 0 outside"});
}

void write_scalar(File& file, const char* name, double value, const Label& label) {
  file.write(name, {1}, std::span<const double>(&value, 1), label);
}

void write_frame(File& file, const Content& of) {
  const Vec3 at = of.frame.center;
  const std::array<double, 3> center{at.x, at.y, at.z};
  write_scalar(file, "/frame/time", of.time, {"s", "of the contact rows"});
  write_scalar(file, "/frame/angle", of.frame.angle, {"rad", "theta, counter-clockwise"});
  file.write("/frame/center", {of.operators.components},
             std::span<const double>(center.data(), of.operators.components),
             {"m", "of the rim: x, y; in three dimensions along t1, n, t2 of the ground"});
  write_scalar(file, "/frame/spin", -of.setup.model.motion.angular_velocity.at(of.time),
               {"rad/s", "s = d theta/dt = -motion.angular_velocity"});
}

void write_all(File& file, const Content& of) {
  file.set_attribute("/", "format", "rondo matrices 1");
  file.set_attribute("/", "title", as_utf8(of.c.title));
  file.set_attribute("/", "build_record", build_record_json().dump());
  write_operators(file, of.operators);
  if (!of.setup.mesh.clamped.empty())
    file.write("/clamped", {of.setup.mesh.clamped.size()}, of.setup.mesh.clamped,
               {"1", "nodes of the mesh that are clamped: u = 0"});
  write_frame(file, of);
  if (of.contact) write_contact(file, of);
}

void refuse_still(const Case& c) {
  if (!rules_of(c.analysis.kind).in_time)
    throw case_error(c, "analysis.kind", "is no motion in time, whose matrices these are",
                     "\"dynamic\", with [motion] and [time], from a start above the ground");
}

}  // namespace

MatricesReport write_matrices(const Case& c, const MatricesRequest& request) {
  if (request.output.empty() || request.output.filename().empty())
    throw request_error("-o", request.output.string(), "the matrices need a file",
                        "-o matrices.h5");
  refuse_still(c);
  const Setup s = build(c, 1);
  if (request.warn)
    for (const auto* warnings : {&c.warnings, &s.warnings})
      for (const std::string& text : *warnings) request.warn(text);
  const FramePlace frame = frame_at(s.model, request.time, "--time");
  const Operators o = make_operators(c, s);
  std::optional<ContactRows> contact;
  if (s.model.contact && !s.model.contact->nodes.empty())
    contact = contact_rows(c, s.model, frame, {});
  const Content content{c, s, o, contact, frame, request.time};
  io::write_checkpoint_file(request.output, [&](File& file) { write_all(file, content); });
  MatricesReport r{.file = request.output,
                   .nodes = o.nodes.size(),
                   .unknowns = o.n_unknowns(),
                   .entries = static_cast<std::size_t>(o.stiffness.nonZeros()),
                   .contact_nodes = contact ? contact->gap.size() : 0,
                   .time = request.time};
  std::error_code error;
  r.bytes = std::filesystem::file_size(request.output, error);
  return r;
}

}  // namespace rondo::study
