// SPDX-License-Identifier: MIT
//
// A list of issues in the form of Code Climate, as far as GitLab reads it. It
// keeps one issue of each fingerprint, compares those of two branches, and
// names files from the root of the repository.
#include <algorithm>

#include "report/formats/escapes.hpp"
#include "report/formats/formats.hpp"
#include "text/json.hpp"

namespace btcheck {
namespace {

std::string_view gitlab_severity(Severity severity) {
  switch (severity) {
    case Severity::Error:
      return "major";
    case Severity::Warning:
      return "minor";
    case Severity::Note:
      break;
  }
  return "info";
}

}  // namespace

std::string gitlab_text(const Report& report) {
  Fingerprints fingerprints(report);
  Json issues = Json::array();
  for (const ReportedTree& tree : report.trees) {
    for (const Finding& finding : all_findings(tree)) {
      const Place& place = finding.place;
      const std::string path =
          plain_text(path_from(report.root, report.directory, place.file));
      issues.push({{"description", plain_text(finding.message)},
                   {"check_name", finding.code},
                   {"fingerprint", fingerprints.next(finding)},
                   {"severity", gitlab_severity(finding.severity)},
                   {"location",
                    {{"path", path},
                     {"lines", {{"begin", std::max(place.span.line, 1)}}}}}});
    }
  }
  return issues.indented(1) + "\n";
}

}  // namespace btcheck
