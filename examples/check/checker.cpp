// SPDX-License-Identifier: MIT
//
// Checks the first tree of the command line, of which the others are includes
// and neighbours, and prints what is found with its place. Files are read once,
// before the check: it sees texts alone.
//   checker [--seconds S] TREE [FILE...]
#include <btcheck/check.hpp>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

namespace {

namespace bt = btcheck::v1;

// Ends the call after so many seconds, as a person who has seen enough would.
class Patience final : public bt::Monitor {
 public:
  explicit Patience(double seconds) : seconds_(seconds) {}
  bool goes_on(const bt::Progress& progress) override {
    return progress.seconds < seconds_;
  }

 private:
  double seconds_;
};

const char* word(bt::Level level) {
  if (level == bt::Level::Error) return "error";
  return level == bt::Level::Warning ? "warning" : "note";
}

}  // namespace

int main(int count, char** words) {
  std::vector<std::string> names(words + 1, words + count);
  double seconds = 3600;
  if (names.size() > 2 && names[0] == "--seconds") {
    seconds = std::atof(names[1].c_str());
    names.erase(names.begin(), names.begin() + 2);
  }
  if (names.empty()) {
    std::cerr << "usage: checker [--seconds S] TREE [FILE...]\n";
    return 2;
  }
  bt::Files files;
  for (const std::string& name : names) {
    std::ifstream stream(name);
    if (!stream) {
      std::cerr << "cannot read " << name << '\n';
      return 2;
    }
    files.add(name, std::string(std::istreambuf_iterator<char>(stream), {}));
  }
  bt::Request request;
  request.tree = names[0];
  Patience patience(seconds);
  const bt::Report report = bt::check(request, files, &patience);
  for (const bt::Finding& finding : report.findings) {
    std::cout << finding.where.file << ':' << finding.where.line << ':'
              << finding.where.column << ": " << word(finding.level) << " ["
              << finding.code << "] "
              << finding.message.substr(0, finding.message.find('\n')) << '\n';
  }
  std::cout << report.node_count << " nodes, " << report.states << " states"
            << (report.stopped.empty() ? "" : ", stopped: " + report.stopped)
            << '\n';
  return static_cast<int>(report.outcome);
}
