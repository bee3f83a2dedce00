// SPDX-License-Identifier: MIT
//
// What all calls have in common: their limits, and the texts that they read.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
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
  std::atomic<std::uint64_t> states_ = 0;  // told last
  std::atomic<bool> is_stopped_ = false;
  std::atomic<double> stopped_at_ = -1;  // seconds; before: negative
};

// Where the texts of a call come from, and its settings.
class CallSources : public btcheck::Sources {
 public:
  // Throws std::invalid_argument where there are settings and they cannot be
  // read.
  virtual std::optional<NamedText> settings(const std::string& tree) = 0;
};

// The user's sources as those of a check.
class AskedSources final : public CallSources {
 public:
  AskedSources(v1::Sources& sources, bool is_one_program)
      : sources_(sources), is_one_program_(is_one_program) {}

  Result<InputFile> text(const std::string& name) override;
  NearestFile with_tree(std::string_view tree,
                        const std::string& from) override;
  std::string package(std::string_view name,
                      const std::string& /*from*/) override {
    return sources_.package(std::string(name));
  }
  std::optional<NamedText> settings(const std::string& tree) override {
    return sources_.settings(tree);
  }
  const XmlProject& project() const override;
  bool is_of_one_program() const override { return is_one_program_; }

 private:
  v1::Sources& sources_;
  const bool is_one_program_;
  // Read when it is asked for: within the limits of the call.
  mutable std::optional<XmlProject> project_;
  XmlProject around_;
};

struct Inputs {
  TreeInput tree;
  std::vector<InputFile> rules;
  Judgement judgement;
  std::optional<TickSemantics> ticks;
};

// What a request names, read, with what the settings say; what is wrong with it
// is added to `found`. Nothing where a file is missing, or settings are wrong.
std::optional<Inputs> inputs_of(const Request& request, CallSources& sources,
                                std::vector<Diagnostic>& found);
// The same without rules.
std::optional<Inputs> inputs_of_tree(const Request& request,
                                     CallSources& sources,
                                     std::vector<Diagnostic>& found);
// How a check is made that the request asks for.
CheckOptions options_of(const Request& request, const Inputs& inputs,
                        Call& call);

// Reports of the same texts, asked for before.
class KnownReports {
 public:
  virtual ~KnownReports() = default;
  virtual std::optional<Report> find(const Request& request,
                                     const Inputs& inputs) = 0;
  // The last one of the tree, however it was then.
  virtual std::optional<Report> last(const Request& request) = 0;
  // Of a call that no limit of time has ended or shortened.
  virtual void keep(const Request& request, const Inputs& inputs,
                    const Report& report) = 0;
};

// Hears what a check has found before repairs are tried: a report without them,
// and without pages.
using FoundFirst = std::function<void(const Report&)>;

// The calls of btcheck/check.hpp, with sources of this program.
Report checked(const Request& request, CallSources& sources, Monitor* monitor,
               KnownReports* known = nullptr, const FoundFirst& first = {});
Report linted(const Request& request, CallSources& sources, Monitor* monitor,
              KnownReports* known = nullptr);
Description described(const Request& request, CallSources& sources,
                      Monitor* monitor);
Simulation simulated(const Request& request, const Plan& plan,
                     CallSources& sources, Monitor* monitor);

// BT9003: the call ended before there was anything to tell.
Diagnostic spent_diagnostic(const BudgetSpent& spent, const std::string& file);

}  // namespace btcheck::v1
