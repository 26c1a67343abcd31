// SPDX-License-Identifier: BSD-3-Clause
/// V10: sudden spin-up of a disk at rest, by both operators. Damped, it settles on the stationary
/// spin of its own mesh; without damping it oscillates about it for ever (v10_spin_up_long.cpp has
/// the long times).
#include "support/spin_up.hpp"
#include "support/traps.hpp"

namespace v10_spin_up {

using namespace rondo;
using namespace rondo::dynamics;

namespace {
class SpinUp : public testing::TestWithParam<StiffnessOperator> {};
}  // namespace

TEST_P(SpinUp, DampedSettlesOnTheStationarySpin) {
  auto c = test::rubber_annulus(4, 36);
  c.alpha = 200.0;
  c.beta = 1e-5;
  const auto b = test::build(c);
  test::Stepping run(b, GetParam());
  const test::FloatingPointTraps traps;
  run.advance_to(0.3);
  const auto exact = statics::stationary_spin(b.model.stiffness, b.model.mass, b.model.reference,
                                              b.model.free, -50.0);
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < b.model.n_nodes(); ++i) {
    error = std::max(error, norm(run.state().u.plane()[i] - exact.u.plane()[i]));
    size = std::max(size, norm(exact.u.plane()[i]));
  }
  // The slowest wave decays at about α/2 = 100 1/s: e^{-30} is left after 0.3 s.
  EXPECT_LT(error, 1e-6 * size);
  EXPECT_LT(run.balance().relative, 1e-13);
}

/// The stationary start is at rest in the turning frame and stays so.
TEST_P(SpinUp, StationaryStartDoesNotMove) {
  const auto b = test::build(test::rubber_annulus(4, 36));
  const auto s = statics::stationary_spin(b.model.stiffness, b.model.mass, b.model.reference,
                                          b.model.free, -50.0);
  test::Stepping run(b, GetParam(), to_vector(s.u.plane()), std::vector<Vec2>(b.model.n_nodes()));
  run.advance(5000);
  for (std::size_t i = 0; i < b.model.n_nodes(); ++i)
    ASSERT_LT(norm(run.state().u.plane()[i] - s.u.plane()[i]),
              1e-12 * 1.6e-4);  // round-off of K u, 5,000 steps
}

TEST_P(SpinUp, OscillatesAboutTheStationarySpin) {
  test::expect_oscillation_for_ever(GetParam(), 60000);
}

INSTANTIATE_TEST_SUITE_P(Both, SpinUp, testing::ValuesIn(test::both_operators),
                         [](const auto& p) { return test::name(p.param); });

}  // namespace v10_spin_up
