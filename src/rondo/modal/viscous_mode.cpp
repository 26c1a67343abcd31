// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/modal/viscous_mode.hpp"

#include <cmath>
#include <complex>
#include <limits>
#include <type_traits>

#include "rondo/core/vec3.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/fem/stiffness_product.hpp"

namespace rondo::modal {
namespace {

using Complexes = std::complex<double>;

template <class Vec, class Stiffness>
double form(const Stiffness& v, std::span<const Vec> u) {
  std::vector<Vec> force(u.size());
  if constexpr (std::is_same_v<Stiffness, fem::BlockCsr>)
    fem::apply(v, u, force, 1);
  else
    fem::apply(v, u, force);
  double sum = 0.0;
  for (std::size_t k = 0; k < u.size(); ++k) sum += dot(u[k], force[k]);
  return sum;
}

/// A polynomial in λ, and branches that stiffen it by h(λ) times a number.
struct Equation {
  Complexes linear;
  double constant = 0.0;
  struct Branch {
    double stiffness, time;
  };
  std::vector<Branch> branches;

  [[nodiscard]] Complexes value(Complexes x) const noexcept {
    Complexes sum = x * (x + linear) + constant;
    for (const auto& [stiffness, time] : branches) sum += stiffness * x * time / (1.0 + x * time);
    return sum;
  }
  [[nodiscard]] Complexes slope(Complexes x) const noexcept {
    Complexes sum = 2.0 * x + linear;
    for (const auto& [stiffness, time] : branches)
      sum += stiffness * time / ((1.0 + x * time) * (1.0 + x * time));
    return sum;
  }
};

/// By Newton's method; NaN: not found.
Complexes root_near(const Equation& f, Complexes x) noexcept {
  constexpr int most = 100;
  constexpr double round_off = 1e-14;
  for (int i = 0; i < most; ++i) {
    const Complexes step = f.value(x) / f.slope(x);
    x -= step;
    if (std::abs(step) <= round_off * std::abs(x)) return x;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

template <class Stiffness>
double take_branches(std::span<const fem::ViscousPart<Stiffness>> parts,
                     std::span<const double> mass, double spin, Damping damping, Mode& mode) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (mode.wave == Wave::rigid || !(mode.omega > 0.0)) return none;
  using Vec = std::conditional_t<std::is_same_v<Stiffness, fem::SolidSector>, Vec3, Vec2>;
  const std::span<const Vec> real = mode.real, imaginary = mode.imaginary;
  const ModeForms forms = forms_of(mass, spin, mode);
  Equation f{{damping.mass + damping.stiffness * forms.elastic, forms.gyroscopic},
             forms.elastic - forms.softening,
             {}};
  Complexes stiffer = 1.0;
  for (const fem::ViscousPart<Stiffness>& part : parts) {
    const double v = form(part.stiffness, real) + form(part.stiffness, imaginary);
    for (const fem::ViscousBranch& b : part.branches)
      f.branches.push_back({b.relative_modulus * v, b.time});
    stiffer += fem::branch_modulus(part.branches, mode.omega).real() * v / forms.elastic;
  }
  const Complexes root = root_near(f, {0.0, mode.omega * std::sqrt(stiffer.real())});
  constexpr double round_off_of_real = 1e-9;
  if (!(root.imag() > round_off_of_real * std::abs(root))) return none;
  mode.omega = std::abs(root);
  return -root.real() / mode.omega;
}

template double take_branches(std::span<const fem::ViscousPart<fem::SectorStiffness>>,
                              std::span<const double>, double, Damping, Mode&);
template double take_branches(std::span<const fem::ViscousPart<fem::SolidSector>>,
                              std::span<const double>, double, Damping, Mode&);
template double take_branches(std::span<const fem::ViscousPart<fem::BlockCsr>>,
                              std::span<const double>, double, Damping, Mode&);

}  // namespace rondo::modal
