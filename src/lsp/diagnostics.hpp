// SPDX-License-Identifier: MIT
//
// Findings as an editor shows them: at the place where what they are about
// stands now.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "btcheck/check.hpp"
#include "cli/inputs/file_sources.hpp"
#include "lsp/documents.hpp"
#include "lsp/texts/lines.hpp"
#include "text/json.hpp"

namespace btcheck::lsp {

// Where places of older texts stand in those of today.
class Movement {
 public:
  // Both must outlive it.
  Movement(const Buffers& then, const Buffers& now) : then_(then), now_(now) {}

  // Nothing where the file is unknown.
  std::optional<TextStretch> operator()(const v1::Position& place);

 private:
  struct OfFile {
    std::shared_ptr<const Lines> lines;  // of the text then
    std::optional<Shift> shift;          // nothing where it is the same
  };

  const Buffers& then_;
  const Buffers& now_;
  std::map<std::string, OfFile> files_;
};

// What is to be said of a finding: its message and what helps.
std::string message_of(const v1::Finding& finding);

class DiagnosticList {
 public:
  // All must outlive it.
  DiagnosticList(const Buffers& texts, const Documents& documents,
                 Encoding encoding)
      : texts_(texts), documents_(documents), encoding_(encoding) {}

  // A file of which there is always something to say, if only that there is
  // nothing; what is wrong with contracts and rules that no tree reads.
  void add_file(const std::string& path, FileKind kind);
  // What a report of these texts has; what was said already is not said again.
  void add(const v1::Report& report, const Buffers& then);

  // By the path of a file, a JSON array.
  std::map<std::string, std::string> take();

 private:
  struct Entry {
    TextStretch at;
    int level = 1;
    std::string json;
  };

  void add(const v1::Finding& finding, Movement& moved);

  const Buffers& texts_;
  const Documents& documents_;
  const Encoding encoding_;
  std::map<std::string, std::vector<Entry>> files_;
  std::set<std::tuple<std::string, std::size_t, std::string, std::string>>
      said_;
};

}  // namespace btcheck::lsp
