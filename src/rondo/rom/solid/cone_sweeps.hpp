// SPDX-License-Identifier: BSD-3-Clause
/// @file  Gauss–Seidel over the contacts of a law in space (cone_law.hpp) whose fixed point
/// Anderson's mixing finds sooner (Anderson, J. ACM 12 (1965) 547). Changes of the forces since the
/// round began meet the compliance in single precision; what the forces of its beginning do is
/// known exactly.
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "rondo/rom/solid/cone_contact.hpp"
#include "rondo/rom/solid/kernels/cone_table.hpp"
#include "rondo/rom/solid/window_compliance.hpp"

namespace rondo::rom {

class ConeSweeps {
 public:
  explicit ConeSweeps(const kernels::ConeTable& table) : table_(table) {}

  /// Begins a round with the contacts that have a force or a gap below a bound; the others stay
  /// open in it. Allocates nothing but room for more contacts than ever before.
  /// @param contacts, all the same contacts; forces of `all` are along the axes of each, `moved`
  /// is what they do
  /// @param friction null: that of each of `all`
  void begin(std::span<const ConeContact> contacts, std::span<const ConeLocal> all,
             const WindowCompliance& compliance, double gap, const ConeFriction* friction);
  /// Sweeps until no force changes by more than a share of the largest normal force, at most
  /// `most` times. @return number of sweeps
  int iterate(std::span<const ConeContact> contacts, std::span<ConeLocal> all, double share,
              int most);

 private:
  struct Member {
    std::size_t contact = 0;
    Eigen::Vector3d start;  ///< force at the beginning of the round                     [N]
    Eigen::Vector3d base;   ///< moved by the forces of the others, at that time         [m]
  };
  struct Run {
    int place = 0, count = 0;  ///< of members whose places are one after the other
  };
  void gather(std::span<const ConeContact> contacts, const WindowCompliance& compliance);
  double sweep(std::span<const ConeContact> contacts, std::span<ConeLocal> all);
  void pack(std::span<const ConeLocal> all, Eigen::VectorXd& to) const noexcept;
  void mix();
  void forget() noexcept { kept_ = oldest_ = 0; }
  void take_mixed(std::span<const ConeContact> contacts, std::span<ConeLocal> all) noexcept;
  void shift(std::size_t member, const ConeContact& c, const ConeLocal& l) noexcept;
  [[nodiscard]] Eigen::Index n_forces() const noexcept {
    return Eigen::Index{3} * static_cast<Eigen::Index>(members_.size());
  }

  static constexpr Eigen::Index depth = 8;  ///< of the mixing

  const kernels::ConeTable& table_;
  const ConeFriction* friction_ = nullptr;  ///< of the round
  std::vector<Member> members_;
  std::vector<Run> runs_;
  Eigen::Index stride_ = 0;   ///< of the rows: n_forces(), and what fills a register
  std::vector<float> rows_;   ///< (n_forces, stride) compliance without the blocks of a contact
                              ///< with itself, in its own axes
  std::vector<float> shift_;  ///< (stride) changes of the forces since the beginning, likewise
  bool has_rim_ = false;
  Eigen::Vector3d rim_;  ///< accelerations of the rim by these changes
  // The last sweep, and differences of the sweeps before it.
  Eigen::VectorXd before_, after_, change_, change_before_, after_before_;
  Eigen::MatrixXd changes_, results_;
  Eigen::Matrix<double, depth, depth> products_;  ///< of the columns of changes_
  Eigen::Index kept_ = 0, oldest_ = 0;
  double size_before_ = 0.0;
};

}  // namespace rondo::rom
