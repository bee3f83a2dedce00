// SPDX-License-Identifier: MIT
#include "lsp/workbench.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <utility>

#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/process_limits.hpp"
#include "cli/options/roots.hpp"
#include "lsp/diagnostics.hpp"
#include "lsp/features.hpp"
#include "model/tree/tree.hpp"
#include "project/content.hpp"
#include "serve/asked.hpp"

namespace btcheck::lsp {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// An edit makes what is under way worth nothing. A check that lasts tells how
// far it is.
class CheckMonitor final : public v1::Monitor {
 public:
  CheckMonitor(Workbench& bench, std::string name, bool tells)
      : bench_(bench), name_(std::move(name)), tells_(tells) {}
  ~CheckMonitor() override {
    if (!token_.empty()) tell(Json{{"kind", "end"}});
  }
  CheckMonitor(const CheckMonitor&) = delete;
  CheckMonitor& operator=(const CheckMonitor&) = delete;

  bool goes_on(const v1::Progress& progress) override {
    if (is_cancelled_ || limits_of_command().overdrawn() == Spent::Memory) {
      return false;
    }
    const std::unique_lock lock(telling_, std::try_to_lock);
    if (!tells_ || !lock || progress.seconds < next_) return true;
    next_ = progress.seconds + kEvery;
    const std::string states = fmt::format("{} states", progress.states);
    if (token_.empty()) {
      static std::atomic<int> count = 0;
      token_ = fmt::format("btcheck-check-{}", ++count);
      bench_.demand("window/workDoneProgress/create", Json{{"token", token_}});
      tell(Json{{"kind", "begin"},
                {"title", "btcheck " + name_},
                {"message", states}});
    } else {
      tell(Json{{"kind", "report"}, {"message", states}});
    }
    return true;
  }
  void cancel() { is_cancelled_ = true; }
  bool is_cancelled() const { return is_cancelled_; }

 private:
  static constexpr double kEvery = 0.5;  // seconds

  void tell(const Json& value) {
    bench_.notify("$/progress", Json{{"token", token_}, {"value", value}});
  }

  Workbench& bench_;
  const std::string name_;
  const bool tells_;
  std::mutex telling_;
  double next_ = 1;  // seconds, when it is told
  std::string token_;
  std::atomic<bool> is_cancelled_ = false;
};

namespace {

// What is not known of the new text is taken back so long after an edit: with
// what the editor needs to show it, within 200 ms.
constexpr auto kStale = 170ms;
constexpr auto kLook = 50ms;
// Files that no editor tells of are looked at so often.
constexpr auto kStampInterval = 1s;

// What is told instead of a report where the call itself is wrong.
std::shared_ptr<v1::Report> refused(const Subject& subject,
                                    const std::string& why) {
  auto report = std::make_shared<v1::Report>();
  report->outcome = v1::Outcome::BadInput;
  v1::Finding finding;
  finding.code = "BT0004";
  finding.level = v1::Level::Error;
  finding.message = why;
  finding.where.file = subject.tree;
  report->findings.push_back(std::move(finding));
  return report;
}

template <class Call>
std::shared_ptr<const v1::Report> report_of(const Subject& subject, Call call) {
  try {
    return std::make_shared<v1::Report>(call());
  } catch (const std::bad_alloc&) {
    return refused(subject, "out of memory");
  } catch (const std::exception& fault) {
    return refused(subject, fault.what());
  }
}

// The report of the last check of a subject, where all is as it was then.
class LastReport final : public v1::KnownReports {
 public:
  LastReport(const Look& look, std::string& content,
             const ServedSources& sources)
      : look_(look), content_(content), sources_(sources) {}

  std::optional<v1::Report> find(const v1::Request& request,
                                 const v1::Inputs& inputs) override {
    const bool is_there = look_.check.report && look_.check.is_whole;
    if (!is_there || content_ != of(request, inputs)) return std::nullopt;
    return *look_.check.report;
  }
  std::optional<v1::Report> last(const v1::Request& /*request*/) override {
    if (!look_.check.report) return std::nullopt;
    return *look_.check.report;
  }
  void keep(const v1::Request& request, const v1::Inputs& inputs,
            const v1::Report& /*report*/) override {
    content_ = of(request, inputs);
  }

 private:
  std::string of(const v1::Request& request, const v1::Inputs& inputs) const {
    Content all;
    all.add(inputs.tree);
    all.add(inputs.rules);
    all.add(sources_.settings_text());
    all.add(fmt::format("{} {} {}", request.profile, request.tries_repairs,
                        request.seconds));
    return all.text();
  }

  const Look look_;
  std::string& content_;
  const ServedSources& sources_;
};

// What the tree of a look is made of.
bool has_node_in(const Look& look, const std::string& path) {
  return look.description &&
         std::ranges::any_of(look.description->nodes, [&](const auto& node) {
           return node.where.file == path;
         });
}

}  // namespace

// --- Views ------------------------------------------------------------------

std::string View::uri(const std::string& path) const {
  const auto open = uris.find(path);
  return open == uris.end() ? uri_of(path) : open->second;
}

const FileText* View::text(const std::string& path) const {
  const auto found = texts->find(path);
  return found == texts->end() ? nullptr : &found->second;
}

Range View::range_in(const std::string& path, TextStretch part) const {
  const FileText* found = text(path);
  return found == nullptr ? Range{}
                          : found->parsed<Lines>()->range(part, encoding);
}

std::optional<TextStretch> View::now(const v1::Position& place,
                                     const Texts& then) const {
  return Movement(*then, *texts)(place);
}

// --- The editor tells -------------------------------------------------------

Workbench::Workbench(Wire& wire, Options options, std::uint64_t bytes)
    : wire_(wire), options_(std::move(options)), bytes_(bytes) {
  threads_.emplace_back([this] { lint_loop(); });
  threads_.emplace_back([this] { check_loop(); });
  threads_.emplace_back([this] { sweep_loop(); });
}

Workbench::~Workbench() {
  const std::scoped_lock lock(mutex_);
  is_over_ = true;
  if (checking_) checking_->cancel();
  changed_.notify_all();
}

void Workbench::begin(std::vector<std::string> folders, Encoding encoding,
                      const Takes& takes) {
  const std::scoped_lock lock(mutex_);
  encoding_ = encoding;
  takes_ = takes;
  folders_ = std::move(folders);
  folders_changed_ = true;
  is_begun_ = true;
  wake();
}

void Workbench::set(const Wishes& wishes) {
  const std::scoped_lock lock(mutex_);
  wishes_ = wishes;
  ++edits_;
  for (auto& [subject, look] : looks_) look.needed = edits_;
  wake();
}

void Workbench::change_folders(const JsonValue& event) {
  const std::scoped_lock lock(mutex_);
  const auto each = [&](std::string_view which, auto act) {
    const JsonValue* list = event.member(which);
    if (list == nullptr) return;
    for (const JsonValue& folder : list->items)
      act(path_of(folder.word("uri")));
  };
  each("removed", [&](const std::string& path) { std::erase(folders_, path); });
  each("added", [&](std::string path) { folders_.push_back(std::move(path)); });
  folders_changed_ = true;
  wake();
}

void Workbench::open(const JsonValue& params) {
  const std::scoped_lock lock(mutex_);
  const std::string path = documents_.open(params);
  workspace_.put(path, documents_.find(path)->text);
  edited(path, true);
}

void Workbench::change(const JsonValue& params) {
  const std::scoped_lock lock(mutex_);
  const std::string path = documents_.change(params, encoding_);
  edited(path, workspace_.put(path, documents_.find(path)->text));
}

void Workbench::save(const JsonValue& params) {
  const std::scoped_lock lock(mutex_);
  const JsonValue* told = params.member("textDocument");
  if (told == nullptr) return;
  const auto subjects = subjects_.find(path_of(told->word("uri")));
  if (subjects == subjects_.end()) return;
  forced_.insert(subjects->second.begin(), subjects->second.end());
  wake();
}

void Workbench::close(const JsonValue& params) {
  const std::scoped_lock lock(mutex_);
  const std::string path = documents_.close(params);
  untold_.erase(path);
  edited(path, take_from_disk(path));
  find_subjects();
}

void Workbench::change_files(const JsonValue& params) {
  const std::scoped_lock lock(mutex_);
  const JsonValue* changes = params.member("changes");
  if (changes == nullptr) return;
  for (const JsonValue& change : changes->items) {
    const std::string path = path_of(change.word("uri"));
    if (documents_.find(path) != nullptr) continue;
    take_from_disk(path);
    // Settings and packages are nothing that is known here.
    edited(path, true);
  }
}

bool Workbench::take_from_disk(const std::string& path) {
  const auto file = read_file(path);
  return file.value ? workspace_.put(path, file.value->text)
                    : workspace_.remove(path);
}

// --- What is known -----------------------------------------------------------

bool Workbench::concerns(const Look& look, const std::string& path) const {
  if (look.subject.tree == path || look.subject.rules == path) return true;
  switch (kind_of(path, {})) {
    case FileKind::Xml:
      return has_node_in(look, path);
    case FileKind::Leaves:
      return true;
    case FileKind::Rules:
    case FileKind::Btf:
      return false;
    case FileKind::Other:
      break;
  }
  return path.ends_with(".toml");
}

void Workbench::edited(const std::string& path, bool concerns_others) {
  ++edits_;
  edited_at_ = Clock::now();
  texts_.reset();
  if (documents_.find(path) != nullptr) untold_.insert(path);
  bool is_concerned = concerns_others;
  for (auto& [subject, look] : looks_) {
    if (!concerns_others && !concerns(look, path)) continue;
    look.needed = edits_;
    is_concerned = true;
  }
  // What is edited has the next check, whatever the one under way is about.
  if (checking_ && is_concerned) checking_->cancel();
  if (concerns_others) find_subjects();
  // What is edited comes first.
  const auto own = subjects_.find(path);
  if (own != subjects_.end()) {
    std::stable_partition(order_.begin(), order_.end(),
                          [&](const Subject& each) {
                            return std::ranges::count(own->second, each) > 0;
                          });
  }
  wake();
}

// Whether all that reading tells of an edited document is known.
bool Workbench::is_news(const std::string& path) const {
  const auto own = subjects_.find(path);
  return own == subjects_.end() ||
         std::ranges::all_of(own->second, [&](const Subject& each) {
           return looks_.at(each).is_linted();
         });
}

bool Workbench::has_news() const {
  return std::ranges::any_of(
      untold_, [&](const std::string& path) { return is_news(path); });
}

void Workbench::find_subjects() {
  subjects_.clear();
  std::set<Subject> wanted;
  std::vector<Subject> order;
  for (const auto& [path, document] : documents_.all()) {
    auto& own = subjects_[path];
    own = workspace_.subjects_of(document);
    for (const Subject& each : own) {
      if (wanted.insert(each).second) order.push_back(each);
    }
  }
  std::erase_if(
      looks_, [&](const auto& known) { return !wanted.contains(known.first); });
  for (const Subject& subject : order) {
    const auto [look, is_new] = looks_.try_emplace(subject);
    if (!is_new) continue;
    look->second.subject = subject;
    look->second.needed = edits_;
  }
  order_ = std::move(order);
}

Texts Workbench::texts_now() {
  if (!texts_) {
    auto all = std::make_shared<Buffers>(documents_.buffers());
    for (const auto& [path, text] : workspace_.files()) {
      all->try_emplace(path, text);
    }
    texts_ = std::move(all);
  }
  return texts_;
}

void Workbench::wake() { changed_.notify_all(); }

std::optional<Subject> Workbench::next_to_lint() const {
  const auto found = std::ranges::find_if(order_, [&](const Subject& each) {
    return !looks_.at(each).is_linted();
  });
  return found == order_.end() ? std::nullopt : std::optional(*found);
}

std::optional<Subject> Workbench::next_to_check() const {
  const auto found = std::ranges::find_if(order_, [&](const Subject& each) {
    const Look& look = looks_.at(each);
    const bool is_wanted =
        wishes_.checks_typing || forced_.contains(each) || !look.check.report;
    return is_wanted && look.is_linted() &&
           (!look.is_checked() || !look.check.is_whole);
  });
  return found == order_.end() ? std::nullopt : std::optional(*found);
}

v1::Request Workbench::request_of(const Subject& subject) const {
  v1::Request request;
  request.tree = subject.tree;
  request.main_tree = subject.main_tree;
  if (!subject.rules.empty()) request.rules = {subject.rules};
  // A tree of the other language has nothing to do with it.
  const bool is_btf = subject.tree.ends_with(".btf");
  if (is_btf == (wishes_.profile == profile_name(Profile::Paper))) {
    request.profile = wishes_.profile;
  }
  request.tries_repairs = wishes_.tries_repairs;
  request.seconds = wishes_.seconds;
  if (options_.timeout > 0 && options_.timeout < request.seconds) {
    request.seconds = options_.timeout;
  }
  if (options_.max_states != UINT64_MAX) request.states = options_.max_states;
  request.bytes = bytes_;
  request.directory = current_directory();
  return request;
}

// Where its texts may lie: in the folders of the editor; of a document that
// lies in none of them, in its repository or folder.
Options Workbench::options_for(const Subject& subject) const {
  Options options = options_;
  if (options.given.contains("--root")) return options;
  options.roots = folders_;
  const bool is_inside =
      std::ranges::any_of(folders_, [&](const std::string& folder) {
        return subject.tree.starts_with(folder + "/");
      });
  if (!is_inside) {
    const std::string folder = fs::path(subject.tree).parent_path().string();
    const std::string repository = repository_of(folder);
    options.roots.push_back(repository.empty() ? folder : repository);
  }
  return options;
}

// --- Threads ---------------------------------------------------------------

// Files that have changed and no editor has told it.
void Workbench::reread_files() {
  std::unique_lock lock(mutex_);
  std::vector<std::string> paths;
  for (const auto& [path, text] : workspace_.files()) {
    if (documents_.find(path) == nullptr) paths.push_back(path);
  }
  lock.unlock();
  for (const std::string& path : paths) {
    struct stat found {};
    std::pair<std::int64_t, std::int64_t> stamp{};
    if (::stat(path.c_str(), &found) == 0) {
      stamp = {found.st_mtim.tv_sec * 1'000'000'000 + found.st_mtim.tv_nsec,
               found.st_size};
    }
    lock.lock();
    const auto [known, is_new] = stamps_.try_emplace(path, stamp);
    const bool is_other = !is_new && known->second != stamp;
    known->second = stamp;
    if (is_other && documents_.find(path) == nullptr) {
      edited(path, take_from_disk(path));
    }
    lock.unlock();
  }
}

void Workbench::lint_loop() {
  auto next_reading = Clock::now();
  std::unique_lock lock(mutex_);
  while (!is_over_) {
    if (!is_begun_) {
      changed_.wait(lock);
      continue;
    }
    if (folders_changed_) {
      folders_changed_ = false;
      const auto folders = folders_;
      lock.unlock();
      Workspace read;
      read.read(folders);
      lock.lock();
      workspace_ = std::move(read);
      for (const auto& [path, document] : documents_.all()) {
        workspace_.put(path, document.text);
      }
      texts_.reset();
      find_subjects();
      continue;
    }
    const auto subject = next_to_lint();
    if (!subject && has_news()) {  // of what no tree has to do with
      lock.unlock();
      publish();
      lock.lock();
      continue;
    }
    if (!subject) {
      const bool is_quiet =
          changed_.wait_for(lock, kStampInterval) == std::cv_status::timeout;
      if (is_quiet && Clock::now() >= next_reading) {
        next_reading = Clock::now() + kStampInterval;
        lock.unlock();
        reread_files();
        lock.lock();
      }
      continue;
    }
    const Texts texts = texts_now();
    const std::uint64_t edit = edits_;
    lock.unlock();
    lint(*subject, texts, edit);
    lock.lock();
  }
}

void Workbench::lint(const Subject& subject, const Texts& texts,
                     std::uint64_t edit) {
  std::unique_lock lock(mutex_);
  v1::Request request = request_of(subject);
  const Options options = options_for(subject);
  lock.unlock();
  request.tries_repairs = false;
  ServedSources sources(options, {}, *texts);
  const auto report =
      report_of(subject, [&] { return v1::linted(request, sources, nullptr); });
  lock.lock();
  const auto found = looks_.find(subject);
  if (found == looks_.end()) return;
  found->second.lint = {report, texts, edit, true};
  changed_.notify_all();
  const bool is_due = has_news();
  lock.unlock();
  if (is_due) publish();
  lock.lock();
  const auto look = looks_.find(subject);
  const bool is_old = look == looks_.end() || !look->second.is_linted();
  lock.unlock();
  if (report->outcome != v1::Outcome::BadInput && !is_old) {
    describe(subject, request, options, texts);
  }
}

void Workbench::describe(const Subject& subject, const v1::Request& request,
                         const Options& options, const Texts& texts) {
  ServedSources sources(options, {}, *texts);
  std::shared_ptr<const v1::Description> made;
  try {
    made = std::make_shared<v1::Description>(
        v1::described(request, sources, nullptr));
  } catch (const std::exception&) {
    return;  // the report has said why
  }
  const std::scoped_lock lock(mutex_);
  const auto found = looks_.find(subject);
  if (found == looks_.end() || made->outcome != v1::Outcome::Met) return;
  found->second.description = std::move(made);
  found->second.described = texts;
}

void Workbench::check_loop() {
  std::map<Subject, std::string> contents;  // of the last reports
  std::unique_lock lock(mutex_);
  while (!is_over_) {
    const auto subject = is_begun_ ? next_to_check() : std::nullopt;
    if (!subject) {
      changed_.wait(lock);
      continue;
    }
    std::erase_if(contents, [&](const auto& known) {
      return !looks_.contains(known.first);
    });
    checking_ = std::make_shared<CheckMonitor>(
        *this, fs::path(subject->tree).filename().string(), takes_.progress);
    auto monitor = checking_;
    const Texts texts = texts_now();
    const std::uint64_t edit = edits_;
    const Look before = looks_.at(*subject);
    const v1::Request request = request_of(*subject);
    const Options options = options_for(*subject);
    lock.unlock();
    ServedSources sources(options, {}, *texts);
    LastReport last(before, contents[*subject], sources);
    const auto keep = [&](std::shared_ptr<const v1::Report> report,
                          bool is_whole) {
      if (monitor->is_cancelled()) return;
      {
        const std::scoped_lock keeping(mutex_);
        const auto found = looks_.find(*subject);
        if (found == looks_.end()) return;
        found->second.check = {std::move(report), texts, edit, is_whole};
        if (is_whole) forced_.erase(*subject);
        changed_.notify_all();
      }
      publish();
      if (is_whole) tell_check(*subject);
    };
    const auto report = report_of(*subject, [&] {
      return v1::checked(request, sources, monitor.get(), &last,
                         [&](const v1::Report& first) {
                           keep(std::make_shared<v1::Report>(first), false);
                         });
    });
    keep(report, true);
    lock.lock();
    checking_.reset();
    lock.unlock();
    monitor.reset();  // tells that it has ended
    lock.lock();
  }
}

void Workbench::sweep_loop() {
  std::unique_lock lock(mutex_);
  while (!is_over_) {
    if (swept_ == edits_) {
      changed_.wait(lock);
      continue;
    }
    const auto due = edited_at_ + kStale;
    if (Clock::now() < due) {
      changed_.wait_until(lock, due);
      continue;
    }
    swept_ = edits_;
    lock.unlock();
    publish();
    lock.lock();
  }
}

// --- Telling ---------------------------------------------------------------

void Workbench::notify(std::string_view method, const Json& params) {
  wire_.send(notification_text(method, params));
}

void Workbench::demand(std::string_view method,
                       const std::optional<Json>& params) {
  Json message{{"jsonrpc", "2.0"},
               {"id", fmt::format("btcheck-{}", ++demands_)},
               {"method", method}};
  if (params) message.add("params", *params);
  wire_.send(message.text());
}

void Workbench::publish() {
  const std::scoped_lock telling(telling_);
  std::map<std::string, std::string> all;  // by path, as JSON
  std::vector<std::pair<std::string, std::string>> messages;
  {
    const std::scoped_lock lock(mutex_);
    const Texts texts = texts_now();
    DiagnosticList list(*texts, documents_, encoding_);
    for (const auto& [of, document] : documents_.all()) {
      if (document.kind == FileKind::Other) {
        untold_.erase(of);
      } else {
        list.add_file(of, document.kind);
      }
    }
    for (const Subject& subject : order_) {
      const Look& look = looks_.at(subject);
      // What is not known of this text stays for a moment.
      const bool keeps_stale = swept_ != edits_;
      if (look.lint.report && (look.is_linted() || keeps_stale)) {
        list.add(*look.lint.report, *look.lint.texts);
      }
      if (look.check.report && (look.is_checked() || keeps_stale)) {
        list.add(*look.check.report, *look.check.texts);
      }
    }
    all = list.take();
    for (const auto& [of, told] : told_) all.try_emplace(of, "[]");
    for (const auto& [of, diagnostics] : all) {
      const auto before = told_.find(of);
      const bool is_same =
          before == told_.end() ? false : before->second == diagnostics;
      const bool is_awaited = untold_.contains(of) && is_news(of);
      if (is_same && !is_awaited) continue;
      if (is_awaited) untold_.erase(of);
      const Document* open = documents_.find(of);
      const std::string version =
          open == nullptr ? std::string()
                          : fmt::format(R"("version":{},)", open->version);
      messages.emplace_back(
          of, fmt::format(
                  R"({{"jsonrpc":"2.0","method":)"
                  R"("textDocument/publishDiagnostics","params":{{"uri":{},)"
                  R"({}"diagnostics":{}}}}})",
                  Json(documents_.uri(of)).text(), version, diagnostics));
    }
    for (const auto& [of, diagnostics] : all) {
      if (diagnostics == "[]" && documents_.find(of) == nullptr) {
        told_.erase(of);
      } else {
        told_[of] = diagnostics;
      }
    }
  }
  for (const auto& [of, message] : messages) wire_.send(message);
}

// --- Asked ------------------------------------------------------------------

View Workbench::view(const JsonValue& params) {
  const JsonValue* told = params.member("textDocument");
  if (told == nullptr) {
    throw RpcError(rpc::kInvalidParams, "`textDocument` is needed");
  }
  const std::string path = path_of(needed_text(*told, "uri"));
  const std::scoped_lock lock(mutex_);
  if (documents_.find(path) == nullptr) {
    throw RpcError(rpc::kInvalidParams, "the document is not open");
  }
  return view_of(path);
}

View Workbench::view_of(const std::string& path) {
  const Document* open = documents_.find(path);
  View view;
  view.document = *open;
  view.lines = open->lines();
  view.encoding = encoding_;
  view.texts = texts_now();
  for (const Subject& each : subjects_[path]) {
    view.looks.push_back(looks_.at(each));
  }
  for (const auto& [of, document] : documents_.all()) {
    view.uris[of] = document.uri;
  }
  return view;
}

void Workbench::tell_check(const Subject& subject) {
  if (takes_.lenses) demand("workspace/codeLens/refresh");
  if (takes_.hints) demand("workspace/inlayHint/refresh");
  std::vector<std::pair<std::string, View>> views;
  {
    const std::scoped_lock lock(mutex_);
    for (const auto& [path, subjects] : subjects_) {
      if (std::ranges::count(subjects, subject) > 0) {
        views.emplace_back(documents_.uri(path), view_of(path));
      }
    }
  }
  for (const auto& [uri, view] : views) {
    notify("btcheck/runs", Json{{"uri", uri}, {"runs", runs(view)}});
  }
}

std::string Workbench::drawn(const Look& look, Work& work) {
  std::unique_lock lock(mutex_);
  v1::Request request = request_of(look.subject);
  const Options options = options_for(look.subject);
  const Texts texts = texts_now();
  lock.unlock();
  request.rules.clear();
  ServedSources sources(options, {}, *texts);
  v1::Plan plan;
  plan.ticks = 1;
  return v1::simulated(request, plan, sources, &work).html();
}

bool Workbench::wait_for_check(const JsonValue& params, Work& work) {
  const JsonValue* told = params.member("textDocument");
  const std::string path =
      told == nullptr ? std::string() : path_of(told->word("uri"));
  std::unique_lock lock(mutex_);
  const auto subjects = subjects_[path];
  forced_.insert(subjects.begin(), subjects.end());
  wake();
  const auto is_known = [&] {
    return std::ranges::all_of(subjects, [&](const Subject& each) {
      const auto look = looks_.find(each);
      return look == looks_.end() ||
             (look->second.is_checked() && look->second.check.is_whole);
    });
  };
  while (!is_over_ && !work.is_cancelled()) {
    if (is_known()) return true;
    changed_.wait_for(lock, kLook);
  }
  return false;
}

}  // namespace btcheck::lsp
