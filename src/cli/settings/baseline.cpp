// SPDX-License-Identifier: MIT
//
// A file that several trees include is found in each of them: what is known of
// it is the most that one tree has, not the sum. Notes fail no check, and are
// not kept; those that an older file has are known all the same.
#include "cli/settings/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace btcheck {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::string_view kSchema = "btcheck-baseline/1";

KnownFinding finding_from(const OrderedJson& from, const std::string& folder) {
  KnownFinding finding;
  from.at("code").get_to(finding.code);
  finding.file = placed(folder, from.at("file").get<std::string>());
  from.at("node").get_to(finding.node);
  from.at("text").get_to(finding.text);
  if (!from.at("count").is_number_unsigned()) {
    throw std::invalid_argument("`count` is no number");
  }
  from.at("count").get_to(finding.count);
  return finding;
}

std::vector<KnownFinding> findings_from(const OrderedJson& file,
                                        const std::string& folder) {
  if (!file.is_object() || file.value("schema", "") != kSchema) {
    throw std::invalid_argument(fmt::format("its `schema` is not {}", kSchema));
  }
  std::vector<KnownFinding> findings;
  for (const OrderedJson& each : file.at("findings")) {
    findings.push_back(finding_from(each, folder));
  }
  return findings;
}

// Behind the library's own number: "[json.exception.out_of_range.403] ".
std::string_view words_of(std::string_view what) {
  const auto end = what.find("] ");
  return end == what.npos ? what : what.substr(end + 2);
}

struct InOrder {
  bool operator()(const KnownFinding& one, const KnownFinding& other) const {
    return one.key() < other.key();
  }
};
struct Occurrence {
  std::size_t count = 0;
  bool can_fail = false;
};
using FoundSet = std::map<KnownFinding, Occurrence, InOrder>;

// What the trees have, told or known, and how often the one that has it most.
FoundSet found_in(const std::string& directory,
                  const std::vector<const Judged*>& trees) {
  FoundSet found;
  for (const Judged* tree : trees) {
    std::vector<KnownFinding> all = tree->told;
    all.insert(all.end(), tree->known.begin(), tree->known.end());
    for (KnownFinding& each : all) each.file = placed(directory, each.file);
    for (const KnownFinding& each : counted_alike(std::move(all))) {
      Occurrence& seen = found[each];
      seen.count = std::max(seen.count, each.count);
      seen.can_fail |= each.can_fail;
    }
  }
  return found;
}

// The files that were looked at, and whether for every kind of finding.
std::map<std::string, bool> looked_at(const std::string& directory,
                                      const std::vector<const Judged*>& trees) {
  std::map<std::string, bool> files;
  for (const Judged* tree : trees) {
    for (const std::string& file : tree->files) {
      const auto [at, is_new] =
          files.emplace(placed(directory, file), tree->is_whole);
      if (!is_new) at->second = at->second && tree->is_whole;
    }
  }
  return files;
}

}  // namespace

Result<std::vector<KnownFinding>> read_baseline(const std::string& directory,
                                                const std::string& name,
                                                std::string_view text) {
  const SourceText source(name, text);
  const auto refused = [&](SourceSpan span, std::string message) {
    return Result<std::vector<KnownFinding>>{
        std::nullopt,
        {source.diagnostic(Severity::Error, "BT1511", span, std::move(message),
                           {}, "write it with btcheck --write-baseline")}};
  };
  try {
    return {counted_alike(findings_from(OrderedJson::parse(text),
                                        folder_of(directory, name))),
            {}};
  } catch (const OrderedJson::parse_error& error) {
    const std::size_t at = std::min(error.byte, text.size());
    return refused(source.span(at > 0 ? at - 1 : 0, at), "this is no JSON");
  } catch (const std::exception& fault) {
    return refused(
        {}, fmt::format("no baseline of btcheck: {}", words_of(fault.what())));
  }
}

std::string baseline_text(const std::string& directory, const std::string& name,
                          const std::vector<KnownFinding>& findings) {
  const std::string folder = folder_of(directory, name);
  std::string lines;
  for (const KnownFinding& each : findings) {
    const std::filesystem::path file(each.file);
    const OrderedJson line = {
        {"code", each.code},
        {"file", file.lexically_relative(folder).string()},
        {"node", each.node},
        {"text", each.text},
        {"count", each.count}};
    lines += lines.empty() ? "\n" : ",\n";
    lines += line.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  }
  return fmt::format("{{\"schema\":\"{}\",\n\"findings\":[{}\n]}}\n", kSchema,
                     lines);
}

BaselineChange change_of(const Judgement& said,
                         const std::vector<const Judged*>& trees) {
  const FoundSet found = found_in(said.directory, trees);
  const auto files = looked_at(said.directory, trees);
  BaselineChange change;
  for (const KnownFinding& each : said.baseline) {
    const auto file = files.find(each.file);
    const bool is_looked_for =
        file != files.end() && (file->second || each.code.starts_with("BT1"));
    const auto now = found.find(each);
    if (is_looked_for) {
      change.gone += now == found.end() || now->second.count < each.count;
    } else if (now == found.end()) {
      change.now.push_back(each);
    }
  }
  for (const auto& [finding, seen] : found) {
    if (!seen.can_fail) continue;
    change.now.push_back(finding);
    change.now.back().count = seen.count;
  }
  change.now = counted_alike(std::move(change.now));
  return change;
}

}  // namespace btcheck
