// SPDX-License-Identifier: BSD-3-Clause
/// @file  The modes of LATIN-PGD as the directory of a POD, RUN/pod/displacement-pgd, and the
/// fields in it that another run may begin with (docs/results.md).
#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "rondo/mesh/mesh.hpp"
#include "rondo/statics/latin/latin.hpp"
#include "rondo/statics/latin/pgd.hpp"

namespace rondo::study {

/// n nodes, N increments. Pointers and spans are only read by write_pgd().
struct PgdModes {
  const mesh::Mesh* mesh = nullptr;
  std::span<const double> mass;   ///< (n) lumped mass of the nodes                          [kg/m]
  std::string title;              ///< title of the run
  std::vector<double> parameter;  ///< (N) of each increment, in the place of time, rising      [-]
  const statics::Separated* solution = nullptr;  ///< all of it: Pgd::separated(0.0)
  const Eigen::MatrixXd* basis = nullptr;        ///< (2n, b) field of Pgd::basis()
  double share = 0.0;      ///< share of the norm of the solution that the modes left out may have
  double direction = 0.0;  ///< k                                                          [N/m²]
  statics::LatinReport latin;      ///< report of the last iteration
  int solves = 0, most_modes = 0;  ///< counts of the Pgd
};

/// The results of write_pgd().
struct PgdFiles {
  int values = 0, modes = 0;    ///< singular values; modes kept
  double left_out = 0.0;        ///< by the modes kept, of the norm of the solution           [-]
  double orthonormality = 0.0;  ///< max |ΦᵀAΦ - 1| of the modes kept
};

/// A directory that opens is complete: pod.json is written last. @throws FileError
PgdFiles write_pgd(const std::filesystem::path& run_directory, const PgdModes& modes);

/// The basis file of a run that is done, or of its PGD. @throws InputError: as read_pgd_basis()
[[nodiscard]] std::filesystem::path pgd_basis_file(const std::filesystem::path& run);

/// The fields another run was solved with: (2n, b), b >= 1. @param run its directory, or that of
/// its PGD. @throws InputError: no such run, one without modes of LATIN-PGD, of another mesh;
/// FileError: damaged
[[nodiscard]] Eigen::MatrixXd read_pgd_basis(const std::filesystem::path& run,
                                             const mesh::Mesh& mesh);

}  // namespace rondo::study
