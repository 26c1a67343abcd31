// SPDX-License-Identifier: BSD-3-Clause
/// @file  Files of a POD: pod.h5, spectrum.csv, modes.xdmf, reconstruction.xdmf, and basis.h5 for
/// LATIN-PGD (docs/results.md).
///
/// All are written into a separate folder beside the old ones; commit() then replaces those one by
/// one. A program killed before that leaves the old POD unchanged.
#pragma once
#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <list>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rondo/core/field.hpp"
#include "rondo/core/files/removed_at_signal.hpp"
#include "rondo/io/h5/h5.hpp"
#include "rondo/io/xdmf.hpp"
#include "rondo/mesh/mesh.hpp"
#include "rondo/pod/decompose.hpp"
#include "rondo/pod/spectrum.hpp"

namespace rondo::io {

/// Result of a POD; pointers and spans are read only by the constructor of PodWriter. Points are
/// nodes or contact candidates; r modes, k singular values, t snapshots.
struct PodContent {
  const mesh::Mesh* mesh = nullptr;
  std::span<const double> mass;  ///< (n) lumped mass of the nodes [kg/m]; in 3-D [kg]
  bool contact = false;  ///< points are candidates; normal, tangential (and lateral) components
  std::string quantity;  ///< "displacement"
  std::string unit;      ///< of the quantity: "m"
  std::string time_unit = "s";  ///< "1": fractions of the load of a crush
  std::string frame, shift;     ///< of the analysis
  /// "mass" [kg/m], "delassus" [m/kg], "none" [1]; in three dimensions [kg] and [1/kg];
  /// "search-direction": the norm uᵀ(K + k HᵀH)u [J/m], which has no weights of points
  std::string weight;
  std::span<const double> point_weight;  ///< (n_points); empty: the norm has no such weights
  const pod::Decomposition* decomposition = nullptr;  ///< its `modes` are not read
  const pod::Spectrum* spectrum = nullptr;
  std::size_t components = 2;  ///< of a point
  /// (components n_points, r) Φ, unweighted; row components · point + component
  const Eigen::MatrixXd* modes = nullptr;
  std::vector<double> time;                ///< (t) [s]
  std::vector<double> angle;               ///< (t) of the rotating frame [rad]
  std::vector<int> run;                    ///< (t) index in `runs`
  std::vector<double> error;               ///< (t) relative error with r modes
  std::vector<std::string> runs;           ///< directories
  const Eigen::MatrixXd* basis = nullptr;  ///< (2n, b) for basis.h5; null: no such file
};

struct PodCounts {
  std::size_t nodes, points, modes, values, temporal, times, reconstructed;
};

class PodWriter {
 public:
  using Vector = std::array<float, 3>;  ///< for ParaView

  /// Writes everything except the reconstruction, of which `n_reconstructed` snapshots will follow
  /// (0: no reconstruction.xdmf). @pre `directory` exists. @throws FileError
  PodWriter(const std::filesystem::path& directory, const PodContent& content,
            std::size_t n_reconstructed);
  ~PodWriter();  ///< without commit(), removes everything that was written
  PodWriter(const PodWriter&) = delete;
  PodWriter& operator=(const PodWriter&) = delete;

  /// Adds the next snapshot, in the frame of the analysis. @param original, reconstructed
  /// (n_points) @pre time increases. @throws FileError
  void add(double time, FieldView original, FieldView reconstructed);
  /// Replaces the files in the directory and removes files that do not belong to this POD. It first
  /// removes pod.json, which the caller writes last: if pod.json exists, the POD is complete.
  /// @pre all snapshots added. @throws FileError
  void commit();

  /// Size in bytes of pod.h5 and basis.h5.
  [[nodiscard]] static std::size_t bytes(const PodContent& content,
                                         std::size_t n_reconstructed) noexcept;

 private:
  void write_all(const PodContent& c);
  void write_modes(const PodContent& c);
  void write_csv(const PodContent& c) const;
  void create_reconstruction(const PodContent& c);
  [[nodiscard]] XdmfSeries series(const PodContent& c, std::size_t times) const;
  void add_fields(XdmfSeries& s, const std::string& name, const std::string& dataset) const;
  void put(h5::Dataset& dataset, std::size_t row, FieldView values);

  std::filesystem::path directory_, folder_;  ///< folder_: where the files are written
  std::list<RemovedAtSignal> at_signal_;      ///< folder_ and its files
  PodCounts n_;
  std::vector<int> boundary_;       ///< nodes of the points; empty: points are the nodes
  std::vector<Vector> field_;       ///< (n) reused
  std::vector<double> difference_;  ///< (n_points, components) reused
  std::size_t components_ = 2;      ///< of a point
  std::size_t added_ = 0;
  double last_ = 0.0;  ///< last time added [s]
  h5::File file_;
  struct {
    h5::Dataset original, reconstructed, error;
  } d_;
  std::unique_ptr<Xdmf> xdmf_;
};

}  // namespace rondo::io
