// SPDX-License-Identifier: MIT
//
// A line that is wrong is reported and left out. What a node may answer at all
// is read off its automaton; whether it may do so when asked turns out in the
// run.
#include "check/simulate/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "check/bind/node_names.hpp"
#include "model/tree/node_types.hpp"
#include "text/numbers.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostFindings = 20;

// Bytes [begin, end) of the text.
struct ScriptWord {
  std::size_t begin = 0;
  std::size_t end = 0;
};

// The nodes, or the variable, that a name stands for. All nodes take the same
// words.
struct Speaker {
  std::vector<NodeId> nodes;
  // Free, or what SetSV nodes write: words are its values. Else statuses.
  std::optional<StateVariableId> variable;
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// Which of the words it is, without regard to case.
template <class Words>
std::optional<int> place_in(const Words& words, std::string_view word) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (equal_ignoring_case(words[i], word)) return static_cast<int>(i);
  }
  return std::nullopt;
}

class Reader {
 public:
  Reader(const BehaviorTree& tree, const Network& network,
         const SourceText& source)
      : tree_(tree),
        network_(network),
        source_(source),
        text_(source.text()),
        names_(tree) {
    script_.of_node.resize(tree.nodes.size());
    script_.of_variable.resize(tree.variables.size());
  }

  Result<SimulationScript> read() {
    std::size_t begin = text_.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    while (begin < text_.size() && !is_full()) {
      const std::size_t end = std::min(text_.find('\n', begin), text_.size());
      read_line({begin, end});
      begin = end + 1;
    }
    if (!findings_.empty()) return {std::nullopt, std::move(findings_)};
    return {std::move(script_), {}};
  }

 private:
  // --- Words ---------------------------------------------------------------

  // Where the comment begins, or the line ends.
  std::size_t end_of_content(ScriptWord line) const {
    bool is_quoted = false;
    for (std::size_t i = line.begin; i < line.end; ++i) {
      if (text_[i] == '"') is_quoted = !is_quoted;
      const bool opens = i == line.begin || is_blank(text_[i - 1]);
      if (!is_quoted && opens && (text_[i] == '#' || text_[i] == ';')) return i;
    }
    return line.end;
  }

  // Takes the name and its colon off the front of the line.
  std::optional<ScriptWord> take_name(ScriptWord& line) {
    std::size_t at = line.begin;
    std::optional<ScriptWord> name;
    if (text_[at] == '"') {
      const std::size_t close = text_.find('"', at + 1);
      if (close >= line.end) {
        return report("BT1404", line, "this name is never closed",
                      "no second `\"` on the line", "close it with `\"`");
      }
      name = ScriptWord{at + 1, close};
      at = close + 1;
      while (at < line.end && is_blank(text_[at])) ++at;
      if (at >= line.end || text_[at] != ':') at = line.end;
    } else {
      at = std::min(text_.find(':', at), line.end);
      name = ScriptWord{line.begin, at};
      while (name->end > name->begin && is_blank(text_[name->end - 1])) {
        --name->end;
      }
    }
    if (at == line.end || name->begin == name->end) {
      return report("BT1404", line, "a line is a name, a colon and results",
                    at == line.end ? "no colon" : "no name",
                    "write for instance `land: running*3 success`");
    }
    line.begin = at + 1;
    return name;
  }

  std::vector<ScriptWord> words_in(ScriptWord rest) const {
    std::vector<ScriptWord> words;
    std::size_t at = rest.begin;
    while (true) {
      while (at < rest.end && is_blank(text_[at])) ++at;
      if (at >= rest.end) return words;
      const std::size_t begin = at;
      while (at < rest.end && !is_blank(text_[at])) ++at;
      words.push_back({begin, at});
    }
  }

  void read_line(ScriptWord line) {
    line.end = end_of_content(line);
    while (line.begin < line.end && is_blank(text_[line.begin])) ++line.begin;
    while (line.end > line.begin && is_blank(text_[line.end - 1])) --line.end;
    if (line.begin == line.end) return;
    const std::optional<ScriptWord> name = take_name(line);
    if (!name) return;
    const std::vector<ScriptWord> words = words_in(line);
    if (words.empty()) {
      report("BT1404", *name, "nothing stands after the colon", "no result",
             "write for instance `running*3 success`");
      return;
    }
    const std::string written(text_of(*name));
    const auto sequence = sequence_of(written, *name);
    if (sequence) read_results(*sequence, named_[written].speaker, words);
  }

  // The sequence of a name; a name that is a mistake is reported once.
  std::optional<std::size_t> sequence_of(const std::string& name,
                                         ScriptWord at) {
    const auto [found, is_new] = named_.try_emplace(name);
    if (!is_new) return found->second.sequence;
    auto speaker = speaker_called(name, at);
    if (!speaker) return std::nullopt;
    const std::size_t sequence = script_.sequences.size();
    if (!assign(sequence, *speaker, at)) return std::nullopt;
    script_.sequences.push_back({name, {}});
    found->second = {sequence, std::move(*speaker)};
    return sequence;
  }

  // The name that fits fewer nodes speaks for a node.
  bool assign(std::size_t sequence, const Speaker& speaker, ScriptWord at) {
    const auto known = [&](std::size_t other) -> const Named& {
      return named_.at(script_.sequences[other].name);
    };
    const auto refused = [&](std::size_t other) {
      report("BT1404", at,
             fmt::format("`{}` has its results as `{}`", text_of(at),
                         script_.sequences[other].name),
             "the same once more", "use one of the two names");
      return false;
    };
    if (speaker.nodes.empty()) {
      auto& own = script_.of_variable[index(*speaker.variable)];
      if (own) return refused(*own);
      own = sequence;
      return true;
    }
    for (const NodeId node : speaker.nodes) {
      auto& own = script_.of_node[index(node)];
      const std::size_t fitted = own ? known(*own).speaker.nodes.size() : 0;
      if (own && fitted == speaker.nodes.size()) return refused(*own);
      if (!own || fitted > speaker.nodes.size()) own = sequence;
    }
    return true;
  }

  // --- Names ---------------------------------------------------------------

  std::optional<StateVariableId> variable_called(std::string_view name) const {
    for (std::uint32_t v = 0; v < tree_.variables.size(); ++v) {
      if (equal_ignoring_case(tree_.variables[v].name, name)) {
        return StateVariableId{v};
      }
    }
    return std::nullopt;
  }

  std::optional<Speaker> speaker_called(const std::string& name,
                                        ScriptWord at) {
    const bool is_variable = name.starts_with('$');
    const auto variable = variable_called(is_variable ? name.substr(1) : name);
    std::vector<NodeId> nodes;
    if (!is_variable) nodes = names_.called(name);
    std::vector<NodeId> leaves;
    for (const NodeId node : nodes) {
      if (is_scripted(tree_.node(node).type)) leaves.push_back(node);
    }
    if (!leaves.empty()) return speaker_of(leaves, name, at);
    if (variable) return speaker_of(*variable, at);
    if (nodes.empty()) {
      return report("BT1401", at, fmt::format("unknown leaf `{}`", name),
                    "no node or variable has this name",
                    names_.nearest_help(name));
    }
    const NodeType type = tree_.node(nodes[0]).type;
    const std::string_view why =
        !is_leaf(type)           ? "answers by what its children answer"
        : type == NodeType::Eval ? "answers by its expression"
                                 : "answers when its time is up";
    return report(
        "BT1402", at, fmt::format("`{}` cannot be scripted", name),
        fmt::format("this {} {}", type_name(type), why),
        "write about actions, conditions, SetSV nodes and variables that move "
        "by themselves");
  }

  std::optional<Speaker> speaker_of(const std::vector<NodeId>& nodes,
                                    const std::string& name, ScriptWord at) {
    Speaker speaker{nodes, std::nullopt};
    const Node& first = tree_.node(nodes[0]);
    const bool measures = first.type == NodeType::SetSV;
    if (measures) speaker.variable = first.variable;
    for (const NodeId node : nodes) {
      const Node& other = tree_.node(node);
      if ((other.type == NodeType::SetSV) == measures &&
          (!measures || other.variable == first.variable)) {
        continue;
      }
      return report("BT1402", at,
                    fmt::format("`{}` names leaves of several kinds", name),
                    "which one is meant?",
                    fmt::format("write `{}@{}` or `{}@{}`", first.name,
                                first.span.line, other.name, other.span.line));
    }
    return speaker;
  }

  std::optional<Speaker> speaker_of(StateVariableId variable, ScriptWord at) {
    if (moves_freely(tree_, variable)) return Speaker{{}, variable};
    // One that is measured takes its values wherever that is done.
    for (const Node& node : tree_.nodes) {
      if (node.type == NodeType::SetSV && node.variable == variable) {
        return Speaker{{}, variable};
      }
    }
    return report(
        "BT1402", at,
        fmt::format("`{}` cannot be scripted", tree_.variable(variable).name),
        "only the tree changes it",
        "write about the leaves that change it, or leave it out");
  }

  // --- Results -------------------------------------------------------------

  void read_results(std::size_t number, const Speaker& speaker,
                    const std::vector<ScriptWord>& words) {
    std::vector<ScriptedResult>& results = script_.sequences[number].results;
    for (ScriptWord word : words) {
      if (is_full()) return;
      const ScriptWord whole = word;
      if (!results.empty() && results.back().times == kForEver) {
        report("BT1404", whole, "nothing comes after what is repeated for ever",
               "never reached", "write how often, for instance `running*3`");
        return;
      }
      const auto times = times_of(word);
      if (!times) return;
      const auto value = speaker.variable ? value_of(*speaker.variable, word)
                                          : status_of(speaker.nodes, word);
      if (!value) continue;
      results.push_back({*value, *times, whole.begin, whole.end});
    }
  }

  // Cuts `*3` or `*` off the end of a word.
  std::optional<std::uint32_t> times_of(ScriptWord& word) {
    const std::string_view text = text_of(word);
    const std::size_t star = text.rfind('*');
    if (star == std::string_view::npos) return 1;
    const std::string_view digits = text.substr(star + 1);
    const ScriptWord whole = word;
    word.end = word.begin + star;
    if (digits.empty()) return kForEver;
    const auto times = as_number<std::uint32_t>(digits);
    if (times && *times >= 1 && *times < kForEver) return times;
    return report("BT1404", whole,
                  fmt::format("`{}` is no number of times", digits), {},
                  "write `running*3`, or `running*` for ever");
  }

  // What the node can answer at all, in the order of its table.
  std::vector<std::string> answers_of(NodeId node) const {
    const Automaton& automaton = network_.automaton(node);
    std::vector<std::string> answers;
    for (const LocationRole answer :
         {LocationRole::Success, LocationRole::Failure, LocationRole::Running,
          LocationRole::Skipped}) {
      const auto location = automaton.find_location(answer);
      const auto is_reached = [&](const Edge& edge) {
        return edge.target == *location;
      };
      if (location && std::ranges::any_of(automaton.edges, is_reached)) {
        answers.push_back(automaton.locations[index(*location)].name);
      }
    }
    return answers;
  }

  std::optional<int> status_of(const std::vector<NodeId>& nodes,
                               ScriptWord word) {
    const std::string_view text = text_of(word);
    for (const NodeId node : nodes) {
      const std::vector<std::string> answers = answers_of(node);
      if (place_in(answers, text)) continue;
      return unknown(
          word, answers, fmt::format("answer of `{}`", short_name(tree_, node)),
          fmt::format("this {} answers {}", type_name(tree_.node(node).type),
                      alternatives(answers)));
    }
    return place_in(status_names(tree_.profile), text);
  }

  std::optional<int> value_of(StateVariableId id, ScriptWord word) {
    const StateVariable& variable = tree_.variable(id);
    if (const auto s = place_in(variable.states, text_of(word))) return s;
    const auto number = decimal_number(text_of(word));
    const auto value = number
                           ? bound_of(Operation::Equal, variable.scale, *number)
                           : std::nullopt;
    if (!variable.is_enumeration() && value && *value >= variable.min &&
        *value <= variable.max) {
      return static_cast<int>(*value);
    }
    return unknown(
        word, variable.states, fmt::format("value of `{}`", variable.name),
        variable.is_enumeration() ? "it can be " + alternatives(variable.states)
                                  : numbers_of(variable));
  }

  static std::string numbers_of(const StateVariable& variable) {
    const std::string range =
        fmt::format("a number from {} to {}", variable.value_name(variable.min),
                    variable.value_name(variable.max));
    return variable.scale.is_one() ? range
                                   : fmt::format("{} in steps of {}", range,
                                                 variable.scale.text(1));
  }

  std::nullopt_t unknown(ScriptWord word, const std::vector<std::string>& known,
                         const std::string& what, std::string label) {
    const auto near = closest_match(text_of(word), known);
    return report(
        "BT1403", word, fmt::format("`{}` is no {}", text_of(word), what),
        std::move(label), near ? fmt::format("did you mean `{}`?", *near) : "");
  }

  std::string_view text_of(ScriptWord word) const {
    return text_.substr(word.begin, word.end - word.begin);
  }
  bool is_full() const { return findings_.size() == kMostFindings; }
  // So that a function without a result can end with it.
  std::nullopt_t report(std::string_view code, ScriptWord at,
                        std::string message, std::string label = {},
                        std::string help = {}) {
    if (!is_full()) {
      findings_.push_back(source_.diagnostic(
          Severity::Error, code, source_.span(at.begin, at.end),
          std::move(message), std::move(label), std::move(help)));
    }
    return std::nullopt;
  }

  const BehaviorTree& tree_;
  const Network& network_;
  const SourceText& source_;
  std::string_view text_;
  NodeNames names_;
  SimulationScript script_;
  std::vector<Diagnostic> findings_;
  struct Named {
    std::optional<std::size_t> sequence;  // none: the name is a mistake
    Speaker speaker;
  };
  std::map<std::string, Named> named_;
};

}  // namespace

std::string alternatives(const std::vector<std::string>& words) {
  constexpr std::size_t kMostListed = 8;
  std::string text;
  for (std::size_t i = 0; i < words.size() && i < kMostListed; ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text + (words.size() > kMostListed ? ", …" : "");
}

Result<SimulationScript> read_simulation_script(const BehaviorTree& tree,
                                                const Network& network,
                                                std::string_view file_name,
                                                std::string_view text) {
  const SourceText source(file_name, text);
  if (auto refusal = source.refuse_binary()) {
    return {std::nullopt, {std::move(*refusal)}};
  }
  return Reader(tree, network, source).read();
}

}  // namespace btcheck
