// SPDX-License-Identifier: MIT
//
// A directory of its own for a test that needs files; it is gone afterwards.
#pragma once

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace btcheck {

class TemporaryFolder {
 public:
  // Throws std::filesystem::filesystem_error when there cannot be one.
  TemporaryFolder() {
    std::string name =
        std::filesystem::temp_directory_path() / "btcheck-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) {
      throw std::filesystem::filesystem_error(
          "cannot make a temporary directory", name,
          std::error_code(errno, std::generic_category()));
    }
    path_ = name;
  }
  // A test may have made the directory read-only.
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all,
                                 ignored);
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace btcheck
