// SPDX-License-Identifier: BSD-3-Clause
/// @file  modelDescription.xml of a wheel (FMI 2.0.4,
/// 2.2 and 4.3), and the other files in the FMU.
#pragma once
#include <string>

#include "rondo/fmu/values.hpp"

namespace rondo::fmu {

struct Description {
  std::string identifier;  ///< a C identifier: the name of the binary
  std::string title;       ///< of the case
  std::string guid;        ///< of case and model
  Dimension dimension = Dimension::plane;
  Values start;
};

/// The name with only letters, digits, underscores, and no digit first.
[[nodiscard]] std::string identifier_of(const std::string& name);

[[nodiscard]] std::string model_description(const Description& d);

/// documentation/index.html
[[nodiscard]] std::string index_page(const Description& d);

}  // namespace rondo::fmu
