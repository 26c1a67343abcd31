// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/basis_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/h5/h5.hpp"
#include "rondo/io/mesh_files.hpp"

namespace rondo::io {
namespace {

using Eigen::Index;

constexpr const char* basis_format = "rondo basis 1";
constexpr const char* fields = "/basis/field";

void check_format(const h5::File& file) {
  std::string format = "none";
  try {
    format = file.attribute("/", "format");
  } catch (const FileError&) {  // reported below
  }
  if (format != basis_format)
    throw FileError(file.path(), fmt::format("its format is \"{}\", not \"{}\": damaged, or not of "
                                             "this version; run the case again",
                                             format, basis_format));
}

}  // namespace

void write_basis(const std::filesystem::path& path, const mesh::Mesh& mesh,
                 std::span<const double> mass, const Eigen::MatrixXd& field) {
  RONDO_DEMAND(!mesh.is_solid() && field.rows() == static_cast<Index>(2 * mesh.n_nodes()),
               field.rows(), mesh.n_nodes());
  h5::File file = h5::File::create(path);
  file.set_attribute("/", "format", basis_format);
  write_mesh(file, mesh, mass);
  if (field.cols() > 0)  // a dataset without numbers is left out
    file.write(fields, {static_cast<std::size_t>(field.cols()), mesh.n_nodes(), 2},
               std::span<const double>(field.data(), static_cast<std::size_t>(field.size())),
               {"m (J/m)^(-1/2)",
                "fields of the body under loads on its contact nodes, at each node: x, y"});
  file.close();
}

Basis read_basis(const std::filesystem::path& path) {
  const h5::File file = h5::File::open(path);
  check_format(file);
  Basis basis{read_mesh(file).mesh, {}};
  const auto n = basis.mesh.n_nodes();
  basis.field.resize(static_cast<Index>(2 * n), 0);
  if (!file.contains(fields)) return basis;
  const h5::Dataset dataset = file.dataset(fields, {h5::any, n, 2});
  const std::vector<double> numbers = dataset.read<double>();
  basis.field = Eigen::Map<const Eigen::MatrixXd>(numbers.data(), basis.field.rows(),
                                                  static_cast<Index>(dataset.shape()[0]));
  if (!basis.field.allFinite())
    throw FileError(path.string(), fmt::format("{} holds what is not a number: damaged", fields));
  return basis;
}

std::size_t basis_bytes(const mesh::Mesh& mesh, const Eigen::MatrixXd& field) noexcept {
  constexpr std::size_t description = 65536;
  return description + mesh_bytes(mesh) + static_cast<std::size_t>(field.size()) * sizeof(double);
}

}  // namespace rondo::io
