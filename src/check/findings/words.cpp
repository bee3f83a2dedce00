// SPDX-License-Identifier: MIT
#include "check/findings/words.hpp"

#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <utility>

namespace btcheck {
namespace {

std::string_view in_py_trees(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 10>
      kWords = {{{"ReactiveSequence", "Sequence without memory"},
                 {"ReactiveFallback", "Selector without memory"},
                 {"Fallback", "Selector"},
                 {"Fallbacks", "Selectors"},
                 {"ForceSuccess", "FailureIsSuccess"},
                 {"ForceFailure", "SuccessIsFailure"},
                 {"KeepRunningUntilFailure", "SuccessIsRunning"},
                 {"RetryUntilSuccessful", "Retry"},
                 {"RunOnce", "OneShot"},
                 {"PolicyParallel", "Parallel"}}};
  for (const auto& [other, own] : kWords) {
    if (word == other) return own;
  }
  return word;
}

bool is_of_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Names of nodes stand in backticks and stay as they are.
std::string in_py_trees_text(std::string_view text) {
  std::string told;
  bool is_quoted = false;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && is_of_word(text[end])) ++end;
    if (end == at) {
      is_quoted ^= text[at] == '`';
      told += text[at++];
      continue;
    }
    const std::string_view word = text.substr(at, end - at);
    told += is_quoted ? word : in_py_trees(word);
    at = end;
  }
  return told;
}

// Pre- and postconditions are of BehaviorTree.CPP alone.
bool has_attribute(std::string_view text) {
  return text.find(" _") != text.npos || text.find("`_") != text.npos;
}

}  // namespace

std::string in_words_of(Profile profile, std::string_view text) {
  return profile == Profile::PyTrees ? in_py_trees_text(text)
                                     : std::string(text);
}

void put_into_words(const BehaviorTree& tree,
                    std::vector<TreeFinding>& findings) {
  if (tree.profile != Profile::PyTrees) return;
  for (TreeFinding& finding : findings) {
    finding.message = in_py_trees_text(finding.message);
    finding.why = in_py_trees_text(finding.why);
    finding.help = has_attribute(finding.help) ? std::string()
                                               : in_py_trees_text(finding.help);
    finding.repairs.clear();
  }
}

}  // namespace btcheck
