// SPDX-License-Identifier: BSD-3-Clause
/// Files that are no reduced wheel of the case: what they are said to be.
#include "rondo/analysis/reduced/wheel_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <functional>
#include <limits>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/reduced/prepare_wheel.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/checkpoint_file.hpp"

namespace rondo::study::wheel_file_test {
namespace {

constexpr const char* small = R"(schema = 1
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = 3
circumferential = 24
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[motion]
angular_velocity = 33.333333
height = 0.31
speed = 10.0
[ground]
profile = "flat"
friction = 0.3
[time]
end = 0.01
)";

/// A wheel that was prepared, for the file that the tests write.
class WheelFileTest : public testing::Test {
 public:
  WheelFileTest() {
    RunOptions options;
    options.reduced = wheel_of_case;
    options.reduced_modes = 9;
    prepare_wheel(c_, options, {}, setup_, wheel_);
  }
  ~WheelFileTest() override { std::filesystem::remove(file_); }

 protected:
  [[nodiscard]] WheelFile read() const { return read_wheel_file(file_, c_, setup_, *wheel_.ring); }
  void write() {
    write_wheel_file(file_, c_, setup_, *wheel_.ring, wheel_.model,
                     {WheelBasis::pod, {"results/a", "results/b"}});
  }
  /// @tparam Error that reading the file is to throw with this text
  template <class Error>
  void expect(const char* text) const {
    try {
      static_cast<void>(read());
      FAIL() << "read, where it should say " << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  }

  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("rondo-wheel-" + std::to_string(getpid()) + ".h5");
  Case c_ = read_case_text("small.toml", small);
  study::Setup setup_ = build(c_, 1);
  PreparedWheel wheel_;
};

TEST_F(WheelFileTest, HasTheModesToTheLastBit) {
  write();
  const WheelFile found = read();
  EXPECT_EQ(found.basis, WheelBasis::pod);
  ASSERT_EQ(found.harmonics.size(), wheel_.model.harmonics.size());
  for (std::size_t h = 0; h < found.harmonics.size(); ++h) {
    const rom::RingHarmonic& a = found.harmonics[h];
    const rom::RingHarmonic& b = wheel_.model.harmonics[h];
    EXPECT_EQ(a.k, b.k);
    EXPECT_EQ(a.squares, b.squares);
    EXPECT_EQ(a.shapes, b.shapes);
    EXPECT_EQ(a.contact, b.contact);
    EXPECT_EQ(a.coriolis, b.coriolis);
    EXPECT_EQ(a.translation, b.translation);
  }
}

TEST_F(WheelFileTest, AModelOfAnEarlierVersionNamesItsRuns) {
  io::write_checkpoint_file(file_, [](io::h5::File& h5) {
    h5.set_attribute("/", "format", "rondo reduced model 2");
    h5.set_attribute("/", "runs", "results/mu0\nresults/mu06\n");
  });
  expect<InputError>("model of an earlier version");
  expect<InputError>("rondo reduce results/mu0 results/mu06 --basis pod -o wheel.h5");
}

TEST_F(WheelFileTest, AnotherFileIsNone) {
  io::write_checkpoint_file(
      file_, [](io::h5::File& h5) { h5.set_attribute("/", "format", "rondo checkpoint 1"); });
  expect<FileError>("is not a reduced wheel");
}

TEST_F(WheelFileTest, NumbersThatAreNoModesAreRefused) {
  std::vector<rom::RingHarmonic>& harmonics = wheel_.model.harmonics;
  const auto damaged = [&](const std::function<void()>& change) {
    const std::vector<rom::RingHarmonic> kept = harmonics;
    change();
    write();
    harmonics = kept;
    expect<FileError>("has modes that are none of its mesh");
  };
  damaged([&] { harmonics[1].shapes(0, 0) = std::numeric_limits<double>::quiet_NaN(); });
  damaged([&] { harmonics[1].squares[0] = -1.0; });
  damaged([&] { harmonics[1].k = 12; });
  damaged([&] { std::swap(harmonics[0], harmonics[1]); });
}

TEST_F(WheelFileTest, OfAnotherBody) {
  write();
  c_.material.poissons_ratio = 0.25;
  expect<InputError>("the case has poissons_ratio = 0.25 against poissons_ratio = 0.3");
}

}  // namespace
}  // namespace rondo::study::wheel_file_test
