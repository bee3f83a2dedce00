// SPDX-License-Identifier: MIT
#include "batch/entry_result.hpp"

#include <fmt/format.h>

#include <csignal>
#include <exception>
#include <new>
#include <utility>

#include "batch/results/kept_text.hpp"
#include "batch/run.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"

namespace btcheck {
namespace {

// Ends the search of one entry: at its limits, or when the batch asks for that.
class EntryMonitor : public SearchMonitor {
 public:
  explicit EntryMonitor(ProcessLimits& limits) : limits_(limits) {}

  StopReason observe(const SearchProgress&) override {
    return limits_.reached();
  }
  bool may_tell() override { return limits_.may_tell(); }
  bool has_spare() override { return limits_.has_spare(); }

 private:
  ProcessLimits& limits_;
};

// The result of an entry that memory or a mistake of ours has ended.
ReportedTree failed_tree(const BatchEntry& entry, ExitCode code,
                         std::string_view why) {
  const bool is_ours = code == ExitCode::Internal;
  ReportedTree tree = broken_tree(
      entry, {is_ours ? file_error("BT9002", "",
                                   fmt::format("internal error: {}", why))
                      : file_error("BT9001", "", std::string(why),
                                   "--memory sets a limit that is kept")});
  tree.code = code;
  return tree;
}

// The result that is kept, or why there is none; nothing where it is on us to
// check the entry.
std::optional<EntryResult> known_result(const BatchEntry& entry,
                                        const std::string& key,
                                        KeptResults& kept, bool& is_damaged) {
  using enum EntryResult::Origin;
  for (const bool is_ours : {false, true}) {
    KeptResults::Found found = kept.find(key);
    is_damaged = found.is_damaged;
    if (found.tree && !drop_lost_pages(*found.tree)) {
      return EntryResult{Kept, std::move(*found.tree)};
    }
    if (is_ours) break;  // and nobody was done with it before that
    const auto claim = kept.claim(key);
    if (claim == KeptResults::Claim::Others) return EntryResult{Held, {}};
    if (claim == KeptResults::Claim::Nobodys) {
      return EntryResult{Missing,
                         unrun_tree(entry, kept.why_missing(entry.name, key))};
    }
  }
  return std::nullopt;
}

// Reads an entry and checks it, or takes what is kept of it. Nothing for one
// that was broken off.
std::optional<EntryResult> found_result(const BatchEntry& entry,
                                        const Options& all, KeptResults& kept,
                                        const LookingOn& looking,
                                        const KeyListener& tell_key) {
  using enum EntryResult::Origin;
  if (has_error(entry.diagnostics)) {
    return EntryResult{New, broken_tree(entry, entry.diagnostics)};
  }
  std::vector<Diagnostic> found = entry.diagnostics;
  Options own = applied(all, entry.choices);
  own.project = entry.project;
  allow(own);
  const auto inputs = gather_inputs(entry.input, entry.properties, own, found);
  // An include may lie outside, and all the rest be there.
  if (!inputs || has_error(found)) {
    return EntryResult{New, broken_tree(entry, std::move(found))};
  }
  const Options& options = inputs->options;
  const std::string key = key_of(entry, *inputs, options);
  tell_key(key, looking.seen());
  bool is_damaged = false;
  if (auto known = known_result(entry, key, kept, is_damaged)) return known;
  EntryMonitor monitor(limits_of_command());
  const Limits limits{options.max_states, options.max_bytes, &monitor};
  EntryResult result{is_damaged ? Mended : New,
                     checked_tree(entry, *inputs, options, limits)};
  if (InterruptWatch::is_interrupted()) return std::nullopt;
  result.tree.seconds = limits_of_command().seconds();
  result.tree.peak_bytes = peak_bytes();
  return result;
}

}  // namespace

ReportedTree spent_tree(const BatchEntry& entry, const BudgetSpent& spent) {
  ReportedTree tree =
      broken_tree(entry, {spent_diagnostic(spent, entry.input)});
  tree.code = ExitCode::Undecided;
  return tree;
}

std::optional<EntryResult> result_of(const BatchEntry& entry,
                                     const Options& all, KeptResults& kept,
                                     const KeyListener& tell_key) {
  const LookingOn looking;
  EntryResult failed;
  try {
    auto result = found_result(entry, all, kept, looking, tell_key);
    if (result) result->looked_at = looking.seen();
    return result;
  } catch (const BudgetSpent& spent) {
    if (InterruptWatch::is_interrupted()) return std::nullopt;
    failed.tree = spent_tree(entry, spent);
  } catch (const std::bad_alloc&) {
    failed.tree = failed_tree(entry, ExitCode::Undecided, "out of memory");
  } catch (const std::exception& fault) {
    failed.tree = failed_tree(entry, ExitCode::Internal, fault.what());
  }
  failed.looked_at = looking.seen();
  return failed;
}

ReportedTree ended_tree(const BatchEntry& entry, int signal) {
  // SIGKILL is what the kernel does when there is no memory left.
  if (signal == SIGKILL || signal == SIGTERM) {
    return failed_tree(
        entry, ExitCode::Undecided,
        "killed, by the system for want of memory or by somebody");
  }
  return failed_tree(
      entry, ExitCode::Internal,
      signal == 0 ? "the check has ended without a result"
                  : fmt::format("the check was ended by signal {}", signal));
}

std::string sent_head(const std::string& key, const LookedAt& looked_at) {
  return key + '\n' + looked_at.text() + '\n';
}

std::string sent_text(const EntryResult& result) {
  return static_cast<char>(result.origin) + kept_text(result.tree);
}

Received received(std::string_view text) {
  Received all;
  const std::size_t end = text.find('\n');
  const std::size_t end_of_head = text.find("\n\n");
  if (end_of_head == text.npos) return all;
  all.key = text.substr(0, end);
  if (end < end_of_head) {
    all.looked_at =
        LookedAt::from_text(text.substr(end + 1, end_of_head - end));
  }
  text.remove_prefix(end_of_head + 2);
  if (text.empty()) return all;
  if (auto tree = tree_from(text.substr(1))) {
    all.result = EntryResult{static_cast<EntryResult::Origin>(text[0]),
                             std::move(*tree), all.looked_at};
  }
  return all;
}

}  // namespace btcheck
