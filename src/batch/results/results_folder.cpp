// SPDX-License-Identifier: MIT
//
// A file has three lines: who has made it, of which entry in how many seconds
// (both for people, and for guesses), and what is sealed.
#include "batch/results/results_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

#include "batch/results/kept_text.hpp"
#include "cli/inputs/build.hpp"
#include "cli/inputs/files.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".result";

// The first lines, where they are not too long.
std::string head_of(const std::string& name) {
  const OpenFile file(name, O_RDONLY | O_NONBLOCK);
  if (!file.is_open() || !S_ISREG(file.mode())) return {};
  std::vector<char> block(1 << 14);
  const ssize_t count = file.read(block);
  return {block.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0))};
}

// What comes before the first line feed, which is taken away with it.
std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

// "# 12.3 s: missions/drone3.ltl"
std::string told_time(const ReportedTree& tree) {
  return fmt::format("# {:.3f} s: {}\n", tree.seconds, one_line(tree.entry));
}

}  // namespace

ResultsFolder::ResultsFolder(std::string folder, Role role,
                             double patience_seconds, std::string secret)
    : folder_(std::move(folder)),
      role_(role),
      leases_(folder_, patience_seconds),
      seal_(std::move(secret)) {
  for (const fs::path& file : files()) take_up(head_of(file));
  if (role_ == Role::Works) complaint_ = leases_.begin();
}

std::string ResultsFolder::file_of(const std::string& key) const {
  return fmt::format("{}/{}{}", folder_, key, kEnding);
}

std::vector<fs::path> ResultsFolder::files() const {
  std::vector<fs::path> all;
  std::error_code fault;
  fs::directory_iterator at(folder_, fault);
  for (; !fault && at != fs::directory_iterator(); at.increment(fault)) {
    if (at->path().extension() == kEnding) all.push_back(at->path());
  }
  return all;
}

void ResultsFolder::take_up(std::string_view head) {
  const std::string build = build_in(take_line(head));
  std::string_view told = take_line(head);
  if (!told.starts_with("# ")) return;
  told.remove_prefix(2);
  double seconds = 0;
  const auto [end, fault] =
      std::from_chars(told.data(), told.data() + told.size(), seconds);
  told.remove_prefix(static_cast<std::size_t>(end - told.data()));
  constexpr std::string_view kUnit = " s: ";
  if (fault != std::errc() || !told.starts_with(kUnit)) return;
  Earlier& earlier = earlier_[std::string(told.substr(kUnit.size()))];
  earlier.seconds = std::max(earlier.seconds, seconds);
  earlier.is_of_this_build |= build == build_identity();
}

KeptResults::Found ResultsFolder::find(const std::string& key) const {
  const std::string name = file_of(key);
  std::error_code fault;
  if (!fs::exists(fs::symlink_status(name, fault))) return {};
  const auto read = read_file_in({folder_}, name);
  std::string_view text;
  if (read.value) text = read.value->text;
  while (text.starts_with('#')) take_line(text);
  if (!text.ends_with('\n')) return {std::nullopt, true};
  text.remove_suffix(1);
  const auto opened = seal_.opened(text);
  // One that lies under the name of another is as good as damaged.
  if (!opened || opened->key != key) return {std::nullopt, true};
  auto tree = tree_from(opened->tree);
  if (tree && role_ == Role::Joins) drop_lost_pages(*tree);
  return {std::move(tree)};
}

void ResultsFolder::use(const std::string& key) {
  if (role_ == Role::Works) leases_.clear(key);
}

void ResultsFolder::add(const std::string& key, const ReportedTree& tree) {
  // Somebody else may have had more memory.
  const bool is_better = may_be_kept(tree) || !find(key).tree;
  const std::string text =
      heading() + told_time(tree) + seal_.line(key, kept_text(tree));
  const std::string problem =
      is_better ? replace_file(file_of(key), text) : std::string();
  if (problem.empty()) {
    leases_.clear(key);
  } else {
    leases_.release(key);
    complaint_ = problem;
  }
}

KeptResults::Claim ResultsFolder::claim(const std::string& key) {
  if (role_ == Role::Joins) return Claim::Nobodys;
  return leases_.claim(key) ? Claim::Ours : Claim::Others;
}

std::string ResultsFolder::why_missing(const std::string& entry,
                                       const std::string& key) const {
  if (find(key).is_damaged) {
    return fmt::format("damaged or foreign result in `{}`", folder_);
  }
  if (const std::string holder = leases_.holder_name(key); !holder.empty()) {
    return fmt::format("begun by {}", holder);
  }
  const auto known = earlier_.find(one_line(entry));
  if (known == earlier_.end()) {
    return fmt::format("no result in `{}`", folder_);
  }
  return fmt::format("result of {} in `{}`",
                     known->second.is_of_this_build ? "other inputs or options"
                                                    : "another build",
                     folder_);
}

double ResultsFolder::seconds_of(const std::string& entry) const {
  const auto known = earlier_.find(one_line(entry));
  return known == earlier_.end() ? KeptResults::seconds_of(entry)
                                 : known->second.seconds;
}

void ResultsFolder::drop_failed() {
  for (const fs::path& file : files()) {
    const Found found = find(file.stem().string());
    if (found.tree && !may_be_kept(*found.tree)) ::remove(file.c_str());
  }
}

}  // namespace btcheck
