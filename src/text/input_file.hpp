// SPDX-License-Identifier: MIT
//
// A file that has been read, and what its text was parsed into. Many stages
// look at one text: who looks for the trees it includes, who reads it, who
// edits it. Copies of a text share what it was parsed into, so that whoever
// asks first pays for it and no text is parsed twice.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <typeindex>
#include <utility>

namespace btcheck {

// A text that is never changed; a copy costs a pointer.
class FileText {
 public:
  FileText() : FileText(std::string()) {}
  FileText(std::string text) : held_(std::make_shared<Held>(std::move(text))) {}
  FileText(std::string_view text) : FileText(std::string(text)) {}
  FileText(const char* text) : FileText(std::string(text)) {}

  const std::string& text() const { return held_->text; }
  operator const std::string&() const { return held_->text; }
  operator std::string_view() const { return held_->text; }
  std::size_t size() const { return held_->text.size(); }
  bool empty() const { return held_->text.empty(); }

  friend bool operator==(const FileText& one, const FileText& other) {
    return one.held_ == other.held_ || one.text() == other.text();
  }

  // Parsed(text), made for the first who asks, in any thread. The text lives as
  // long as any copy does, so what is made of it may point into it.
  template <class Parsed>
  std::shared_ptr<const Parsed> parsed() const {
    const std::scoped_lock lock(held_->mutex);
    auto& found = held_->parsed[typeid(Parsed)];
    if (!found) {
      found = std::make_shared<const Parsed>(held_->text);
      note_parse();
    }
    return std::static_pointer_cast<const Parsed>(found);
  }
  // Gives back the memory; who asks again pays again.
  void forget_parsed() const {
    const std::scoped_lock lock(held_->mutex);
    held_->parsed.clear();
  }

 private:
  struct Held {
    explicit Held(std::string of) : text(std::move(of)) {}

    const std::string text;
    std::mutex mutex;
    std::map<std::type_index, std::shared_ptr<const void>> parsed;
  };

  void note_parse() const;

  std::shared_ptr<Held> held_;
};

// Counts, for tests, how often each text is parsed in this thread while it
// stands.
class ParseCount {
 public:
  ParseCount();
  ~ParseCount();
  ParseCount(const ParseCount&) = delete;
  ParseCount& operator=(const ParseCount&) = delete;

  const std::map<std::string, int, std::less<>>& of_texts() const {
    return of_texts_;
  }

 private:
  friend class FileText;

  std::map<std::string, int, std::less<>> of_texts_;
  ParseCount* before_;
};

struct InputFile {
  std::string name;  // as the user knows it
  FileText text;
};

}  // namespace btcheck
