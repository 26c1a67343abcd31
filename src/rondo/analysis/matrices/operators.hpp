// SPDX-License-Identifier: BSD-3-Clause
/// @file  The operators of the equation of motion as sparse matrices, for programs with methods of
/// their own (docs/operators.md). With the displacement u of the nodes that are not clamped, in the
/// frame that turns counter-clockwise at the rate s = -ω (docs/theory.md, 3.1; docs/wheel3d.md,
/// S.2),
///
///     M u'' + (C + s G) u' + (K - s² Z + ½ s' G) u = s² Z X - ½ s' G X + f + Hᵀ λ,
///
/// where f holds gravity, the acceleration of the center, and pressures; H is in contact_rows.hpp.
#pragma once
#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

#include "rondo/case/setup.hpp"

namespace rondo::study {

/// Compressed rows, the columns of a row ascending: the arrays of scipy.sparse.csr_matrix.
using Csr = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Unknown components·k + i is component i of nodes[k]. Units are those of a plane body, per metre
/// of its width; in three dimensions masses are in kg and K is in N/m.
struct Operators {
  std::size_t components = 2;     ///< of a node: 2 in the plane, 3 in space
  std::vector<int> nodes;         ///< (f) that are not clamped, ascending; numbers of the mesh
  std::vector<double> reference;  ///< (components·f) X                                   [m]
  Csr mass;       ///< M, diagonal, as it moves: 0 at massless contact nodes            [kg/m]
  Csr damping;    ///< C = α M + β K                                                    [N·s/m²]
  Csr stiffness;  ///< K, bitwise symmetric, with stress stiffening if the case asks    [N/m²]
  Csr gyroscopic;   ///< G = 2 M J, skew; J turns by +90° and has no axial part           [kg/m]
  Csr centrifugal;  ///< Z = M P, diagonal: M without the axial components                [kg/m]

  [[nodiscard]] std::size_t n_unknowns() const noexcept { return components * nodes.size(); }
};

/// @param s built from c. @throws InputError: no constant K (rubber at finite strain, a material of
/// its own, bodies that nothing holds), or more memory than there is
[[nodiscard]] Operators make_operators(const Case& c, const Setup& s);

}  // namespace rondo::study
