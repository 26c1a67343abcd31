// SPDX-License-Identifier: BSD-3-Clause
/// @file  The contact law that a case asks for: the one place where keys become a friction law.
#pragma once
#include <array>

#include "rondo/case/case.hpp"
#include "rondo/contact/friction_laws.hpp"
#include "rondo/contact/law.hpp"

namespace rondo::study {

/// @param of GroundCase or BodyContactCase
template <class Contact>
[[nodiscard]] contact::Law law_of(const Contact& of) {
  return {contact::make_friction("constant", std::array{of.friction}), of.restitution, of.impact};
}

}  // namespace rondo::study
