// SPDX-License-Identifier: MIT
//
// After a line that begins with #, which says where the file was begun, a line
// is `SEAL KEY TREE`: a hash of what follows it, the entry's content hash, and
// JSON, which has no line feed of its own. In the JSON each struct is an object
// with the names of its members; enumerations are their numbers.
#include "batch/kept_results.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <boost/uuid/detail/sha1.hpp>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "cli/inputs/files.hpp"
#include "cli/options/interface.hpp"

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
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ChangedLines, first, before, after)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ChangedFile, file, changes, around)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CheckedRepair, files, comes_from)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Diagnostic, severity, code, message, file,
                                   span, source_line, label, help, repair)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SearchProgress, states, expanded,
                                   transitions, depth, bytes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Place, file, span)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RelatedPlace, place, text)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ToldStep, kind, text, time, is_chosen, place)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ToldRun, steps, unit, time, loop)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Finding, code, severity, title, message,
                                   place, node, related, run, repair, identity)
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
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(KnownFinding, code, file, node, text, count)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Judged, allowed, told, known, is_denied,
                                   is_whole, has_baseline, files)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedTree, entry, not_run, file, nodes,
                                   variables, root, diagnostics, files,
                                   findings, judged, code, seconds, peak_bytes)

namespace {

constexpr std::size_t kKeyLength = 32;

using Sha1 = boost::uuids::detail::sha1;

std::string sha1(std::initializer_list<std::string_view> parts) {
  Sha1 hash;
  for (const std::string_view part : parts) {
    hash.process_bytes(part.data(), part.size());
  }
  Sha1::digest_type words;
  hash.get_digest(words);
  std::string bytes;
  for (const auto word : words) {  // words in older releases of Boost, or bytes
    for (std::size_t shift = 8 * sizeof word; shift > 0; shift -= 8) {
      bytes += static_cast<char>(word >> (shift - 8));
    }
  }
  return bytes;
}

// HMAC-SHA-1 (RFC 2104).
std::string sealed(std::string_view secret, std::string_view text) {
  constexpr std::size_t kBlock = 64;
  std::string key =
      secret.size() > kBlock ? sha1({secret}) : std::string(secret);
  key.resize(kBlock);
  std::string inner = key;
  std::string outer = key;
  for (char& c : inner) c = static_cast<char>(c ^ 0x36);
  for (char& c : outer) c = static_cast<char>(c ^ 0x5c);
  std::string seal;
  for (const char c : sha1({outer, sha1({inner, text})})) {
    seal += fmt::format("{:02x}", static_cast<unsigned char>(c));
  }
  return seal;
}

std::string hash_of_program() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  std::vector<char> block(1 << 16);
  while (program.read(block.data(), static_cast<std::streamsize>(block.size())),
         program.gcount() > 0) {
    XXH3_128bits_update(&state, block.data(),
                        static_cast<std::size_t>(program.gcount()));
  }
  const XXH128_hash_t hash = XXH3_128bits_digest(&state);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

// # btcheck 0.1.0 (build 3f…) on robot-ci in /home/me/missions
std::string heading() {
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  std::error_code fault;
  return fmt::format("# btcheck {} (build {}) on {} in {}\n", kVersion,
                     build_identity(), host,
                     std::filesystem::current_path(fault).string());
}

}  // namespace

std::string KeptResults::written(const std::string& key,
                                 const std::string& tree) const {
  const std::string rest = key + ' ' + tree;
  return fmt::format("{} {}\n", seal_of(rest), rest);
}

std::string KeptResults::seal_of(std::string_view text) const {
  return secret_.empty() ? content_hash(text) : sealed(secret_, text);
}

bool KeptResults::take_up_line(std::string_view line) {
  const std::size_t seal = line.find(' ');
  if (seal == line.npos) return false;
  const std::string_view rest = line.substr(seal + 1);
  if (rest.size() <= kKeyLength || rest[kKeyLength] != ' ' ||
      seal_of(rest) != line.substr(0, seal)) {
    return false;
  }
  kept_[std::string(rest.substr(0, kKeyLength))] = {
      std::string(rest.substr(kKeyLength + 1))};
  return true;
}

const std::string& build_identity() {
  static const std::string identity = hash_of_program();
  return identity;
}

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

KeptResults::KeptResults(std::string file, Start start, std::string secret)
    : file_(std::move(file)), secret_(std::move(secret)) {
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
  std::string all = kept_.empty() ? "" : heading();
  for (const auto& [key, kept] : kept_) all += written(key, kept.tree);
  return all;
}

void KeptResults::take_up(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const bool is_whole = end != text.npos;
    if (!is_whole || (text[0] != '#' && !take_up_line(text.substr(0, end)))) {
      ++damaged_;
    }
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
  }
}

std::optional<ReportedTree> KeptResults::find(const std::string& key) const {
  const auto found = kept_.find(key);
  if (found == kept_.end()) return std::nullopt;
  return tree_from(found->second.tree);
}

void KeptResults::use(const std::string& key) {
  if (const auto found = kept_.find(key); found != kept_.end()) {
    found->second.is_used = true;
  }
}

void KeptResults::add(const std::string& key, const ReportedTree& tree) {
  std::string text = kept_text(tree);
  const std::string line =
      (kept_.empty() ? heading() : std::string()) + written(key, text);
  kept_[key] = {std::move(text), true};
  if (complaint_.empty()) complaint_ = append_file(file_, line);
}

void KeptResults::drop_unused() {
  const auto unused =
      std::erase_if(kept_, [](const auto& one) { return !one.second.is_used; });
  if (unused > 0 && complaint_.empty()) {
    complaint_ = write_file(file_, lines());
  }
}

}  // namespace btcheck
