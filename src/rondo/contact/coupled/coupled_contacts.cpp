// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/coupled_contacts.hpp"

namespace rondo::contact {

void CoupledContacts::clear() {
  problem.free.clear();
  impulse.clear();
  for (auto* numbers : {&problem.bounce, &problem.friction, &problem.mass}) numbers->clear();
  problem.row_start.assign(1, 0);
  problem.column.clear();
  problem.blocks.clear();
}

void CoupledContacts::add(Vec2 free, double bounce, double friction, Vec2 from) {
  problem.free.push_back(free);
  problem.bounce.push_back(bounce);
  problem.friction.push_back(friction);
  impulse.push_back(from);
}

const CoupledResult& CoupledContacts::solve() {
  start = impulse;
  status.assign(problem.size(), Status::open);
  result = solve_coupled(problem, limits, impulse, status, workspace);
  difficult.look_at(problem, impulse, start, result, dump_above);
  return result;
}

Vec2 kept_impulse(const KeptImpulses& kept, std::uint64_t key) noexcept {
  const auto found = std::ranges::lower_bound(kept, key, {}, [](const auto& k) { return k.first; });
  return found != kept.end() && found->first == key ? found->second : Vec2{};
}

void CoupledContacts::sort_kept() noexcept {
  std::ranges::sort(kept, {}, [](const auto& k) { return k.first; });
}

}  // namespace rondo::contact
