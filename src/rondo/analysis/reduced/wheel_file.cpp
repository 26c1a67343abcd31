// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/reduced/wheel_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <sstream>
#include <utility>

#include "rondo/core/error.hpp"
#include "rondo/core/index.hpp"
#include "rondo/io/checkpoint_file.hpp"
#include "rondo/io/mesh_files.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {
namespace {

using Eigen::Index, Eigen::MatrixXcd, Eigen::VectorXd;
using io::h5::File, io::h5::Label, io::h5::Shape;
using rom::RingHarmonic;

constexpr const char* format = "rondo reduced wheel 1";
constexpr const char* format_of_old = "rondo reduced model";  ///< and a number
constexpr const char* how_to_make = "rondo reduce CASE.toml -o wheel.h5 makes a file for --reduced";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Collects what all modes have, one after the other.
class AllModes {
 public:
  AllModes(File& file, std::span<const RingHarmonic> harmonics)
      : file_(file), harmonics_(harmonics) {
    for (const RingHarmonic& h : harmonics) n_ += at(h.squares.size());
  }
  [[nodiscard]] std::size_t size() const noexcept { return n_; }

  /// Columns of the harmonics as rows of (n, shape...), real and imaginary part.
  void columns(const char* name, MatrixXcd RingHarmonic::*of, Shape shape, const Label& label) {
    std::vector<double> numbers;
    for (const RingHarmonic& h : harmonics_) put_all(h.*of, numbers);
    write(name, std::move(shape), numbers, label);
  }
  void entries(const char* name, Eigen::VectorXcd RingHarmonic::*of, const Label& label) {
    std::vector<double> numbers;
    for (const RingHarmonic& h : harmonics_) put_all(h.*of, numbers);
    write(name, {}, numbers, label);
  }
  void coriolis(const Label& label) {
    MatrixXcd all = MatrixXcd::Zero(static_cast<Index>(n_), static_cast<Index>(n_));
    Index first = 0;
    for (const RingHarmonic& h : harmonics_) {
      const Index r = h.squares.size();
      all.block(first, first, r, r) = h.coriolis.transpose();
      first += r;
    }
    std::vector<double> numbers;
    put_all(all, numbers);
    write("/modes/coriolis", {n_}, numbers, label);
  }

 private:
  /// Column after column.
  template <class Complexes>
  static void put_all(const Complexes& from, std::vector<double>& to) {
    for (Index k = 0; k < from.size(); ++k)
      to.insert(to.end(), {from.data()[k].real(), from.data()[k].imag()});
  }
  void write(const char* name, Shape shape, const std::vector<double>& numbers,
             const Label& label) {
    shape.insert(shape.begin(), n_);
    shape.push_back(2);
    file_.write(name, shape, numbers, label);
  }

  File& file_;
  std::span<const RingHarmonic> harmonics_;
  std::size_t n_ = 0;
};

void write_modes(File& file, const rom::Ring& ring, std::span<const RingHarmonic> harmonics) {
  AllModes modes(file, harmonics);
  std::vector<std::int64_t> harmonic;
  std::vector<double> square;
  for (const RingHarmonic& h : harmonics) {
    harmonic.insert(harmonic.end(), at(h.squares.size()), h.k);
    square.insert(square.end(), h.squares.begin(), h.squares.end());
  }
  file.write("/modes/harmonic", {modes.size()}, harmonic, {"1", "k of each mode, ascending"});
  file.write("/modes/square", {modes.size()}, square,
             {"1/s2", "square of the angular frequency at rest"});
  modes.columns("/modes/shape", &RingHarmonic::shapes, {ring.stiffness.n_local(), 2},
                {"(m/kg)^(1/2)",
                 "mode, row of a sector, components in the frame of the sector, real and "
                 "imaginary part; shape^H M shape = 1 over the masses of one sector"});
  modes.columns("/modes/contact", &RingHarmonic::contact, {ring.contact.size(), 2},
                {"(m/kg)^(1/2)", "the same at the contact nodes alone"});
  modes.coriolis({"1", "row, column: mode^H M J mode, 0 between harmonics"});
  modes.entries("/modes/reference", &RingHarmonic::reference,
                {"(kg m)^(1/2)", "mode^H M X, of harmonic 0"});
  modes.entries("/modes/turned", &RingHarmonic::turned,
                {"(kg m)^(1/2)", "mode^H M J X, of harmonic 0"});
  modes.entries("/modes/translation", &RingHarmonic::translation,
                {"(kg/m)^(1/2)", "mode^T M (1, -i), of the harmonic that moves the center"});
}

void write_sector(File& file, const rom::Ring& ring) {
  std::vector<std::int64_t> node(ring.stiffness.nodes.begin(), ring.stiffness.nodes.end()),
      contact(ring.contact.begin(), ring.contact.end());
  const std::array<std::int64_t, 2> counts{ring.n_sectors(), ring.stiffness.nodes_per_sector};
  file.write("/sector/counts", {2}, std::span<const std::int64_t>(counts),
             {"1",
              "sectors, nodes of a sector in the mesh; row a of sector j is the node "
              "j * nodes + /sector/node[a]"});
  file.write("/sector/node", {node.size()}, node, {"1", "node of each row, within the sector"});
  file.write("/sector/contact", {contact.size()}, contact, {"1", "rows of the contact nodes"});
}

std::vector<double> blocks_of(std::span<const rom::RingResidual> residuals) {
  std::vector<double> blocks;
  for (const rom::RingResidual& r : residuals)
    blocks.insert(blocks.end(), r.blocks.begin(), r.blocks.end());
  return blocks;
}

/// What only a viscous wheel has.
void write_creep(File& file, const io::h5::Shape& shape, const rom::WheelModel& model) {
  std::vector<double> branches, creep;
  for (const fem::ViscousBranch& b : model.branches)
    branches.insert(branches.end(), {b.relative_modulus, b.time});
  for (const rom::CreepTerm& term : model.creep) creep.insert(creep.end(), {term.share, term.time});
  file.write("/material/branches", {model.branches.size(), 2}, branches,
             {"1, s", "relative modulus and time of relaxation of each viscous branch"});
  file.write("/residual/creep", {model.creep.size(), 2}, creep,
             {"1, s",
              "share and time of creep of each term: lagging forces of the first one go with "
              "/residual/compliance, those of all others with /residual/compliance_later"});
  file.write("/residual/compliance_later", shape, blocks_of(model.later),
             {"m2/N", "as /residual/compliance, of the terms of the creep but the first"});
}

void write_residual(File& file, const rom::Ring& ring, const rom::WheelModel& model) {
  const std::size_t n = at(ring.n_sectors()), size = at(ring.n_contact()),
                    tables = model.residuals.size();
  std::vector<double> centrifugal;
  for (const rom::RingResidual& r : model.residuals)
    centrifugal.insert(centrifugal.end(), r.centrifugal.begin(), r.centrifugal.end());
  file.write("/residual/spin_squared", {tables}, model.squares,
             {"1/s2", "square of the spin of each table; between three, a polynomial in it"});
  file.write("/residual/compliance", {tables, n, size, size}, blocks_of(model.residuals),
             {"m2/N",
              "table, lag d, force component, displacement component: displacement of contact node "
              "i of sector j + d by a force on the contact nodes of sector j, beyond the modes"});
  file.write("/residual/centrifugal", {tables, ring.stiffness.n_local(), 2}, centrifugal,
             {"m", "displacement by the spin beyond the modes, rows of a sector"});
  if (!model.creep.empty()) write_creep(file, {tables, n, size, size}, model);
}

MatrixXcd read_complex(const File& file, const char* name, std::size_t modes, Index rows) {
  const Shape shape{modes, at(rows) / 2, 2, 2};
  const std::vector<double> numbers = file.dataset(name, shape).read<double>();
  MatrixXcd out(rows, static_cast<Index>(modes));
  for (Index k = 0; k < out.size(); ++k)
    out.data()[k] = {numbers[at(2 * k)], numbers[at(2 * k + 1)]};
  return out;
}

/// The harmonics that the modes are of. @throws FileError
std::vector<RingHarmonic> read_modes(const File& file, const rom::Ring& ring,
                                     const std::string& path) {
  const auto harmonic = file.dataset("/modes/harmonic", {io::h5::any}).read<std::int64_t>();
  const std::size_t n = harmonic.size();
  const std::vector<double> square = file.dataset("/modes/square", {n}).read<double>();
  const MatrixXcd shape = read_complex(file, "/modes/shape", n, ring.n_rows());
  const auto is_good = [](double x) { return std::isfinite(x) && x > 0.0; };
  const bool good = std::ranges::is_sorted(harmonic) &&
                    (n == 0 || (harmonic.front() >= 0 && 2 * harmonic.back() < ring.n_sectors())) &&
                    std::ranges::all_of(square, is_good) && shape.allFinite();
  if (!good) throw FileError(path, "has modes that are none of its mesh");
  std::vector<RingHarmonic> out;
  for (std::size_t first = 0, end = 0; first < n; first = end) {
    while (end < n && harmonic[end] == harmonic[first]) ++end;
    const auto a = static_cast<Index>(first), r = static_cast<Index>(end - first);
    out.push_back(rom::make_harmonic(ring, static_cast<int>(harmonic[first]),
                                     Eigen::Map<const VectorXd>(square.data() + a, r),
                                     shape.middleCols(a, r)));
  }
  return out;
}

[[noreturn]] void refuse_old_model(const File& file, const std::string& path) {
  const std::vector<std::string> runs = lines_of(file.attribute("/", "runs"));
  throw InputError(Fault{
      path, 0, 0, "", "",
      "is a model of an earlier version, whose contact was at points fixed in space",
      fmt::format("rondo run CASE.toml --reduced, which needs no file; or the modes of the runs "
                  "behind it: rondo reduce {} --basis pod -o wheel.h5",
                  fmt::join(runs, " "))});
}

File open_wheel_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw InputError(Fault{path.string(), 0, 0, "", "", "no such file",
                           "a file that `rondo reduce CASE.toml -o wheel.h5` has written; or "
                           "--reduced without a file"});
  if (std::filesystem::is_directory(path, error))
    throw request_error("--reduced", path.string(), "is a directory, not a file of modes",
                        "of results: rondo reduce RESULTS --basis pod -o wheel.h5; or --reduced "
                        "without a file");
  try {
    File file = io::open_checkpoint_file(path);
    const std::string found = file.attribute("/", "format");
    if (found.starts_with(format_of_old)) refuse_old_model(file, path.string());
    if (found == format) return file;
  } catch (const FileError& fault) {
    throw FileError(fault, how_to_make);
  }
  throw FileError(path.string(),
                  fmt::format("is not a reduced wheel (\"{}\"); {}", format, how_to_make));
}

/// @throws InputError: the file is of another body
void demand_same_body(const File& file, const std::string& path, const Case& c, const Setup& setup,
                      const rom::Ring& ring) {
  const auto refuse = [&](const std::string& why) {
    throw request_error(
        "--reduced", path, fmt::format("it is of another mesh or material: {}", why),
        "a file made of this body: rondo reduce CASE.toml -o wheel.h5; or --reduced without a "
        "file");
  };
  const std::string difference = body_difference(body_text(c), file.attribute("/", "body"));
  if (!difference.empty()) refuse("the case has " + difference);
  const io::MeshWithMass body = io::read_mesh(file);
  const std::string other = io::mesh_difference(body.mesh, setup.mesh);
  if (!other.empty()) refuse(other);
  if (!std::ranges::equal(body.mass, lumped_mass_of(setup.model))) refuse("its masses");
  const auto node = file.dataset("/sector/node", {ring.stiffness.n_local()}).read<std::int64_t>();
  if (!std::ranges::equal(node, ring.stiffness.nodes)) refuse("its free nodes");
}

}  // namespace

const char* name_of(WheelBasis basis) noexcept {
  return basis == WheelBasis::pod ? "pod" : "eigenmodes";
}

void write_wheel_file(const std::filesystem::path& file, const Case& c, const Setup& setup,
                      const rom::Ring& ring, const rom::WheelModel& model,
                      const WheelOrigin& origin) {
  io::write_checkpoint_file(file, [&](File& h5) {
    h5.set_attribute("/", "format", format);
    h5.set_attribute("/", "basis", name_of(origin.basis));
    h5.set_attribute("/", "body", body_text(c));
    h5.set_attribute("/", "runs", fmt::format("{}", fmt::join(origin.runs, "\n")));
    h5.set_attribute("/", "build_record", build_record_json().dump());
    io::write_mesh(h5, setup.mesh, lumped_mass_of(setup.model));
    h5.write("/mesh/mass_dynamic", {setup.model.mass.size()}, setup.model.mass,
             {"kg/m", "mass of each node with which it moves: 0 at contact nodes"});
    write_sector(h5, ring);
    write_modes(h5, ring, model.harmonics);
    write_residual(h5, ring, model);
  });
}

WheelFile read_wheel_file(const std::filesystem::path& path, const Case& c, const Setup& setup,
                          const rom::Ring& ring) {
  const File file = open_wheel_file(path);
  demand_same_body(file, path.string(), c, setup, ring);
  WheelFile content;
  if (file.attribute("/", "basis") == name_of(WheelBasis::pod)) content.basis = WheelBasis::pod;
  content.harmonics = read_modes(file, ring, path.string());
  return content;
}

bool is_wheel_file(const std::filesystem::path& path) {
  try {
    const std::string found = io::open_checkpoint_file(path).attribute("/", "format");
    return found == format || found.starts_with(format_of_old);
  } catch (const FileError&) {
    return false;
  }
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
  if (body.mesh) body.mesh->file.clear();  // its cells are compared
  if (c.stress_stiffening != StressStiffening::none)
    body.motion.angular_velocity = dynamics::Table(c.motion.angular_velocity.at(0.0));
  return write_case(body);
}

namespace {

/// Tables end with a line that is empty.
std::string_view line_text(const std::string& line) noexcept {
  return line.empty() ? "no such setting" : std::string_view(line);
}

}  // namespace

std::string body_difference(const std::string& of_case, const std::string& of_other) {
  if (of_case == of_other) return {};
  const std::vector<std::string> a = lines_of(of_case), b = lines_of(of_other);
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (a[i] != b[i]) return fmt::format("{} against {}", line_text(a[i]), line_text(b[i]));
  return "one has settings that the other has not";
}

}  // namespace rondo::study
