// SPDX-License-Identifier: MIT
//
// Runs of trees that are larger, or worse, than what people write.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "trace/hand_made_run.hpp"

namespace btcheck {

// A Fallback over Sequences over Fallbacks …, of which some are never come to.
inline RecordedRun large_run(std::size_t nodes, int ticks) {
  RecordedRun about;
  about.tree = "large.xml";
  about.ticks = "root";
  about.property = "never root.failure";
  about.formula = "never root.failure";
  about.verdict = "VIOLATED";
  about.why = "Everything that could be tried was tried.";
  const auto add = [&](std::string type, std::string name,
                       std::optional<std::uint32_t> parent) {
    const auto number = static_cast<std::uint32_t>(about.nodes.size());
    about.nodes.push_back({name + "_btn" + std::to_string(number),
                           std::move(type), name, number + 3, 5, parent});
    return number;
  };
  const std::array<const char*, 8> kVerbs = {
      "go_to",   "look_for", "pick_up",      "dock",
      "is_near", "has_seen", "turn_towards", "wait_for"};
  const std::uint32_t root = add("BehaviorTree", "main", std::nullopt);
  const std::uint32_t top = add("Sequence", "rooms", root);
  for (std::size_t room = 0; about.nodes.size() < nodes; ++room) {
    const std::string where = "_" + std::to_string(room);
    const std::uint32_t inside = add("Fallback", "room" + where, top);
    for (std::size_t task = 0; task < 4 && about.nodes.size() < nodes; ++task) {
      const std::uint32_t doing =
          add("Sequence", "task" + where + "_" + std::to_string(task), inside);
      for (std::size_t leaf = 0; leaf < 4 && about.nodes.size() < nodes;
           ++leaf) {
        add("Action", kVerbs[(room * 3 + task * 5 + leaf) % 8] + where, doing);
      }
    }
  }
  about.variables = {"room"};
  about.is_number = {true};
  HandMadeRun made(std::move(about), {"0"},
                   [](std::uint32_t leaf, int tick) -> LeafAnswer {
                     const auto t = static_cast<std::uint32_t>(tick);
                     if (leaf % 11 == 0) return {Phase::Failure, true};
                     if (leaf % 37 == t % 37) return {Phase::Running, true};
                     return {Phase::Success, true};
                   });
  for (int i = 0; i < ticks; ++i) made.tick();
  RecordedRun run = made.finished();
  run.lost = run.states.size() - 1;
  run.end_words = "this state breaks the rule";
  return run;
}

// Names, values and a source that no page should stumble over.
inline RecordedRun nasty_run() {
  RecordedRun about;
  about.tree = "dir/<b>&\"'\xff.btf";
  about.source =
      "; </script><script>document.title='broken'</script>\n"
      "; \xe2\x80\xa8 and {{script}} and <!-- and ]]> and \xc3\x28\n"
      "(BehaviorTree :name \"\xf0\x9f\xa4\x96\" ~a_btn1~)\n";
  about.ticks = "root";
  about.property = "p<i>\"q\"</i>";
  about.formula = "[] (a < b && c > d) </title><img src=x onerror=alert(1)>";
  about.verdict = "VIOLATED";
  about.why = "<img src=x onerror=alert(1)> & \xe2\x80\xae so on";
  const auto add = [&](std::string key, std::string type, std::string name,
                       std::optional<std::uint32_t> parent) {
    about.nodes.push_back(
        {std::move(key), std::move(type), std::move(name), 3, 2, parent});
  };
  add("__proto__", "BehaviorTree", "__proto__", std::nullopt);
  add("1", "Sequence", "</script>", 0u);
  add("0", "Action", "<img src=x onerror=alert(1)>", 1u);
  add("a_btn1", "Action",
      "\xe2\x80\xae"
      "drawkcab",
      1u);
  add("a_btn12", "Action", "a~b~~", 1u);
  add("~3", "Condition", std::string(300, 'w'), 1u);
  add("caf\xc3\xa9\xff", "Action", "caf\xc3\xa9\xff", 1u);
  add("nul", "Action", std::string("nul\0nul", 7), 1u);
  about.variables = {"constructor", "2", "1"};
  about.is_number = {false, true, true};
  about.atoms = {"a < b", "\"c\" && '\\'"};
  HandMadeRun made(
      std::move(about), {"</script>", "7", "-3"},
      [](std::uint32_t leaf, int tick) -> LeafAnswer {
        if (leaf == 7 && tick < 3) return {Phase::Running, true};
        if (leaf == 3) {
          return {Phase::Success, true, 0, "~0 \xe2\x80\xa9 &amp;"};
        }
        return {Phase::Success, leaf % 2 == 0};
      });
  for (int i = 0; i < 3; ++i) made.tick();
  RecordedRun run = made.finished();
  run.trigger = 1;
  run.trigger_words = "</script> \"~\"";
  return run;
}

}  // namespace btcheck
