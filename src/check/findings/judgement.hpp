// SPDX-License-Identifier: MIT
//
// What the user has said of findings: which are meant, which are known, and
// which are not to be.
//
// A comment at the node takes one out. The levels of btcheck.toml come next, by
// code and file, the last that fits; then what is denied; and what a baseline
// has is known, and not told. Errors of reading are not judged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "check/findings/suspicion.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

enum class Level : std::uint8_t { Allow, Note, Warning, Error };

// In the place of a code: whatever is a warning.
inline constexpr std::string_view kWarnings = "warnings";

struct LevelRule {
  std::string code;  // "BT2208", or kWarnings
  Level level = Level::Warning;
  std::string folder;   // absolute: names of files are seen from there
  std::string pattern;  // with wildcards; "" for every file
};

// A finding as it is known again when lines have moved.
struct KnownFinding {
  std::string code;
  std::string file;
  std::string node;  // its name, "" where no node is to blame
  std::string text;  // of its line: the beginning, without blanks around it
  std::size_t count = 1;
  bool can_fail = true;  // no note: a baseline leaves those out

  // All but the count.
  auto key() const { return std::tie(file, code, node, text); }
};

struct Judgement {
  std::string directory;               // absolute: files are named from there
  std::vector<LevelRule> levels;       // the last that fits decides
  std::vector<std::string> denied;     // codes and kWarnings: those are errors
  std::vector<KnownFinding> baseline;  // its files are absolute
  bool has_baseline = false;
};

// What came of it. Names of files are those that the findings have.
struct Judged {
  std::size_t allowed = 0;
  std::vector<KnownFinding> told;
  std::vector<KnownFinding> known;  // and not told: the baseline has them
  bool is_denied = false;           // what a reader warned of is an error
  bool is_whole = false;            // every kind of finding was looked for
  bool has_baseline = false;
  std::vector<std::string> files;  // that findings could be about
};

// The file as it is compared: absolute, without `..`.
std::string placed(const std::string& directory, const std::string& file);
// The folder that it is in, likewise.
std::string folder_of(const std::string& directory, const std::string& file);

// Puts those that are alike together; in the order of file, code, node, text.
std::vector<KnownFinding> counted_alike(std::vector<KnownFinding> findings);

// Judges findings and diagnostics, one list after the other. What is not to be
// told is taken out, the others get their severity.
class FindingsJudge {
 public:
  // Comments are looked for in `sources`. Both have to stay.
  FindingsJudge(const Judgement& said, const std::vector<SourceText>& sources)
      : said_(said), sources_(sources), unused_(counted_alike(said.baseline)) {}

  // What is less serious than `least` is left out without a word.
  void judge(std::vector<TreeFinding>& findings, const BehaviorTree& tree,
             Severity least);
  void judge(std::vector<Diagnostic>& diagnostics);
  // Likewise of what is said with a code and stands at a node: false where it
  // is not to be told.
  bool judge(std::string_view code, const BehaviorTree& tree, NodeId at,
             Severity& severity, Severity least);

  Judged take();

 private:
  bool is_told(KnownFinding finding, int line, Severity& severity,
               Severity least);
  std::string line_of(const std::string& file, int line) const;

  const Judgement& said_;
  const std::vector<SourceText>& sources_;
  std::vector<KnownFinding> unused_;  // what is left of the baseline
  Judged judged_;
};

}  // namespace btcheck
