// SPDX-License-Identifier: BSD-3-Clause
/// Rules of the start of rubber, and the default of its step size (docs/rubber.md).
#include "rondo/case/case_rules.hpp"

namespace rondo::study {
void check_rubber(CaseValues& in, Case& c) {
  if (!has_rubber(c)) return;
  if (c.initial.state == InitialState::steady_rolling)
    in.refuse("initial.state",
              "steady rolling is computed at small strain, rubber at finite strain", "\"rest\"");
  const bool has_steps = means_to(*find_case_key("time.safety"), c.analysis.kind);
  if (has_steps && !c.time.step && !in.has("time.safety")) c.time.safety = rubber_safety;
}

}  // namespace rondo::study
