// SPDX-License-Identifier: MIT
//
// Files in and out, and what can go wrong with them.
#pragma once

#include <sys/types.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "check/check.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// A descriptor that is closed at the end, or none.
class OpenFile {
 public:
  explicit OpenFile(int file) : file_(file) {}
  // `flags` as open(2) has them. Where it is not open, errno says why.
  OpenFile(const std::string& name, int flags);
  ~OpenFile();
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool is_open() const { return file_ >= 0; }
  int number() const { return file_; }
  // Its kind and permissions; 0 where the system does not say.
  mode_t mode() const;
  // How many bytes there are in the block now: 0 at the end, negative on a
  // failure.
  ssize_t read(std::span<char> block) const;
  // All of it, or false.
  bool write(std::string_view text) const;

 private:
  int file_;
};

// No more is read of one file.
inline constexpr std::size_t kMostInputBytes = std::size_t{64} << 20;

// The text of a regular file, or of what the caller has opened (kStandardInput,
// /dev/stdin, /dev/fd/63). Anything else, a directory, a pipe, a missing file
// or one of more than 64 MiB, is a diagnostic; none is waited for.
Result<InputFile> read_file(const std::string& name);

// What the caller has opened, a pipe of `<(...)` for instance: it lies in no
// folder of a project.
bool is_given(const std::string& name);

// BT0009 where a file or folder lies in none of `roots`, folders or the file
// itself, once links are followed, or is hidden in them by a name that begins
// with a dot; nothing where there are no roots.
std::optional<Diagnostic> refusal_outside(const std::vector<std::string>& roots,
                                          const std::string& name);

// The text of a file that lies there.
Result<InputFile> read_file_in(const std::vector<std::string>& roots,
                               const std::string& name);

// Writes a file as a whole: into a temporary one beside it, then renamed. A
// device or a pipe, /dev/stderr for instance, is written to directly. Returns
// what went wrong, or "".
std::string write_file(const std::string& name, const std::string& text);

// The same piece by piece, for what is too large to be held as a text: nothing
// is there under the name before `keep`, and nothing is left without it.
class WholeFile {
 public:
  explicit WholeFile(std::string name);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  // False: something went wrong, now or before, and `keep` says what.
  bool write(std::string_view text);
  // Puts it in its place. Returns what went wrong, or "".
  std::string keep();

 private:
  std::string name_;
  std::string temporary_;  // "" for a device, and when it is gone
  std::optional<OpenFile> file_;
  std::string complaint_;
};

// The same, and nothing is ever written to what is there under that name.
std::string replace_file(const std::string& name, const std::string& text);

// The same of a file that is there, and keeps its permissions; where it is a
// link, of the one that it leads to. One that may not be written to stays as it
// is.
std::string rewrite_file(const std::string& name, const std::string& text);

// Adds the text to the end of a file, which is made if need be. Returns what
// went wrong, or "".
std::string append_file(const std::string& name, const std::string& text);

// Makes the directory if it is not there. Returns what went wrong, or "".
std::string make_directory(const std::string& name);

}  // namespace btcheck
