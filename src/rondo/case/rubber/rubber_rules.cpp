// SPDX-License-Identifier: BSD-3-Clause
/// What rubber does not go with, by the case alone (docs/rubber.md).
#include "rondo/case/case_rules.hpp"

namespace rondo::study {
namespace {

void refuse_steady_rolling(CaseValues& in, const Case& c) {
  if (c.analysis.kind == AnalysisKind::steady_rolling)
    in.refuse("analysis.kind",
              "steady rolling is computed at small strain, rubber at finite strain",
              "\"dynamic\", and a run long enough to settle; or material.model = \"linear\"");
  if (c.initial.state == InitialState::steady_rolling)
    in.refuse("initial.state",
              "steady rolling is computed at small strain, rubber at finite strain", "\"rest\"");
}

void check_law(CaseValues& in, const Case& c) {
  if (c.material.plane == fem::Plane::stress)
    in.refuse("material.plane", "rubber is supported in plane strain only",
              "\"strain\"; or material.model = \"linear\"");
  if (c.stress_stiffening != StressStiffening::none)
    in.refuse("material.stress_stiffening", "rubber at finite strain includes it", "\"none\"");
}

void check_steps(CaseValues& in, const Case& c) {
  if (c.time.scheme != Scheme::symplectic)
    in.refuse("time.scheme", "rubber needs the scheme \"symplectic\"",
              "\"symplectic\"; or material.model = \"linear\"");
  if (c.contact_mass != ContactMass::lumped)
    in.refuse("solver.contact_mass",
              "the positions of contact nodes without mass follow from the stiffness of small "
              "strain, which rubber does not have",
              "\"lumped\"");
  if (!c.implicit.empty())
    in.refuse("solver.implicit[0]",
              "implicit elements need a body of linear elements only, and there is rubber",
              "no [[solver.implicit]]; or material.model = \"linear\" for the whole of the body");
}

}  // namespace

void check_rubber(CaseValues& in, Case& c) {
  if (!has_rubber(c)) return;
  check_law(in, c);
  check_steps(in, c);
  refuse_steady_rolling(in, c);
  const bool has_steps = means_to(*find_case_key("time.safety"), c.analysis.kind);
  if (has_steps && !c.time.step && !in.has("time.safety")) c.time.safety = rubber_safety;
}

}  // namespace rondo::study
