// SPDX-License-Identifier: MIT
#include "cli/from.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/recordings.hpp"
#include "model/btcpp/tree/entry_programs.hpp"
#include "trace/conform/start.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

// From more states than these rules are not checked one by one.
constexpr std::size_t kMostStarts = 64;

Diagnostic too_many(const std::string& file, std::size_t count,
                    std::string what, std::string help) {
  return file_error(
      "BT1809", file,
      fmt::format("the tree may be in {} states there, and {}", count, what),
      std::move(help));
}

bool is_worse(const PropertyVerdict& one, const PropertyVerdict& other) {
  const auto rank = [](const PropertyVerdict& verdict) {
    if (verdict.verdict == Verdict::Violated) return 2;
    return verdict.verdict == Verdict::Undecided ? 1 : 0;
  };
  return rank(one) > rank(other);
}

// Of each rule the worse verdict.
void take_worse(CheckResult& all, CheckResult from_another) {
  for (std::size_t f = 0; f < all.files.size(); ++f) {
    auto& verdicts = all.files[f].verdicts;
    for (std::size_t v = 0; v < verdicts.size(); ++v) {
      PropertyVerdict& other = from_another.files[f].verdicts[v];
      if (!is_worse(other, verdicts[v])) continue;
      const Property* const rule = verdicts[v].property;
      verdicts[v] = std::move(other);
      verdicts[v].property = rule;
    }
    all.files[f].has_faults |= from_another.files[f].has_faults;
    if (!all.files[f].fault_level) {
      all.files[f].fault_level = from_another.files[f].fault_level;
    }
  }
}

}  // namespace

std::optional<StartFrom> StartFrom::read(const Options& options,
                                         const Limits& limits) {
  StartFrom start;
  start.file_ = options.from;
  start.tick_ = options.from_tick;
  start.reading_ = reading_of(options);
  const auto file = read_file(options.from);
  show(options, file.diagnostics);
  if (!file.value) return std::nullopt;
  const std::string& text = file.value->text;
  bool is_read = false;
  const auto take = [&](auto read) {
    show(options, read.diagnostics);
    is_read = read.value.has_value();
    if (is_read) start.recording_ = std::move(*read.value);
  };
  if (is_log(options.from, text)) {
    take(read_whole_log(options, options.from, text, limits));
  } else {
    take(read_itf(options.from, text));
  }
  if (!is_read) return std::nullopt;
  return start;
}

std::string StartFrom::text() const {
  return tick_ ? fmt::format("from {}@{}", file_, *tick_)
               : fmt::format("from {}", file_);
}

std::vector<Diagnostic> StartFrom::begin(const BehaviorTree& tree,
                                         Network& network,
                                         const TreeInput& input,
                                         std::size_t number,
                                         const Limits& limits) {
  if (tree.programs && !tree.programs->programs.empty()) {
    return {file_error("BT1810", file_,
                       "the scripts of this tree keep values that no recording "
                       "shows",
                       "check it from its beginning, without --from")};
  }
  auto states =
      std::holds_alternative<BehaviorLog>(recording_)
          ? states_after(file_, tree, network, recorded_tree(tree, input),
                         std::get<BehaviorLog>(recording_), reading_, tick_,
                         limits)
          : states_after(file_, tree, network,
                         std::get<RecordedRun>(recording_), tick_);
  if (!states.value) return std::move(states.diagnostics);
  count_ = std::max(count_, states.value->size());
  if (states.value->size() > kMostStarts) {
    return {too_many(file_, states.value->size(), "that is too many to check",
                     "begin at another tick, or from an ITF file")};
  }
  // From all of them or from none: a rule has to hold from each.
  if (std::ranges::any_of(*states.value, has_clock)) {
    return {file_error("BT1810", file_,
                       "a node has been counting time there, for a duration, a "
                       "delay or a rate",
                       "begin at a tick in which none is under way")};
  }
  const std::size_t last = states.value->size() - 1;
  begin_at(network, (*states.value)[std::min(number, last)]);
  return {};
}

bool begin_from(const Options& options, const BehaviorTree& tree,
                const TreeInput& input, Network& network,
                const Limits& limits) {
  if (options.from.empty()) return true;
  auto start = StartFrom::read(options, limits);
  if (!start) return false;
  auto found = start->begin(tree, network, input, 0, limits);
  if (found.empty() && start->count() > 1) {
    found.push_back(too_many(options.from, start->count(),
                             "only rules are asked of several",
                             "begin at another tick, or from an ITF file"));
  }
  show(options, found);
  return found.empty();
}

std::optional<CheckResult> check_from(const Options& options,
                                      const TreeInput& tree,
                                      const std::vector<InputFile>& properties,
                                      CheckOptions how) {
  auto start = StartFrom::read(options, how.limits);
  if (!start) return std::nullopt;
  how.start_text = start->text();
  std::size_t number = 0;
  how.start = [&](const BehaviorTree& of, Network& network) {
    auto found = start->begin(of, network, tree, number, how.limits);
    if (found.empty() && properties.empty() && start->count() > 1) {
      found.push_back(too_many(options.from, start->count(),
                               "only rules are asked of several",
                               "write rules: --prop FILE"));
    }
    return found;
  };
  CheckResult result = check(tree, properties, how);
  while (!result.files.empty() && ++number < start->count()) {
    take_worse(result, check(tree, properties, how));
  }
  return result;
}

}  // namespace btcheck
