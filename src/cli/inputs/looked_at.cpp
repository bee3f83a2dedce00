// SPDX-License-Identifier: MIT
#include "cli/inputs/looked_at.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace btcheck {
namespace {

thread_local LookedAt* gathered = nullptr;

}  // namespace

void LookedAt::add(const LookedAt& more) {
  files.insert(more.files.begin(), more.files.end());
  folders.insert(more.folders.begin(), more.folders.end());
}

// No name that is read has a line break.
std::string LookedAt::text() const {
  std::string all;
  for (const std::string& file : files) all += file + '\n';
  for (const std::string& folder : folders) all += folder + "/\n";
  return all;
}

LookedAt LookedAt::from_text(std::string_view text) {
  LookedAt all;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string name(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (name.ends_with('/')) {
      name.pop_back();
      all.folders.insert(std::move(name));
    } else {
      all.files.insert(std::move(name));
    }
  }
  return all;
}

void LookedAt::note_file(const std::string& name) {
  if (gathered == nullptr || name.find('\n') != name.npos) return;
  gathered->files.insert(name);
}

void LookedAt::note_folder(const std::string& name) {
  if (gathered == nullptr || name.find('\n') != name.npos) return;
  gathered->folders.insert(name.empty() ? "." : name);
}

LookingOn::LookingOn() : before_(gathered) { gathered = &seen_; }

LookingOn::~LookingOn() { gathered = before_; }

}  // namespace btcheck
