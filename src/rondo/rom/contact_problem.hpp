// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of a reduced step (docs/reduced.md, 5): which points touch, what the law sees at
/// them, and their impulses, all together as every mode moves all of them.
#pragma once
#include <memory>
#include <vector>

#include "rondo/contact/coupled/coupled.hpp"
#include "rondo/contact/ground.hpp"
#include "rondo/rom/contact_table.hpp"
#include "rondo/rom/rim_response.hpp"
#include "rondo/rom/saved_reduced.hpp"

namespace rondo::rom {

/// The body at one time, as contact sees it.
struct BodyState {
  double angle = 0.0;  ///< θ [rad]
  Vec2 center;         ///< c, fixed frame                                         [m]
  Vec2 velocity;       ///< ċ likewise                                             [m/s]
  /// A point of the material at arm a, fields v there, moves with ċ + turn_rate a + turn v,
  /// complex: i s and 1, or what they are in the mean over a step of central differences (4.2).
  Complex turn_rate, turn{1.0, 0.0};
  const VectorXd* q = nullptr;  ///< (r)
  const VectorXd* p = nullptr;  ///< (r)
};

/// A step without contact.
struct FreeStep {
  double dt = 0.0;    ///< [s]
  double spin = 0.0;  ///< s, of the fields at places that stand still [rad/s]
  BodyState before, end;
  const RimResponse* rim = nullptr;  ///< of a rim that moves by itself; none: it is driven
  const VectorXd* q_arm = nullptr;   ///< (r) of the arms of impulses on such a rim
};

/// A point of the rim against a facet.
struct PointContact {
  int point = 0;     ///< in the table of the step
  int material = 0;  ///< the point that stands still, or place in Rings::point of the candidates
  Vec2 normal;       ///< out of the ground, frame of the model
  double gap = 0.0;  ///< at the end of the step, without contact                  [m]
  Vec2 impulse;      ///< r: normal, tangential                                    [N·s/m]
  contact::Status status = contact::Status::open;
};

struct ContactOutcome {
  int iterations = 0;
  double residual = 0.0;       ///< of the law, over the largest free impulse [-]
  double free_velocity = 0.0;  ///< largest |w| that the law sees without impulses [m/s]
  bool converged = true;
};

class ContactSolver {
 public:
  /// All must outlive it.
  ContactSolver(const mesh::Mesh& mesh, const rom::ReducedModel& model,
                const contact::Ground& ground, contact::CoupledLimits limits);
  /// Finds the contacts of the step and their impulses.
  /// The energy-safe law of impacts is only for nodes and central differences.
  [[nodiscard]] ContactOutcome solve(const FreeStep& step, const contact::Law& law,
                                     const StepMatrices& matrices);
  /// The matrices of the steps to come are others.
  void forget_matrices() noexcept;

  [[nodiscard]] SavedContact save() const;
  [[nodiscard]] bool fits(const SavedContact& saved) const noexcept;
  /// @param matrices those of the last step, which the blocks at hand are of; null: no step was
  /// made. @pre fits()
  void restore(const SavedContact& saved, const StepMatrices* matrices);

  /// Of the last step, by point.
  [[nodiscard]] const std::vector<PointContact>& contacts() const noexcept { return contacts_; }
  /// Its points at its end.
  [[nodiscard]] const ContactTable& table() const noexcept { return *end_.table; }
  /// R of the model's frame at an angle: 1 in the rectified frame.
  [[nodiscard]] Complex frame_rotation(double angle) const noexcept;
  /// Tables of nodes made so far: as many as there are phases.
  [[nodiscard]] long long tables_made() const noexcept { return made_; }

 private:
  /// Points at one time: a table, and by how many sectors the nodes are on from there.
  struct Points {
    ContactTable* table = nullptr;
    int sectors = 0;
  };
  static constexpr double same_phase = 1e-8;  ///< in sectors: closer ones are one
  struct Phase {
    double share = 0.0;  ///< in sectors
    long long used = 0;  ///< step of the last use
    std::unique_ptr<ContactTable> table;
  };

  [[nodiscard]] Points points_at(double angle);
  [[nodiscard]] ContactTable* table_of(double share);
  [[nodiscard]] int material_of(int point, int sectors) const noexcept;
  [[nodiscard]] int point_of(int material, int sectors) const noexcept;
  /// @param next by the gaps one step further on, which the velocities lead to
  void find(const FreeStep& step, bool next);
  void make_problem(const FreeStep& step, const contact::Law& law, const StepMatrices& matrices);
  void find_rim_responses(const FreeStep& step);
  [[nodiscard]] DelassusPair pair_of(std::size_t at, std::size_t from) const;
  [[nodiscard]] Vec2 opening(const BodyState& body, const Points& points, int point,
                             double spin) const;
  [[nodiscard]] Vec2 material_velocity(const BodyState& body, const Points& points,
                                       int point) const;

  const mesh::Mesh& mesh_;
  const contact::Ground& ground_;
  contact::CoupledLimits limits_;
  bool nodes_;                                ///< the points are nodes
  bool turning_;                              ///< of the turning frame
  std::unique_ptr<rom::NodeRows> node_rows_;  ///< none: points that stand still
  std::vector<Phase> phases_;
  std::size_t most_phases_ = 2;
  long long steps_ = 0, made_ = 0;
  Points before_, end_;
  std::vector<PointContact> contacts_;
  std::vector<Vec2> warm_;  ///< by material: impulses of the step before             [N·s/m]
  std::vector<int> points_;
  std::vector<PointResponse> rim_;  ///< of the contacts; none: a driven rim
  contact::CoupledProblem problem_;
  contact::CoupledWorkspace work_;
  std::vector<Vec2> impulse_;
  std::vector<contact::Status> status_;
};

}  // namespace rondo::rom
