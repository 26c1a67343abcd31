// SPDX-License-Identifier: BSD-3-Clause
/// @file  `rondo matrices`: the operators of a case's motion in an HDF5 file (docs/operators.md).
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "rondo/case/case.hpp"

namespace rondo::study {

struct MatricesRequest {
  std::filesystem::path output;  ///< file that is written, or replaced
  double time = 0.0;             ///< time of the contact rows                             [s]
  std::function<void(const std::string&)> warn;  ///< gets the warnings; may be empty
};

struct MatricesReport {
  std::filesystem::path file;
  std::uintmax_t bytes = 0;
  std::size_t nodes = 0;          ///< not clamped
  std::size_t unknowns = 0;       ///< 2 or 3 of each node
  std::size_t entries = 0;        ///< of K
  std::size_t contact_nodes = 0;  ///< rows of H over the components; 0: there is no ground
  double time = 0.0;              ///< of the contact rows                                  [s]
};

/// Builds the case as a run would, and writes its operators; the file is there as a whole or not at
/// all. @throws InputError: what build() and make_operators() say, no motion in time, a wrong time,
/// no file; FileError
MatricesReport write_matrices(const Case& c, const MatricesRequest& request);

}  // namespace rondo::study
