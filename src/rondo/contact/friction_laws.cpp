// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/friction_laws.hpp"

#include <algorithm>
#include <array>

namespace rondo::contact {
namespace {

Friction constant_friction(std::span<const double> parameters) {
  RONDO_DEMAND(parameters.size() == 1, parameters.size());
  return parameters[0];
}

constexpr std::array laws{
    FrictionLaw{"constant", constant_friction},
};

}  // namespace

std::span<const FrictionLaw> friction_laws() noexcept {
  return laws;
}

Friction make_friction(std::string_view name, std::span<const double> parameters) {
  const auto* const law = std::ranges::find(laws, name, &FrictionLaw::name);
  RONDO_DEMAND(law != laws.end(), name);
  return law->make(parameters);
}

}  // namespace rondo::contact
