// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/viscosity.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondo/core/contract.hpp"
#include "rondo/fem/assembly.hpp"
#include "rondo/fem/solid/solid_sector.hpp"

namespace rondo::fem {
namespace {

using Eigen::Index;

/// The times of the outermost branches lie beyond the band by this factor.
constexpr double margin = 1.5;
constexpr double two_pi = 2.0 * std::numbers::pi;

/// `count` numbers from low to high, equally spaced in their logarithms.
std::vector<double> spaced(double low, double high, int count) {
  std::vector<double> all;
  for (int k = 0; k < count; ++k) all.push_back(low * std::pow(high / low, k / (count - 1.0)));
  return all;
}

std::vector<double> frequencies_of(Band band) {
  constexpr int in_decade = 50;
  const double decades = std::log10(band.high / band.low);
  std::vector<double> all =
      spaced(band.low, band.high, 2 + static_cast<int>(std::ceil(in_decade * decades)));
  for (double& frequency : all) frequency *= two_pi;
  return all;
}

/// Im g - tan δ Re g = 0 is linear in the moduli; each of its rows counts by 1/(tan δ Re g) of the
/// moduli before.
void fit(double tangent, const std::vector<double>& omega, std::vector<ViscousBranch>& branches) {
  Eigen::MatrixXd rows(std::ssize(omega), std::ssize(branches));
  Eigen::VectorXd right(std::ssize(omega));
  for (Index m = 0; m < rows.rows(); ++m) {
    const double at = omega[static_cast<std::size_t>(m)];
    const double weight = 1.0 / (tangent * (1.0 + branch_modulus(branches, at).real()));
    right[m] = tangent * weight;
    for (Index b = 0; b < rows.cols(); ++b) {
      const ViscousBranch one{1.0, branches[static_cast<std::size_t>(b)].time};
      const std::complex<double> g = branch_modulus(std::span(&one, 1), at);
      rows(m, b) = weight * (g.imag() - tangent * g.real());
    }
  }
  const Eigen::VectorXd moduli = rows.colPivHouseholderQr().solve(right);
  for (std::size_t b = 0; b < branches.size(); ++b)
    branches[b].relative_modulus = moduli[static_cast<Index>(b)];
}

void assemble(const mesh::Mesh& mesh, std::span<const Material> materials, SectorStiffness& k) {
  k = assemble_sector(mesh, materials);
}
void assemble(const mesh::Mesh& mesh, std::span<const Material> materials, SolidSector& k) {
  k = assemble_solid_sector(mesh, materials);
}
void assemble(const mesh::Mesh& mesh, std::span<const Material> materials, BlockCsr& k) {
  k = assemble_stiffness(mesh, materials);
}

/// What the branches of some materials resist, without their moduli: the others have none.
/// @param is_taken 2: these
std::vector<Material> alone(std::span<const Material> materials, std::span<const char> is_taken) {
  std::vector<Material> some(materials.begin(), materials.end());
  for (std::size_t k = 0; k < some.size(); ++k) {
    if (is_taken[k] != 2) some[k].youngs_modulus = 0.0;
    some[k].only_shear = some[k].rubber.has_value();
    some[k].rubber.reset();
  }
  return some;
}

}  // namespace

const std::vector<ViscousBranch>& branches_of(const Material& m) noexcept {
  return m.rubber ? m.rubber->branches : m.branches;
}

std::complex<double> branch_modulus(std::span<const ViscousBranch> branches,
                                    double omega) noexcept {
  std::complex<double> sum;
  for (const ViscousBranch& b : branches) {
    const double turned = omega * b.time, square = turned * turned;
    sum += b.relative_modulus / (1.0 + square) * std::complex<double>{square, turned};
  }
  return sum;
}

double loss_factor(std::span<const ViscousBranch> branches, double omega) noexcept {
  const std::complex<double> more = branch_modulus(branches, omega);
  return more.imag() / (1.0 + more.real());
}

std::vector<ViscousBranch> branches_of(double tangent, Band band) {
  RONDO_DEMAND(tangent > 0.0 && tangent < 1.0, tangent);
  RONDO_DEMAND(band.low > 0.0 && band.low < band.high, band.low, band.high);
  const double decades = std::log10(band.high / band.low);
  const int count = std::clamp(1 + static_cast<int>(std::ceil(1.25 * decades)), 3, 8);
  const std::vector<double> omega = frequencies_of(band);
  std::vector<ViscousBranch> branches;
  for (const double time :
       spaced(1.0 / (margin * two_pi * band.high), margin / (two_pi * band.low), count))
    branches.push_back({0.0, time});
  constexpr int passes = 30;
  for (int pass = 0; pass < passes && !branches.empty(); ++pass) {
    fit(tangent, omega, branches);
    std::erase_if(branches, [](const ViscousBranch& b) { return !(b.relative_modulus > 0.0); });
  }
  return branches;
}

template <class Stiffness>
std::vector<ViscousPart<Stiffness>> viscous_parts(const mesh::Mesh& mesh,
                                                  std::span<const Material> materials,
                                                  ViscousBy by) {
  std::vector<ViscousPart<Stiffness>> parts;
  std::vector<char> is_taken(materials.size(), 0);
  for (std::size_t k = 0; k < materials.size(); ++k) {
    const std::vector<ViscousBranch>& branches = branches_of(materials[k]);
    if (branches.empty() || is_taken[k] != 0) continue;
    for (std::size_t other = k; other < materials.size(); ++other)
      if (other == k || (by == ViscousBy::branches && branches_of(materials[other]) == branches))
        is_taken[other] = 2;
    ViscousPart<Stiffness>& part = parts.emplace_back();
    const bool has_name = k < mesh.region_names.size() && !mesh.region_names[k].empty();
    part.name = has_name ? mesh.region_names[k] : "material";
    part.branches = branches;
    assemble(mesh, alone(materials, is_taken), part.stiffness);
    std::ranges::replace(is_taken, 2, 1);
  }
  return parts;
}

template std::vector<ViscousPart<SectorStiffness>> viscous_parts(const mesh::Mesh&,
                                                                 std::span<const Material>,
                                                                 ViscousBy);
template std::vector<ViscousPart<SolidSector>> viscous_parts(const mesh::Mesh&,
                                                             std::span<const Material>, ViscousBy);
template std::vector<ViscousPart<BlockCsr>> viscous_parts(const mesh::Mesh&,
                                                          std::span<const Material>, ViscousBy);

template <int C>
SectorBlocks<C> with_branches(const SectorBlocks<C>& k,
                              std::span<const ViscousPart<SectorBlocks<C>>> parts) {
  SectorBlocks<C> all = k;
  for (const ViscousPart<SectorBlocks<C>>& part : parts) {
    RONDO_DEMAND(part.stiffness.nodes == k.nodes, part.stiffness.n_local(), k.n_local());
    double sum = 0.0;
    for (const ViscousBranch& b : part.branches) sum += b.relative_modulus;
    for (std::size_t a = 0; a < k.n_local(); ++a)
      for (const auto& e : part.stiffness.row(a)) {
        if (std::ranges::all_of(e.block, [](double value) { return value == 0.0; })) continue;
        const auto row =
            std::span(all.entries).subspan(k.row_start[a], k.row_start[a + 1] - k.row_start[a]);
        const auto same = std::ranges::find_if(
            row, [&](const auto& of) { return of.column == e.column && of.shift == e.shift; });
        RONDO_DEMAND(same != row.end(), a, e.column, e.shift);
        for (std::size_t i = 0; i < e.block.size(); ++i) same->block[i] += sum * e.block[i];
      }
  }
  return all;
}

template SectorStiffness with_branches(const SectorStiffness&,
                                       std::span<const ViscousPart<SectorStiffness>>);
template SolidSector with_branches(const SolidSector&, std::span<const ViscousPart<SolidSector>>);

double fit_error(std::span<const ViscousBranch> branches, double tangent, Band band) {
  double largest = 0.0;
  for (const double omega : frequencies_of(band))
    largest = std::max(largest, std::abs(loss_factor(branches, omega) / tangent - 1.0));
  return largest;
}

}  // namespace rondo::fem
