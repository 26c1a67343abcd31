// SPDX-License-Identifier: BSD-3-Clause
/// @file  Files of a POD: pod.h5, spectrum.csv, modes.xdmf, reconstruction.xdmf, and of LATIN-PGD
/// basis.h5 (docs/results.md).
///
/// All are written into a folder of their own beside the old ones, which commit() replaces one by
/// one by complete files: a program killed before leaves the old POD as it was.
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

/// What a POD found; pointers and spans are only read by the constructor of PodWriter. Points are
/// nodes, or the contact candidates; r modes, k singular values, t snapshots.
struct PodContent {
  const mesh::Mesh* mesh = nullptr;
  std::span<const double> mass;  ///< (n) lumped mass of the nodes [kg/m]; in 3-D [kg]
  bool contact = false;  ///< points are candidates, components normal, tangential (and lateral)
  std::string quantity;  ///< "displacement"
  std::string unit;      ///< of the quantity: "m"
  std::string time_unit = "s";  ///< "1": shares of the load of a crush
  std::string frame, shift;     ///< of the analysis
  /// "mass" [kg/m], "delassus" [m/kg], "none" [1]; in three dimensions [kg] and [1/kg];
  /// "search-direction": the norm uᵀ(K + k HᵀH)u [J/m], which has no weight of a point
  std::string weight;
  std::span<const double> point_weight;  ///< (n_points); empty: the norm is not of points
  const pod::Decomposition* decomposition = nullptr;  ///< its `modes` are not read
  const pod::Spectrum* spectrum = nullptr;
  std::size_t components = 2;  ///< of a point
  /// (components n_points, r) Φ, unweighted; row components · point + component
  const Eigen::MatrixXd* modes = nullptr;
  std::vector<double> time;                ///< (t) [s]
  std::vector<double> angle;               ///< (t) of the turning frame [rad]
  std::vector<int> run;                    ///< (t) place in `runs`
  std::vector<double> error;               ///< (t) of r modes, relative
  std::vector<std::string> runs;           ///< directories
  const Eigen::MatrixXd* basis = nullptr;  ///< (2n, b) of basis.h5; none: there is no such file
};

struct PodCounts {
  std::size_t nodes, points, modes, values, temporal, times, reconstructed;
};

class PodWriter {
 public:
  using Vector = std::array<float, 3>;  ///< of ParaView

  /// Writes all but the reconstruction, of which `n_reconstructed` snapshots will follow (0: no
  /// reconstruction.xdmf). @pre `directory` is there. @throws FileError
  PodWriter(const std::filesystem::path& directory, const PodContent& content,
            std::size_t n_reconstructed);
  ~PodWriter();  ///< without commit(): nothing is left of what was written
  PodWriter(const PodWriter&) = delete;
  PodWriter& operator=(const PodWriter&) = delete;

  /// The next snapshot, in the frame of the analysis. @param original, reconstructed (n_points)
  /// @pre time rises. @throws FileError
  void add(double time, FieldView original, FieldView reconstructed);
  /// Replaces the files in the directory, removes those that are not of this POD and, first of all,
  /// pod.json, which the caller writes last: where it is, the POD is complete.
  /// @pre all snapshots added. @throws FileError
  void commit();

  /// Bytes that pod.h5 will take, and basis.h5.
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

  std::filesystem::path directory_, folder_;  ///< folder_: where the files are made
  std::list<RemovedAtSignal> at_signal_;      ///< folder_ and what is in it
  PodCounts n_;
  std::vector<int> boundary_;       ///< nodes of the points; empty: points are the nodes
  std::vector<Vector> field_;       ///< (n) reused
  std::vector<double> difference_;  ///< (n_points, components) reused
  std::size_t components_ = 2;      ///< of a point
  std::size_t added_ = 0;
  double last_ = 0.0;  ///< time added [s]
  h5::File file_;
  struct {
    h5::Dataset original, reconstructed, error;
  } d_;
  std::unique_ptr<Xdmf> xdmf_;
};

}  // namespace rondo::io
