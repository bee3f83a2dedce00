// SPDX-License-Identifier: MIT
#include "btcpp_random/faulty_scripts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>
#include <vector>

#include "btcpp_random/scripted_run.hpp"
#include "model/tree_file.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference {
namespace {

// What a leaf answers, one after the other; the last for ever.
struct Answers {
  std::string leaf;
  std::vector<std::string> words;

  std::string line() const {
    std::string text = leaf + ":";
    for (const std::string& word : words) text += " " + word;
    return text + "\n";
  }
};

std::vector<Answers> answers_in(const std::string& script) {
  std::vector<Answers> all;
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(':');
    Answers& made = all.emplace_back(Answers{line.substr(0, colon), {}});
    std::istringstream words(line.substr(colon + 1));
    for (std::string word; words >> word;) {
      const std::size_t star = word.find('*');
      const int times =
          star == word.npos ? 1 : std::stoi(word.substr(star + 1));
      made.words.insert(made.words.end(), static_cast<std::size_t>(times),
                        word.substr(0, star));
    }
  }
  return all;
}

std::string text_of(const std::vector<Answers>& all) {
  std::string text;
  for (const Answers& each : all) text += each.line();
  return text;
}

bool is_action(const Answers& answers) { return answers.leaf[0] == 'a'; }

// An action that works never fails, and ends.
void let_work(Answers& answers) {
  for (std::string& word : answers.words) {
    if (word == "failure") word = "success";
  }
  answers.words.emplace_back("success");
}

// What a leaf that is said to take two ticks at most takes.
void let_end_in_time(Answers& answers) {
  std::vector<std::string> words;
  int running = 0;
  for (const std::string& word : answers.words) {
    running = word == "running" ? running + 1 : 0;
    if (running <= 2) words.push_back(word);
  }
  answers.words = std::move(words);
}

void let_be_late(Answers& answers) {
  std::vector<std::string> words;
  for (const std::string& word : answers.words) {
    if (word == "running") continue;
    if (word == "success") words.insert(words.end(), 5, "running");
    words.push_back(word);
  }
  // For ever so.
  for (int i = 0; i < 8; ++i) {
    words.insert(words.end(), 5, "running");
    words.emplace_back("success");
  }
  answers.words = std::move(words);
}

// The fault strikes at the success of this number.
void put_in(Answers& answers, FaultKind kind, int number) {
  std::vector<std::string>& words = answers.words;
  if (kind == FaultKind::Fails) words = {"failure"};
  // The last one stays: it may be that one.
  words.insert(words.end(), static_cast<std::size_t>(number) + 1, words.back());
  int seen = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != "success") continue;
    const int here = seen++;
    switch (kind) {
      case FaultKind::FailsOn:
        if (here == number) {
          words.resize(i);
          words.emplace_back("failure");
          return;
        }
        break;
      case FaultKind::FailsOnce:
        if (here == number) words[i] = "failure";
        break;
      case FaultKind::NeverEnds:
        if (here == number) {
          words.resize(i);
          words.emplace_back("running");
          return;
        }
        break;
      case FaultKind::Throws:
        if (here == number) words[i] = "throws";
        break;
      default:
        break;
    }
  }
}

void say_duration(std::string& leaves, const std::string& leaf) {
  const std::size_t begin = leaves.find("(defaction " + leaf + " ");
  const std::size_t end = leaves.find('\n', begin);
  leaves.insert(end - 1, " :duration [0,2]");
}

// Its ticks up to the end of the tree; "" where something other than the
// script decides.
std::string first_mission(const ScriptedTree& made, Profile profile,
                          const std::string& script, int ticks) {
  const auto tree =
      read_tree("t.xml", made.xml, scripted_reading(profile, made.leaves));
  if (!tree.value) return "";
  const ScriptedRun run = scripted_run(*tree.value, script, ticks);
  if (!run.is_determined) return "";
  std::istringstream lines(run.lines);
  std::string mission;
  for (std::string line; std::getline(lines, line);) {
    mission += line + "\n";
    if (line.find("root=success") != line.npos ||
        line.find("root=failure") != line.npos) {
      break;
    }
  }
  return mission;
}

// How often the leaf succeeds in it.
int successes(const std::string& mission, const std::string& leaf) {
  int count = 0;
  const std::string name = " " + leaf + "=";
  for (std::size_t at = mission.find(name); at != mission.npos;
       at = mission.find(name, at + 1)) {
    const std::size_t end = mission.find_first_of(" \n", at + 1);
    const std::string answers = mission.substr(at, end - at);
    for (std::size_t one = answers.find("success"); one != answers.npos;
         one = answers.find("success", one + 1)) {
      ++count;
    }
  }
  return count;
}

}  // namespace

std::vector<FaultyScript> random_faulty_scripts(std::uint64_t seed,
                                                Profile profile, int ticks,
                                                std::size_t most) {
  constexpr std::array kKinds = {FaultKind::Fails,    FaultKind::FailsOnce,
                                 FaultKind::FailsOn,  FaultKind::NeverEnds,
                                 FaultKind::EndsLate, FaultKind::Throws};
  SplitMix64 random(seed ^ 0x5eed);
  const ScriptedTree tree =
      random_scripted_tree(seed, profile, World::Scripted, ticks);
  std::vector<Answers> well = answers_in(tree.script);
  for (Answers& each : well) {
    if (is_action(each)) let_work(each);
  }
  std::vector<FaultyScript> found;
  // Each leaf with each kind, in a random order, as long as they are wanted.
  std::vector<std::pair<std::size_t, FaultKind>> open;
  for (std::size_t i = 0; i < well.size(); ++i) {
    if (!is_action(well[i])) continue;
    for (const FaultKind kind : kKinds) open.emplace_back(i, kind);
  }
  while (!open.empty() && found.size() < most) {
    const auto at = static_cast<std::ptrdiff_t>(
        random.below(static_cast<int>(open.size())));
    const auto [number, kind] = open[static_cast<std::size_t>(at)];
    open.erase(open.begin() + at);
    FaultyScript made{tree, "", well[number].leaf, kind};
    std::vector<Answers> all = well;
    Answers& chosen = all[number];
    const bool skips =
        std::ranges::find(chosen.words, "skipped") != chosen.words.end();
    if (kind == FaultKind::EndsLate) {
      if (skips) continue;
      let_end_in_time(chosen);
      say_duration(made.tree.leaves, made.leaf);
    }
    made.well = text_of(all);
    const std::string mission =
        first_mission(made.tree, profile, made.well, ticks);
    const int times = successes(mission, made.leaf);
    if (times == 0) continue;
    if (kind == FaultKind::EndsLate) {
      let_be_late(chosen);
    } else {
      put_in(chosen, kind, random.below(times));
    }
    made.tree.script = text_of(all);
    const bool is_played =
        kind != FaultKind::Throws && kind != FaultKind::EndsLate;
    if (is_played) {
      const std::string with_fault =
          first_mission(made.tree, profile, made.tree.script, ticks);
      if (with_fault.empty() || with_fault == mission) continue;
    }
    found.push_back(std::move(made));
  }
  return found;
}

}  // namespace btcheck::reference
