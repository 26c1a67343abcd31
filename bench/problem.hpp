// SPDX-License-Identifier: BSD-3-Clause
/// @file  Disks for timing steps, and the work that a step of them requires.
#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "baseline.hpp"
#include "rondo/contact/ground.hpp"
#include "rondo/mesh/disk.hpp"
#include "stream.hpp"

namespace rondo::bench {

/// Kinds of steps: the two operators of the program, and two for comparison.
enum class Steps {
  cyclic,
  sparse,
  eigen,      ///< product by Eigen, separate updates (baseline.hpp)
  reference,  ///< the reference step
};
inline constexpr Steps all_steps[] = {Steps::cyclic, Steps::sparse, Steps::eigen, Steps::reference};
[[nodiscard]] std::string_view name_of(Steps steps) noexcept;

/// Variant of a disk; all spin and have mass damping.
struct Variant {
  bool rolling = false;  ///< in contact with the ground, friction 0.3
  bool beta = true;      ///< with stiffness damping
  int threads = 1;
  contact::GroundShape ground{};
  double pressure = 0.0;    ///< on the tread                                           [Pa]
  bool loaded_rim = false;  ///< height and spin are free under a load
  bool massless = false;    ///< contact nodes are massless
  int implicit_layer = 0;   ///< number of an implicit layer of elements, 1 at the rim; 0: none
  /// Material of all cells, by the sparse operator; none: linear. Δt is that of the linear disk.
  std::optional<fem::Rubber> rubber{};
};

/// Minimum work of a step according to the formulas of the scheme and the arrays of its operator,
/// without contact.
struct Work {
  double flops = 0.0;  ///< per degree of freedom and step
  Streams streams;     ///< one pass over them corresponds to a step
};

/// A disk with material and motion of cases/ledge-smooth.toml. Data of an operator are made when
/// they are first requested.
class Problem {
 public:
  explicit Problem(const mesh::Disk& disk);
  /// From this call on it spins in place, above x = 0. @param height of the center [m]
  void stand_at(double height);

  /// Starts from rest with 0.8 of the step of the element bound (no Lanczos: the bound is a few per
  /// cent higher, and takes no time on a large mesh). Only the latest integrator may be used.
  [[nodiscard]] std::unique_ptr<dynamics::Integrator> integrator(Steps steps,
                                                                 const Variant& variant);

  [[nodiscard]] Work work(Steps steps, const Variant& variant);
  [[nodiscard]] std::size_t n_dofs() const noexcept { return 2 * model_.free.size(); }
  [[nodiscard]] const dynamics::Model& model() const noexcept { return model_; }
  /// The assembled stiffness, and the same in the format of Eigen.
  [[nodiscard]] const fem::BlockCsr& blocks();
  [[nodiscard]] const CsrMatrix& csr();

 private:
  void assemble();
  void move_mass(bool from_contact);
  void make_implicit(int layer);
  void make_rubber(const std::optional<fem::Rubber>& rubber);

  mesh::Mesh mesh_;
  dynamics::Model model_;
  fem::BlockCsr stiffness_;  ///< stored here if the model must not have it
  CsrMatrix csr_;
  double omega_ = 0.0;  ///< upper bound of the largest frequency [rad/s]
};

}  // namespace rondo::bench
