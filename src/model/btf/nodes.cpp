// SPDX-License-Identifier: MIT
//
// Which keyword belongs to which node types stands in one table. What a node
// says about others (the names in an Eval, the tree of a SubTree) is left for
// later passes, because it may stand further down in the file. A node with a
// mistake in it stays in the tree, so that its children are checked as well.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "model/btf/trees.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"
#include "text/numbers.hpp"

namespace btcheck::btf {
namespace {

constexpr int kMostRounds = 1'000'000;

constexpr std::uint64_t bit(NodeType type) {
  return std::uint64_t{1} << static_cast<unsigned>(type);
}

constexpr std::uint64_t any_of(std::initializer_list<NodeType> types) {
  std::uint64_t set = 0;
  for (const NodeType type : types) set |= bit(type);
  return set;
}

static_assert(kNodeTypeCount <= 64);
constexpr std::uint64_t kHalting =
    any_of({NodeType::ReactiveSequence, NodeType::ReactiveFallback,
            NodeType::Parallel, NodeType::ParallelAll});

constexpr std::array<KeywordRule, 15> kKeywords = {{
    {"name"},
    {"ID"},
    {"loop", Takes::Word, bit(NodeType::BehaviorTree)},
    {"halt", Takes::Word, kHalting},
    {"wait", Takes::Word, kHalting},
    {"success", Takes::Word, bit(NodeType::Parallel)},
    {"repeat", Takes::Word, bit(NodeType::Repeat)},
    {"num_attempts", Takes::Word, bit(NodeType::RetryUntilSuccessful)},
    {"num_retries", Takes::Word, bit(NodeType::Recovery)},
    {"retry", Takes::Word, bit(NodeType::Recovery)},
    {"hz", Takes::Word, bit(NodeType::RateController)},
    {"SF", Takes::Flag, bit(NodeType::Action)},
    {"sv", Takes::Word, bit(NodeType::SetSV)},
    {"duration", Takes::List,
     any_of({NodeType::Action, NodeType::Wait, NodeType::Timeout}),
     any_of({NodeType::Wait, NodeType::Timeout})},
    {"args", Takes::List,
     any_of({NodeType::Action, NodeType::Condition, NodeType::SetSV,
             NodeType::Wait, NodeType::RateController, NodeType::SubTree})},
}};

// A number that a type needs: its keyword, perhaps with another spelling.
struct CountRule {
  NodeType type;
  int Node::*into;
  int least;
  std::string_view name;
  std::string_view other = {};
};
constexpr std::array<CountRule, 4> kCounts = {{
    {NodeType::Parallel, &Node::threshold, 1, "success"},
    {NodeType::Repeat, &Node::repetitions, 1, "repeat"},
    {NodeType::RetryUntilSuccessful, &Node::repetitions, 1, "num_attempts"},
    {NodeType::Recovery, &Node::repetitions, 0, "num_retries", "retry"},
}};

std::string children(int count) {
  return fmt::format("{} child{}", count, count == 1 ? "" : "ren");
}

// What to say to an unknown node type.
std::string node_type_advice(std::string_view word) {
  constexpr std::array<std::array<std::string_view, 2>, 9> kElsewhere = {
      {{"Selector", "Fallback"},
       {"Priority", "Fallback"},
       {"SequenceStar", "SequenceWithMemory"},
       {"RecoveryNode", "Recovery"},
       {"Retry", "RetryUntilSuccessful"},
       {"Delay", "Wait"},
       {"Sleep", "Wait"},
       {"Not", "Inverter"},
       {"SubTreePlus", "SubTree"}}};
  for (const auto& [foreign, ours] : kElsewhere) {
    if (equal_ignoring_case(word, foreign)) {
      return fmt::format("here it is called `{}`", ours);
    }
  }
  std::vector<std::string> names;
  for (const NodeTypeInfo& info : btf_node_types()) {
    names.emplace_back(info.name);
  }
  return did_you_mean(word, names,
                      fmt::format("an action is `(Action :ID {})`", word));
}

// Ticks per second; nothing after an error.
std::optional<double> read_rate(const Reading& reading, FormId value) {
  constexpr double kSlowest = 1e-5;
  constexpr double kFastest = 1e6;
  const Form& form = reading.form(value);
  const auto rate =
      form.is_word() ? as_number<double>(form.text) : std::nullopt;
  if (rate && *rate >= kSlowest && *rate <= kFastest) return rate;
  reading.error(form.span, "BT1008", "this is not a rate",
                "ticks per second from 0.00001 to 1000000 are needed");
  return std::nullopt;
}

// What a RateController of that rate waits for: ticks of the root, rounded, at
// least one.
Duration rate_period(double hz, int tick_ms) {
  const double ticks_per_second = 1000.0 / tick_ms;
  const int ticks =
      std::max(1, static_cast<int>(std::lround(ticks_per_second / hz)));
  return {ticks, ticks};
}

// One form of the tree: reads its keywords into a draft.
class NodeReader {
 public:
  NodeReader(const Reading& reading, const Variables& variables, FormId form)
      : reading_(reading),
        variables_(variables),
        clauses_(reading, form, kKeywords) {
    draft_.form = form;
    draft_.node.span = reading.forms.head(form)->span;
  }

  // The forms of the children are appended to `children`.
  NodeDraft read(std::vector<FormId>& children) {
    const bool is_known = read_type();
    if (is_known) check_keywords();
    read_names();
    read_children(children);
    if (is_known) {
      check_child_count(static_cast<int>(children.size()));
      read_keywords(static_cast<int>(children.size()));
    }
    count_words(children);
    return std::move(draft_);
  }

 private:
  Node& node() { return draft_.node; }

  // An unknown type is read on as a Sequence, for its children.
  bool read_type() {
    const Form& head = *reading_.forms.head(draft_.form);
    const auto type = find_node_type(head.text);
    node().type = type.value_or(NodeType::Sequence);
    if (type) {
      reading_.findings.case_warning(head.span, head.text, type_name(*type));
      node().contract.may_run = *type != NodeType::Condition;
      return true;
    }
    reading_.error(head.span, "BT1004",
                   fmt::format("unknown node type `{}`", head.text), "",
                   node_type_advice(head.text));
    return false;
  }

  // Reports keywords of other node types, which are left out, and of none.
  void check_keywords() {
    std::erase_if(clauses_.all, [&](const Clause& clause) {
      const KeywordRule* rule = clauses_.rule_of(clause);
      if (!rule || (rule->types & bit(node().type))) return false;
      report_misplaced(reading_.form(clause.keyword), rule->types);
      return true;
    });
    std::vector<KeywordRule> rules;
    for (const KeywordRule& rule : kKeywords) {
      if (rule.types & bit(node().type)) rules.push_back(rule);
    }
    has_unknown_ = clauses_.report_unknown(rules, type_name(node().type));
  }

  void report_misplaced(const Form& keyword, std::uint64_t types) {
    std::vector<std::string> takers;
    for (const NodeTypeInfo& info : btf_node_types()) {
      if (types & bit(info.type)) takers.emplace_back(info.name);
    }
    reading_.error(keyword.span, "BT1005",
                   fmt::format("`{}` does not belong to {}", keyword.text,
                               type_name(node().type)),
                   "", fmt::format("it is a keyword of {}", listed(takers)));
  }

  void read_names() {
    draft_.reference = node().span;
    std::string name = read_name_after("name");
    node().id = read_name_after("ID");
    if (name.empty()) name = node().id;
    if (name.empty()) {
      name = fmt::format("{}{}", type_name(node().type), node().span.line);
    }
    node().name = std::move(name);
  }

  // The name after a keyword, "" when there is none. A SubTree refers to the
  // one that is read last.
  std::string read_name_after(std::string_view keyword) {
    const Clause* clause = clauses_.find(keyword);
    if (!clause) return "";
    draft_.reference = clauses_.value(*clause).span;
    return clauses_.name(*clause).value_or("");
  }

  void read_children(std::vector<FormId>& children) {
    if (node().type == NodeType::Eval) {
      read_expression();
      return;
    }
    for (const FormId item : clauses_.items) {
      if (reading_.forms.head(item)) {
        children.push_back(item);
      } else {
        report_stray(reading_.form(item));
      }
    }
  }

  void report_stray(const Form& form) {
    has_unknown_ = true;
    reading_.error(
        form.span, "BT1003",
        form.is_list() ? std::string("a list without a node type")
                       : fmt::format("`{}` belongs to no keyword", form.text),
        "a child or a keyword is needed here",
        "write a child as `(Type ...)`, an option as `:keyword value`");
  }

  void read_expression() {
    const std::size_t count = clauses_.items.size();
    if (count == 1) {
      draft_.expression = clauses_.items.front();
    } else if (!has_unknown_) {
      reading_.error(
          node().span, "BT1009",
          fmt::format("Eval takes 1 expression, not {}", count), "",
          "join conditions with `(and ...)`; give each `:=` an Eval");
    }
  }

  void check_child_count(int count) {
    const NodeTypeInfo& info = info_of(node().type);
    const bool is_reference = info.type == NodeType::SubTree;
    const int least = is_reference ? 0 : info.min_children;
    const int most = is_reference ? 0 : info.max_children;
    if (has_unknown_ || (count >= least && count <= most)) return;
    const std::string wanted =
        most == 0 ? "no children"
                  : (most == kAnyNumber ? "at least " : "") + children(least);
    reading_.error(
        node().span, "BT1009",
        fmt::format("{} takes {}, not {}", info.name, wanted, count), "",
        is_reference ? "what it contains stands in its BehaviorTree" : "");
  }

  void read_keywords(int child_count) {
    read_arguments_and_rate();
    node().loop = clauses_.flag("loop");
    node().halt = clauses_.flag("halt");
    node().wait = clauses_.flag("wait");
    if (clauses_.flag("SF")) node().contract.may_run = false;
    read_duration();
    const NodeType type = node().type;
    for (const KeywordRule& rule : kKeywords) {
      const bool is_needed = (rule.needed_by & bit(type)) != 0;
      if (is_needed && !clauses_.find(rule.name)) {
        report_missing(fmt::format(":{}", rule.name));
      }
    }
    for (const CountRule& rule : kCounts) {
      const bool is_of_children = type == NodeType::Parallel;
      const int most = is_of_children ? std::max(child_count, 1) : kMostRounds;
      if (rule.type == type) node().*rule.into = read_count(rule, most);
    }
    if (type == NodeType::ParallelAll) node().threshold = child_count;
    if (type == NodeType::SetSV) read_variable();
    const bool is_named = clauses_.find("ID") || clauses_.find("name");
    if (type == NodeType::SubTree && !is_named) report_missing(":ID");
  }

  int read_count(const CountRule& rule, int most) {
    const Clause* found = nullptr;
    for (const std::string_view name : {rule.name, rule.other}) {
      const Clause* clause = name.empty() ? nullptr : clauses_.find(name);
      if (found && clause) {
        reading_.error(
            reading_.form(clause->keyword).span, "BT1006",
            "the number is given twice",
            fmt::format("`{}` is given already", clauses_.text(*found)),
            "delete one of them");
      }
      if (!found) found = clause;
    }
    if (!found) report_missing(fmt::format(":{}", rule.name));
    return found
               ? clauses_.integer(*found, rule.least, most).value_or(rule.least)
               : rule.least;
  }

  void read_duration() {
    if (const Clause* clause = clauses_.find("duration")) {
      node().duration = clauses_.duration(*clause);
      refuse_no_time(clauses_.value(*clause));
    }
  }

  void refuse_no_time(const Form& value) {
    if (node().type != NodeType::Timeout || !node().duration ||
        node().duration->min > 0)
      return;
    reading_.error(value.span, "BT1008", "a Timeout of no ticks",
                   "its child is ticked at least once",
                   "write 1 or more; without a limit, leave the Timeout out");
  }

  void read_arguments_and_rate() {
    const Clause* args = clauses_.find("args");
    if (args) {
      node().arguments = clauses_.arguments(*args);
      draft_.arguments = args->value;
    }
    if (node().type != NodeType::RateController) return;
    const Clause* hz = clauses_.find("hz");
    const auto rate = hz     ? hz->value
                      : args ? argument(clauses_.value(*args), "hz")
                             : std::nullopt;
    if (rate) {
      node().rate_hz = read_rate(reading_, *rate).value_or(1.0);
      node().duration = rate_period(node().rate_hz, reading_.tick_ms);
    } else {
      report_missing(":hz");
    }
  }

  std::optional<FormId> argument(const Form& args, std::string_view key) const {
    for (std::size_t at = 0; at + 1 < args.items.size(); at += 2) {
      if (equal_ignoring_case(reading_.form(args.items[at]).text, key)) {
        return args.items[at + 1];
      }
    }
    return std::nullopt;
  }

  void read_variable() {
    const Clause* clause = clauses_.find("sv");
    if (!clause) return report_missing(":sv");
    const Form& word = clauses_.value(*clause);
    const auto found = variables_.find(reading_, word);
    if (found) node().variable = *found;
  }

  void report_missing(std::string_view keyword) {
    // Without a value it is reported already.
    if (clauses_.is_given(keyword.substr(1))) return;
    const std::string_view type = type_name(node().type);
    reading_.error(node().span, "BT1006",
                   fmt::format("{} needs `{}`", type, keyword), "",
                   fmt::format("write `({} {} ...)`", type, keyword));
  }

  void count_words(const std::vector<FormId>& children) {
    const auto size = [&](FormId id) {
      return reading_.form(id).end_token - reading_.form(id).first_token;
    };
    draft_.words = size(draft_.form);
    for (const FormId child : children) draft_.words -= size(child);
  }

  const Reading& reading_;
  const Variables& variables_;
  Clauses clauses_;
  NodeDraft draft_;
  bool has_unknown_ = false;  // so that the number of items proves nothing
};

}  // namespace

std::span<const KeywordRule> node_keywords() { return kKeywords; }

std::optional<NodeType> find_node_type(std::string_view word) {
  for (const NodeTypeInfo& info : kNodeTypes) {
    const bool is_here = has(info.in, In::Btf);
    if (is_here && equal_ignoring_case(info.name, word)) return info.type;
  }
  return std::nullopt;
}

TreeDraft read_tree(const Reading& reading, const Variables& variables,
                    FormId form) {
  struct Work {
    FormId form;
    std::uint32_t parent;
  };
  TreeDraft tree;
  std::vector<Work> work = {{form, 0}};
  std::vector<FormId> children;
  while (!work.empty()) {
    const Work next = work.back();
    work.pop_back();
    const auto number = static_cast<std::uint32_t>(tree.size());
    if (number > 0) tree[next.parent].children.push_back(number);
    children.clear();
    ask_budget();
    tree.push_back(NodeReader(reading, variables, next.form).read(children));
    for (auto child = children.rbegin(); child != children.rend(); ++child) {
      work.push_back({*child, number});
    }
  }
  return tree;
}

}  // namespace btcheck::btf
