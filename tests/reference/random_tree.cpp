// SPDX-License-Identifier: MIT
//
// Small random trees as .btf text, and the smallest one that still fails.
//
// A random tree is made as nested lists of words and only then printed, so
// that the reader of .btf files is exercised with it. Half of what goes wrong
// in a behavior tree goes wrong when something is halted; therefore most
// trees get, below the root, a node that halts: a reactive node whose first
// child is a leaf that may decide, beside children that run, or a Parallel
// or PipelineSequence over such children. How many leaves may run, and how
// many Parallels there are, is limited, since these multiply the states.
//
// Shrinking is delta debugging on the lists (Zeller, Hildebrandt 2002, with
// chunks of one or two): elements are dropped, lists are replaced by one of
// their elements and numbers made smaller as long as the text still fails.
// What no longer is a tree does not fail, so no step needs to know a grammar.
#include "reference/random_tree.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <initializer_list>
#include <optional>
#include <set>
#include <utility>

namespace btcheck::reference {

std::uint64_t SplitMix64::next() {
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

int SplitMix64::below(int bound) {
  return static_cast<int>(next() % static_cast<std::uint64_t>(bound));
}

namespace {

SExpression word(std::string text) {
  SExpression result;
  result.word = std::move(text);
  return result;
}
SExpression number(int value) { return word(std::to_string(value)); }
SExpression list(std::vector<SExpression> elements) {
  SExpression result;
  result.list = std::move(elements);
  result.is_list = true;
  return result;
}
void append(SExpression& to, std::initializer_list<SExpression> elements) {
  to.list.insert(to.list.end(), elements);
}

// --- Generating ----------------------------------------------------------

struct Variable {
  std::string name;
  std::vector<std::string> states;  // empty for a number
  int max = 0;                      // of a number
  bool free = false;                // then no node writes it
};

class Generator {
 public:
  Generator(std::uint64_t seed, const RandomTreeWeights& weights)
      : random_(seed), weights_(weights) {}

  SExpression file() {
    std::vector<SExpression> forms;
    const int variables = random_.below(weights_.max_variables + 1);
    for (int i = 0; i < variables; ++i) forms.push_back(state_variable(i));
    const int spread = weights_.max_nodes - weights_.min_nodes + 1;
    const int one = random_.below(spread);
    const int nodes = weights_.min_nodes + std::max(one, random_.below(spread));
    SExpression root = list({word("BehaviorTree"), word(":name"), word("t")});
    if (random_.percent(weights_.looping_root))
      append(root, {word(":loop"), number(1)});
    root.list.push_back(nodes - 1 >= 3 && random_.percent(weights_.halting_top)
                            ? halting_node(nodes - 1, weights_.max_depth)
                            : node(nodes - 1, weights_.max_depth));
    forms.insert(forms.end(), contracts_.begin(), contracts_.end());
    forms.push_back(std::move(root));
    return list(std::move(forms));
  }

 private:
  template <class T, std::size_t n>
  const T& one_of(const std::array<T, n>& choices) {
    return choices[static_cast<std::size_t>(
        random_.below(static_cast<int>(n)))];
  }
  template <class T>
  const T& one_of(const std::vector<T>& choices) {
    return choices[static_cast<std::size_t>(
        random_.below(static_cast<int>(choices.size())))];
  }

  SExpression state_variable(int i) {
    Variable variable;
    variable.name = i == 0 ? "x" : "y";
    SExpression form = list({word("defsv"), word(variable.name)});
    if (random_.percent(weights_.number)) {
      variable.max = 1 + random_.below(weights_.most_number);
      append(form,
             {word(":init"), number(random_.below(variable.max + 1)),
              word(":min"), number(0), word(":max"), number(variable.max)});
      if (weights_.moving_number > 0 &&
          random_.percent(weights_.moving_number)) {
        append(form, {word(":moves"), word("free")});
      }
    } else {
      const int count = 2 + random_.below(2);
      for (int s = 0; s < count; ++s)
        variable.states.push_back(variable.name + std::to_string(s));
      enumerate(form, variable);
    }
    variables_.push_back(std::move(variable));
    return form;
  }

  void enumerate(SExpression& form, Variable& variable) {
    SExpression states = list({});
    for (const std::string& state : variable.states)
      states.list.push_back(word(state));
    append(form, {word(":states"), std::move(states), word(":init"),
                  word(one_of(variable.states)), word(":transitions"),
                  random_.percent(50) ? word(":all") : cycle(variable)});
    variable.free = !random_.percent(weights_.sampled);
    if (variable.free && weights_.timed_moves > 0 &&
        random_.percent(weights_.timed_moves))
      form.list.back() = timed(variable);
    if (variable.free ? random_.percent(50) : random_.percent(80))
      append(form, {word(":moves"), word(variable.free ? "free" : "sampled")});
  }

  // Each state to the next, and sometimes the last to the first.
  SExpression cycle(const Variable& variable) {
    SExpression pairs = list({});
    for (std::size_t i = 0; i + 1 < variable.states.size(); ++i)
      append(pairs,
             {list({word(variable.states[i]), word(variable.states[i + 1])})});
    if (random_.percent(50))
      append(pairs, {list({word(variable.states.back()),
                           word(variable.states.front())})});
    return pairs;
  }

  // Times that leave no transition behind the first that is forced; sometimes
  // a state without an end.
  SExpression timed(const Variable& variable) {
    SExpression moves = list({});
    for (const std::string& from : variable.states) {
      const int latest = 1 + random_.below(3);
      for (const std::string& to : variable.states) {
        if (from == to || random_.percent(25)) continue;
        const int least = random_.below(latest + 1);
        const bool is_endless = random_.percent(25);
        append(
            moves,
            {list({word(from), word(to),
                   is_endless ? word("[" + std::to_string(least) + ",inf]")
                              : duration(least, latest + random_.below(2))})});
      }
    }
    return moves;
  }

  // A subtree of at most `budget` nodes.
  SExpression node(int budget, int depth) {
    if (budget <= 1 || depth == 0) return leaf(false);
    if (budget == 2 || random_.percent(35)) return decorator(budget, depth);
    if (random_.percent(35)) return halting_node(budget, depth);
    static const std::array<std::string, 7> kTypes = {
        "Sequence",           "Sequence",   "Fallback", "Fallback",
        "SequenceWithMemory", "RoundRobin", "Recovery"};
    const std::string type = one_of(kTypes);
    SExpression result = control(type);
    if (type == "Recovery") {
      append(result, {word(":num_retries"), number(random_.below(3))});
      add_children(result, 2, budget - 1, depth);
    } else {
      add_children(result, child_count(budget), budget - 1, depth);
    }
    return result;
  }

  // Most types want two or three children; one is worth a try, too.
  int child_count(int budget) {
    if (random_.percent(8)) return 1;
    return std::min(budget - 1, 2 + random_.below(2));
  }

  SExpression decorator(int budget, int depth) {
    static const std::array<std::string, 8> kTypes = {
        "Inverter",       "ForceSuccess",
        "ForceFailure",   "KeepRunningUntilFailure",
        "Repeat",         "RetryUntilSuccessful",
        "RateController", "Timeout"};
    const std::string type = one_of(kTypes);
    SExpression result = control(type);
    if (type == "Repeat") {
      append(result, {word(":repeat"), number(1 + random_.below(3))});
    } else if (type == "RetryUntilSuccessful") {
      append(result, {word(":num_attempts"), number(1 + random_.below(3))});
    } else if (type == "Timeout") {
      // Not an interval: scripts of results do not say when the time is up.
      append(result, {word(":duration"), number(1 + random_.below(3))});
    } else if (type == "RateController") {
      static const std::array<std::string, 5> kRates = {"10", "5", "4", "20",
                                                        "3.5"};
      if (random_.percent(80))
        append(result, {word(":hz"), word(one_of(kRates))});
      else
        append(result,
               {word(":args"), list({word("hz"), word(one_of(kRates))})});
    }
    add_children(result, 1, budget - 1, depth);
    return result;
  }

  // A node that halts, over children of which some may run for long.
  SExpression halting_node(int budget, int depth) {
    static const std::array<std::string, 6> kTypes = {
        "ReactiveSequence", "ReactiveFallback", "ReactiveSequence",
        "ReactiveFallback", "PipelineSequence", "Parallel"};
    std::string type = one_of(kTypes);
    if (type == "Parallel" && parallels_ >= weights_.max_parallels)
      type = "PipelineSequence";
    const int children =
        type == "Parallel" ? std::min(2, budget - 1) : child_count(budget);
    if (type == "Parallel" && random_.percent(35)) type = "ParallelAll";
    SExpression result = control(type);
    if (type != "PipelineSequence") add_halt_and_wait(result);
    if (type == "Parallel")
      append(result, {word(":success"), number(1 + random_.below(children))});
    if (type.starts_with("Parallel")) ++parallels_;
    const bool reactive = type.starts_with("Reactive");
    ++halting_;
    if (reactive && children > 1 && random_.percent(weights_.guard_first)) {
      result.list.push_back(leaf(true));
      add_children(result, children - 1, budget - 2, depth);
    } else {
      add_children(result, children, budget - 1, depth);
    }
    --halting_;
    return result;
  }

  void add_halt_and_wait(SExpression& to) {
    if (random_.percent(weights_.halt_option))
      append(to, {word(":halt"), number(1)});
    else if (random_.percent(20))
      append(to, {word(":halt"), number(0)});
    if (random_.percent(weights_.wait_option))
      append(to, {word(":wait"), number(1)});
  }

  SExpression control(const std::string& type) {
    SExpression result = list({word(type)});
    if (random_.percent(50))
      append(result, {word(":name"), word("c" + std::to_string(++controls_))});
    return result;
  }

  // The budget is dealt out one node at a time.
  void add_children(SExpression& to, int count, int budget, int depth) {
    std::vector<int> shares(static_cast<std::size_t>(count), 1);
    for (int left = budget - count; left > 0; --left)
      ++shares[static_cast<std::size_t>(random_.below(count))];
    for (const int share : shares) to.list.push_back(node(share, depth - 1));
  }

  SExpression leaf(bool decides) {
    if (weights_.computed > 0 && !decides && random_.percent(30))
      return set_sv();
    const int kind = random_.below(100);
    if (decides && kind < 60)
      return kind < 35 || variables_.empty() ? condition() : test();
    if (halting_ > 0 && random_.percent(weights_.runs_below))
      return random_.percent(70) ? action() : wait();
    if (kind < 50) return action();
    if (kind < 60) return condition();
    if (kind < 68) return wait();
    if (kind < 78) return set_sv();
    if (kind < 90) return assignment();
    return test();
  }

  std::string new_leaf() {
    const std::string name = "a" + std::to_string(++leaves_);
    names_.push_back(name);
    return name;
  }

  SExpression action() {
    const std::string name = new_leaf();
    SExpression result = list({word("Action"), word(":ID"), word(name)});
    if (running_ >= weights_.max_running || random_.percent(20)) {
      append(result, {word(":SF")});
      add_contract("defaction", name, Runs::Never);
      return result;
    }
    ++running_;
    if (!random_.percent(weights_.duration)) {
      add_contract("defaction", name, Runs::Maybe);
      return result;
    }
    const int min = 1 + random_.below(2);
    const SExpression window = random_.percent(15)
                                   ? word("[" + std::to_string(min) + ",inf]")
                                   : duration(min, min + random_.below(2));
    if (random_.percent(60)) {
      append(result, {word(":duration"), window});
      add_contract("defaction", name, Runs::Always);
    } else {
      contracts_.push_back(
          list({word("defaction"), word(name), word(":duration"), window}));
    }
    return result;
  }

  static SExpression duration(int min, int max) {
    return word("[" + std::to_string(min) + "," + std::to_string(max) + "]");
  }

  SExpression condition() {
    const std::string name = new_leaf();
    add_contract("defcondition", name, Runs::Never);
    return list({word("Condition"), word(":ID"), word(name)});
  }

  // Whether `running` stands among what the leaf returns.
  enum class Runs : unsigned char { Never, Maybe, Always };

  void add_contract(const std::string& kind, const std::string& name,
                    Runs runs) {
    if (!random_.percent(weights_.contract)) return;
    SExpression form = list({word(kind), word(name)});
    if (random_.percent(40)) {
      SExpression returns = list({word("success")});
      if (runs == Runs::Always || (runs == Runs::Maybe && random_.percent(70)))
        append(returns, {word("running")});
      if (random_.percent(30)) append(returns, {word("failure")});
      append(form, {word(":returns"), std::move(returns)});
    }
    if (!variables_.empty() && random_.percent(50))
      append(form, {word(":requires"), truth(1)});
    if (weights_.decided > 0 && !variables_.empty() &&
        random_.percent(weights_.decided)) {
      append(form, {word(":succeeds-when"), truth(1)});
    }
    for (const char* key : {":on-success", ":on-failure"})
      if (random_.percent(35))
        if (std::optional<SExpression> effect = assign())
          append(form, {word(key), list({*effect})});
    if (form.list.size() > 2) contracts_.push_back(std::move(form));
  }

  SExpression wait() {
    if (running_ >= weights_.max_running) return action();
    ++running_;
    return list(
        {word("Wait"), word(":duration"), number(1 + random_.below(3))});
  }

  SExpression set_sv() {
    if (weights_.computed > 0 && !variables_.empty()) {
      const Variable& any = one_of(variables_);
      if (!any.free) return list({word("SetSV"), word(":sv"), word(any.name)});
    }
    for (const Variable& variable : variables_)
      if (!variable.states.empty() && !variable.free)
        return list({word("SetSV"), word(":sv"), word(variable.name)});
    return condition();
  }

  SExpression assignment() {
    if (std::optional<SExpression> form = assign())
      return list({word("Eval"), *form});
    return action();
  }

  SExpression test() { return list({word("Eval"), truth(2)}); }

  // An assignment to a variable that nodes may write, if there is one.
  std::optional<SExpression> assign() {
    std::vector<const Variable*> writable;
    for (const Variable& variable : variables_)
      if (!variable.free) writable.push_back(&variable);
    if (writable.empty()) return std::nullopt;
    const Variable& variable = *one_of(writable);
    SExpression value = !variable.states.empty() ? word(one_of(variable.states))
                        : random_.percent(50)
                            ? number(random_.below(variable.max + 1))
                            : advanced(variable);
    return list({word(":="), word(variable.name), std::move(value)});
  }

  // One more, around the corner at the end of the range; or not around it.
  SExpression advanced(const Variable& variable) {
    if (is_computed()) return computed();
    SExpression sum = list({word("+"), number(1), word(variable.name)});
    if (random_.percent(weights_.leaving_range)) return sum;
    return list({word("mod"), std::move(sum), number(variable.max + 1)});
  }

  SExpression truth(int depth) {
    if (depth > 0 && random_.percent(25)) {
      SExpression left = truth(depth - 1);
      if (random_.percent(40)) return list({word("~"), std::move(left)});
      const char* joined = random_.percent(50) ? "and" : "or";
      return list({word(joined), std::move(left), truth(depth - 1)});
    }
    if (variables_.empty() || (!names_.empty() && random_.percent(15)))
      return status_test();
    return comparison(one_of(variables_));
  }

  // Of all kinds of expressions over numbers one is made where this is so; the
  // weight 0 draws nothing.
  bool is_computed() {
    return weights_.computed > 0 && !variables_.empty() &&
           random_.percent(weights_.computed);
  }

  // Over one number, sometimes over two.
  SExpression computed() {
    std::vector<const Variable*> numbers;
    for (const Variable& variable : variables_)
      if (variable.states.empty()) numbers.push_back(&variable);
    if (numbers.empty()) return number(1);
    const Variable& of = *one_of(numbers);
    const auto binary = [&](const char* sign, SExpression left,
                            SExpression right) {
      return list({word(sign), std::move(left), std::move(right)});
    };
    const SExpression name = word(of.name);
    if (numbers.size() > 1 && random_.percent(25))
      return binary("-", word(numbers[0]->name), word(numbers[1]->name));
    switch (random_.below(9)) {
      case 0:
        return name;
      case 1:
        return binary("-", name, number(1));
      case 2:
        return binary("/", name, number(2 + random_.below(2)));
      case 3:
        return binary("mod", name, number(1 + random_.below(3)));
      case 4:
        return binary("-", number(of.max), name);
      case 5:
        return binary("/", number(of.max), name);
      case 6:
        return binary("-", binary("*", name, name), number(of.max));
      case 7:
        return binary("mod", binary("+", number(1), name), number(of.max + 1));
      default:
        return binary("+", name, number(1));
    }
  }

  SExpression comparison(const Variable& variable) {
    SExpression name = word((random_.percent(20) ? "$" : "") + variable.name);
    if (!variable.states.empty())
      return list({word(random_.percent(75) ? "=" : "~="), std::move(name),
                   word(one_of(variable.states))});
    static const std::array<std::string, 6> kOperators = {"=",  "~=", "<",
                                                          "<=", ">",  ">="};
    if (is_computed()) name = computed();
    return list({word(one_of(kOperators)), std::move(name),
                 number(random_.below(variable.max + 1))});
  }

  // Of a leaf further to the left; there may be none.
  SExpression status_test() {
    if (names_.empty()) return list({word("="), number(1), number(1)});
    static const std::array<std::string, 3> kWords = {"success", "failure",
                                                      "running"};
    return list(
        {word("="), word(one_of(names_) + ".rstatus"), word(one_of(kWords))});
  }

  SplitMix64 random_;
  const RandomTreeWeights& weights_;
  std::vector<Variable> variables_;
  std::vector<SExpression> contracts_;
  std::vector<std::string> names_;  // of leaves, in pre-order
  int leaves_ = 0;
  int controls_ = 0;
  int running_ = 0;
  int parallels_ = 0;
  int halting_ = 0;  // how many nodes above may halt what is made now
};

// --- Reading and printing ------------------------------------------------

bool is_blank(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

// A form that gets a line of its own: a definition or a node.
bool stands_alone(const SExpression& form) {
  static const std::set<std::string, std::less<>> kHeads = {
      "BehaviorTree",
      "Sequence",
      "Fallback",
      "SequenceWithMemory",
      "ReactiveSequence",
      "ReactiveFallback",
      "Parallel",
      "ParallelAll",
      "Inverter",
      "ForceSuccess",
      "ForceFailure",
      "KeepRunningUntilFailure",
      "Repeat",
      "RetryUntilSuccessful",
      "RateController",
      "Timeout",
      "Recovery",
      "RoundRobin",
      "PipelineSequence",
      "SubTree",
      "Action",
      "Condition",
      "SetSV",
      "Eval",
      "Wait",
      "Trees",
      "defsv",
      "defaction",
      "defcondition"};
  return form.is_list && !form.list.empty() &&
         kHeads.contains(form.list[0].word);
}

void print(const SExpression& form, std::size_t depth, std::string& out) {
  if (!form.is_list) {
    out += form.word;
    return;
  }
  out += '(';
  bool first = true;
  for (const SExpression& element : form.list) {
    if (stands_alone(element) && !(first && depth == 0))
      out += '\n' + std::string(2 * depth + 1, ' ');
    else if (!first)
      out += ' ';
    print(element, depth + 1, out);
    first = false;
  }
  out += ')';
}

// --- Shrinking -----------------------------------------------------------

// Where a list is: the places to descend into from the outermost one.
using Path = std::vector<std::size_t>;

SExpression& at(SExpression& from, const Path& path) {
  SExpression* here = &from;
  for (const std::size_t place : path) here = &here->list[place];
  return *here;
}

void collect_paths(const SExpression& from, Path& here,
                   std::vector<Path>& paths) {
  paths.push_back(here);
  for (std::size_t i = 0; i < from.list.size(); ++i) {
    here.push_back(i);
    collect_paths(from.list[i], here, paths);
    here.pop_back();
  }
}

std::size_t size_of(const SExpression& form) {
  std::size_t size = 1;
  for (const SExpression& element : form.list) size += size_of(element);
  return size;
}

// Every smaller text one step away, large steps first.
std::vector<SExpression> smaller(const SExpression& whole) {
  std::vector<SExpression> results;
  const auto with = [&](const Path& path, const auto& change) {
    results.push_back(whole);
    change(at(results.back(), path));
  };
  std::vector<Path> paths;
  Path here;
  collect_paths(whole, here, paths);
  for (const Path& path : paths) {
    SExpression copy = whole;
    const SExpression& form = at(copy, path);
    const std::size_t count = form.list.size();
    for (std::size_t i = 0; i < count; ++i) {
      with(path, [&](SExpression& target) {
        SExpression only = target.list[i];
        target = std::move(only);
      });
      for (const std::size_t drop : {std::size_t{2}, std::size_t{1}})
        if (i + drop <= count)
          with(path, [&](SExpression& target) {
            const auto begin = target.list.begin() + static_cast<long>(i);
            target.list.erase(begin, begin + static_cast<long>(drop));
          });
    }
    int value = 0;
    const std::string& text = form.word;
    const char* end = text.data() + text.size();
    if (!text.empty() && std::from_chars(text.data(), end, value).ptr == end &&
        value > 0)
      with(path, [&](SExpression& target) {
        target.word = std::to_string(value - 1);
      });
  }
  std::ranges::stable_sort(results, {}, size_of);
  return results;
}

}  // namespace

std::string random_tree(std::uint64_t seed, const RandomTreeWeights& weights) {
  return print_s_expression(Generator(seed, weights).file());
}

SExpression parse_s_expression(std::string_view text) {
  std::vector<SExpression> open = {list({})};
  const auto close = [&open] {
    SExpression done = std::move(open.back());
    open.pop_back();
    open.back().list.push_back(std::move(done));
  };
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == ';') {
      i = std::min(text.find('\n', i), text.size());
    } else if (c == '(') {
      open.push_back(list({}));
      ++i;
    } else if (c == ')') {
      if (open.size() > 1) close();
      ++i;
    } else if (is_blank(c)) {
      ++i;
    } else {
      const std::size_t begin = i;
      while (i < text.size() && !is_blank(text[i]) && text[i] != '(' &&
             text[i] != ')' && text[i] != ';')
        ++i;
      open.back().list.push_back(
          word(std::string(text.substr(begin, i - begin))));
    }
  }
  while (open.size() > 1) close();
  std::vector<SExpression>& forms = open.front().list;
  return forms.size() == 1 ? std::move(forms.front()) : std::move(open.front());
}

std::string print_s_expression(const SExpression& expression) {
  std::string out;
  print(expression, 0, out);
  out += '\n';
  return out;
}

std::string shrink(const std::string& text,
                   const std::function<bool(const std::string&)>& fails) {
  SExpression smallest = parse_s_expression(text);
  std::string best = print_s_expression(smallest);
  std::set<std::string> tried = {best};
  if (!fails(best)) return text;  // it needs its comments or its layout
  for (bool progress = true; progress;) {
    progress = false;
    for (SExpression& candidate : smaller(smallest)) {
      std::string printed = print_s_expression(candidate);
      if (!tried.insert(printed).second || !fails(printed)) continue;
      smallest = std::move(candidate);
      best = std::move(printed);
      progress = true;
      break;
    }
  }
  return best;
}

}  // namespace btcheck::reference
