// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/limits/control_groups.hpp"

#include <fstream>
#include <sstream>

namespace rondo {
namespace fs = std::filesystem;
namespace {

/// Whether a list such as "cpu,memory" contains "memory".
bool names(const std::string& controllers, const std::string& controller) {
  std::istringstream list(controllers);
  for (std::string name; std::getline(list, name, ',');)
    if (name == controller) return true;
  return false;
}

void add_group(fs::path mount, const std::string& group, std::vector<fs::path>& folders) {
  folders.push_back(mount);
  for (const fs::path& part : fs::path(group).relative_path()) folders.push_back(mount /= part);
}

}  // namespace

std::vector<fs::path> control_group_folders(const std::string& groups, const fs::path& mount,
                                            const std::string& controller) {
  std::vector<fs::path> folders;
  std::istringstream lines(groups);
  for (std::string line; std::getline(lines, line);) {  // number:controllers:path
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string group = line.substr(second + 1);
    if (controllers.empty()) add_group(mount, group, folders);
    if (!names(controllers, controller)) continue;
    add_group(mount / controller, group, folders);
    if (controllers != controller) add_group(mount / controllers, group, folders);
  }
  return folders;
}

std::string text_or_nothing(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace rondo
