// SPDX-License-Identifier: BSD-3-Clause
/// @file  Disks to make steps with, and what a step of them has to do.
#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "baseline.hpp"
#include "rondo/contact/ground.hpp"
#include "rondo/mesh/disk.hpp"
#include "stream.hpp"

namespace rondo::bench {

/// Whose steps: the program's two operators, and two to compare with.
enum class Steps {
  cyclic,
  sparse,
  eigen,      ///< product by Eigen, updates apart (baseline.hpp)
  reference,  ///< the readable step
};
inline constexpr Steps all_steps[] = {Steps::cyclic, Steps::sparse, Steps::eigen, Steps::reference};
[[nodiscard]] std::string_view name_of(Steps steps) noexcept;

/// All spin and have mass damping.
struct Variant {
  bool rolling = false;  ///< in contact with the ground, friction 0.3
  bool beta = true;      ///< with stiffness damping
  int threads = 1;
  contact::GroundShape ground{};
  double pressure = 0.0;    ///< on the tread                                           [Pa]
  bool loaded_rim = false;  ///< height and spin are free, under a load
  bool massless = false;    ///< contact nodes have no mass
  int implicit_layer = 0;   ///< this layer of elements, 1 at the rim, is implicit; 0: none
  /// All of it, by the sparse operator; none: linear. The step stays that of the linear disk.
  std::optional<fem::Rubber> rubber{};
};

/// What a step has to do at the least, by the formulas of the scheme and the arrays of its
/// operator, contact left out.
struct Work {
  double flops = 0.0;  ///< a degree of freedom and step
  Streams streams;     ///< one pass over them is one step
};

/// A disk of the material and the motion of cases/ledge-smooth.toml. What an operator needs is made
/// when it is first asked for.
class Problem {
 public:
  explicit Problem(const mesh::Disk& disk);
  /// Spins where it is, above x = 0, from here on. @param height of the centre       [m]
  void stand_at(double height);

  /// From rest at 0.8 of the step of the element bound (no Lanczos: the bound is some per cent
  /// above, and costs nothing on a large mesh). Only the integrator asked for last may be used.
  [[nodiscard]] std::unique_ptr<dynamics::Integrator> integrator(Steps steps,
                                                                 const Variant& variant);

  [[nodiscard]] Work work(Steps steps, const Variant& variant);
  [[nodiscard]] std::size_t n_dofs() const noexcept { return 2 * model_.free.size(); }
  [[nodiscard]] const dynamics::Model& model() const noexcept { return model_; }
  /// The assembled stiffness, and the same for Eigen.
  [[nodiscard]] const fem::BlockCsr& blocks();
  [[nodiscard]] const CsrMatrix& csr();

 private:
  void assemble();
  void move_mass(bool from_contact);
  void make_implicit(int layer);
  void make_rubber(const std::optional<fem::Rubber>& rubber);

  mesh::Mesh mesh_;
  dynamics::Model model_;
  fem::BlockCsr stiffness_;  ///< here while the model is not to have it
  CsrMatrix csr_;
  double omega_ = 0.0;  ///< upper bound of the largest frequency [rad/s]
};

}  // namespace rondo::bench
