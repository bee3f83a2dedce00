// SPDX-License-Identifier: MIT
//
// Any words as a command line: options that make sense, or a text that says
// what is wrong and exit code 2.
#include <algorithm>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cli/options/options.hpp"
#include "fuzzed.hpp"

namespace btcheck {
namespace {

// One word to a line; NUL ends a word in any command line.
std::vector<std::string> words_in(std::string_view bytes) {
  std::vector<std::string> words{"btcheck"};
  while (!bytes.empty()) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    words.emplace_back(line.substr(0, line.find('\0')));
    bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
  }
  return words;
}

void check_answer(const Answer& answer) {
  require(answer.text.ends_with('\n'));
  require(answer.code == ExitCode::Met || answer.code == ExitCode::BadInput);
  if (answer.code == ExitCode::BadInput) {
    require(answer.text.starts_with("error[BT0001]: "));
  }
}

void check_options(const Options& options) {
  require(options.threads >= 1 && options.threads <= kMostThreads);
  require(options.timeout >= 0);
  require(options.max_states >= 1);
  require(options.inputs.empty() || options.input == options.inputs[0]);
  require(!options.reports.empty());
  if (options.command != Command::Batch) return;
  require(!options.batch.sources.empty() && options.batch.jobs >= 1);
  require(options.batch.shard.index >= 1 &&
          options.batch.shard.index <= options.batch.shard.count);
}

}  // namespace

void check_bytes(std::string_view bytes) {
  const std::vector<std::string> words = words_in(bytes);
  std::vector<const char*> line;
  for (const std::string& word : words) line.push_back(word.c_str());
  const auto result = parse_options(static_cast<int>(line.size()), line.data());
  if (const auto* answer = std::get_if<Answer>(&result)) {
    check_answer(*answer);
  } else {
    check_options(std::get<Options>(result));
  }
}

}  // namespace btcheck
