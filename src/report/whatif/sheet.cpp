// SPDX-License-Identifier: MIT
//
// The rows of a failure modes and effects analysis, and of the tables that a
// risk assessment by ISO 12100 asks for. How severe an effect is, and how
// likely, only the owner of the robot can say: there are columns to be filled
// in for it.
#include <fmt/format.h>

#include "model/tree/node_types.hpp"
#include "report/formats/reported.hpp"
#include "report/whatif/files.hpp"
#include "report/whatif/words.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

// In quotes where it needs them. A cell that a spreadsheet would take for a
// formula is one word more to it, and none to a reader.
std::string cell(std::string_view text) {
  std::string value = unbroken(harmless(text));
  if (!value.empty() &&
      std::string_view("=+-@").find(value[0]) != std::string_view::npos) {
    value.insert(0, "'");
  }
  if (value.find_first_of(",\"\n\r") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string line_of_cells(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& each : cells) {
    line += (line.empty() && &each == &cells[0] ? "" : ",") + cell(each);
  }
  return line + "\r\n";
}

std::string detected_by(const BehaviorTree& tree, const FaultRow& row) {
  if (row.harm == Harm::NotAsked) return "";
  if (!row.notice) return "nobody";
  return fmt::format("{} {}", short_name(tree, row.notice->node),
                     answer_word(row.notice->what));
}

// Alone it keeps the mission from its end, or a rule from being kept.
bool is_single_point(const FaultRow& row) { return row.harm <= Harm::MayFail; }

}  // namespace

std::string what_if_csv(const WhatIfReport& report) {
  const BehaviorTree& tree = report.tree();
  const WhatIf& result = report.result;
  std::string text = line_of_cells({"id",
                                    "item",
                                    "function",
                                    "path",
                                    "file",
                                    "line",
                                    "failure mode",
                                    "failure mode (words)",
                                    "effect on the mission",
                                    "effect class",
                                    "rules broken",
                                    "detected by",
                                    "detected after (ticks)",
                                    "detected at the latest after (ticks)",
                                    "recovery",
                                    "single point of failure",
                                    "struck in tick",
                                    "ended in tick",
                                    "run",
                                    "severity",
                                    "occurrence",
                                    "measure"});
  for (std::size_t n = 1; n <= result.rows.size(); ++n) {
    const FaultRow& row = result.rows[n - 1];
    const InjectedFault& fault = row.faults[0];
    const Node& leaf = tree.node(fault.leaf);
    const FaultFacts& facts = facts_of(fault.fault.kind);
    const auto tick = [](int number) {
      return number == 0 ? std::string() : fmt::format("{}", number);
    };
    text += line_of_cells(
        {fmt::format("{}", n),
         short_name(tree, fault.leaf),
         leaf.id.empty() ? std::string(type_name(leaf.type)) : leaf.id,
         stable_path(tree, fault.leaf),
         tree.file_of(fault.leaf),
         fmt::format("{}", leaf.span.line),
         std::string(facts.word),
         std::string(facts.told),
         fmt::format("the mission {}", harm_text(tree, result, row)),
         std::string(facts_of(row.harm).word),
         fmt::format("{}", fmt::join(broken_rules(result, row.effect), " ")),
         detected_by(tree, row),
         row.notice ? fmt::format("{}", row.notice->ticks) : "",
         row.within ? fmt::format("{}", *row.within) : "",
         recovery_text(tree, row),
         is_single_point(row) ? "yes" : "no",
         tick(row.struck_in),
         tick(row.ended_in),
         n <= report.runs.size() ? report.runs[n - 1] : "",
         "",
         "",
         ""});
  }
  return text;
}

}  // namespace btcheck
