// SPDX-License-Identifier: MIT
//
// Writes the pages that viewer_test.mjs opens, and beside each the ITF file
// that it has to give back: make_pages SOURCE_OF_DRONE3 DIRECTORY
#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

#include "trace/hand_made_drone.hpp"
#include "trace/hand_made_extremes.hpp"
#include "trace/run/itf.hpp"
#include "trace/viewer/html.hpp"

namespace {

std::string content(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

bool write(const std::string& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  return stream.good();
}

// As if what failed in the run had been skipped.
btcheck::RecordedRun with_skips(btcheck::RecordedRun run) {
  for (btcheck::RecordedState& state : run.states) {
    std::ranges::replace(state.phases, btcheck::Phase::Failure,
                         btcheck::Phase::Skipped);
  }
  return run;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "make_pages SOURCE_OF_DRONE3 DIRECTORY\n";
    return 2;
  }
  const std::string source = content(argv[1]);
  const std::pair<const char*, btcheck::RecordedRun> runs[] = {
      {"lasso", btcheck::drone_lasso(source)},
      {"skipped", with_skips(btcheck::drone_lasso(source))},
      {"watched", btcheck::drone_watched(source)},
      {"thousand", btcheck::drone_survey(source, 1000)},
      {"large", btcheck::large_run(330, 3)},
      {"nasty", btcheck::nasty_run()}};
  for (const auto& [name, run] : runs) {
    const std::string stem = std::string(argv[2]) + "/" + name;
    if (!write(stem + ".html", btcheck::html_text(run)) ||
        !write(stem + ".itf.json", btcheck::itf_text(run))) {
      std::cerr << "cannot write " << stem << "\n";
      return 1;
    }
  }
}
