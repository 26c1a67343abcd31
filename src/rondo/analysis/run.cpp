// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/run.hpp"

#include "rondo/analysis/registry.hpp"
#include "rondo/analysis/run_session.hpp"

namespace rondo::study {
namespace {

RunReport run_from(RunSession::Clock::time_point begin, Analysis& analysis, const Case& c,
                   const RunOptions& options) {
  RunSession session(analysis, c, options, nullptr, begin);
  while (!session.is_over()) session.advance();
  return session.finish();
}

}  // namespace

RunReport run_case(const Case& c, const RunOptions& options) {
  static_cast<void>(dispatch_level());  // a wrong one is told before anything is built
  const auto begin = RunSession::Clock::now();
  const std::unique_ptr<Analysis> analysis = make_analysis(c, options);
  return run_from(begin, *analysis, c, options);
}

RunReport run_analysis(Analysis& analysis, const Case& c, const RunOptions& options) {
  return run_from(RunSession::Clock::now(), analysis, c, options);
}

}  // namespace rondo::study
