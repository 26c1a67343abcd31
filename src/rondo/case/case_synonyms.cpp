// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/case_keys.hpp"

namespace rondo::study {
namespace {

constexpr std::string_view no_load =
    "no key gives a load: motion.height brings the rim down, and a sweep finds the height that "
    "bears a load (docs/studies.md); [[load.pressure]] presses on a curve";

// A key of the same name in the table that was written comes before the one that stands here.
constexpr Synonym synonyms[] = {
    {"mu", "ground.friction"},
    {"friction_coefficient", "ground.friction"},
    {"coefficient_of_friction", "ground.friction"},
    {"cor", "ground.restitution"},
    {"E", "material.youngs_modulus"},
    {"young", "material.youngs_modulus"},
    {"modulus", "material.youngs_modulus"},
    {"elastic_modulus", "material.youngs_modulus"},
    {"nu", "material.poissons_ratio"},
    {"poisson", "material.poissons_ratio"},
    {"rho", "material.density"},
    {"omega", "motion.angular_velocity"},
    {"spin", "motion.angular_velocity"},
    {"rotation_speed", "motion.angular_velocity"},
    {"velocity", "motion.speed"},
    {"V", "motion.speed"},
    {"g", "motion.gravity"},
    {"alpha", "damping.mass"},
    {"beta", "damping.stiffness"},
    {"dt", "time.step"},
    {"timestep", "time.step"},
    {"time_step", "time.step"},
    {"duration", "time.end"},
    {"t_end", "time.end"},
    {"radius", "disk.outer_radius"},
    {"load", "", no_load},
    {"normal_load", "", no_load},
    {"vertical_load", "", no_load},
    {"force", "", no_load},
    {"force_y", "", no_load},
    {"weight", "", no_load},
};

}  // namespace

std::span<const Synonym> synonyms_of_keys() noexcept {
  return synonyms;
}

}  // namespace rondo::study
