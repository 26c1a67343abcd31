// SPDX-License-Identifier: BSD-3-Clause
/// @file  The friction laws that there are, as one table. A new law is a function in a file of its
/// own, and its row.
#pragma once
#include <span>
#include <string_view>

#include "rondo/contact/friction.hpp"

namespace rondo::contact {

struct FrictionLaw {
  std::string_view name;
  Friction (*make)(std::span<const double> parameters);  ///< @pre as many as the law has
};
[[nodiscard]] std::span<const FrictionLaw> friction_laws() noexcept;

/// @pre `name` is in the table
[[nodiscard]] Friction make_friction(std::string_view name, std::span<const double> parameters);

}  // namespace rondo::contact
