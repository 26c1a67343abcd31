// SPDX-License-Identifier: BSD-3-Clause
/// @file  Signorini–Coulomb contact of nodes without mass over a step, in space (docs/reduced.md):
/// gaps, and distances slid along two tangents, at its end. All contacts are coupled by a dense
/// compliance that is not symmetric. Gauss–Seidel over the contacts, whose fixed point Anderson's
/// mixing finds sooner (Anderson, J. ACM 12 (1965) 547), and Newton's method behind it (Alart,
/// Curnier, CMAME 92 (1991) 353).
#pragma once
#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "rondo/contact/law.hpp"
#include "rondo/core/vec3.hpp"

namespace rondo::rom {

/// A contact. Vectors named `free` and `moved` are along (normal, first tangent, second tangent),
/// forces along the axes in which the compliance is.
struct ConeContact {
  int place = 0;                ///< of the contact in the window of the compliance
  Vec3 free;                    ///< gap and distances slid where nothing presses             [m]
  std::array<Vec3, 3> axes;     ///< normal and tangents, in the axes of the compliance
  std::array<Vec3, 3> lift{};   ///< what unit accelerations of a rim do to it, likewise
  std::array<Vec3, 3> reply{};  ///< what its force does to these: their products
  double friction = 0.0;        ///< μ; out: that of the force, where it follows a law
  Vec3 force;                   ///< in: where to start                                       [N]
  Vec3 moved;                   ///< gap and distances slid with the forces                   [m]
  contact::Status status = contact::Status::open;
};

/// The compliance of a window of a ring: (n, n) displacements by forces, three of each node. That
/// of a smaller window is its leading part.
class WindowCompliance {
 public:
  /// Makes room for n rows; what was there is lost where it grows.
  void resize(Eigen::Index n);
  [[nodiscard]] Eigen::Index size() const noexcept { return exact_.rows(); }
  /// A column, to be filled before round().
  [[nodiscard]] double* column(Eigen::Index j) noexcept { return exact_.col(j).data(); }
  [[nodiscard]] const double* column(Eigen::Index j) const noexcept { return exact_.col(j).data(); }
  /// The columns in single precision, for the sweeps.
  [[nodiscard]] const float* rounded(Eigen::Index j) const noexcept {
    return rounded_.col(j).data();
  }
  void round();

 private:
  Eigen::MatrixXd exact_;
  Eigen::MatrixXf rounded_;
};

/// μ of a contact by its number, the distance slid and the normal force [m], [N].
using ConeFriction = std::function<double(std::size_t, double, double)>;

class ConeLaw {
 public:
  /// @param tolerance residual of the law, over the largest force
  explicit ConeLaw(double tolerance) : tolerance_(tolerance) {}

  struct Report {
    int sweeps = 0;
    bool by_newton = false;
    double residual = 0.0;  ///< of the law, over the largest force                     [-]
  };
  /// 0 <= normal force ⊥ gap >= 0; |shear| <= μ normal, opposed to the distance slid. Allocates
  /// nothing but room for more contacts than ever before, and in Newton's method.
  /// @param rows of the window that the contacts are in
  /// @param friction of contacts whose coefficient is none of ConeContact; or null
  Report solve(std::span<ConeContact> contacts, const WindowCompliance& compliance,
               Eigen::Index rows, const ConeFriction* friction = nullptr);
  /// No contacts: nothing moves.
  void clear() noexcept { moved_.clear(); }
  /// (rows) What the forces of solve() do in the window, in the axes of the compliance; without
  /// the rim [m]
  [[nodiscard]] std::span<const double> moved() const noexcept { return moved_; }

 private:
  struct Local {
    Eigen::Matrix3d own, inverse;  ///< compliance of the contact with itself, along its axes
    Eigen::Vector3d force;         ///< along its axes
    double friction;               ///< μ of its force
  };
  void prepare(std::span<const ConeContact> contacts, const WindowCompliance& compliance);
  void multiply(std::span<const ConeContact> contacts, const WindowCompliance& compliance);
  [[nodiscard]] Eigen::Vector3d moved_of(const ConeContact& c) const noexcept;
  double sweep(std::span<const ConeContact> contacts, const WindowCompliance& compliance);
  [[nodiscard]] Eigen::Vector3d solve_one(const Local& local, double friction,
                                          const Eigen::Vector3d& free) const noexcept;
  [[nodiscard]] Eigen::Vector3d solve_sliding(std::size_t contact, const Eigen::Vector3d& free);
  [[nodiscard]] double friction_of(std::size_t contact, const Eigen::Vector3d& force,
                                   const Eigen::Vector3d& moved) const;
  void push(const ConeContact& c, const WindowCompliance& compliance,
            const Eigen::Vector3d& change) noexcept;
  void pack(Eigen::VectorXd& to) const noexcept;
  void unpack(const Eigen::VectorXd& from) noexcept;
  void mix();
  void finish(std::size_t contact, ConeContact& c) const;
  [[nodiscard]] Eigen::Index n_forces() const noexcept {
    return Eigen::Index{3} * static_cast<Eigen::Index>(local_.size());
  }
  [[nodiscard]] double residual(std::span<const ConeContact> contacts) const;
  bool newton(std::span<const ConeContact> contacts, const WindowCompliance& compliance);
  void iterate(std::span<const ConeContact> contacts, const WindowCompliance& compliance,
               double goal, Report& report);

  static constexpr Eigen::Index depth = 6;  ///< of Anderson's mixing

  const double tolerance_;
  const ConeFriction* friction_ = nullptr;  ///< of the last solve()
  Eigen::Index rows_ = 0;
  std::vector<Local> local_;
  std::vector<double> moved_;  ///< (rows) W r
  Eigen::Vector3d rim_;        ///< accelerations by the forces
  double mean_ = 0.0;          ///< of the compliance's diagonal                  [m/N]
  // Anderson's mixing: the last sweep, and differences of the sweeps before it.
  Eigen::VectorXd before_, after_, change_, change_before_, after_before_;
  Eigen::MatrixXd changes_, results_;
  Eigen::Index kept_ = 0, oldest_ = 0;
  double size_before_ = 0.0;
};

}  // namespace rondo::rom
