// SPDX-License-Identifier: MIT
//
// What all calls have in common: their limits, and the texts that they read.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "btcheck/check.hpp"
#include "check/check.hpp"
#include "explore/state/limits.hpp"
#include "model/automata/network.hpp"
#include "project/sources.hpp"
#include "text/budget.hpp"
#include "text/choice.hpp"
#include "text/diagnostic.hpp"

namespace btcheck::v1 {

// The time and the monitor of one call, for every stage of it. While it lasts,
// its thread speaks of fields of the request.
class Call final : public Budget, public SearchMonitor {
 public:
  Call(const Request& request, Monitor* monitor)
      : seconds_(request.seconds), monitor_(monitor) {}

  // For a moment after a search has been stopped what it knows is told.
  Spent look() override { return is_telling() ? Spent::Nothing : spent({}); }
  StopReason observe(const SearchProgress& progress) override;
  bool may_tell() override { return stopped_at_ < 0 || is_telling(); }
  bool has_spare() override {
    return stopped_at_ < 0 && (seconds_ == 0 || seconds() < seconds_ / 2);
  }

  double seconds() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;

  SpeaksOfRequests words_;
  static constexpr double kTelling = 0.3;
  static constexpr double kAskEvery = 0.005;

  bool is_telling() const {
    const double at = stopped_at_;
    return at >= 0 && seconds() - at < kTelling;
  }
  Spent spent(Progress progress);

  const Clock::time_point begin_ = Clock::now();
  const double seconds_;
  Monitor* monitor_;
  std::atomic<double> next_ = 0;
  std::atomic<bool> is_stopped_ = false;
  std::atomic<double> stopped_at_ = -1;  // seconds; before: negative
};

// The user's sources as those of a check.
class AskedSources final : public btcheck::Sources {
 public:
  explicit AskedSources(v1::Sources& sources);

  Result<InputFile> text(const std::string& name) override;
  NearestFile with_tree(std::string_view tree,
                        const std::string& from) override {
    return project_.with_tree(tree, from);
  }
  std::string package(std::string_view name,
                      const std::string& /*from*/) override {
    return sources_.package(std::string(name));
  }
  std::optional<NamedText> settings(const std::string& tree) {
    return sources_.settings(tree);
  }
  const XmlProject& project() const override { return project_; }
  bool is_of_one_program() const override { return true; }

 private:
  v1::Sources& sources_;
  XmlProject project_;
};

struct Inputs {
  TreeInput tree;
  std::vector<InputFile> rules;
  Judgement judgement;
  std::optional<TickSemantics> ticks;
};

// What a request names, read, with what the settings say; what is wrong with it
// is added to `found`. Nothing where a file is missing, or settings are wrong.
std::optional<Inputs> inputs_of(const Request& request, AskedSources& sources,
                                std::vector<Diagnostic>& found);
// The same without rules.
std::optional<Inputs> inputs_of_tree(const Request& request,
                                     AskedSources& sources,
                                     std::vector<Diagnostic>& found);

// BT9003: the call ended before there was anything to tell.
Diagnostic spent_diagnostic(const BudgetSpent& spent, const std::string& file);

}  // namespace btcheck::v1
