// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/keep_larger.hpp"
#include "rondo/integrators/massless/ring_contact.hpp"

namespace rondo::dynamics {
namespace {

using contact::Status;

constexpr std::size_t header = 5, per_contact = 10;

/// (5.3), (3.10a)
void add_works(const ContactStep& s, const ActiveContact& c, Vec2 mean_velocity,
               ContactReport& report) noexcept {
  const Vec2 impulse = conj(s.rotation) * from_frame(c.normal, c.impulse.plane());  // co-rotating
  const double work = dot(impulse, mean_velocity);
  const Vec3 mean = 0.5 * (c.before + c.after);
  report.work += work;
  report.dissipation_friction -= c.impulse.y * mean.y;
  report.loss_impact -= c.impulse.x * mean.x;
  report.work_rim += work - dot(c.impulse, mean);
}

ActiveContact active_of(const RingContact& c) noexcept {
  ActiveContact a;
  a.candidate = static_cast<std::size_t>(c.node);
  a.normal = c.normal;
  a.gap = c.gap;
  a.free = c.free;
  a.impulse = c.impulse;
  a.status = c.status;
  return a;
}

void report_solution(const RingContacts& found, ContactReport& report) noexcept {
  const int n = static_cast<int>(found.contacts.size());
  report.clusters = n > 1 ? 1 : 0;
  report.clusters_not_converged = found.converged ? 0 : 1;
  report.cluster_largest = n;
  report.cluster_iterations = found.iterations;
  report.extensions = found.extensions;
  report.two_facets = found.two_facets;
}

}  // namespace

ContactReport MasslessContact::report(const ContactStep& step, Vec2 center,
                                      std::vector<ActiveContact>& active) const {
  ContactReport report;
  active.clear();
  report_solution(now_, report);
  for (const RingContact& c : now_.contacts) {
    const std::size_t i = static_cast<std::size_t>(c.node);
    RONDO_ASSERT(i < nodes().size(), c.node, nodes().size());
    const Vec2 arm = model_.reference[at(nodes()[i])] + motion_.place[i];
    ActiveContact a = active_of(c);
    a.before = to_frame(c.normal, velocity_before(step, arm, motion_.before[i]));
    a.after = to_frame(c.normal, drive_of(step, arm) + step.rotation_next * velocity_[i]);
    add_works(step, a, 0.5 * (motion_.before[i] + velocity_[i]), report);
    active.push_back(a);
    report.residual = keep_larger(report.residual, c.residual);
    report.penetration = std::max(report.penetration, -c.gap);
    report.free_velocity = std::max(report.free_velocity, norm(c.free));
    const Vec2 impulse = from_frame(c.normal, c.impulse);
    report.impulse += impulse;
    report.angular_impulse += cross(step.center + step.rotation * arm - center, impulse);
    if (c.impulse.x <= 0.0) continue;
    ++report.nodes;
    report.sticking += c.status == Status::stick ? 1 : 0;
    report.length += model_.contact->tributary[i];
  }
  return report;
}

std::vector<double> MasslessContact::save() const {
  std::vector<double> numbers{static_cast<double>(next_.iterations),
                              static_cast<double>(next_.extensions), next_.converged ? 1.0 : 0.0,
                              next_.two_facets ? 1.0 : 0.0,
                              static_cast<double>(next_.contacts.size())};
  for (const RingContact& c : next_.contacts)
    for (const double number :
         {static_cast<double>(c.node), static_cast<double>(c.status), c.normal.x, c.normal.y, c.gap,
          c.free.x, c.free.y, c.impulse.x, c.impulse.y, c.residual})
      numbers.push_back(number);
  return numbers;
}

bool MasslessContact::is_saved(std::span<const double> numbers, std::size_t n_candidates) noexcept {
  if (numbers.size() < header || (numbers.size() - header) % per_contact != 0) return false;
  const std::size_t n_contacts = (numbers.size() - header) / per_contact;
  if (static_cast<double>(n_contacts) != numbers[4]) return false;
  constexpr double most = 1e9;
  if (!(numbers[0] >= 0.0 && numbers[0] <= most && numbers[1] >= 0.0 && numbers[1] <= most))
    return false;
  if (!std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); }))
    return false;
  double before = -1.0;
  for (std::size_t i = header; i < numbers.size(); i += per_contact) {
    const double node = numbers[i], status = numbers[i + 1];
    if (!(node > before && node < static_cast<double>(n_candidates) && std::floor(node) == node &&
          (status == 0.0 || status == 1.0 || status == 2.0)))
      return false;
    before = node;
  }
  return true;
}

void MasslessContact::restore(std::span<const double> numbers) {
  RONDO_DEMAND(is_saved(numbers, nodes().size()), numbers.size());
  next_.iterations = static_cast<int>(numbers[0]);
  next_.extensions = static_cast<int>(numbers[1]);
  next_.converged = numbers[2] != 0.0;
  next_.two_facets = numbers[3] != 0.0;
  next_.contacts.clear();
  for (const double* n = numbers.data() + header; n != numbers.data() + numbers.size();
       n += per_contact)
    next_.contacts.push_back({.node = static_cast<int>(n[0]),
                              .normal = {n[2], n[3]},
                              .gap = n[4],
                              .free = {n[5], n[6]},
                              .impulse = {n[7], n[8]},
                              .residual = n[9],
                              .status = static_cast<Status>(static_cast<int>(n[1]))});
}

}  // namespace rondo::dynamics
