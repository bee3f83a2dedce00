// SPDX-License-Identifier: MIT
//
// What rules say of runs of the engine, by their definitions: for each
// NAME.events, which run_observer writes, and its NAME.ltl, the lines of
// NAME.naive; and what a monitor says of them that has the table NAME.monitor,
// where there is one, as NAME.monitored.
//   btcpp_verdicts NAME.events...
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "btcpp_random/engine_events.hpp"
#include "btcpp_random/monitored.hpp"
#include "btcpp_random/naive_rules.hpp"
#include "ltl/rules/property.hpp"

namespace fs = std::filesystem;

namespace btcheck::reference {
namespace {

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write(const fs::path& file, const std::vector<NaiveVerdict>& verdicts) {
  std::ofstream out(file);
  for (const NaiveVerdict& verdict : verdicts) out << shown(verdict) << '\n';
}

void write_verdicts(const fs::path& events) {
  const fs::path name = fs::path(events).replace_extension(".ltl");
  const auto rules = read_properties(name.string(), text_of(name));
  if (!rules.value) {
    throw std::runtime_error(fmt::format("{}: {}", name.string(),
                                         rules.diagnostics.front().message));
  }
  const EngineRun run = engine_run(text_of(events));
  write(fs::path(events).replace_extension(".naive"),
        naive_verdicts(run, *rules.value));
  const fs::path table = fs::path(events).replace_extension(".monitor");
  if (!fs::exists(table)) return;
  write(fs::path(events).replace_extension(".monitored"),
        monitored_verdicts(run, text_of(table)));
}

}  // namespace
}  // namespace btcheck::reference

int main(int count, char** words) {
  int failures = 0;
  for (int i = 1; i < count; ++i) {
    try {
      btcheck::reference::write_verdicts(words[i]);
    } catch (const std::exception& failure) {
      fmt::print(stderr, "{}: {}\n", words[i], failure.what());
      ++failures;
    }
  }
  return failures == 0 ? 0 : 2;
}
