// SPDX-License-Identifier: MIT
//
// Where ROS packages lie, installed or in the sources of a workspace.
#pragma once

#include <string>
#include <string_view>

namespace btcheck {

// The share folder of a ROS package, for <include ros_pkg="…">: that of
// AMENT_PREFIX_PATH, else the folder of its package.xml, in the workspace that
// `from` lies in: of its folders the one called `src`, or else the third above.
// "" where there is none.
std::string package_folder(std::string_view package, const std::string& from);

}  // namespace btcheck
