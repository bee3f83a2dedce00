// SPDX-License-Identifier: MIT
//
// A line is `CHECKSUM KEY TREE`: two content hashes, and JSON, which has no
// line feed of its own. In the JSON each struct is an object with the names of
// its members; enumerations are their numbers.
#include "batch/kept_results.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "cli/inputs/files.hpp"

namespace nlohmann {

template <class Value>
struct adl_serializer<std::optional<Value>> {
  static void to_json(json& to, const std::optional<Value>& value) {
    if (value) {
      to = *value;
    } else {
      to = nullptr;
    }
  }
  static void from_json(const json& from, std::optional<Value>& value) {
    if (from.is_null()) {
      value.reset();
    } else {
      // Not `get`: clang 14 holds that a nested struct with default values
      // cannot be made by default.
      value.emplace(Value{});
      from.get_to(*value);
    }
  }
};

}  // namespace nlohmann

namespace btcheck {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SourceSpan, line, column, length)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Diagnostic, severity, code, message, file,
                                   span, source_line, label, help)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SearchProgress, states, expanded,
                                   transitions, depth, bytes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Place, file, span)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RelatedPlace, place, text)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ToldStep, kind, text, time, is_chosen, place)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ToldRun, steps, unit, time, loop)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Finding, code, severity, title, message,
                                   place, node, related, run, identity)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedProperty, name, title, text, tags,
                                   place, verdict, expectation, is_met,
                                   is_vacuous, note, reason, error, stopped,
                                   progress, triggers, longest_answer, run,
                                   told, page)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedAnswer, key, code, question, answer,
                                   verdict, is_fault, run, page)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedNode::Possible, verdict, time)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedNode, key, name, type, place,
                                   answers)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedFile, properties, profile, ticks,
                                   assumptions, has_faults, verdicts, answers,
                                   nodes, stopped, progress, error)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedTree, entry, not_run, file, nodes,
                                   variables, root, diagnostics, files,
                                   findings, code, seconds, peak_bytes)

namespace {

constexpr std::size_t kHashLength = 32;

struct KeptLine {
  std::string key;
  std::string tree;
};

std::string written(const std::string& key, const std::string& tree) {
  const std::string rest = key + ' ' + tree;
  return fmt::format("{} {}\n", content_hash(rest), rest);
}

// Nothing for a line that is not as it was written.
std::optional<KeptLine> line_in(std::string_view line) {
  constexpr std::size_t kTree = 2 * (kHashLength + 1);
  if (line.size() < kTree || line[kHashLength] != ' ') return std::nullopt;
  const std::string_view rest = line.substr(kHashLength + 1);
  if (content_hash(rest) != line.substr(0, kHashLength)) return std::nullopt;
  return KeptLine{std::string(rest.substr(0, kHashLength)),
                  std::string(line.substr(kTree))};
}

}  // namespace

std::string content_hash(std::string_view text) {
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string kept_text(const ReportedTree& tree) {
  using nlohmann::json;
  return json(tree).dump(-1, ' ', false, json::error_handler_t::replace);
}

std::optional<ReportedTree> tree_from(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) return std::nullopt;
  try {
    return json.get<ReportedTree>();
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;  // another version's
  }
}

KeptResults::KeptResults(std::string file, Start start)
    : file_(std::move(file)) {
  std::error_code fault;
  const bool is_there = std::filesystem::exists(file_, fault);
  if (start == Start::TakeUp && is_there) {
    const auto read = read_file(file_);
    if (read.value) {
      take_up(read.value->text);
    } else {
      ++damaged_;
    }
    if (damaged_ == 0) return;
  }
  if (is_there) complaint_ = write_file(file_, lines());
}

std::string KeptResults::lines() const {
  std::string all;
  for (const auto& [key, kept] : kept_) all += written(key, kept.tree);
  return all;
}

void KeptResults::take_up(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const auto line =
        end == text.npos ? std::nullopt : line_in(text.substr(0, end));
    if (line) {
      kept_[line->key] = {line->tree};
    } else {
      ++damaged_;
    }
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
  }
}

std::optional<ReportedTree> KeptResults::find(const std::string& key) {
  std::string text;
  {
    const std::lock_guard lock(mutex_);
    const auto found = kept_.find(key);
    if (found == kept_.end()) return std::nullopt;
    found->second.is_used = true;
    text = found->second.tree;
  }
  return tree_from(text);
}

void KeptResults::add(const std::string& key, const ReportedTree& tree) {
  std::string text = kept_text(tree);
  const std::string line = written(key, text);
  const std::lock_guard lock(mutex_);
  kept_[key] = {std::move(text), true};
  if (complaint_.empty()) complaint_ = append_file(file_, line);
}

void KeptResults::drop_unused() {
  const std::lock_guard lock(mutex_);
  const auto unused =
      std::erase_if(kept_, [](const auto& one) { return !one.second.is_used; });
  if (unused > 0 && complaint_.empty()) {
    complaint_ = write_file(file_, lines());
  }
}

std::string KeptResults::complaint() const {
  const std::lock_guard lock(mutex_);
  return complaint_;
}

}  // namespace btcheck
