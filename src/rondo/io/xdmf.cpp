// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/xdmf.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <iterator>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include "rondo/io/files.hpp"

namespace rondo::io {
namespace {

constexpr const char* head =
    "<?xml version=\"1.0\" ?>\n"
    "<Xdmf Version=\"3.0\">\n"
    "<Domain>\n"
    "<Grid Name=\"rondo\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
constexpr std::string_view tail = "</Grid>\n</Domain>\n</Xdmf>\n";

}  // namespace

Xdmf::Xdmf(std::filesystem::path file, XdmfSeries series, std::vector<double> times)
    : path_(std::move(file)), series_(std::move(series)), times_(std::move(times)) {
  times_.reserve(series_.n_times);
  write_whole(true);
}

Xdmf::~Xdmf() {
  if (closed_ || listed_ == times_.size()) return;
  try {
    write_whole(false);
  } catch (const std::exception&) {  // the error that ends the run was reported before
  }
}

/// Replaces the file by one with all grids. @param durable  also safe against a power cut
void Xdmf::write_whole(bool durable) {
  const UnfinishedFile beside(path_.string() + unfinished_ending());
  text_ = head;
  if (times_.empty()) append_reference_grid();
  write_grids(beside.path, "wbe", 0, durable);
}

/// Replaces the file by a copy with the grids that it does not list yet.
void Xdmf::write_more() {
  if (listed_ > 0) {
    const UnfinishedFile beside(path_.string() + unfinished_ending());
    std::error_code fault;
    std::filesystem::copy_file(path_, beside.path, fault);
    text_.clear();
    if (!fault) return write_grids(beside.path, "r+be", listed_, false);
  }
  write_whole(false);
}

/// Writes text_, the grids from a row on, and the end of the file: over the end that is there.
void Xdmf::write_grids(const std::filesystem::path& beside, const char* mode, std::size_t row,
                       bool durable) {
  constexpr std::size_t block = 1 << 16;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(beside.c_str(), mode),
                                                      std::fclose);
  if (!out) fail_on(path_, "create");
  const auto put = [&] {
    if (std::fwrite(text_.data(), 1, text_.size(), out.get()) != text_.size())
      fail_on(path_, "write");
    text_.clear();
  };
  if (row > 0 && std::fseek(out.get(), -static_cast<long>(tail.size()), SEEK_END) != 0)
    fail_on(path_, "write");
  for (; row < times_.size(); ++row) {
    append_grid(row);
    if (text_.size() >= block) put();
  }
  text_ += tail;
  put();
  if (std::fclose(out.release()) != 0) fail_on(path_, "write");
  if (durable)
    replace_file(beside, path_);
  else if (std::rename(beside.c_str(), path_.c_str()) != 0)
    fail_on(path_, "replace");
  listed_ = times_.size();
}

void Xdmf::append_topology() {
  const XdmfTopology& t = series_.topology;
  fmt::format_to(std::back_inserter(text_),
                 "<Topology TopologyType=\"{}\" NumberOfElements=\"{}\"><DataItem Format=\"HDF\" "
                 "NumberType=\"Int\" Precision=\"4\" Dimensions=\"{}\">{}:{}</DataItem>"
                 "</Topology>\n",
                 t.type, t.n_cells, fmt::join(t.shape, " "), series_.data_file, t.dataset);
}

void Xdmf::append_reference_geometry() {
  fmt::format_to(std::back_inserter(text_),
                 "<Geometry GeometryType=\"{}\"><DataItem Format=\"HDF\" NumberType=\"Float\" "
                 "Precision=\"8\" Dimensions=\"{} {}\">{}:{}</DataItem></Geometry>\n",
                 series_.dimensions == 3 ? "XYZ" : "XY", series_.n_nodes, series_.dimensions,
                 series_.data_file, series_.reference);
}

/// ParaView crashes on a collection without grids.
void Xdmf::append_reference_grid() {
  text_ += "<Grid Name=\"reference\" GridType=\"Uniform\"><Time Value=\"0\"/>\n";
  append_topology();
  append_reference_geometry();
  text_ += "</Grid>\n";
}

/// Row `row` of a dataset (t, n) or (t, n, width), described twice, because ParaView's two families
/// of readers cannot read each other's form. XDMF 3 takes the first text:
/// dataset|start:stride:count:of. XDMF 2 takes the two items inside, because of Type, and uses the
/// first text as the name of the array; since it differs at each time, it is never mistaken for
/// data read before.
void Xdmf::append_array(std::size_t row, const XdmfField& f) {
  const bool deep = f.width > 1;
  const auto in_dataset = [&](const std::string& time, auto node, std::size_t number) {
    return deep ? fmt::format("{} {} {}", time, node, number) : fmt::format("{} {}", time, node);
  };
  const std::string start = in_dataset(fmt::to_string(row), 0, f.first);
  const std::string stride = in_dataset("1", 1, 1);
  const std::string count = in_dataset("1", series_.n_nodes, f.components);
  const std::string of = in_dataset(fmt::to_string(series_.n_times), series_.n_nodes, f.width);
  const std::string shape = f.components > 1 ? fmt::format("{} {}", series_.n_nodes, f.components)
                                             : fmt::to_string(series_.n_nodes);
  const std::string name = series_.data_file + ":" + f.dataset;
  const std::string kind = "Format=\"HDF\" NumberType=\"Float\" Precision=\"4\"";
  fmt::format_to(std::back_inserter(text_),
                 "<DataItem Type=\"HyperSlab\" {0} Dimensions=\"{1}\">{2}|{3}:{4}:{5}:{6}"
                 "<DataItem Format=\"XML\" Dimensions=\"3 {7}\">{3} {4} {5}</DataItem>"
                 "<DataItem {0} Dimensions=\"{6}\">{2}</DataItem></DataItem>",
                 kind, shape, name, start, stride, count, of, deep ? 3 : 2);
}

void Xdmf::append_grid(std::size_t row) {
  fmt::format_to(std::back_inserter(text_),
                 "<Grid Name=\"{}\" GridType=\"Uniform\"><Time Value=\"{}\"/>\n", row, times_[row]);
  append_topology();
  if (series_.position.empty()) {
    append_reference_geometry();
  } else {
    text_ += "<Geometry GeometryType=\"XYZ\">";
    append_array(row, {"position", "Vector", series_.position, 3, 0, 3});
    text_ += "</Geometry>\n";
  }
  for (const XdmfField& field : series_.fields) {
    fmt::format_to(std::back_inserter(text_),
                   "<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">", field.name,
                   field.type);
    append_array(row, field);
    text_ += "</Attribute>\n";
  }
  text_ += "</Grid>\n";
}

void Xdmf::add(double time) {
  times_.push_back(time);
  if (times_.size() >= listed_ + 1 + listed_ / 16) write_more();
}

void Xdmf::close() {
  if (std::exchange(closed_, true)) return;
  series_.n_times = times_.size();
  write_whole(true);
}

}  // namespace rondo::io
