// SPDX-License-Identifier: MIT
//
// Automata written down as tables of edges, for comparing with the tables of
// docs/semantics.md. Names are short: `a_btn2` is `a`, the node's own variables
// stand without their owner, and "`a` has given control back with success" is
// `a says success`.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "model/automata/network.hpp"
#include "model/btf_text.hpp"
#include "model/lowering.hpp"

namespace btcheck {

// The rows of a table, sorted: their order means nothing. A line that begins
// with `+` goes on with the row above.
inline std::string rows(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first == std::string::npos) continue;
    if (line[first] == '+') {
      REQUIRE(!lines.empty());
      lines.back() += line.substr(first + 1);
    } else {
      lines.push_back(line.substr(first));
    }
  }
  std::sort(lines.begin(), lines.end());
  std::string sorted;
  for (const std::string& line : lines) sorted += line + '\n';
  return sorted;
}

inline std::string interval_text(Interval when) {
  if (when == kAtOnce) return "";
  if (when.upper == kUnbounded) {
    return " @[" + std::to_string(when.lower) + ",inf[";
  }
  return " @[" + std::to_string(when.lower) + "," + std::to_string(when.upper) +
         "]";
}

inline std::string shortened(std::string text, const std::string& owner) {
  static const std::regex number("_btn[0-9]+");
  static const std::regex answer(
      "(\\w+)\\.caller = None and \\1\\.rstatus = (\\w+)");
  text = std::regex_replace(text, number, "");
  text = std::regex_replace(text, answer, "$1 says $2");
  const std::string self = owner + ".";
  for (std::size_t at = text.find(self); at != std::string::npos;
       at = text.find(self, at)) {
    const bool is_whole = at == 0 || text[at - 1] == ' ' ||
                          text[at - 1] == '[' || text[at - 1] == '(';
    if (is_whole) {
      text.erase(at, self.size());
    } else {
      ++at;
    }
  }
  return text;
}

inline std::string value_text(const Network& network,
                              const Assignment& update) {
  const auto terms = update.value.terms();
  if (terms.size() == 1 && terms[0].operation == Operation::Constant) {
    return network.variable(update.variable).value_name(terms[0].operand);
  }
  return expression_text(network, update.value);
}

// "start_ -> tick_node [guard] @[1,1] x := 1, y := 2" for each edge.
inline std::string edges_text(const Network& network,
                              const Automaton& automaton) {
  std::string text;
  for (const Edge& edge : automaton.edges) {
    text += automaton.source(edge).name + " -> " + automaton.target(edge).name;
    if (!edge.guard.is_true()) {
      text += " [" + expression_text(network, edge.guard) + "]";
    }
    text += interval_text(edge.when);
    for (std::size_t i = 0; i < edge.updates.size(); ++i) {
      text += (i == 0 ? " " : ", ") +
              qualified_name(network, edge.updates[i].variable) +
              " := " + value_text(network, edge.updates[i]);
    }
    text += '\n';
  }
  const std::string owner =
      std::regex_replace(automaton.name, std::regex("_btn[0-9]+"), "");
  return rows(shortened(text, owner));
}

// The automaton of the node or timer called so, numbers left out.
inline const Automaton& automaton_called(const Network& network,
                                         std::string_view name) {
  const Automaton* found = nullptr;
  for (const Automaton& automaton : network.automata) {
    if (std::regex_replace(automaton.name, std::regex("_btn[0-9]+"), "") ==
        name) {
      found = &automaton;
    }
  }
  INFO(name);
  REQUIRE(found != nullptr);
  return *found;
}

// The edges of one automaton of a tree's network.
inline std::string table_of(std::string_view text, std::string_view name,
                            TickSemantics ticks = TickSemantics::Root) {
  const BehaviorTree tree = tree_of(text);
  const Network network = lower(tree, ticks);
  return edges_text(network, automaton_called(network, name));
}

// The frame of a node (section 3), and that of one that never runs.
inline constexpr std::string_view kFrame = R"(
  start_ -> halt [caller ~= None and rstatus = halt_me]
  start_ -> tick_node [caller ~= None and rstatus ~= halt_me]
    + rstatus := no_ret_status
  success -> done rstatus := success
  failure -> done rstatus := failure
  running -> done rstatus := running
  halted -> done rstatus := failure
  done -> start_ caller := None
)";
inline constexpr std::string_view kShortFrame = R"(
  start_ -> tick_node [caller ~= None] rstatus := no_ret_status
  success -> done rstatus := success
  failure -> done rstatus := failure
  done -> start_ caller := None
)";

// A frame without the answers that nothing in the body leads to.
inline std::string used_part(std::string frame, const std::string& body) {
  for (const std::string word : {"success", "failure", "running"}) {
    if (body.find("-> " + word) != std::string::npos) continue;
    const std::size_t row = frame.find(word + " -> done");
    if (row == std::string::npos) continue;
    frame.erase(row, frame.find('\n', row) - row);
  }
  return frame;
}

// The frame, and what a node adds to it.
inline std::string framed(const std::string& body) {
  return rows(used_part(std::string(kFrame), body) + body);
}
inline std::string short_framed(const std::string& body) {
  return rows(used_part(std::string(kShortFrame), body) + body);
}

// `a -> a_done a.caller := n` for each child of n.
inline std::string calls(const std::vector<std::string>& children) {
  std::string text;
  for (const std::string& child : children) {
    text += child + " -> " + child + "_done " + child + ".caller := n\n";
  }
  return text;
}

// The halting of running children, left to right (section 3): at `from` until
// none runs, then on to `then`.
inline std::string halts(const std::vector<std::string>& children,
                         const std::string& from, const std::string& then,
                         const std::string& updates = "",
                         bool several_run = true) {
  std::string text;
  std::string quiet;  // none of those to the left runs
  std::string back;
  for (const std::string& child : children) {
    text += from + " -> " + from + "_wait [" + (several_run ? quiet : "") +
            child + ".rstatus = running] " + child + ".rstatus := halt_me, " +
            child + ".caller := n\n";
    quiet += child + ".rstatus ~= running and ";
    back += (back.empty() ? "" : " and ") + child + ".caller = None";
  }
  text += from + "_wait -> " + from + " [" + back + "]\n";
  quiet.resize(quiet.size() - std::string_view(" and ").size());
  return text + from + " -> " + then + " [" + quiet + "]" +
         (updates.empty() ? "" : " " + updates) + "\n";
}

// `n` over the actions a, b, … in a tree called t.
inline std::string over(const std::string& node, std::size_t children) {
  std::string text = "(BehaviorTree :name t (" + node + " :name n";
  for (std::size_t i = 0; i < children; ++i) {
    text += std::string(" (Action :name ") + static_cast<char>('a' + i) + ")";
  }
  return text + "))";
}

}  // namespace btcheck
