// SPDX-License-Identifier: BSD-3-Clause
/// Each instruction set that this machine has, within one process.
#include <gnu/libc-version.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "rondo/core/error.hpp"
#include "rondo/integrators/fused/cyclic_integrator.hpp"
#include "rondo/integrators/fused/dispatch.hpp"
#include "rondo/integrators/fused/sparse_integrator.hpp"
#include "support/models.hpp"

namespace levels_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

/// Rolling, all terms on, nothing in it that hangs on a library's eigenvalues.
test::Built rolling(bool tread) {
  auto c = test::rolling_disk(5, 77);
  if (tread) c.disk.tread = mesh::Tread{.pitches = 19};
  c.motion.angular_velocity = Table({{0.0, 33.0}, {0.004, 36.0}});
  c.motion.height = Table({{0.0, 0.2995}, {0.004, 0.298}});
  c.motion.gravity = Table(9.81);
  auto b = test::build(c);
  b.model.dt = 2e-5;
  b.model.sector = fem::assemble_sector(b.mesh, {&c.material, 1});
  test::add_ground(b, {}, {0.3, 0.0});
  return b;
}

struct Outcome {
  State state;
  Balance balance;
};

std::unique_ptr<Integrator> integrator_of(const Model& model, StiffnessOperator of,
                                          const kernels::Table& table) {
  const State start = test::start_at_rest(model);
  if (of == StiffnessOperator::cyclic)
    return std::make_unique<CyclicIntegrator>(model, start, table);
  return std::make_unique<SparseIntegrator>(model, start, table);
}

Outcome after(const test::Built& b, StiffnessOperator of, const kernels::Table& table, int steps) {
  const auto integrator = integrator_of(b.model, of, table);
  std::vector<StepReport> reports(static_cast<std::size_t>(steps));
  Outcome out{State(b.model), {}};
  integrator->advance(reports, &out.state);
  out.balance = reports.back().balance;
  EXPECT_FALSE(out.state.active.empty());
  return out;
}

/// FNV-1a of the bits of the fields and the energies.
std::uint64_t bits_of(const Outcome& o) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto add = [&](const void* data, std::size_t size) {
    const auto* byte = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ byte[i]) * 0x100000001b3U;
  };
  for (const Field* field : {&o.state.u, &o.state.v, &o.state.v_next})
    add(field->plane().data(), field->size() * sizeof(Vec2));
  for (const double x : {o.balance.kinetic, o.balance.strain, o.balance.works.frame,
                         o.balance.works.contact, o.balance.works.dissipation_stiffness})
    add(&x, sizeof x);
  return hash;
}

/// AVX2 does on two registers what AVX-512 does on one: the same bits. Without fused products the
/// results differ by round-off.
void expect_the_same(const test::Built& b, StiffnessOperator of) {
  const Outcome best = after(b, of, *kernel_tables().front(), 200);
  for (const kernels::Table* table : kernel_tables()) {
    const Outcome other = after(b, of, *table, 200);
    double size = 0.0, error = 0.0;
    for (std::size_t i = 0; i < best.state.u.size(); ++i) {
      size = std::max(size, norm(best.state.u.plane()[i]));
      error = std::max(error, norm(best.state.u.plane()[i] - other.state.u.plane()[i]));
    }
    EXPECT_LT(error, 1e-11 * size) << table->name;
    EXPECT_LT(other.balance.relative, 1e-14) << table->name;
    if (std::string_view(table->name) != "baseline") {
      EXPECT_EQ(bits_of(best), bits_of(other)) << table->name;
    }
  }
}

}  // namespace

TEST(Levels, EndWithOneThatEveryMachineHas) {
  ASSERT_FALSE(kernel_tables().empty());
  EXPECT_STREQ(kernel_tables().back()->name, "baseline");
}

/// The whole of these tests is run again with each level in the environment: it must count.
TEST(Levels, TheOneAskedForIsTaken) {
  const char* asked = std::getenv("RONDO_DISPATCH");
  EXPECT_STREQ(kernel_table().name, asked && *asked ? asked : kernel_tables().front()->name);
}

TEST(Levels, AnUnknownOneIsRefused) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // anew: this process may have chosen already
  EXPECT_EXIT(
      {
        setenv("RONDO_DISPATCH", "sse9", 1);
        try {
          kernel_table();
        } catch (const InputError& error) {
          std::fputs(error.what(), stderr);
          std::exit(2);
        }
      },
      testing::ExitedWithCode(2), "RONDO_DISPATCH = sse9.*allowed: .*baseline");
}

TEST(Levels, GiveTheSameToRoundOffAndFusedOnesTheSameBits) {
  for (const bool tread : {false, true})
    for (const StiffnessOperator of : {StiffnessOperator::cyclic, StiffnessOperator::sparse}) {
      SCOPED_TRACE(operator_name(of));
      expect_the_same(rolling(tread), of);
    }
}

/// So that nobody changes them unawares. They also hang on the sines and cosines of the C library
/// and on the compiler's order of sums in the stiffness: elsewhere than on Debian 12 it is skipped.
TEST(Levels, BitsAreThoseRecorded) {
  if (kernel_tables().size() == 1) GTEST_SKIP() << "recorded where sines are made with FMA";
  if (std::string_view(gnu_get_libc_version()) != "2.36" ||
      !std::string_view(__VERSION__).starts_with("12.2"))
    GTEST_SKIP() << "recorded with glibc 2.36 and g++ 12.2, here " << gnu_get_libc_version()
                 << " and " << __VERSION__;
  struct Record {
    std::string_view level;
    StiffnessOperator of;
    std::uint64_t smooth, treaded;
  };
  constexpr auto cyclic = StiffnessOperator::cyclic, sparse = StiffnessOperator::sparse;
  constexpr Record records[] = {{"avx512", cyclic, 3874433451030308355U, 14781144385522393836U},
                                {"avx2", cyclic, 3874433451030308355U, 14781144385522393836U},
                                {"baseline", cyclic, 206957415440807762U, 1944564878519571354U},
                                {"avx512", sparse, 5552904090228827626U, 11108108290183173243U},
                                {"avx2", sparse, 5552904090228827626U, 11108108290183173243U},
                                {"baseline", sparse, 12720353428428110705U, 5340508402849513099U}};
  for (const kernels::Table* table : kernel_tables())
    for (const Record& record : records) {
      if (record.level != table->name) continue;
      SCOPED_TRACE(table->name);
      SCOPED_TRACE(operator_name(record.of));
      EXPECT_EQ(bits_of(after(rolling(false), record.of, *table, 200)), record.smooth);
      EXPECT_EQ(bits_of(after(rolling(true), record.of, *table, 200)), record.treaded);
    }
}

}  // namespace levels_test
