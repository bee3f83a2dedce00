// SPDX-License-Identifier: MIT
#include "report/text/differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "model/tree/tree.hpp"
#include "report/text/report.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostRuns = 3;  // of nodes that can do otherwise

// By NodeQuestion.
constexpr std::array<std::string_view, kNodeQuestionCount> kDeeds = {
    "be ticked",      "succeed",   "fail",
    "answer running", "be halted", "be skipped"};

std::string_view profile_of(const CheckResult& result) {
  return profile_name(result.tree->profile);
}

class Comparison {
 public:
  Comparison(const CheckResult& before, const CheckResult& after, Layout layout)
      : before_(before), after_(after), layout_(layout) {}

  std::string text() {
    for (std::size_t i = 0;
         i < std::min(before_.files.size(), after_.files.size()); ++i) {
      compare_verdicts(before_.files[i], after_.files[i]);
      compare_missions(before_.files[i], after_.files[i]);
    }
    add_findings(after_, before_, "only under");
    add_findings(before_, after_, "gone: only under");
    compare_nodes();
    return std::move(text_);
  }

 private:
  void compare_verdicts(const CheckedFile& one, const CheckedFile& other) {
    for (std::size_t i = 0;
         i < std::min(one.verdicts.size(), other.verdicts.size()); ++i) {
      const PropertyVerdict& was = one.verdicts[i];
      const PropertyVerdict& is = other.verdicts[i];
      if (was.verdict == is.verdict) continue;
      text_ +=
          fmt::format("\n{}: {} under {}, {} under {}\n", is.property->name,
                      verdict_word(was.verdict), profile_of(before_),
                      verdict_word(is.verdict), profile_of(after_));
      if (is.run) {
        text_ += told_text(after_, other, is, layout_);
      } else if (was.run) {
        text_ += told_text(before_, one, was, layout_);
      }
    }
  }

  static bool are_opposite(Verdict one, Verdict other) {
    return (one == Verdict::Holds && other == Verdict::Violated) ||
           (one == Verdict::Violated && other == Verdict::Holds);
  }

  // The questions about the tree as a whole, in a tree without rules.
  void compare_missions(const CheckedFile& one, const CheckedFile& other) {
    if (!one.defaults || !other.defaults) return;
    for (const TreeReport& was : one.defaults->tree) {
      for (const TreeReport& is : other.defaults->tree) {
        if (was.question != is.question ||
            !are_opposite(was.verdict, is.verdict)) {
          continue;
        }
        const bool is_now = is.verdict == Verdict::Holds;
        text_ += fmt::format("\n{}: under {}, not under {}\n",
                             words_of(is.question).words,
                             profile_of(is_now ? after_ : before_),
                             profile_of(is_now ? before_ : after_));
        if (is.run) {
          tell(after_, other, *is.run, {});
        } else if (was.run) {
          tell(before_, one, *was.run, {});
        }
      }
    }
  }

  void tell(const CheckResult& of, const CheckedFile& file, const KeptRun& run,
            const std::vector<NodeId>& nodes) {
    if (run.is_empty()) return;
    text_ += brief_text(recorded_steps(*of.tree, *file.network, run.told()),
                        nodes, layout_.width);
  }

  // A finding is the same where its code and what it says are.
  static std::set<std::pair<std::string_view, std::string>> keys_of(
      const CheckResult& result) {
    std::set<std::pair<std::string_view, std::string>> keys;
    for (const CheckedFile& file : result.files) {
      for (const TreeFinding& finding : file.findings) {
        keys.insert({finding.code, finding.message});
      }
    }
    return keys;
  }

  // Without notes: what they tell, of later releases for instance, is no
  // change.
  void add_findings(const CheckResult& of, const CheckResult& other,
                    std::string_view how) {
    const auto known = keys_of(other);
    bool is_first = true;
    for (const CheckedFile& file : of.files) {
      for (const TreeFinding& finding : file.findings) {
        if (finding.severity == Severity::Note ||
            known.contains({finding.code, finding.message})) {
          continue;
        }
        if (std::exchange(is_first, false)) {
          text_ += fmt::format("\n{} {}\n", how, profile_of(of));
        }
        text_ += finding_text(of, file, finding, layout_);
      }
    }
  }

  static std::map<std::string, const NodeReport*> nodes_of(
      const CheckResult& result) {
    std::map<std::string, const NodeReport*> nodes;
    for (const CheckedFile& file : result.files) {
      if (!file.defaults) continue;
      for (const NodeReport& node : file.defaults->nodes) {
        nodes[unique_name(*result.tree, node.node)] = &node;
      }
    }
    return nodes;
  }

  // What a node can do under one of them and never under the other.
  void compare_nodes() {
    const auto was = nodes_of(before_);
    const auto is = nodes_of(after_);
    std::size_t runs = 0;
    for (const auto& [name, now] : is) {
      const auto then = was.find(name);
      if (then == was.end()) continue;
      for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
        compare(name, q, *then->second, *now, runs);
      }
    }
  }

  void compare(const std::string& name, std::size_t question,
               const NodeReport& was, const NodeReport& is, std::size_t& runs) {
    const Verdict then = was.answers[question].verdict;
    const Verdict now = is.answers[question].verdict;
    if (!are_opposite(then, now)) return;
    const bool is_new = now == Verdict::Holds;
    const CheckResult& with = is_new ? after_ : before_;
    const CheckResult& without = is_new ? before_ : after_;
    text_ +=
        fmt::format("\n{} can {} under {}, never under {}\n", name,
                    kDeeds[question], profile_of(with), profile_of(without));
    const NodeReport& told = is_new ? is : was;
    const auto& run = told.answers[question].run;
    if (!run || run->is_empty() || runs == kMostRuns) return;
    ++runs;
    tell(with, with.files[0], *run, {told.node});
  }

  const CheckResult& before_;
  const CheckResult& after_;
  Layout layout_;
  std::string text_;
};

}  // namespace

std::string differences_text(const CheckResult& before,
                             const CheckResult& after, Layout layout) {
  return Comparison(before, after, layout).text();
}

}  // namespace btcheck
