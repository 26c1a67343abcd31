// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/mode_files.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

#include "rondo/io/h5/h5.hpp"
#include "rondo/io/mesh_files.hpp"
#include "rondo/io/xdmf.hpp"

namespace rondo::io {
namespace fs = std::filesystem;
namespace {

using h5::Type;
using Vector = std::array<float, 3>;  ///< for ParaView

/// One part, real or imaginary, of all modes: as computed, and in the form for ParaView.
struct Part {
  h5::Dataset exact, shown;
};

Part create(h5::File& file, const char* name, const h5::Shape& shape) {
  const std::string part = name;
  const bool solid = shape[2] == 3;
  const std::string unit = solid ? "kg^(-1/2)" : "(kg/m)^(-1/2)";
  return {file.create(
              "/modes/" + part, Type::float64, shape,
              {unit, part + " part of each shape phi at each node: x, y" + (solid ? ", z" : "") +
                         ", in the turning frame; the motion is Re(phi exp(i omega t))"}),
          file.create("/fields/" + part, Type::float32, {shape[0], shape[1], 3},
                      {unit, "/modes/" + part + " for ParaView"})};
}

void put(Part& part, std::size_t row, FieldView shape) {
  std::vector<Vector> shown(shape.size(), Vector{});
  for (std::size_t i = 0; i < shape.size(); ++i)
    for (std::size_t c = 0; c < shape.components; ++c)
      shown[i][c] = static_cast<float>(shape[i][c]);
  part.exact.write_row(row, shape.values);
  part.shown.write_row(row, std::span<const Vector>(shown));
}

XdmfSeries series_of(const mesh::Mesh& mesh, std::size_t modes) {
  XdmfSeries s;
  s.data_file = "modes.h5";
  s.topology = topology_of(mesh);
  s.reference = "/mesh/coordinates";
  s.n_nodes = mesh.n_nodes();
  s.n_times = modes;
  s.fields = {{"real", "Vector", "/fields/real", 3, 0, 3},
              {"imaginary", "Vector", "/fields/imaginary", 3, 0, 3}};
  return s;
}

void write_figures(h5::File& file, std::span<const SpinModes> spins, std::size_t n) {
  std::vector<double> frequency, angular_velocity;
  std::vector<std::int32_t> diameters;
  for (const SpinModes& spin : spins)
    for (const modal::Mode& mode : *spin.modes) {
      frequency.push_back(mode.omega);
      angular_velocity.push_back(spin.angular_velocity);
      diameters.push_back(mode.diameters);
    }
  file.write("/modes/frequency", {n}, frequency,
             {"rad/s", "omega of each mode in the co-rotating frame"});
  file.write("/modes/angular_velocity", {n}, angular_velocity,
             {"rad/s", "of the body, as in the case: > 0 rolls towards +x"});
  file.write("/modes/nodal_diameters", {n}, diameters, {"1", "of each mode; -1: unknown"});
}

}  // namespace

void write_mode_shapes(const fs::path& directory, const mesh::Mesh& mesh,
                       std::span<const double> mass, std::span<const SpinModes> spins) {
  std::size_t n = 0;
  for (const SpinModes& spin : spins) n += spin.modes->size();
  h5::File file = h5::File::create(directory / "modes.h5");
  file.set_attribute("/", "format", "rondo modes 1");
  write_mesh(file, mesh, mass);
  Xdmf xdmf(directory / "modes.xdmf", series_of(mesh, n));
  if (n > 0) {  // readers fail on datasets without numbers
    write_figures(file, spins, n);
    const h5::Shape shape{n, mesh.n_nodes(), mesh.is_solid() ? 3U : 2U};
    Part real = create(file, "real", shape);
    Part imaginary = create(file, "imaginary", shape);
    std::size_t row = 0;
    for (const SpinModes& spin : spins)
      for (const modal::Mode& mode : *spin.modes) {
        put(real, row, mode.real);
        put(imaginary, row, mode.imaginary);
        xdmf.add(static_cast<double>(++row));
      }
  }
  xdmf.close();
  file.close();
}

}  // namespace rondo::io
