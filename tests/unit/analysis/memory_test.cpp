// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/memory.hpp"

#include <gtest/gtest.h>

#include "rondo/analysis/build/bodies.hpp"
#include "rondo/analysis/build/crush/crush_setup.hpp"
#include "rondo/core/bytes.hpp"
#include "rondo/core/limits/memory_limits.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study::memory_test {
namespace {

using namespace test;

std::vector<Fault> faults_when_built(const std::string& text) {
  try {
    build_mesh(read_text(text));
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

TEST(Estimate, CountsNodes) {
  Case c = read_text(base, {"motion.angular_velocity=0.0", "output.snapshots=0"});
  const mesh::Mesh disk = mesh::make_disk(c.disk);
  constexpr std::size_t program = 30'000'000;
  const std::size_t still = motion_memory(c, disk) - program;
  EXPECT_EQ(still, 13U * 180U * (2 * 9 * 36 + 384));
  c.initial.state = InitialState::stationary;  // needs the factors of K
  EXPECT_GT(motion_memory(c, disk) - program, 2 * still);
  c.initial.state = InitialState::rest;
  c.output.snapshots = 7;  // all of them may wait to be written
  EXPECT_EQ(motion_memory(c, disk) - program, still + 7U * 13U * 180U * 32U);
  c.output.snapshots = 100'000;
  EXPECT_LE(motion_memory(c, disk) - program, still + 64'000'000U);
}

/// Cells, nodes, branches and the pattern of tangents; of layers the stiffness of the others,
/// twice.
TEST(Estimate, RubberAddsItsCells) {
  constexpr std::size_t nodes = 13U * 180U, cells = 12U * 180U, stiffness = nodes * 9 * 36;
  const auto of = [](const std::string& text, const std::vector<std::string>& settings = {}) {
    const Case c = read_text(text, settings);
    return rubber_memory(c, build_mesh(c));
  };
  const std::string neo = rubber("model = 'neo-hooke'\nshear_modulus = 1e6");
  EXPECT_EQ(of(base), 0U);
  EXPECT_EQ(of(neo), cells * 248 + nodes * 72 + stiffness);
  EXPECT_EQ(of(neo, {"material.viscosity=[{relative_modulus = 0.3, time = 1}]"}),
            cells * (248 + 48) + nodes * 72 + stiffness);
  EXPECT_EQ(of(base, {"material.region=[{layers = [1, 2, 3], model = 'neo-hooke', shear_modulus = "
                      "1e6, poissons_ratio = 0.49}]"}),
            cells / 4 * 248 + nodes * 72 + stiffness + stiffness * 3 / 2);
  const std::vector<std::string> still{"motion.angular_velocity=0.0"};  // no check of softening
  const Case c = read_text(neo, still), linear = read_text(base, still);
  const mesh::Mesh disk = build_mesh(c);
  EXPECT_EQ(motion_memory(c, disk), motion_memory(linear, disk) + rubber_memory(c, disk));
}

TEST(Estimate, ACrushAddsTheFactorsAndWhatIsWithinReach) {
  Case c = read_text(base, {"motion.angular_velocity=0.0", "output.snapshots=0"});
  const std::size_t still = motion_memory(c, mesh::make_disk(c.disk));
  c.analysis = {AnalysisKind::crush, dynamics::Table(0.02), 10};
  c.ground->shape = {.profile = {{-1.0, 0.0}, {1.0, 0.0}}};
  CrushSetup s;
  s.mesh = mesh::make_disk(c.disk);
  s.within_reach = 20;
  const std::size_t few = crush_memory(c, s);
  EXPECT_GT(few - 30'000'000, 2 * (still - 30'000'000));
  s.within_reach = 40;
  const std::size_t rows = 80, bytes = 3 * rows * rows * sizeof(double);
  EXPECT_EQ(crush_memory(c, s) - few, bytes - bytes / 4);
}

TEST(Estimate, MeshLargerThanTheMachineIsRefused) {
  if (physical_memory() > 700'000'000'000) GTEST_SKIP() << "this machine holds the large mesh";
  const auto faults =
      faults_when_built(with_line(7, "radial = 10000", with_line(8, "circumferential = 200000")));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].key, "disk.mesh.circumferential");
  EXPECT_NE(faults[0].message.find("768 GB"), std::string::npos) << faults[0].text();
  EXPECT_NE(faults[0].message.find(readable_bytes(allowed_memory().bytes)), std::string::npos);
  const auto deep =
      faults_when_built(with_line(7, "radial = 100000", with_line(8, "circumferential = 9999")));
  ASSERT_EQ(deep.size(), 1U);
  EXPECT_EQ(deep[0].key, "disk.mesh.radial");
}

}  // namespace
}  // namespace rondo::study::memory_test
