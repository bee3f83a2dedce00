// SPDX-License-Identifier: MIT
//
// A line of names with their types, then a line for each state: its slots, its
// labels, and the labels of the step that leads on. Texts stand in quotation
// marks, with a backslash before those and before itself. What the layers of
// LTSmin add, the state of an automaton for instance, are columns of their own.
#include "pins/trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

#include "check/replay/replay.hpp"
#include "cli/inputs/files.hpp"

namespace btcheck {
namespace {

using Row = std::vector<std::string>;

Row fields_of(std::string_view line) {
  Row row(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (is_quoted && c == '\\' && i + 1 < line.size()) {
      row.back() += line[++i];
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      row.emplace_back();
    } else {
      row.back() += c;
    }
  }
  return row;
}

std::vector<Row> rows_of(std::string_view text) {
  std::vector<Row> rows;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (!line.empty()) rows.push_back(fields_of(line));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return rows;
}

class TraceReader {
 public:
  TraceReader(const std::string& file, const PinsModel& model)
      : file_(file), model_(model) {}

  Result<Lasso> read(std::string_view text) {
    rows_ = rows_of(text);
    if (rows_.size() < 2) return refuse("it has no states");
    if (!find_columns()) return std::move(refused_);
    std::vector<StateVector> states;
    for (std::size_t i = 1; i < rows_.size(); ++i) {
      if (!read_state(i)) return std::move(refused_);
      states.push_back(packed_);
    }
    if (!begins_at_start(states[0])) {
      return refuse("it does not begin where the tree does",
                    "of pins2lts-dist, put its states in order first: "
                    "ltsmin-convert --rdwr --bfs RUN.gcf IN_ORDER.gcf");
    }
    Lasso trace;
    for (std::size_t i = 0; i < states.size(); ++i) {
      RunState next{states[i], {}};
      if (i > 0 && !find_step(i, states[i - 1], next)) {
        return std::move(refused_);
      }
      trace.prefix.push_back(std::move(next));
    }
    close(trace);
    return {std::move(trace), {}};
  }

 private:
  Result<Lasso> refuse(
      std::string message,
      std::string help =
          "ltsmin-printtrace RUN.gcf RUN.csv prints one; --tree "
          "names what LTSmin was given") {
    return {std::nullopt,
            {file_error("BT1309", file_,
                        fmt::format("no trace of this model: {}", message),
                        std::move(help))}};
  }

  bool begins_at_start(const StateVector& state) const {
    bool is_it = false;
    model_.system().initial_states(
        [&](StateView first) { is_it |= std::ranges::equal(first, state); });
    return is_it;
  }
  bool fail(std::string message) {
    refused_ = refuse(std::move(message));
    return false;
  }

  bool find_columns() {
    std::map<std::string, std::size_t> columns;
    for (std::size_t i = 0; i < rows_[0].size(); ++i) {
      const std::string& heading = rows_[0][i];
      columns[heading.substr(0, heading.rfind(':'))] = i;
    }
    for (std::size_t slot = 0; slot < model_.slots().size(); ++slot) {
      const auto found = columns.find(model_.slot_name(slot));
      if (found == columns.end()) {
        return fail(fmt::format("it has no `{}`", model_.slot_name(slot)));
      }
      columns_.push_back(found->second);
      names_.push_back(model_.value_names(slot));
    }
    const auto action = columns.find("action");
    if (action != columns.end()) action_ = action->second;
    actions_ = action_names(model_.system().network());
    return true;
  }

  bool read_state(std::size_t line) {
    const Row& row = rows_[line];
    if (row.size() != rows_[0].size()) {
      return fail(fmt::format("line {} is cut off", line + 1));
    }
    std::vector<int> values;
    for (std::size_t slot = 0; slot < columns_.size(); ++slot) {
      const auto value = value_of(names_[slot], row[columns_[slot]]);
      if (!value) {
        return fail(fmt::format("line {} has `{}` for `{}`", line + 1,
                                row[columns_[slot]], model_.slot_name(slot)));
      }
      values.push_back(*value);
    }
    packed_.assign(model_.system().word_count(), 0);
    model_.slots().pack(values.data(), packed_.data());
    return true;
  }

  // A name, or a number where the module tells no names.
  static std::optional<int> value_of(const std::vector<std::string>& names,
                                     const std::string& text) {
    const auto found = std::ranges::find(names, text);
    if (found != names.end()) return static_cast<int>(found - names.begin());
    int value = 0;
    const auto [end, fault] =
        std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size()) {
      return std::nullopt;
    }
    return value;
  }

  // The step that is named, else any that leads to the state.
  bool find_step(std::size_t line, const StateVector& from, RunState& to) {
    std::optional<Step> step;
    model_.system().successors(from, [&](StateView target, const Step& found) {
      if (!std::ranges::equal(target, to.state)) return;
      if (!step || is_named(found, line)) step = found;
    });
    if (!step) {
      refused_ = refuse("");
      refused_.diagnostics[0].code = "BT1310";
      refused_.diagnostics[0].message = fmt::format(
          "the trace does not replay: no step of the tree leads from the state "
          "of line {} to that of line {}",
          line + 1, line + 2);
      refused_.diagnostics[0].help.clear();
      return false;
    }
    to.step = *step;
    return true;
  }

  bool is_named(const Step& step, std::size_t line) const {
    return action_ &&
           rows_[line][*action_] == actions_[model_.groups().of(step)];
  }

  // A last state that was there before, with all that the layers add.
  void close(Lasso& trace) const {
    const auto is_again = [&](std::size_t line) {
      return std::equal(rows_[line].begin(),
                        rows_[line].begin() + state_columns(),
                        rows_.back().begin());
    };
    std::size_t first = 1;
    while (first + 1 < rows_.size() && !is_again(first)) ++first;
    if (first + 1 >= rows_.size()) return;
    const auto begin =
        trace.prefix.begin() + static_cast<std::ptrdiff_t>(first);
    trace.cycle.assign(begin, trace.prefix.end());
    trace.closing = trace.cycle.front().step;
    trace.prefix.erase(begin, trace.prefix.end());
  }

  // The labels of steps stand behind everything of states.
  std::ptrdiff_t state_columns() const {
    return static_cast<std::ptrdiff_t>(action_.value_or(rows_[0].size()));
  }

  const std::string& file_;
  const PinsModel& model_;
  std::vector<Row> rows_;
  std::vector<std::size_t> columns_;  // by slot
  std::vector<std::vector<std::string>> names_;
  std::optional<std::size_t> action_;
  std::vector<std::string> actions_;
  StateVector packed_;
  Result<Lasso> refused_;
};

}  // namespace

Result<Lasso> read_trace(const std::string& file, std::string_view text,
                         const PinsModel& model) {
  return TraceReader(file, model).read(text);
}

std::optional<Run> replayed(const PinsModel& model, const Lasso& trace,
                            std::string& error) {
  return replay({model.network(), model.system(), model.forgotten()}, trace,
                error);
}

}  // namespace btcheck
