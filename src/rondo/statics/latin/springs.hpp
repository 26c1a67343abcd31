// SPDX-License-Identifier: BSD-3-Clause
/// @file  The stiffness of a body with springs on its candidates, and fields of other runs seen
/// from them (docs/latin.md, LATIN-PGD).
#pragma once
#include <span>
#include <vector>

#include "rondo/fem/assembly.hpp"
#include "rondo/statics/latin/pgd.hpp"

namespace rondo::statics {

/// K + k HᵀH. @param nodes of the candidates; direction k [N/m²]
[[nodiscard]] fem::BlockCsr with_springs(fem::BlockCsr stiffness, std::span<const int> nodes,
                                         double direction);

/// Places in `nodes` that carry the loads of some field, K φ ≠ 0 in numbers, ascending.
/// @param field (2n, r)
[[nodiscard]] std::vector<std::size_t> loaded_places(const fem::BlockCsr& stiffness,
                                                     std::span<const int> nodes,
                                                     const Eigen::MatrixXd& field);

/// Fields of a body under loads on its candidates, as Pgd::begin_with takes them.
struct Adopted {
  Fields fields;
  double foreign = 0.0;  ///< largest share of a field's load that is not on the candidates: far
                         ///< from 0, the fields are of another body                         [-]
};
/// @param nodes (m) of the histories' rows, field (2n, r) of the whole body
[[nodiscard]] Adopted adopt(const fem::BlockCsr& stiffness, const std::vector<int>& nodes,
                            double direction, Eigen::MatrixXd field);

}  // namespace rondo::statics
