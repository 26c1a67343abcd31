// SPDX-License-Identifier: BSD-3-Clause
/// @file  The contact laws that a case asks for: the one place where keys become a friction law.
#pragma once
#include <array>

#include "rondo/case/case.hpp"
#include "rondo/contact/friction_laws.hpp"
#include "rondo/contact/friction_table.hpp"
#include "rondo/contact/law.hpp"

namespace rondo::study {

[[nodiscard]] inline contact::Law law_of(const GroundCase& of) {
  return {contact::friction_of(of.friction), of.restitution, of.impact};
}

[[nodiscard]] inline contact::Law law_of(const BodyContactCase& of) {
  return {contact::make_friction("constant", std::array{of.friction}), of.restitution, of.impact};
}

}  // namespace rondo::study
