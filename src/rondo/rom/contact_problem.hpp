// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of a reduced step (docs/reduced.md, 5): the points in contact, the velocities
/// that enter the law, and the impulses, solved together because every mode moves all points.
#pragma once
#include <memory>
#include <vector>

#include "rondo/contact/coupled/coupled_contacts.hpp"
#include "rondo/contact/ground.hpp"
#include "rondo/rom/contact_table.hpp"

namespace rondo::rom {

/// The body at one time, as contact needs it.
struct BodyState {
  double angle = 0.0;  ///< θ [rad]
  Vec2 center;         ///< c, fixed frame                                         [m]
  Vec2 velocity;       ///< ċ, fixed frame                                             [m/s]
  /// A material point at arm a with field value v moves with ċ + turn_rate a + turn v, all complex.
  /// The factors are i s and 1, or their means over a step of central differences (4.2).
  Complex turn_rate, turn{1.0, 0.0};
  const VectorXd* q = nullptr;  ///< (r)
  const VectorXd* p = nullptr;  ///< (r)
};

/// Data of a step without contact.
struct FreeStep {
  double dt = 0.0;    ///< [s]
  double spin = 0.0;  ///< s, of the fields at points fixed in space [rad/s]
  BodyState before, end;
};

/// A point of the body against a facet of the ground.
struct PointContact {
  int point = 0;     ///< index in the table of the step
  int material = 0;  ///< the fixed point, or index in Rings::point of the candidates
  Vec2 normal;       ///< out of the ground, frame of the model
  double gap = 0.0;  ///< at the end of the step, without contact                  [m]
  Vec2 impulse;      ///< r: normal, tangential                                    [N·s/m]
  contact::Status status = contact::Status::open;
};

struct ContactOutcome {
  int iterations = 0;
  double residual = 0.0;       ///< of the law, relative to the largest free impulse [-]
  double free_velocity = 0.0;  ///< largest |w| in the law without impulses [m/s]
  bool converged = true;
};

class ContactSolver {
 public:
  /// All arguments must outlive it.
  ContactSolver(const mesh::Mesh& mesh, const rom::ReducedModel& model,
                const contact::Ground& ground, contact::CoupledLimits limits);
  /// Finds the contacts of the step and their impulses. The energy-safe law of impacts is available
  /// only for nodes with central differences.
  [[nodiscard]] ContactOutcome solve(const FreeStep& step, const contact::Law& law,
                                     const StepMatrices& matrices);
  /// The matrices of the following steps are different.
  void forget_matrices() noexcept;

  /// Contacts of the last step, ordered by point.
  [[nodiscard]] const std::vector<PointContact>& contacts() const noexcept { return contacts_; }
  /// Its points at the end of the step.
  [[nodiscard]] const ContactTable& table() const noexcept { return *end_.table; }
  /// R of the model's frame at an angle: 1 in the rectified frame.
  [[nodiscard]] Complex frame_rotation(double angle) const noexcept;
  /// Number of tables of nodes made so far: one per phase.
  [[nodiscard]] long long tables_made() const noexcept { return made_; }

 private:
  /// Points at one time: a table, and the number of sectors by which the nodes have moved from it.
  struct Points {
    ContactTable* table = nullptr;
    int sectors = 0;
  };
  static constexpr double same_phase = 1e-8;  ///< in sectors: closer phases are the same
  struct Phase {
    double share = 0.0;  ///< in sectors
    long long used = 0;  ///< step of the last use
    std::unique_ptr<ContactTable> table;
  };

  [[nodiscard]] Points points_at(double angle);
  [[nodiscard]] ContactTable* table_of(double share);
  [[nodiscard]] int material_of(int point, int sectors) const noexcept;
  [[nodiscard]] int point_of(int material, int sectors) const noexcept;
  /// @param next by the gaps one step later, which follow from the velocities
  void find(const FreeStep& step, bool next);
  void make_problem(const FreeStep& step, const contact::Law& law, const StepMatrices& matrices);
  [[nodiscard]] double friction_of(const FreeStep& step, const contact::Friction& friction,
                                   const PointContact& contact) const;
  [[nodiscard]] Vec2 opening(const BodyState& body, const Points& points, int point,
                             double spin) const;
  [[nodiscard]] Vec2 material_velocity(const BodyState& body, const Points& points,
                                       int point) const;

  const mesh::Mesh& mesh_;
  const contact::Ground& ground_;
  bool nodes_;                                ///< whether the points are nodes
  bool turning_;                              ///< whether the model is in the co-rotating frame
  std::unique_ptr<rom::NodeRows> node_rows_;  ///< null: points are fixed in space
  std::vector<Phase> phases_;
  std::size_t most_phases_ = 2;
  long long steps_ = 0, made_ = 0;
  Points before_, end_;
  std::vector<PointContact> contacts_;
  std::vector<Vec2> warm_;  ///< by material: impulses of the previous step             [N·s/m]
  std::vector<int> points_;
  contact::CoupledContacts coupled_;
};

}  // namespace rondo::rom
