// SPDX-License-Identifier: MIT
//
// A line is `CHECKSUM KEY TREE`: two content hashes, and JSON, which has no
// line feed of its own.
#include "batch/kept/kept_results.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "batch/kept/content_hash.hpp"
#include "batch/kept/kept_tree.hpp"
#include "cli/inputs/files.hpp"

namespace btcheck {
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
