// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/case_keys.hpp"

namespace rondo::study {
namespace {

constexpr std::string_view load_keys =
    "a load on the rim is rim.force_y, where [rim] has free = [\"height\"]; for a crush there is "
    "analysis.depth, and [[load.pressure]] presses on a curve";

constexpr std::string_view yaw_keys =
    "in steady rolling motion.turn_slip is the yaw rate over the speed; in steps of time the wheel "
    "does not yaw, and motion.slip_angle may be a table";

// A key with the same name in the table that the user wrote takes precedence over these.
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
    {"G", "material.shear_modulus"},
    {"shear", "material.shear_modulus"},
    {"kappa", "material.bulk_modulus"},
    {"bulk", "material.bulk_modulus"},
    {"law", "material.model"},
    {"hyperelastic", "material.model"},
    {"tau", "material.viscosity[].time"},
    {"tan_delta", "material.loss_factor"},
    {"loss_tangent", "material.loss_factor"},
    {"relaxation_time", "material.viscosity[].time"},
    {"prony", "material.viscosity[].relative_modulus"},
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
    {"yaw", "", yaw_keys},
    {"yaw_rate", "", yaw_keys},
    {"curvature", "motion.turn_slip"},
    {"path_curvature", "motion.turn_slip"},
    {"spin_slip", "motion.turn_slip"},
    {"steer", "motion.slip_angle"},
    {"steering_angle", "motion.slip_angle"},
    {"sideslip", "motion.slip_angle"},
    {"inclination", "motion.camber"},
    {"camber_angle", "motion.camber"},
    {"grooves", "disk.tread.circumferential_grooves"},
    {"load", "", load_keys},
    {"normal_load", "", load_keys},
    {"vertical_load", "", load_keys},
    {"force", "", load_keys},
    {"weight", "", load_keys},
    {"drag", "rim.force_x"},
    {"moment", "rim.torque"},
    {"driving_torque", "rim.torque"},
    {"drive_torque", "rim.torque"},
    {"braking_torque", "rim.brake"},
    {"brake_torque", "rim.brake"},
    {"rim_mass", "rim.mass"},
    {"hub_mass", "rim.mass"},
    {"moment_of_inertia", "rim.inertia"},
    {"rim_inertia", "rim.inertia"},
    {"dofs", "rim.free"},
    {"degrees_of_freedom", "rim.free"},
    {"spring", "rim.support.y.stiffness"},
    {"suspension", "rim.support.y.stiffness"},
    {"dashpot", "rim.support.y.damping"},
    {"damper", "rim.support.y.damping"},
    {"incline", "motion.slope"},
    {"inclination", "motion.slope"},
    {"gradient", "motion.slope"},
    {"tilt", "motion.slope"},
};

}  // namespace

std::span<const Synonym> synonyms_of_keys() noexcept {
  return synonyms;
}

}  // namespace rondo::study
