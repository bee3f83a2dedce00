// SPDX-License-Identifier: MIT
#include "cli/inputs/file_changes.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/inotify.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <utility>

#include "cli/inputs/inputs.hpp"
#include "cli/inputs/process_limits.hpp"
#include "model/tree_file.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// A save is over when nothing has happened for so long; whoever writes on and
// on is not waited for.
constexpr std::chrono::milliseconds kQuiet{30};
constexpr std::chrono::milliseconds kMostUnquiet{1000};
constexpr int kMostLinks = 40;  // as the kernel follows

// What names of files tell, and what else changes a file.
constexpr std::uint32_t kNames =
    IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO | IN_ONLYDIR;
constexpr std::uint32_t kContents = kNames | IN_CLOSE_WRITE | IN_ATTRIB;

// "." for a name without a folder.
std::string folder_with(const fs::path& file) {
  const std::string folder = file.parent_path().string();
  return folder.empty() ? "." : folder;
}

// Without slashes at its end.
std::string plain(const std::string& name) {
  fs::path path = fs::path(name).lexically_normal();
  if (!path.has_filename() && path.has_parent_path()) path = path.parent_path();
  return path.empty() ? "." : path.string();
}

std::string name_in(const std::string& folder, std::string_view name) {
  return (fs::path(folder) / name).lexically_normal().string();
}

// Of a folder that was listed: what an editor keeps beside a file is hidden, or
// has another ending.
bool may_count(std::string_view name, bool is_folder) {
  if (name.starts_with('.')) return false;
  const std::string file(name);
  return is_folder || is_tree_name(file) || is_property_file(file) ||
         name.ends_with(".toml");
}

// The folder that it lies in, "" for the root.
std::string folder_above(const std::string& folder) {
  std::error_code fault;
  const fs::path path = fs::absolute(folder, fault).lexically_normal();
  const std::string whole = plain(path.string());
  return whole == "/" ? "" : folder_with(whole);
}

std::string limit_of_watches() {
  const auto read = read_file("/proc/sys/fs/inotify/max_user_watches");
  if (!read.value) return {};
  std::string text = read.value->text;
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

}  // namespace

FileChanges::FileChanges()
    : inotify_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
  if (inotify_.is_open()) return;
  flaw_ = errno == EMFILE ? "too many programs of yours watch files: see "
                            "fs.inotify.max_user_instances"
                          : std::strerror(errno);
}

// A link counts by its own name, and by those that it leads to.
void FileChanges::add_file(Folders& to, const std::string& name,
                           const std::string& shown) {
  fs::path file = name;
  for (int i = 0; i < kMostLinks; ++i) {
    to[plain(folder_with(file))].names[file.filename().string()].insert(shown);
    std::error_code fault;
    const fs::path target = fs::read_symlink(file, fault);
    if (fault) return;
    file = plain(file.parent_path() / target);
  }
}

void FileChanges::add_above(Folders& to) {
  std::vector<std::string> folders;
  for (const auto& [folder, counts] : to) folders.push_back(folder);
  for (const std::string& folder : folders) {
    std::string shown = folder;
    std::error_code fault;
    for (std::string at = folder; !at.empty();) {
      // A folder that is a link has another place as well.
      const std::string above = folder_above(at);
      if (above.empty()) break;
      const fs::path whole = fs::absolute(at, fault).lexically_normal();
      auto& names =
          to[above].names[plain(whole.string())
                              .substr(above == "/" ? 1 : above.size() + 1)];
      if (!names.insert(shown).second) break;
      at = above;
    }
  }
}

bool FileChanges::watch(const LookedAt& names) {
  Folders wanted;
  for (const std::string& folder : names.folders) {
    wanted[plain(folder)].is_listed = true;
  }
  for (const std::string& file : names.files) {
    add_file(wanted, plain(file), plain(file));
  }
  std::set<std::string> near;  // of which more counts than a name
  for (const auto& [folder, counts] : wanted) near.insert(folder);
  add_above(wanted);
  std::map<int, std::vector<std::string>> watched;
  flaw_.clear();
  std::size_t failed = 0;
  bool has_new = false;
  for (const auto& [folder, counts] : wanted) {
    const bool is_near = near.contains(folder);
    int number =
        ::inotify_add_watch(inotify_.number(), folder.c_str(),
                            IN_MASK_ADD | (is_near ? kContents : kNames));
    if (number < 0) {
      if (is_near) note_flaw(folder, errno, failed);
      continue;
    }
    has_new = has_new || (is_near && !watched_.contains(number));
    watched[number].push_back(folder);
  }
  for (const auto& [number, folders] : watched_) {
    if (!watched.contains(number)) {
      ::inotify_rm_watch(inotify_.number(), number);
    }
  }
  if (failed > 1) flaw_ += fmt::format("; nor {} more folders", failed - 1);
  watched_ = std::move(watched);
  folders_ = std::move(wanted);
  return has_new;
}

// Of what is not there the folder above tells when it comes.
void FileChanges::note_flaw(const std::string& folder, int reason,
                            std::size_t& failed) {
  if (reason == ENOENT || reason == ENOTDIR || ++failed > 1) return;
  flaw_ = fmt::format(
      "`{}` cannot be watched: {}", folder,
      reason == ENOSPC
          ? fmt::format("more than fs.inotify.max_user_watches, {}, are in use",
                        limit_of_watches())
          : std::strerror(reason));
}

void FileChanges::take_event(int number, std::uint32_t kind,
                             std::string_view name,
                             std::set<std::string>& changed) {
  if ((kind & IN_Q_OVERFLOW) != 0) {
    for (const auto& [folder, counts] : folders_) {
      if (counts.is_listed) changed.insert(folder);
      for (const auto& [file, shown] : counts.names) {
        changed.insert(shown.begin(), shown.end());
      }
    }
    return;
  }
  const auto watched = watched_.find(number);
  if (watched == watched_.end() || name.empty()) return;
  for (const std::string& folder : watched->second) {
    const Folder& counts = folders_.at(folder);
    if (const auto known = counts.names.find(name);
        known != counts.names.end()) {
      changed.insert(known->second.begin(), known->second.end());
    } else if (counts.is_listed && may_count(name, (kind & IN_ISDIR) != 0)) {
      changed.insert(name_in(folder, name));
    }
  }
}

std::set<std::string> FileChanges::take() {
  std::set<std::string> changed;
  alignas(inotify_event) char block[1 << 14];
  for (ssize_t count; (count = inotify_.read(block)) > 0;) {
    for (const char* at = block; at < block + count;) {
      inotify_event event;
      std::memcpy(&event, at, sizeof event);
      const char* const name = at + sizeof event;
      take_event(event.wd, event.mask,
                 event.len == 0 ? std::string_view() : std::string_view(name),
                 changed);
      at = name + event.len;
    }
  }
  return changed;
}

// An interrupt must not come between the question whether there was one and the
// wait: it is let in while waiting only.
bool FileChanges::await(std::chrono::milliseconds patience,
                        bool hears_interrupts) const {
  sigset_t all;
  sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before);
  int ready = 0;
  if (!hears_interrupts || !InterruptWatch::is_interrupted()) {
    pollfd file{inotify_.number(), POLLIN, 0};
    const timespec time{patience.count() / 1000,
                        patience.count() % 1000 * 1'000'000};
    ready = ::ppoll(&file, 1, patience.count() < 0 ? nullptr : &time, &before);
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return ready > 0;
}

std::set<std::string> FileChanges::wait() {
  std::set<std::string> changed;
  while (changed.empty() && !InterruptWatch::is_interrupted()) {
    if (await(std::chrono::milliseconds(-1), true)) changed = take();
  }
  if (!changed.empty()) settle(changed);
  return changed;
}

void FileChanges::settle(std::set<std::string>& changed) {
  const Clock::time_point end = Clock::now() + kMostUnquiet;
  while (Clock::now() < end && await(kQuiet, true)) {
    changed.merge(take());
  }
}

}  // namespace btcheck
