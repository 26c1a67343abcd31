// SPDX-License-Identifier: BSD-3-Clause
/// The table of options, and what the Python package has of it.
#include "rondo/study/options/options.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "support/manual.hpp"

namespace rondo::study::options_test {
namespace {

struct Requests {
  RunOptions run;
  ModesRequest modes;
  PodRequest pod;
  ReduceRequest reduce;
  SweepRequest sweep;
  FmuRequest fmu;
  MatricesRequest matrices;

  std::vector<Options> all() {
    return {run_options(run),          modes_options(modes), pod_options(pod),
            reduce_options(reduce),    sweep_options(sweep), fmu_options(fmu),
            matrices_options(matrices)};
  }
};

const Option& row(const Options& options, std::string_view words) {
  return *std::ranges::find(options, words, &Option::words);
}

TEST(Manual, HasTheOptionsOfPython) {
  const auto file = std::filesystem::path(RONDO_CASES).parent_path() / "python/rondo/options.py";
  rondo::test::expect_file(file, python_options());
}

TEST(Options, EachIsUnderstoodByItself) {
  Requests requests;
  for (const Options& options : requests.all())
    for (const Option& o : options) {
      for (const std::string_view help : {o.help, o.in_python.empty() ? o.help : o.in_python}) {
        EXPECT_TRUE(std::isupper(static_cast<unsigned char>(help.front()))) << help;
        EXPECT_FALSE(help.ends_with('.') || help.ends_with(' ')) << help;
      }
      EXPECT_TRUE(o.words.starts_with("--")) << o.words;
      EXPECT_FALSE(is_given(o) && !std::holds_alternative<bool*>(o.target) &&
                   default_text(o).empty())
          << o.words;
      EXPECT_TRUE(!o.range || std::holds_alternative<int*>(o.target)) << o.words;
      // The default is one of the choices, or the help says what holds.
      if (!o.choices.empty() && !default_text(o).empty()) {
        EXPECT_NE(o.choices.find(default_text(o)), std::string_view::npos) << o.words;
      }
    }
}

TEST(Options, NamesAreUsedOnceAndOthersStandBefore) {
  Requests requests;
  for (const Options& options : requests.all()) {
    std::set<std::string_view> words, python;
    for (const Option& o : options) {
      for (const auto& other : {o.needs, o.excludes})
        EXPECT_TRUE(!other || (words.contains(other->words) && python.contains(other->python)))
            << o.words;
      EXPECT_TRUE(words.insert(o.words).second) << o.words;
      EXPECT_TRUE(o.python.empty() || python.insert(o.python).second) << o.python;
    }
  }
}

TEST(Options, TextsHaveUnitChoicesAndDefault) {
  PodRequest pod;
  const Options options = pod_options(pod);
  EXPECT_EQ(help_text(row(options, "--from"), "First; all if left out"),
            "First [s]; all if left out");
  EXPECT_EQ(help_text(row(options, "--field"), "Field"),
            "Field: displacement | velocity | contact");
  EXPECT_EQ(default_text(row(options, "--reconstruct")), "20");
  EXPECT_EQ(default_text(row(options, "--from")), "");
  EXPECT_EQ(default_text(row(options, "--memory")), "2GB");
}

TEST(Options, SomethingIsGivenWhereTheRequestHoldsIt) {
  RunOptions run;
  const Options options = run_options(run);
  for (const char* words : {"--reduced", "--overwrite", "--threads,--jobs"})
    EXPECT_FALSE(is_given(row(options, words))) << words;
  run.reduced = "model.h5";
  run.overwrite = true;
  run.threads = 2;
  for (const char* words : {"--reduced", "--overwrite", "--threads,--jobs"})
    EXPECT_TRUE(is_given(row(options, words))) << words;
}

}  // namespace
}  // namespace rondo::study::options_test
