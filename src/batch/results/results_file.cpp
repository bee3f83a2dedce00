// SPDX-License-Identifier: MIT
//
// Lines that begin with # are for people: the first says where the file was
// begun. All others are sealed. What else lies under that name, a link or a
// pipe, is replaced, and neither read nor written through.
#include "batch/results/results_file.hpp"

#include <filesystem>
#include <utility>

#include "batch/results/kept_text.hpp"
#include "cli/inputs/files.hpp"

namespace btcheck {

ResultsFile::ResultsFile(std::string file, Start start, std::string secret)
    : file_(std::move(file)), seal_(std::move(secret)) {
  std::error_code fault;
  const bool is_there =
      std::filesystem::exists(std::filesystem::symlink_status(file_, fault));
  if (start == Start::TakeUp && is_there) {
    const bool is_link = std::filesystem::is_symlink(file_, fault);
    const auto read = is_link ? Result<InputFile>() : read_file(file_);
    if (read.value) {
      take_up(read.value->text);
    } else {
      ++damaged_;
    }
    if (damaged_ == 0) return;
  }
  if (is_there) complaint_ = replace_file(file_, lines());
}

bool ResultsFile::take_up_line(std::string_view line) {
  const auto opened = seal_.opened(line);
  if (!opened) return false;
  kept_[std::string(opened->key)] = {std::string(opened->tree)};
  return true;
}

void ResultsFile::take_up(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const bool is_whole = end != text.npos;
    if (!is_whole || (text[0] != '#' && !take_up_line(text.substr(0, end)))) {
      ++damaged_;
    }
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
  }
}

std::string ResultsFile::lines() const {
  std::string all = kept_.empty() ? "" : heading();
  for (const auto& [key, kept] : kept_) all += seal_.line(key, kept.tree);
  return all;
}

KeptResults::Found ResultsFile::find(const std::string& key) const {
  const auto found = kept_.find(key);
  if (found == kept_.end()) return {};
  return {tree_from(found->second.tree)};
}

void ResultsFile::use(const std::string& key) {
  if (const auto found = kept_.find(key); found != kept_.end()) {
    found->second.is_used = true;
  }
}

void ResultsFile::add(const std::string& key, const ReportedTree& tree) {
  if (!may_be_kept(tree)) return;
  std::string text = kept_text(tree);
  const std::string line =
      (kept_.empty() ? heading() : std::string()) + seal_.line(key, text);
  kept_[key] = {std::move(text), true};
  if (complaint_.empty() && !file_.empty()) {
    complaint_ = append_file(file_, line);
  }
}

void ResultsFile::drop_unused() {
  const auto unused =
      std::erase_if(kept_, [](const auto& one) { return !one.second.is_used; });
  for (auto& [key, one] : kept_) one.is_used = false;
  if (unused > 0 && complaint_.empty() && !file_.empty()) {
    complaint_ = replace_file(file_, lines());
  }
}

}  // namespace btcheck
