// SPDX-License-Identifier: MIT
//
// Where ROS packages lie, installed or in the sources of a workspace.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace btcheck {

inline constexpr int kMostLooks = 20'000;  // at names of files and folders

// The share folder of a ROS package, for <include ros_pkg="…">, by
// AMENT_PREFIX_PATH. "" where there is none.
std::string installed_package(std::string_view package);

// The folder of its package.xml, in the workspace that `from` lies in: of its
// folders the one called `src`, or else the third above. "" where there is
// none.
std::string package_folder(std::string_view package, const std::string& from);

// The `src` above the ROS package that a file lies in, in which repositories
// lie beside each other. "" where there is none.
std::string workspace_of(const std::string& from);

// The XML files of the ROS package that a file lies in, and then those of more
// and more of its workspace, up to its `src`, its repository, or the third
// folder above the package.
class FilesAround {
 public:
  explicit FilesAround(const std::string& from);
  // False where the file lies in no package, and after the last.
  bool has_more() const { return levels_ > 0; }
  // Named as `from` is; those of before among them.
  std::vector<std::string> next();

 private:
  std::string from_;
  std::filesystem::path here_;
  std::filesystem::path folder_;
  int levels_ = 0;
  int looks_ = kMostLooks;
};

}  // namespace btcheck
