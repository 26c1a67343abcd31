// SPDX-License-Identifier: BSD-3-Clause
/// V12: the scheme as printed feeds energy into one family of waves, at the rate that first-order
/// perturbation predicts; the symplectic scheme keeps every eigenvalue on the unit circle. Both
/// operators take the same step.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <random>

#include "rondo/fem/stiffness_product.hpp"
#include "support/models.hpp"
#include "support/stepping.hpp"

namespace v12_scheme {

using namespace rondo;
using namespace rondo::dynamics;
using ComplexNumber = std::complex<double>;

namespace {

constexpr double spin_rate = 200.0;  // rad/s

test::DiskCase spinning(int radial, int columns, Scheme scheme, double safety) {
  test::DiskCase c;
  c.disk.radial = radial;
  c.disk.circumferential = columns;
  c.alpha = c.beta = 0.0;
  c.scheme = scheme;
  c.safety = safety;
  c.motion.angular_velocity = Table(spin_rate);
  return c;
}

class Schemes : public testing::TestWithParam<StiffnessOperator> {};

/// (u_n, Δt v) after one step of the program's own, as a vector.
Eigen::VectorXd step_of(const Model& model, const Eigen::VectorXd& y) {
  State state = test::start_at_rest(model);
  const auto half = static_cast<Eigen::Index>(2 * model.free.size());
  for (std::size_t i = 0; i < model.free.size(); ++i) {
    const auto k = static_cast<std::size_t>(model.free[i]);
    const auto place = static_cast<Eigen::Index>(2 * i);
    state.u.plane()[k] = {y[place], y[place + 1]};
    state.v_next.plane()[k] = Vec2{y[half + place], y[half + place + 1]} / model.dt;
  }
  apply_stiffness(model, state.u, state.force);
  StepReport report;
  make_integrator(model, state)->advance({&report, 1}, &state);
  Eigen::VectorXd out(2 * half);
  for (std::size_t i = 0; i < model.free.size(); ++i) {
    const auto k = static_cast<std::size_t>(model.free[i]);
    const auto place = static_cast<Eigen::Index>(2 * i);
    out.segment<2>(place) = Eigen::Vector2d(state.u.plane()[k].x, state.u.plane()[k].y);
    out.segment<2>(half + place) =
        model.dt * Eigen::Vector2d(state.v_next.plane()[k].x, state.v_next.plane()[k].y);
  }
  return out;
}

/// Eigenvalues of the step, an affine map whose matrix is found column by column.
Eigen::VectorXcd amplification(const Model& model) {
  const auto n = static_cast<Eigen::Index>(4 * model.free.size());
  const Eigen::VectorXd at_zero = step_of(model, Eigen::VectorXd::Zero(n));
  Eigen::MatrixXd a(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    a.col(j) = step_of(model, Eigen::VectorXd::Unit(n, j)) - at_zero;
  return Eigen::EigenSolver<Eigen::MatrixXd>(a, false).eigenvalues();
}

/// One mode (λ, φ) of λ²M φ + λ 2sMJ φ + (K - s²M) φ = 0, and the growth that lagging the
/// gyroscopic term by half a step gives it to first order.
struct Mode {
  double frequency;
  double growth;
};

std::vector<Mode> modes(const Model& model) {
  const auto n = static_cast<Eigen::Index>(2 * model.free.size());
  const double s = -spin_rate;
  Eigen::MatrixXd k = fem::free_matrix(model.stiffness, model.free);
  Eigen::MatrixXd gyroscopic = Eigen::MatrixXd::Zero(n, n);  // M^-½ G M^-½ = 2sJ
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto mass = [&](Eigen::Index d) {
      return model.mass[static_cast<std::size_t>(model.free[static_cast<std::size_t>(d / 2)])];
    };
    for (Eigen::Index j = 0; j < n; ++j) k(i, j) /= std::sqrt(mass(i) * mass(j));
    k(i, i) -= s * s;
    gyroscopic(i, i % 2 == 0 ? i + 1 : i - 1) = i % 2 == 0 ? -2.0 * s : 2.0 * s;
  }
  Eigen::MatrixXd first_order = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  first_order.topRightCorner(n, n).setIdentity();
  first_order.bottomLeftCorner(n, n) = -k;
  first_order.bottomRightCorner(n, n) = -gyroscopic;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(first_order);
  std::vector<Mode> out;
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const ComplexNumber lambda = solver.eigenvalues()[i];
    if (lambda.imag() <= 0.0) continue;
    const Eigen::VectorXcd phi = solver.eigenvectors().col(i).head(n);
    const ComplexNumber g = phi.dot(gyroscopic.cast<ComplexNumber>() * phi), m = phi.squaredNorm();
    const ComplexNumber delta = 0.5 * model.dt * lambda * lambda * g / (2.0 * lambda * m + g);
    out.push_back({lambda.imag(), delta.real()});
  }
  std::sort(out.begin(), out.end(), [](auto& a, auto& b) { return a.frequency < b.frequency; });
  return out;
}

/// Growth rate of the eigenvalue of the step whose frequency is nearest.
double growth_near(const Eigen::VectorXcd& z, double dt, double frequency) {
  ComplexNumber best = z[0];
  for (const ComplexNumber& value : z)
    if (std::abs(std::arg(value) / dt - frequency) < std::abs(std::arg(best) / dt - frequency))
      best = value;
  return std::log(std::abs(best)) / dt;
}

/// Largest growth of the 12×180 disk, harmonic by harmonic: K is block-circulant in polar
/// components.
double largest_growth_by_harmonics(const test::Built& b) {
  const int n_sectors = b.mesh.n_sectors;
  const double s = -spin_rate, dt = b.model.dt;
  std::map<int, int> place;  // sector_node -> row, of the free nodes of sector 0
  for (const int node : b.model.free)
    if (b.mesh.sector[static_cast<std::size_t>(node)] == 0)
      place.emplace(b.mesh.sector_node[static_cast<std::size_t>(node)],
                    static_cast<int>(place.size()));
  const auto n = static_cast<Eigen::Index>(2 * place.size());
  double largest = 0.0;
  for (int harmonic = 0; harmonic <= n_sectors / 2; ++harmonic) {
    Eigen::MatrixXcd k = Eigen::MatrixXcd::Zero(n, n), a(2 * n, 2 * n);
    for (const int node : b.model.free) {
      const auto row = static_cast<std::size_t>(node);
      if (b.mesh.sector[row] != 0) continue;
      for (auto at = b.model.stiffness.row_start[row]; at < b.model.stiffness.row_start[row + 1];
           ++at) {
        const auto entry = static_cast<std::size_t>(at);
        const auto column = static_cast<std::size_t>(b.model.stiffness.column[entry]);
        const double angle = 2.0 * std::numbers::pi * b.mesh.sector[column] / n_sectors;
        const auto& block = b.model.stiffness.values[entry];
        Eigen::Matrix2d value;
        value << block[0], block[2], block[1], block[3];
        const double scale = 1.0 / std::sqrt(b.model.mass[row] * b.model.mass[column]);
        const ComplexNumber phase = std::polar(scale, harmonic * angle);
        k.block<2, 2>(2 * place[b.mesh.sector_node[row]], 2 * place[b.mesh.sector_node[column]]) +=
            phase * (value * Eigen::Rotation2Dd(angle).toRotationMatrix()).cast<ComplexNumber>();
      }
    }
    k -= s * s * Eigen::MatrixXcd::Identity(n, n);
    Eigen::MatrixXcd j = Eigen::MatrixXcd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; i += 2) j.block<2, 2>(i, i) << 0.0, -1.0, 1.0, 0.0;
    // u' = u + w;  w' = w - Δt²(K - s²)u' - 2Δt s J w
    const Eigen::MatrixXcd identity = Eigen::MatrixXcd::Identity(n, n);
    a << identity, identity, -dt * dt * k, identity - dt * dt * k - 2.0 * dt * s * j;
    const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(a, false);
    largest = std::max(largest, std::log(solver.eigenvalues().cwiseAbs().maxCoeff()) / dt);
  }
  return largest;
}

}  // namespace

TEST_P(Schemes, SymplecticKeepsEveryEigenvalueOnTheUnitCircle) {
  for (const double safety : {0.3, 0.9}) {
    const auto b = test::build(spinning(2, 12, Scheme::symplectic, safety));
    const Model model = test::model_with(b, GetParam());
    for (const ComplexNumber& z : amplification(model)) EXPECT_NEAR(std::abs(z), 1.0, 1e-13);
  }
}

TEST(AsPrinted, GrowsAtThePredictedRate) {
  std::vector<double> growths;
  for (const double safety : {0.05, 0.1}) {
    const auto b = test::build(spinning(2, 12, Scheme::as_printed, safety));
    const Eigen::VectorXcd z = amplification(test::model_with(b, StiffnessOperator::sparse));
    const std::vector<Mode> all = modes(b.model);
    int growing = 0;
    for (std::size_t i = 0; i < 24; ++i) {
      const double growth = growth_near(z, b.model.dt, all[i].frequency);
      EXPECT_NEAR(growth, all[i].growth, 0.1 * std::abs(all[i].growth)) << all[i].frequency;
      growing += growth > 0.0 ? 1 : 0;
    }
    EXPECT_GT(growing, 8);  // one family grows, the other decays
    EXPECT_LT(growing, 16);
    growths.push_back(growth_near(z, b.model.dt, all[13].frequency));
  }
  EXPECT_NEAR(growths[1] / growths[0], 2.0, 0.1);  // proportional to Δt
}

/// The 12×180 disk at 200 rad/s, Courant 0.9. A wave of circular polarisation would grow at
/// s ω_max Δt/2 = 180 1/s to first order; the worst wave of this mesh reaches half of that, in the
/// eigenvalues and in a run alike.
TEST(AsPrinted, LargestGrowthOnTheDisk) {
  const auto b = test::build(spinning(12, 180, Scheme::as_printed, 0.9));
  const double by_harmonics = largest_growth_by_harmonics(b);
  EXPECT_NEAR(0.5 * spin_rate * b.critical.omega * b.model.dt, 180.0, 0.01);
  EXPECT_NEAR(by_harmonics, 88.57, 0.05);

  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(-1.0, 1.0);
  std::vector<Vec2> zero(b.model.n_nodes()), v0(b.model.n_nodes());
  for (Vec2& v : v0) v = {x(random), x(random)};
  test::Stepping run(b, StiffnessOperator::sparse, zero, v0);
  const auto energy_after = [&](int steps) {
    run.advance(steps);
    return run.balance().kinetic + run.balance().strain;
  };
  const double early = energy_after(8000), late = energy_after(2000);
  const double in_a_run = 0.5 * std::log(late / early) / (2000 * b.model.dt);
  EXPECT_NEAR(in_a_run, by_harmonics, 0.02 * by_harmonics);  // neighbours still mixed in
}

/// The same growth in a run: the energy that the ledger says the scheme created.
TEST(AsPrinted, LedgerShowsTheEnergyCreated) {
  auto c = spinning(4, 60, Scheme::as_printed, 0.9);
  auto b = test::build(c);
  test::Stepping run(b, StiffnessOperator::sparse);
  run.advance_to(0.3);
  const Balance printed = run.balance();
  EXPECT_GT(printed.works.scheme, 10.0 * printed.otherwise);
  EXPECT_LT(printed.relative, 1e-13);
  b.model.scheme = Scheme::symplectic;
  test::Stepping kept(b, StiffnessOperator::sparse);
  kept.advance_to(0.3);
  EXPECT_EQ(kept.balance().works.scheme, 0.0);
  EXPECT_LT(kept.balance().relative, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Both, Schemes, testing::ValuesIn(test::both_operators),
                         [](const auto& p) { return test::name(p.param); });

}  // namespace v12_scheme
