// SPDX-License-Identifier: MIT
//
// What an editor has open, and what is known of it.
//
// Notifications and requests come in one thread, in their order. Three others
// follow: one lints what an edit concerns, one checks it, and one takes back
// what is not known of the new text in time. Diagnostics are sent in three
// stages: what reading tells, what a search finds, and what repairs it.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "api/call.hpp"
#include "cli/options/options.hpp"
#include "lsp/documents.hpp"
#include "lsp/workspace.hpp"
#include "serve/server.hpp"
#include "serve/wire.hpp"

namespace btcheck::lsp {

// What the user of the editor has set.
struct Wishes {
  std::string profile;        // "": as files and settings say
  bool checks_typing = true;  // else what is saved, and what is asked for
  bool tries_repairs = true;
  double seconds = 20;  // of one check; 0: no limit
};

// What the editor takes: that it is to ask again, and how far a check is.
struct Takes {
  bool lenses = false;
  bool hints = false;
  bool progress = false;
};

// All texts at one time, by their paths.
using Texts = std::shared_ptr<const Buffers>;

// A report, and the texts that it is about.
struct TimedReport {
  std::shared_ptr<const v1::Report> report;  // null: there is none yet
  Texts texts;
  std::uint64_t edit = 0;  // how many there were then
  bool is_whole = false;   // repairs were tried, and runs have their pages
};

// What is known of a subject.
struct Look {
  Subject subject;
  std::uint64_t needed = 0;  // the last edit that concerns it
  TimedReport lint;
  TimedReport check;
  // Of the last texts that could be read; null before.
  std::shared_ptr<const v1::Description> description;
  Texts described;

  bool is_linted() const { return lint.report && lint.edit >= needed; }
  bool is_checked() const { return check.report && check.edit >= needed; }
};

// What a request sees.
struct View {
  Document document;
  std::shared_ptr<const Lines> lines;
  Encoding encoding = Encoding::Utf16;
  std::vector<Look> looks;  // those of the document, the nearest first
  Texts texts;
  std::map<std::string, std::string> uris;  // of open documents, by path

  std::string uri(const std::string& path) const;
  const FileText* text(const std::string& path) const;
  Range range(TextStretch part) const { return lines->range(part, encoding); }
  // Of another file.
  Range range_in(const std::string& path, TextStretch part) const;
  // Where a place of an older text stands in the text of today; nothing where
  // one of the files is unknown.
  std::optional<TextStretch> now(const v1::Position& place,
                                 const Texts& then) const;
};

class CheckMonitor;

class Workbench {
 public:
  Workbench(Wire& wire, Options options, std::uint64_t bytes);
  ~Workbench();
  Workbench(const Workbench&) = delete;
  Workbench& operator=(const Workbench&) = delete;

  // --- What the editor tells ------------------------------------------------

  void begin(std::vector<std::string> folders, Encoding encoding,
             const Takes& takes);
  void set(const Wishes& wishes);
  void change_folders(const JsonValue& event);
  void open(const JsonValue& params);
  void change(const JsonValue& params);
  void save(const JsonValue& params);
  void close(const JsonValue& params);
  // Files were made, changed or removed beside the editor.
  void change_files(const JsonValue& params);

  // --- What it asks
  // -----------------------------------------------------------

  Encoding encoding() const { return encoding_; }
  // Throws RpcError where `textDocument` is not open.
  View view(const JsonValue& params);
  // The same, once what is known of the first of its subjects, or of all, is of
  // this text, with its runs; false where the request was cancelled, or time
  // was up.
  bool wait_for_check(const JsonValue& params, Work& work);
  // The page of a tree without a run; "" where it cannot be made.
  std::string drawn(const Look& look, Work& work);
  // Any thread may.
  void notify(std::string_view method, const Json& params);
  // A request whose answer nobody waits for.
  void demand(std::string_view method, const std::optional<Json>& params = {});

 private:
  using Clock = std::chrono::steady_clock;

  void lint_loop();
  void check_loop();
  void sweep_loop();
  // These have the lock.
  // The file as it is on the disk; as Workspace::put and remove.
  bool take_from_disk(const std::string& path);
  void edited(const std::string& path, bool concerns_others);
  void find_subjects();
  bool concerns(const Look& look, const std::string& path) const;
  Texts texts_now();
  View view_of(const std::string& path);
  void wake();
  std::optional<Subject> next_to_lint() const;
  std::optional<Subject> next_to_check() const;

  void lint(const Subject& subject, const Texts& texts, std::uint64_t edit);
  void describe(const Subject& subject, const v1::Request& request,
                const Options& options, const Texts& texts);
  v1::Request request_of(const Subject& subject) const;
  Options options_for(const Subject& subject) const;
  // What the check of a subject has come to, for those who show runs.
  void tell_check(const Subject& subject);
  bool is_news(const std::string& path) const;
  bool has_news() const;
  // Sends what there is to say of all files where it is not what was said
  // before; of an edited one in any case, once.
  void publish();
  void reread_files();

  Wire& wire_;
  Options options_;
  const std::uint64_t bytes_;
  Encoding encoding_ = Encoding::Utf16;
  Takes takes_;
  std::atomic<std::uint64_t> demands_ = 0;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool is_over_ = false;
  bool is_begun_ = false;
  Wishes wishes_;
  std::vector<std::string> folders_;
  bool folders_changed_ = false;
  Documents documents_;
  Workspace workspace_;
  std::map<Subject, Look> looks_;
  std::vector<Subject> order_;  // in which they are looked at
  std::map<std::string, std::vector<Subject>> subjects_;  // of open documents
  std::uint64_t edits_ = 0;
  Clock::time_point edited_at_;
  std::set<std::string> untold_;  // documents, since their last edit
  std::uint64_t swept_ = 0;       // the edit up to which stale words are gone
  std::set<Subject> forced_;      // to be checked although nobody types
  Texts texts_;                   // null where they have to be made anew
  std::map<std::string, std::pair<std::int64_t, std::int64_t>> stamps_;
  std::shared_ptr<CheckMonitor> checking_;

  std::mutex telling_;                       // taken before mutex_
  std::map<std::string, std::string> told_;  // by path, as it was sent last

  std::vector<std::jthread> threads_;
};

// The one of this process; begun by run_lsp.
Workbench& workbench();

}  // namespace btcheck::lsp
