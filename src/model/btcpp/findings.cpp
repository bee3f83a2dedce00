// SPDX-License-Identifier: MIT
#include "model/btcpp/findings.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace btcheck::btcpp {

FileFindings::FileFindings(const BtcppDocument& document) {
  for (const BtcppFile& file : document.files) add_file(file.name, file.text);
}

void FileFindings::add_file(std::string_view name, std::string_view text) {
  files_.emplace_back(name, text);
}

const SourceText& FileFindings::source(std::uint32_t file) const {
  return files_.at(file).source;
}

void FileFindings::error(const BtcppPlace& place, Finding finding) {
  files_.at(place.file).findings.error(place.span, std::move(finding));
}

void FileFindings::warning(const BtcppPlace& place, Finding finding) {
  files_.at(place.file).findings.warning(place.span, std::move(finding));
}

void FileFindings::note(const BtcppPlace& place, Finding finding) {
  files_.at(place.file).findings.note(place.span, std::move(finding));
}

void FileFindings::add(std::vector<Diagnostic> diagnostics) {
  std::move(diagnostics.begin(), diagnostics.end(),
            std::back_inserter(others_));
}

bool FileFindings::has_error() const {
  return btcheck::has_error(others_) ||
         std::any_of(files_.begin(), files_.end(), [](const File& file) {
           return file.findings.has_error();
         });
}

std::vector<Diagnostic> FileFindings::take() {
  std::vector<Diagnostic> all = std::exchange(others_, {});
  for (File& file : files_) {
    std::vector<Diagnostic> some = file.findings.take();
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace btcheck::btcpp
