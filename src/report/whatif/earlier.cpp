// SPDX-License-Identifier: MIT
//
// A fault is found again by the path of its leaf and its kind; where the path
// is gone, by the name of the leaf, if only one has it.
#include "report/whatif/earlier.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>

#include "report/formats/reported.hpp"
#include "report/whatif/files.hpp"
#include "report/whatif/words.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

using ParsedJson = nlohmann::json;

std::optional<Harm> harm_named(std::string_view word) {
  for (std::size_t h = 0; h < kHarms; ++h) {
    if (kHarmFacts[h].word == word) return static_cast<Harm>(h);
  }
  return std::nullopt;
}

// Nothing is worse of a fault that does not strike than of one that is
// survived.
int rank_of(Harm harm) {
  return static_cast<int>(harm == Harm::NotAsked ? Harm::Survives : harm);
}

// What has to be the same again.
struct FaultKey {
  std::string by_path;
  std::string by_name;

  void add(const std::string& path, std::string_view name,
           std::string_view kind) {
    by_path += fmt::format("{}{} {}", by_path.empty() ? "" : " + ", path, kind);
    by_name += fmt::format("{}{} {}", by_name.empty() ? "" : " + ", name, kind);
  }
};

std::string last_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::string last = slash == path.npos ? path : path.substr(slash + 1);
  return last.substr(0, last.find('#'));
}

// "land" of "land@23": lines move.
std::string without_line(const std::string& name) {
  return name.substr(0, name.rfind('@'));
}

void read_rows(const ParsedJson& rows, EarlierResult& to) {
  for (const ParsedJson& row : rows) {
    FaultKey key;
    for (const ParsedJson& fault : row.at("faults")) {
      const auto path = unbroken(fault.at("path").get<std::string>());
      key.add(path, last_of(path),
              unbroken(fault.at("kind").get<std::string>()));
    }
    EarlierFault known;
    known.by_name = key.by_name;
    const auto word = row.at("harm").get<std::string>();
    const auto harm = harm_named(word);
    if (!harm) {
      throw std::invalid_argument(fmt::format("`{}` is no harm", word));
    }
    known.harm = *harm;
    for (const char* member : {"broken", "left_running", "left_on"}) {
      for (const ParsedJson& each : row.at(member)) {
        known.more.push_back(without_line(each.get<std::string>()));
      }
    }
    to.faults.emplace(key.by_path, std::move(known));
  }
}

EarlierResult earlier_from(const ParsedJson& file) {
  if (!file.is_object() || file.value("schema", "") != kWhatIfSchema) {
    throw std::invalid_argument(
        fmt::format("its `schema` is not {}", kWhatIfSchema));
  }
  EarlierResult result;
  const ParsedJson& options = file.at("options");
  options.at("order").get_to(result.order);
  options.at("others").get_to(result.others);
  options.at("late").get_to(result.late);
  options.at("faults").get_to(result.kinds);
  result.is_part = !options.at("only").is_null();
  read_rows(file.at("rows"), result);
  read_rows(file.at("pairs"), result);
  return result;
}

// Behind the library's own number: "[json.exception.out_of_range.403] ".
std::string_view without_number(std::string_view what) {
  const auto end = what.find("] ");
  return end == what.npos ? what : what.substr(end + 2);
}

class Comparison {
 public:
  Comparison(const EarlierResult& before, const WhatIfReport& report)
      : before_(before),
        report_(report),
        tree_(report.tree()),
        result_(report.result) {
    for (const auto& [path, fault] : before.faults) {
      ++bearers_[fault.by_name];
      path_of_[fault.by_name] = path;
    }
  }

  WhatIfChange take() {
    std::string worse;
    std::string better;
    std::map<std::string, int> now;
    for (std::size_t n = 1; n <= row_count(result_); ++n) {
      ++now[key_of(row_numbered(result_, n)).by_name];
    }
    for (std::size_t n = 1; n <= row_count(result_); ++n) {
      const FaultRow& row = row_numbered(result_, n);
      const FaultKey key = key_of(row);
      const EarlierFault* known = find(key, now[key.by_name] == 1);
      if (row.harm == Harm::Undecided) {
        ++change_.open;
        continue;
      }
      if (known == nullptr) {
        if (!is_bad(row.harm) || !is_looked_for(row)) continue;
        ++change_.worse;
        worse += line(n, row, "new");
        continue;
      }
      if (known->harm == Harm::Undecided) continue;
      const std::string was = fmt::format("was {}", facts_of(known->harm).word);
      if (is_worse(row, *known)) {
        ++change_.worse;
        worse += line(n, row, was);
      } else if (rank_of(row.harm) > rank_of(known->harm)) {
        ++change_.better;
        better += line(n, row, was);
      }
    }
    add_gone(better);
    if (!worse.empty()) change_.text += "worse:\n" + worse;
    if (!better.empty()) change_.text += "better:\n" + better;
    change_.text += fmt::format(
        "beside {}: {} worse, {} better{}\n", before_.file, change_.worse,
        change_.better,
        change_.open == 0 ? "" : fmt::format(", {} not decided", change_.open));
    return std::move(change_);
  }

 private:
  FaultKey key_of(const FaultRow& row) const {
    FaultKey key;
    for (const InjectedFault& fault : row.faults) {
      const std::string path = stable_path(tree_, fault.leaf);
      key.add(path, last_of(path), facts_of(fault.fault.kind).word);
    }
    return key;
  }

  const EarlierFault* find(const FaultKey& key, bool is_only_one) {
    auto found = before_.faults.find(key.by_path);
    const auto bearers = bearers_.find(key.by_name);
    if (found == before_.faults.end() && is_only_one &&
        bearers != bearers_.end() && bearers->second == 1) {
      found = before_.faults.find(path_of_[key.by_name]);
    }
    if (found == before_.faults.end()) return nullptr;
    met_.insert(found->first);
    return &found->second;
  }

  // Whether the earlier search would have told of such a fault.
  bool is_looked_for(const FaultRow& row) const {
    if (before_.is_part) return false;
    if (row.faults.size() > 1 && before_.order < 2) return false;
    return std::ranges::all_of(row.faults, [&](const InjectedFault& fault) {
      return before_.kinds.empty() ||
             std::ranges::count(before_.kinds,
                                facts_of(fault.fault.kind).word) > 0;
    });
  }

  bool is_worse(const FaultRow& row, const EarlierFault& known) const {
    if (row.harm != known.harm) {
      return rank_of(row.harm) < rank_of(known.harm);
    }
    if (row.harm != Harm::RuleBreaks && row.harm != Harm::LeftOn) return false;
    std::vector<std::string> more = broken_rules(result_, row.effect);
    for (const auto* leaves : {&row.effect.left_running, &row.effect.left_on}) {
      for (const NodeId leaf : *leaves) {
        more.push_back(without_line(short_name(tree_, leaf)));
      }
    }
    return std::ranges::any_of(more, [&](const std::string& each) {
      return std::ranges::count(known.more, each) == 0;
    });
  }

  std::string line(std::size_t number, const FaultRow& row,
                   const std::string& was) const {
    const std::string text =
        fmt::format("{}: the mission {} ({})", faults_text(tree_, row),
                    harm_text(tree_, result_, row), was);
    return fmt::format("{:>7}  {}\n", number, wrapped(text, 9));
  }

  // Pairs are in a result only where they do what neither fault does alone.
  void add_gone(std::string& better) {
    for (const auto& [path, fault] : before_.faults) {
      if (met_.contains(path) || !is_bad(fault.harm)) continue;
      const bool is_pair = path.find(" + ") != path.npos;
      const bool is_whole = result_.choices.kinds.empty() &&
                            report_.only.empty() &&
                            (!is_pair || result_.order > 1);
      if (!is_whole) continue;
      ++change_.better;
      better +=
          fmt::format("{:>7}  {}\n", "",
                      wrapped(fmt::format("{}: gone (was {})", fault.by_name,
                                          facts_of(fault.harm).word),
                              9));
    }
  }

  const EarlierResult& before_;
  const WhatIfReport& report_;
  const BehaviorTree& tree_;
  const WhatIf& result_;
  std::map<std::string, int> bearers_;  // of a name, among the earlier faults
  std::map<std::string, std::string> path_of_;
  std::set<std::string> met_;
  WhatIfChange change_;
};

}  // namespace

Result<EarlierResult> read_earlier(const std::string& name,
                                   std::string_view text) {
  const SourceText source(name, text);
  const auto refused = [&](SourceSpan span, std::string message) {
    return Result<EarlierResult>{
        std::nullopt,
        {source.diagnostic(Severity::Error, "BT1515", span, std::move(message),
                           {}, "write it with btcheck whatif, as JSON")}};
  };
  try {
    EarlierResult result = earlier_from(ParsedJson::parse(text));
    result.file = name;
    return {std::move(result), {}};
  } catch (const ParsedJson::parse_error& error) {
    const std::size_t at = std::min(error.byte, text.size());
    return refused(source.span(at > 0 ? at - 1 : 0, at), "this is no JSON");
  } catch (const std::exception& fault) {
    return refused({}, fmt::format("no result of btcheck whatif: {}",
                                   without_number(fault.what())));
  }
}

WhatIfChange change_since(const EarlierResult& before,
                          const WhatIfReport& report) {
  return Comparison(before, report).take();
}

ExitCode exit_code_of(const WhatIf& result, const WhatIfChange& change) {
  if (!result.error.empty()) return ExitCode::Internal;
  if (change.worse > 0) return ExitCode::Missed;
  const bool is_whole = result.stopped == StopReason::None && change.open == 0;
  return is_whole ? ExitCode::Met : ExitCode::Undecided;
}

}  // namespace btcheck
