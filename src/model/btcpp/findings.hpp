// SPDX-License-Identifier: MIT
//
// The findings in all files of one document, collected until `take`.
#pragma once

#include <algorithm>
#include <deque>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/btcpp/document.hpp"
#include "text/findings.hpp"

namespace btcheck::btcpp {

using Finding = Wording;

// One collector for each file, in the order in which they are added.
class FileFindings {
 public:
  FileFindings() = default;
  // The files must outlive this.
  explicit FileFindings(const std::vector<InputFile>& files) {
    for (const InputFile& file : files) add_file(file.name, file.text);
  }
  FileFindings(const FileFindings&) = delete;
  FileFindings& operator=(const FileFindings&) = delete;

  // The texts must outlive this.
  void add_file(std::string_view name, std::string_view text) {
    files_.emplace_back(name, text);
  }
  const SourceText& source(std::uint32_t file) const {
    return files_.at(file).source;
  }

  void error(const BtcppPlace& place, Finding finding) {
    files_.at(place.file).findings.error(place.span, std::move(finding));
  }
  void warning(const BtcppPlace& place, Finding finding) {
    files_.at(place.file).findings.warning(place.span, std::move(finding));
  }
  void note(const BtcppPlace& place, Finding finding) {
    files_.at(place.file).findings.note(place.span, std::move(finding));
  }
  // What `finding.refused_by` refuse: an error where the release is one of
  // them; else a note, the first of its code.
  void refused(const BtcppPlace& place, std::optional<int> release,
               Finding finding) {
    if (release && is_among(*release, finding.refused_by)) {
      error(place, std::move(finding));
    } else if (told_.insert(std::string(finding.code)).second) {
      note(place, std::move(finding));
    }
  }
  // Diagnostics that are complete; not limited in number.
  void add(std::vector<Diagnostic> diagnostics) {
    std::ranges::move(diagnostics, std::back_inserter(others_));
  }

  bool has_error() const {
    return btcheck::has_error(others_) ||
           std::ranges::any_of(files_, [](const File& file) {
             return file.findings.has_error();
           });
  }
  // Those that were complete first, then file by file in the order of the text.
  std::vector<Diagnostic> take() {
    for (File& file : files_) add(file.findings.take());
    return std::exchange(others_, {});
  }

 private:
  struct File {
    File(std::string_view name, std::string_view text)
        : source(name, text), findings(source) {}
    SourceText source;
    Findings findings;
  };
  std::deque<File> files_;  // never moved: findings point at their source
  std::vector<Diagnostic> others_;
  std::set<std::string> told_;  // codes
};

}  // namespace btcheck::btcpp
