// SPDX-License-Identifier: BSD-3-Clause
/// V38, long: the ledger of a wheel in three dimensions that corners, leans, bounces and slides.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "rondo/integrators/integrator.hpp"
#include "rondo/integrators/start.hpp"
#include "support/solid_wheel.hpp"

namespace rondo::dynamics::v38_cornering_long {
namespace {

TEST(V38CorneringLong, TheLedgerClosesOverAHundredThousandSteps) {
  const mesh::Mesh mesh = make_wheel(test::box_wheel());
  Model m = test::cornering_model(mesh, {.slip_angle = 0.05, .camber = 0.05});
  m.motion.gravity = Table(9.81);
  m.contact->law.restitution = 0.5;
  const Field rest(m.n_nodes(), 3);
  const State s = start(m, rest, rest);
  const auto integrator = make_integrator(m, s);
  std::array<StepReport, 50> reports;
  double ledger = 0.0, law = 0.0;
  for (int n = 0; n < 2000; ++n) {
    integrator->advance(reports);
    for (const StepReport& r : reports) law = std::max(law, r.contact.residual);
    ledger = std::max(ledger, reports.back().balance.relative);
  }
  EXPECT_LT(ledger, 1e-12);
  EXPECT_LT(law, 1e-12);
}

}  // namespace
}  // namespace rondo::dynamics::v38_cornering_long
