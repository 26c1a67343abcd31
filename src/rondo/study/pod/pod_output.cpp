// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/pod/pod_output.hpp"

#include <algorithm>
#include <span>
#include <string>

#include "rondo/io/files.hpp"
#include "rondo/io/pod_files.hpp"
#include "rondo/study/pod/pod_report.hpp"

namespace rondo::study {
namespace {

using pod::Index;

/// `count` evenly spaced columns, including the first and the last.
std::vector<std::size_t> spread(std::size_t count, std::size_t columns) {
  std::vector<std::size_t> chosen;
  count = std::min(count, columns);
  for (std::size_t k = 0; k < count; ++k)
    chosen.push_back(count > 1 ? k * (columns - 1) / (count - 1) : columns - 1);
  return chosen;
}

FieldView as_points(const Eigen::VectorXd& rows, std::size_t components) {
  return {{rows.data(), static_cast<std::size_t>(rows.size())}, components};
}

/// Snapshots of several runs are numbered consecutively because their times would decrease.
void reconstruct(io::PodWriter& writer, RunSnapshots& snapshots, const PodResult& found,
                 const std::vector<std::size_t>& chosen) {
  Eigen::MatrixXd original(snapshots.rows(), 1);
  Eigen::VectorXd rebuilt(snapshots.rows());
  const bool several = found.columns.back().run > 0;
  const Index r = found.d.modes.cols();
  for (const std::size_t j : chosen) {
    const auto column = static_cast<Index>(j);
    snapshots.read_columns(column, original);
    snapshots.unweight(original.col(0));
    rebuilt.noalias() = found.d.modes * found.d.sigma.head(r).cwiseProduct(
                                            found.d.temporal.row(column).head(r).transpose());
    const double time = several ? static_cast<double>(j) : found.columns[j].time;
    writer.add(time, as_points(original.col(0), snapshots.components()),
               as_points(rebuilt, snapshots.components()));
  }
}

io::PodContent content_of(const PodRequest& request, const PodReport& report,
                          const RunSnapshots& snapshots, const PodResult& found) {
  io::PodContent content;
  content.mesh = &snapshots.run().mesh();
  content.mass = snapshots.run().mass();
  content.contact = request.field == "contact";
  content.quantity = request.field;
  content.unit = report.unit;
  content.time_unit = report.time_unit;
  content.frame = request.frame;
  content.shift = request.frame == "rectified" ? request.shift : "none";
  content.weight = report.weight;
  content.point_weight = snapshots.weight();
  content.decomposition = &found.d;
  content.spectrum = &found.spectrum;
  content.components = snapshots.components();
  content.modes = &found.d.modes;
  for (std::size_t j = 0; j < found.columns.size(); ++j) {
    content.time.push_back(found.columns[j].time);
    content.angle.push_back(found.columns[j].angle);
    content.run.push_back(static_cast<int>(found.columns[j].run));
    content.error.push_back(
        relative_error(found.identity.squared_error[j], found.identity.snapshot_energy[j]));
  }
  for (const PodRun& run : report.runs) content.runs.push_back(run.directory.string());
  return content;
}

}  // namespace

void write_pod_files(const PodRequest& request, const PodReport& report, RunSnapshots& snapshots,
                     PodResult& result) {
  // U becomes Φ, in the order of the mesh, in place: it may be half of all memory used.
  for (Index i = 0; i < result.d.modes.cols(); ++i) snapshots.unweight(result.d.modes.col(i));
  const io::PodContent content = content_of(request, report, snapshots, result);
  const std::size_t asked = result.d.rank > 0 ? static_cast<std::size_t>(request.reconstruct) : 0;
  const std::vector<std::size_t> chosen = spread(asked, result.columns.size());
  io::PodWriter writer(report.directory, content, chosen.size());
  reconstruct(writer, snapshots, result, chosen);
  writer.commit();
}

}  // namespace rondo::study
