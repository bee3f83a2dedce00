// SPDX-License-Identifier: MIT
//
// What is found in the files of one document, until it is handed over.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/document.hpp"
#include "text/findings.hpp"

namespace btcheck::btcpp {

using Finding = Wording;

// One collector for each file, in the order in which they are added.
class FileFindings {
 public:
  FileFindings() = default;
  // Of a document that has been read: all its files. It must outlive this.
  explicit FileFindings(const BtcppDocument& document);
  FileFindings(const FileFindings&) = delete;
  FileFindings& operator=(const FileFindings&) = delete;

  // The texts must outlive this.
  void add_file(std::string_view name, std::string_view text);
  const SourceText& source(std::uint32_t file) const;

  void error(const BtcppPlace& place, Finding finding);
  void warning(const BtcppPlace& place, Finding finding);
  void note(const BtcppPlace& place, Finding finding);
  // As they were made; not limited in number.
  void add(std::vector<Diagnostic> diagnostics);

  bool has_error() const;
  // File by file, each in the order of its text.
  std::vector<Diagnostic> take();

 private:
  struct File {
    File(std::string_view name, std::string_view text)
        : source(name, text), findings(source) {}
    SourceText source;
    Findings findings;
  };
  std::deque<File> files_;  // never moved: findings point at their source
  std::vector<Diagnostic> others_;
};

}  // namespace btcheck::btcpp
