// SPDX-License-Identifier: MIT
//
// Fiacre as src/model/export/fiacre/fiacre.cpp writes it, read and explored in
// discrete time.
//
// Of the language: interval types, constants, processes whose transitions are
// `on`, `wait` or a port, assignments and `to`, in `select`; one component with
// variables, ports with intervals and priorities; properties (read in
// fiacre_property.cpp), of which `always` and `absent` are evaluated. The
// meaning is that of "The syntax and semantics of Fiacre" (2012): a
// transition's clock starts when it becomes enabled, or its own process moves;
// time may not pass the end of the interval of an enabled transition; a port
// goes before those of lower priority when it could be taken. Nothing is known
// of networks.
#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

#include "reference/fiacre_property.hpp"
#include "reference/model_text.hpp"
#include "reference/read_model.hpp"

namespace btcheck::reference {
namespace {

using Code = ReadExpression::Code;
constexpr int kNoEnd = std::numeric_limits<int>::max();

const OperatorWords& fiacre_operators() {
  static const OperatorWords words{
      {{"and", Code::And},
       {"or", Code::Or},
       {"=", Code::Equal},
       {"<", Code::Less},
       {"<=", Code::LessEqual},
       {">", Code::Greater},
       {">=", Code::GreaterEqual},
       {"+", Code::Add},
       {"-", Code::Subtract},
       {"*", Code::Multiply},
       {"/", Code::Divide},
       {"%", Code::Modulo}},
      {{"not", Code::Not}, {"-", Code::Negate}, {"$", Code::Keep}}};
  return words;
}

struct Span {
  int low = 0;
  int high = kNoEnd;
};

// One path of a process from a state to a state.
struct Way {
  int from = 0;
  int to = 0;
  std::vector<ReadExpression> guards;
  std::optional<Span> wait;
  std::string port;  // as the process calls it; "" for none
  std::vector<std::pair<int, ReadExpression>> updates;  // of its variables
};

struct LocalVariable {
  Span range;
  int initial = 0;
};

struct ProcessText {
  std::vector<std::string> ports;
  std::vector<std::string> parameters;
  NameTable names;  // parameters, then its own variables
  std::vector<LocalVariable> own;
  std::vector<std::string> states;
  std::vector<Way> ways;
};

struct Instance {
  const ProcessText* process = nullptr;
  std::map<std::string, std::string> ports;
  std::vector<std::size_t> slots;  // of its variables in the state
  std::size_t state = 0;           // the slot of its state
};

// A way of an instance, with the time that the instance gives it.
struct Transition {
  std::size_t instance = 0;
  const Way* way = nullptr;
  Span when;
  std::string port;
  std::optional<std::size_t> clock;  // its slot
};

struct Observation {
  std::size_t instance = 0;
  int state = -1;        // it is there; or
  ReadExpression value;  // this is true
};

class FiacreModel {
 public:
  explicit FiacreModel(const std::string& text)
      : words_(words_of(text,
                        {"...", ":=", "..", "||", "[]", "<>", "<=", ">=", "=>"},
                        "//")) {
    types_["int"] = {std::numeric_limits<int>::min(), kNoEnd};
    constants_["true"] = {NameKind::Constant, 1};
    constants_["false"] = {NameKind::Constant, 0};
    while (!words_.at_end()) declaration(words_.take());
    if (instances_.empty()) throw std::runtime_error("nothing runs");
    give_times();
  }

  std::optional<ReadSpace> explored(std::size_t most) {
    ReadSpace space;
    for (const auto& [name, claim] : claims_) space.always[name] = true;
    std::map<std::vector<int>, bool> known;
    std::vector<std::vector<int>> found{initial_};
    known[initial_] = true;
    const auto reach = [&](const std::vector<int>& next) {
      ++space.transitions;
      if (known.emplace(next, true).second) found.push_back(next);
    };
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found.size() > most) return std::nullopt;
      const std::vector<int> state = found[i];
      for (const auto& [name, claim] : claims_) {
        space.always[name] = space.always[name] && observed(claim, state);
      }
      for (const Transition* transition : fireable(state)) {
        reach(after(state, *transition));
      }
      const std::vector<int> later = waited(state);
      if (later != state) reach(later);
    }
    space.states = found.size();
    return space;
  }

 private:
  // --- reading ---

  void declaration(const std::string& keyword) {
    if (keyword == "type") {
      const std::string name = fiacre_name(words_);
      words_.expect("is");
      const int low = words_.number();
      words_.expect("..");
      types_[name] = {low, words_.number()};
    } else if (keyword == "const") {
      constant();
    } else if (keyword == "process") {
      process();
    } else if (keyword == "component") {
      component();
    } else if (keyword == "property") {
      property();
    } else if (keyword != component_) {
      throw std::runtime_error("no declaration " + keyword);
    }
  }

  void constant() {
    const std::string name = fiacre_name(words_);
    words_.expect(":");
    const Span range = types_.at(words_.take());
    words_.expect("is");
    const int number = words_.number();
    if (number < range.low || number > range.high) {
      throw std::runtime_error("a constant out of its range: " + name);
    }
    constants_[name] = {NameKind::Constant, number};
  }

  // Words up to the closing bracket, which is taken, by commas.
  template <class Read>
  void list(std::string_view end, Read read) {
    do {
      read();
    } while (words_.accept(","));
    if (!end.empty()) words_.expect(end);
  }

  Span interval() {
    words_.expect("[");
    Span span;
    span.low = words_.number();
    words_.expect(",");
    if (words_.accept("...")) {
      words_.expect("[");
    } else {
      span.high = words_.number();
      words_.expect("]");
    }
    return span;
  }

  // `NAME : TYPE := VALUE`.
  std::pair<std::string, LocalVariable> variable() {
    const std::string name = fiacre_name(words_);
    words_.expect(":");
    LocalVariable made;
    made.range = types_.at(words_.take());
    words_.expect(":=");
    made.initial = constants_.count(words_.peek()) > 0
                       ? constants_.at(words_.take()).number
                       : words_.number();
    return {name, made};
  }

  void process() {
    const std::string name = fiacre_name(words_);
    ProcessText& made = processes_[name];
    made.names = constants_;
    if (words_.accept("[")) {
      list("]", [&] {
        made.ports.push_back(fiacre_name(words_));
        words_.expect(":");
        words_.expect("sync");
      });
    }
    int count = 0;
    const auto named = [&](const std::string& variable) {
      made.names[variable] = {NameKind::Variable, count++};
    };
    if (words_.accept("(")) {
      list(")", [&] {
        words_.expect("&");
        made.parameters.push_back(fiacre_name(words_));
        words_.expect(":");
        types_.at(words_.take());
        named(made.parameters.back());
      });
    }
    words_.expect("is");
    words_.expect("states");
    list("", [&] { made.states.push_back(fiacre_name(words_)); });
    if (words_.accept("var")) {
      list("", [&] {
        const auto [own, range] = variable();
        made.own.push_back(range);
        named(own);
      });
    }
    while (words_.accept("from")) transition(made);
  }

  static int state_of(const ProcessText& process, const std::string& name) {
    const auto found = std::ranges::find(process.states, name);
    if (found == process.states.end()) {
      throw std::runtime_error("no state " + name);
    }
    return static_cast<int>(found - process.states.begin());
  }

  void transition(ProcessText& process) {
    const int from = state_of(process, words_.take());
    const bool is_choice = words_.accept("select");
    do {
      process.ways.push_back(way(process));
      process.ways.back().from = from;
    } while (words_.accept("[]"));
    if (is_choice) words_.expect("end");
  }

  ReadExpression expression(const NameTable& names) {
    return read_expression(words_, fiacre_operators(), names);
  }

  Way way(const ProcessText& process) {
    Way made;
    while (!words_.accept("to")) {
      const std::string word = words_.take();
      if (word == "on") {
        made.guards.push_back(expression(process.names));
      } else if (word == "wait") {
        made.wait = interval();
      } else if (words_.accept(":=")) {
        made.updates.emplace_back(process.names.at(word).number,
                                  expression(process.names));
      } else {
        if (std::ranges::find(process.ports, word) == process.ports.end()) {
          throw std::runtime_error("no port " + word);
        }
        made.port = word;
      }
      words_.expect(";");
    }
    if (made.wait && !made.port.empty()) {
      throw std::runtime_error("a wait and a port");
    }
    made.to = state_of(process, words_.take());
    return made;
  }

  std::size_t add_slot(Span range, int value) {
    ranges_.push_back(range);
    initial_.push_back(value);
    return initial_.size() - 1;
  }

  void component() {
    component_ = fiacre_name(words_);
    words_.expect("is");
    std::map<std::string, std::size_t> shared;
    if (words_.accept("var")) {
      list("", [&] {
        const auto [name, made] = variable();
        shared[name] = add_slot(made.range, made.initial);
      });
    }
    if (words_.accept("port")) {
      list("", [&] {
        const std::string name = fiacre_name(words_);
        words_.expect(":");
        words_.expect("sync");
        ports_[name] = words_.accept("in") ? interval() : Span{};
      });
    }
    if (words_.accept("priority")) priority();
    words_.expect("par");
    do {
      instance(shared);
    } while (words_.accept("||"));
    words_.expect("end");
  }

  void priority() {
    std::vector<std::string> above;
    std::vector<std::string> below;
    do {
      above.push_back(words_.take());
    } while (words_.accept("|"));
    words_.expect(">");
    do {
      below.push_back(words_.take());
    } while (words_.accept("|"));
    for (const std::string& port : below) {
      above_[port].insert(above_[port].end(), above.begin(), above.end());
    }
  }

  void instance(const std::map<std::string, std::size_t>& shared) {
    const ProcessText& process = processes_.at(words_.take());
    Instance made{&process, {}, {}, 0};
    if (words_.accept("[")) {
      std::size_t number = 0;
      list("]", [&] {
        const std::string port = words_.take();
        ports_.at(port);
        made.ports[process.ports.at(number++)] = port;
      });
    }
    if (words_.accept("(")) {
      list(")", [&] {
        words_.expect("&");
        made.slots.push_back(shared.at(words_.take()));
      });
    }
    if (made.slots.size() != process.parameters.size() ||
        made.ports.size() != process.ports.size()) {
      throw std::runtime_error("not as many arguments as parameters");
    }
    for (const LocalVariable& own : process.own) {
      made.slots.push_back(add_slot(own.range, own.initial));
    }
    made.state = add_slot({0, static_cast<int>(process.states.size())}, 0);
    instances_.push_back(made);
  }

  void property() {
    NameTable names;
    ReadProperty made =
        read_fiacre_property(words_, [&] { return observation(names); });
    if (!properties_.insert(made.name).second) {
      throw std::runtime_error("a second property " + made.name);
    }
    if (made.form.empty()) return;
    WordReader formula(std::move(made.condition));
    ReadExpression claim = read_expression(formula, fiacre_operators(), names);
    if (made.form == "absent") claim.items.push_back({Code::Not, 0});
    claims_[made.name] = std::move(claim);
  }

  // `C/k/state S` or `C/k/value (E)`: becomes one name.
  std::string observation(NameTable& names) {
    words_.expect(component_);
    words_.expect("/");
    Observation made;
    made.instance = static_cast<std::size_t>(words_.number()) - 1;
    const ProcessText& process = *instances_.at(made.instance).process;
    words_.expect("/");
    if (words_.accept("state")) {
      made.state = state_of(process, words_.take());
    } else {
      words_.expect("value");
      words_.expect("(");
      made.value = expression(process.names);
      words_.expect(")");
    }
    const int number = static_cast<int>(observations_.size());
    observations_.push_back(std::move(made));
    const std::string name = "#" + std::to_string(number);
    names[name] = {NameKind::Definition, number};
    return name;
  }

  void give_times() {
    for (std::size_t i = 0; i < instances_.size(); ++i) {
      const Instance& instance = instances_[i];
      for (const Way& way : instance.process->ways) {
        Transition made{i, &way, way.wait.value_or(Span{}), "", std::nullopt};
        if (!way.port.empty()) {
          made.port = instance.ports.at(way.port);
          made.when = ports_.at(made.port);
        }
        if (made.when.low > 0 ||
            (made.when.high > 0 && made.when.high != kNoEnd)) {
          made.clock = add_slot({0, kNoEnd}, 0);
        }
        transitions_.push_back(made);
      }
    }
  }

  // --- meaning ---

  std::int64_t value(const ReadExpression& of, const Instance& instance,
                     const std::vector<int>& state) const {
    return of.value(
        [&](int local) {
          return state[instance.slots[static_cast<std::size_t>(local)]];
        },
        [](int) -> std::int64_t { throw std::runtime_error("no definition"); });
  }

  bool enabled(const std::vector<int>& state, const Transition& at) const {
    const Instance& instance = instances_[at.instance];
    if (state[instance.state] != at.way->from) return false;
    return std::ranges::all_of(at.way->guards, [&](const ReadExpression& on) {
      return value(on, instance, state) != 0;
    });
  }

  static int age(const std::vector<int>& state, const Transition& at) {
    return at.clock ? state[*at.clock] : 0;
  }

  std::vector<const Transition*> fireable(const std::vector<int>& state) const {
    std::vector<const Transition*> all;
    for (const Transition& at : transitions_) {
      if (!enabled(state, at)) continue;
      const int now = age(state, at);
      if (now >= at.when.low && now <= at.when.high) all.push_back(&at);
    }
    std::vector<const Transition*> first;
    for (const Transition* at : all) {
      const auto higher = above_.find(at->port);
      const bool is_blocked =
          higher != above_.end() &&
          std::ranges::any_of(all, [&](const Transition* other) {
            return std::ranges::find(higher->second, other->port) !=
                   higher->second.end();
          });
      if (!is_blocked) first.push_back(at);
    }
    return first;
  }

  std::vector<int> after(const std::vector<int>& state,
                         const Transition& fired) const {
    const Instance& instance = instances_[fired.instance];
    std::vector<int> next = state;
    for (const auto& [local, expression] : fired.way->updates) {
      const std::size_t slot = instance.slots[static_cast<std::size_t>(local)];
      next[slot] = static_cast<int>(value(expression, instance, next));
      if (next[slot] < ranges_[slot].low || next[slot] > ranges_[slot].high) {
        throw std::runtime_error("a value out of its type");
      }
    }
    next[instance.state] = fired.way->to;
    for (const Transition& other : transitions_) {
      if (!other.clock) continue;
      const bool goes_on = other.instance != fired.instance &&
                           enabled(state, other) && enabled(next, other);
      if (!goes_on) next[*other.clock] = 0;
    }
    return next;
  }

  // One unit later, or the same state where time cannot pass.
  std::vector<int> waited(const std::vector<int>& state) const {
    std::vector<int> next = state;
    for (const Transition& at : transitions_) {
      if (!enabled(state, at)) continue;
      if (age(state, at) == at.when.high) return state;
      if (!at.clock) continue;
      const int most = at.when.high == kNoEnd ? at.when.low : at.when.high;
      next[*at.clock] = std::min(state[*at.clock] + 1, most);
    }
    return next;
  }

  bool observed(const ReadExpression& claim,
                const std::vector<int>& state) const {
    const auto holds = [&](int number) -> std::int64_t {
      const Observation& seen = observations_[static_cast<std::size_t>(number)];
      const Instance& instance = instances_[seen.instance];
      if (seen.state >= 0) return state[instance.state] == seen.state;
      return value(seen.value, instance, state) != 0;
    };
    return claim.value([](int) -> std::int64_t { return 0; }, holds) != 0;
  }

  WordReader words_;
  std::map<std::string, Span> types_;
  NameTable constants_;
  std::map<std::string, ProcessText> processes_;
  std::string component_;
  std::map<std::string, Span> ports_;
  std::map<std::string, std::vector<std::string>> above_;
  std::vector<Span> ranges_;  // by slot
  std::vector<int> initial_;
  std::vector<Instance> instances_;
  std::vector<Transition> transitions_;
  std::vector<Observation> observations_;
  std::set<std::string> properties_;
  std::map<std::string, ReadExpression> claims_;
};

}  // namespace

std::optional<ReadSpace> read_fiacre_space(const std::string& text,
                                           std::size_t most) {
  return FiacreModel(text).explored(most);
}

}  // namespace btcheck::reference
