// SPDX-License-Identifier: MIT
//
// What an editor has open: texts that stand for files.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cli/inputs/file_sources.hpp"
#include "lsp/texts/lines.hpp"
#include "serve/message.hpp"
#include "text/input_file.hpp"

namespace btcheck::lsp {

enum class FileKind : std::uint8_t { Xml, Btf, Rules, Leaves, Other };
// By the name, and of XML trees without one by the text.
FileKind kind_of(std::string_view path, std::string_view text);

// "file:///a/b%20c.xml" → "/a/b c.xml". Of other schemes, which name what lies
// in an editor only, the path likewise: files beside it are found by it. Of
// what has none, "untitled:Untitled-1", a name in the folder `/`.
std::string path_of(std::string_view uri);
std::string uri_of(std::string_view path);

struct Document {
  std::string uri;   // as the editor writes it
  std::string path;  // absolute
  long version = 0;
  FileText text;
  FileKind kind = FileKind::Other;

  std::shared_ptr<const Lines> lines() const { return text.parsed<Lines>(); }
};

// Not guarded: whoever has them, has a lock.
class Documents {
 public:
  // What the three notifications say; the path of the document. Throws RpcError
  // for what does not fit.
  std::string open(const JsonValue& params);
  std::string change(const JsonValue& params, Encoding encoding);
  std::string close(const JsonValue& params);

  // By its path, or nullptr.
  const Document* find(const std::string& path) const;
  const std::map<std::string, Document>& all() const { return all_; }
  // The URI of a file, as the editor writes it where it is open.
  std::string uri(const std::string& path) const;
  // All texts, by their paths.
  Buffers buffers() const;

 private:
  std::map<std::string, Document> all_;  // by path
};

}  // namespace btcheck::lsp
