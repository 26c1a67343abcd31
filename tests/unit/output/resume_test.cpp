// SPDX-License-Identifier: BSD-3-Clause
/// What a checkpoint keeps, and what it refuses to go on with.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "rondo/analysis/build/build.hpp"
#include "rondo/core/error.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/output/resume.hpp"
#include "unit/case/case_fixture.hpp"

namespace resume_test {

using namespace rondo;
using namespace rondo::study;

namespace {

namespace fs = std::filesystem;

class Resume : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("rondo-resume-" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    case_ = test::read_text(test::base, {"disk.mesh.radial=2", "disk.mesh.circumferential=24"});
    setup_ = build(case_, 1);
  }
  void TearDown() override { fs::remove_all(folder_); }

  Checkpoint after_steps() {
    const dynamics::State start =
        dynamics::start(setup_.model, setup_.displacement, setup_.velocity);
    const auto integrator = dynamics::make_integrator(setup_.model, start);
    std::vector<dynamics::StepReport> reports(10);
    integrator->advance(reports);
    Checkpoint k;
    k.identity = identity_of(case_, setup_);
    k.state = integrator->resumable()->save();
    k.n_steps = setup_.n_steps;
    k.history.done = k.state.step;
    k.schedule = snapshot_schedule(case_.output, setup_.model.dt, setup_.n_steps);
    for (const long long step : k.schedule.steps)
      k.files.snapshots.count += step <= k.state.step ? 1 : 0;
    return k;
  }

  /// The same with a number of its own in each place.
  Checkpoint with_all_numbers() {
    Checkpoint k = after_steps();
    k.state.gradient = {{0.5, 0.25}};
    k.state.energy = {1.5};
    k.state.poses = {{{1.0, 2.0}, {0.6, 0.8}, 7.0}};
    k.state.impulses = {{~0ULL, {3.0, 4.0}}};
    k.history = {11, 12, k.state.step, Vec2{0.1, 0.2}, 0.3, 0.4};
    k.last_row = {0.7, 0.8};
    k.schedule = {{0, 5, 20}, 0.125};
    k.contact = {1e-17, 2.0, 3e-5, 21, 22, 1LL << 40, 24, 25, 26, 27, 28, 29};
    k.problems_kept = 3;
    k.loop_wall_s = 1.0 / 3.0;
    k.loop_cpu_s = 2.0 / 3.0;
    k.files = {{{"history.csv", {100, "a1"}}, {"contact.csv", {200, "b2"}}},
               {2, {{"/frame/time", "c3"}}}};
    return k;
  }

  /// What is said of it.
  std::string refusal(const Checkpoint& k) {
    try {
      demand_same_program(k.identity, identity_of(case_, setup_));
      demand_same_run(k, identity_of(case_, setup_), case_, setup_);
      return {};
    } catch (const InputError& error) {
      std::string text;
      for (const Fault& fault : error.faults()) text += fault.text() + "\n";
      return text;
    }
  }

  fs::path folder_;
  Case case_;
  study::Setup setup_;
};

}  // namespace

TEST_F(Resume, ACheckpointIsReadBackToTheBit) {
  const Checkpoint a = with_all_numbers();
  write_checkpoint(folder_, a);
  const Checkpoint b = read_checkpoint(folder_);
  EXPECT_EQ(a.identity.version, b.identity.version);
  EXPECT_EQ(a.identity.build_id, b.identity.build_id);
  EXPECT_EQ(a.identity.dispatch, b.identity.dispatch);
  EXPECT_EQ(a.identity.case_text, b.identity.case_text);
  EXPECT_EQ(a.identity.mesh_hash, b.identity.mesh_hash);
  EXPECT_EQ(a.identity.step, b.identity.step);
  EXPECT_EQ(a.state.step, b.state.step);
  EXPECT_EQ(a.state.u, b.state.u);
  EXPECT_EQ(a.state.v, b.state.v);
  EXPECT_EQ(a.state.force, b.state.force);
  EXPECT_EQ(a.state.gradient, b.state.gradient);
  EXPECT_EQ(a.state.energy, b.state.energy);
  EXPECT_EQ(a.state.poses.front().rotation, b.state.poses.front().rotation);
  EXPECT_EQ(a.state.poses.front().angle, b.state.poses.front().angle);
  EXPECT_EQ(a.state.impulses, b.state.impulses);
  EXPECT_EQ(a.state.ledger, b.state.ledger);
  EXPECT_EQ(a.n_steps, b.n_steps);
  EXPECT_EQ(a.history.done, b.history.done);
  EXPECT_EQ(a.history.next, b.history.next);
  EXPECT_EQ(a.history.steps, b.history.steps);
  EXPECT_EQ(a.history.impulse, b.history.impulse);
  EXPECT_EQ(a.history.angular_impulse, b.history.angular_impulse);
  EXPECT_EQ(a.history.penetration, b.history.penetration);
  EXPECT_EQ(a.last_row, b.last_row);
  EXPECT_EQ(a.schedule.steps, b.schedule.steps);
  EXPECT_EQ(a.schedule.interval, b.schedule.interval);
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_EQ(a.problems_kept, b.problems_kept);
  EXPECT_EQ(a.loop_wall_s, b.loop_wall_s);
  EXPECT_EQ(a.loop_cpu_s, b.loop_cpu_s);
  EXPECT_EQ(a.files, b.files);
  EXPECT_EQ(refusal(b), "");
}

TEST_F(Resume, AnotherProgramIsRefused) {
  Checkpoint k = after_steps();
  k.identity.version = "0.0.9";
  k.identity.build_id = "abc";
  k.identity.dispatch = "none";
  const std::string text = refusal(k);
  for (const char* part : {"was written with version 0.0.9", "was written with build abc",
                           "was written with kernels none", "RONDO_DISPATCH=none"})
    EXPECT_NE(text.find(part), std::string::npos) << part << text;
}

TEST_F(Resume, AnotherStepOrMeshIsRefused) {
  Checkpoint k = after_steps();
  k.identity.step *= 1.0 + 1e-15;
  EXPECT_NE(refusal(k).find("time.step"), std::string::npos);
  k = after_steps();
  k.identity.mesh_hash[0] = k.identity.mesh_hash[0] == '0' ? '1' : '0';
  EXPECT_NE(refusal(k).find("is not the mesh that the run began with"), std::string::npos);
}

/// Whatever the hash says: a program of the same build wrote it.
TEST_F(Resume, NumbersThatContradictEachOtherAreRefused) {
  const Checkpoint whole = after_steps();
  const auto is_taken = [&](const std::function<void(Checkpoint&)>& change) {
    Checkpoint k = whole;
    change(k);
    write_checkpoint(folder_, k);
    try {
      return find_checkpoint(identity_of(case_, setup_), case_, setup_, folder_).has_value();
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find("damaged"), std::string::npos) << error.what();
      return false;
    }
  };
  EXPECT_TRUE(is_taken([](Checkpoint&) {}));
  for (const auto field :
       {&dynamics::SavedState::u, &dynamics::SavedState::v, &dynamics::SavedState::force}) {
    const auto longer = [&](Checkpoint& k) {
      k.state.*field = Field((k.state.*field).size() + 1, 2);
    };
    const auto in_space = [&](Checkpoint& k) { k.state.*field = Field(setup_.model.n_nodes(), 3); };
    EXPECT_FALSE(is_taken(longer));
    EXPECT_FALSE(is_taken(in_space));
  }
  EXPECT_FALSE(is_taken([](Checkpoint& k) { k.state.gradient.emplace_back(); }));
  EXPECT_FALSE(is_taken([](Checkpoint& k) { k.state.energy.push_back(0.0); }));
  EXPECT_FALSE(is_taken([](Checkpoint& k) { k.state.impulses = {{2, {}}, {1, {}}}; }));
  EXPECT_FALSE(is_taken([](Checkpoint& k) { ++k.files.snapshots.count; }));
  EXPECT_FALSE(
      is_taken([](Checkpoint& k) { std::swap(k.schedule.steps[0], k.schedule.steps[1]); }));
  EXPECT_FALSE(is_taken([](Checkpoint& k) { k.schedule.steps.back() = k.n_steps + 1; }));
  EXPECT_FALSE(is_taken([](Checkpoint& k) { k.schedule.interval = std::nan(""); }));
  EXPECT_FALSE(is_taken([](Checkpoint& k) { ++k.history.done; }));
  EXPECT_FALSE(is_taken([](Checkpoint& k) { k.history.next = 0; }));
  EXPECT_FALSE(is_taken([](Checkpoint& k) { k.last_row = {1.0}; }));
  EXPECT_FALSE(is_taken([](Checkpoint& k) { k.problems_kept = -1; }));
}

TEST_F(Resume, AnEndAtTheStepsMadeIsNoLaterOne) {
  Checkpoint k = after_steps();
  setup_.n_steps = k.state.step;
  EXPECT_NE(refusal(k).find("time.end"), std::string::npos);
  k.n_steps = k.state.step;  // it was the end before
  EXPECT_EQ(refusal(k), "");
  setup_.n_steps = k.state.step - 1;
  EXPECT_NE(refusal(k).find("a later end"), std::string::npos);
}

}  // namespace resume_test
