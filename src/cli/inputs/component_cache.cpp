// SPDX-License-Identifier: MIT
//
// A row is found by 64 bits of a hash of the build and the content, and holds
// another 64, by which it is known for sure; the bytes have a seal of their own
// (explore/components/component_bytes). `used` is when they were of use last,
// in seconds: who finds them writes that anew an hour later at the earliest, so
// that who only reads hardly ever writes.
//
// Rows are gathered and written in one transaction, which is there as a whole
// or not at all, whoever is killed. It is not waited for the disk: a power cut
// may damage the database, and then it is made anew. A file that is no database
// of ours is taken for a damaged one, as its name is ours.
#include "cli/inputs/component_cache.hpp"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <exception>
#include <filesystem>
#include <utility>

#include "cli/console/console.hpp"
#include "cli/inputs/build.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kName = "btcheck-components.sqlite";
constexpr const char* kTable =
    "CREATE TABLE parts(id INTEGER PRIMARY KEY, rest INTEGER NOT NULL, used "
    "INTEGER NOT NULL, bytes BLOB NOT NULL)";
constexpr const char* kIndex = "CREATE INDEX by_use ON parts(used)";

constexpr std::size_t kGathered = std::size_t{4} << 20;
constexpr std::size_t kMostGathered = std::size_t{64} << 20;
constexpr int kMostRowBytes = 64 << 20;
constexpr std::int64_t kSecondsToKeepUsed = 3600;
constexpr std::int64_t kPageBytes = 4096;
constexpr int kBusyMilliseconds = 1000;
constexpr int kMostTimesBusy = 3;

std::vector<std::int32_t> numbers_of(const std::string& text) {
  return {text.begin(), text.end()};
}

// What SQLite says of a file that it cannot make sense of.
bool is_damage(int code) {
  return code == SQLITE_CORRUPT || code == SQLITE_NOTADB ||
         code == SQLITE_ERROR;
}

std::int64_t now() { return static_cast<std::int64_t>(std::time(nullptr)); }

}  // namespace

// --- Opened and closed -------------------------------------------------------

void ComponentCache::CloseBase::operator()(sqlite3* base) const {
  sqlite3_close_v2(base);
}

void ComponentCache::CloseStatement::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

ComponentCache::ComponentCache(const std::string& folder,
                               const std::string& build,
                               std::uint64_t most_bytes)
    : file_((fs::path(folder) / kName).string()),
      build_(numbers_of(build)),
      most_bytes_(most_bytes) {}

ComponentCache::~ComponentCache() {
  try {
    write();
  } catch (const std::exception&) {
    // It was not written, which is no harm.
  }
}

void ComponentCache::try_out() {
  const std::lock_guard lock(mutex_);
  if (is_open()) close();
}

void ComponentCache::close() {
  find_.reset();
  base_.reset();
}

// A database that was opened before a fork is nobody's behind it.
bool ComponentCache::is_open() {
  if (is_given_up_) return false;
  if (base_ == nullptr) return open();
  if (opened_by_ == ::getpid()) return true;
  static_cast<void>(find_.release());
  static_cast<void>(base_.release());
  give_up("it was opened before a fork");
  return false;
}

bool ComponentCache::open() {
  std::error_code fault;
  const auto kind = fs::symlink_status(file_, fault).type();
  if (kind != fs::file_type::not_found && kind != fs::file_type::regular) {
    give_up("it is no file");
    return false;
  }
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(
      file_.c_str(), &opened,
      SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX,
      nullptr);
  base_.reset(opened);
  opened_by_ = ::getpid();
  if (code != SQLITE_OK) {
    give_up(opened == nullptr ? "out of memory" : sqlite3_errmsg(opened));
    return false;
  }
  sqlite3_busy_timeout(opened, kBusyMilliseconds);
  for (const auto& [option, value] :
       {std::pair(SQLITE_DBCONFIG_DEFENSIVE, 1),
        std::pair(SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0),
        std::pair(SQLITE_DBCONFIG_ENABLE_TRIGGER, 0),
        std::pair(SQLITE_DBCONFIG_ENABLE_VIEW, 0)}) {
    sqlite3_db_config(opened, option, value, nullptr);
  }
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, kMostRowBytes + 1024);
  for (const char* setting :
       {"PRAGMA cell_size_check=ON", "PRAGMA synchronous=OFF",
        "PRAGMA temp_store=MEMORY", "PRAGMA cache_size=-2048",
        "PRAGMA page_size=4096"}) {
    run(setting);
  }
  if (sqlite3_db_readonly(opened, "main") == 1) {
    is_read_only_ = true;
    complaint_ = "nothing new is kept: it may not be written to";
  }
  if (!has_table() && !make_table()) {
    if (is_given_up_ || !make_anew()) return false;
  }
  run(fmt::format("PRAGMA max_page_count={}",
                  std::max<std::uint64_t>(most_bytes_ / kPageBytes, 16))
          .c_str());
  find_ = made("SELECT rest, used, bytes FROM parts WHERE id = ?1");
  if (find_ == nullptr) give_up(sqlite3_errmsg(opened));
  return find_ != nullptr;
}

bool ComponentCache::run(const char* order) {
  return sqlite3_exec(base_.get(), order, nullptr, nullptr, nullptr) ==
         SQLITE_OK;
}

ComponentCache::Statement ComponentCache::made(const char* order) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(base_.get(), order, -1, &statement, nullptr);
  return Statement(statement);
}

std::optional<std::string> ComponentCache::text_of(const char* question) {
  const Statement asked = made(question);
  if (asked == nullptr) return std::nullopt;
  std::string all;
  int code = SQLITE_OK;
  while ((code = sqlite3_step(asked.get())) == SQLITE_ROW) {
    const auto* text =
        reinterpret_cast<const char*>(sqlite3_column_text(asked.get(), 0));
    if (text != nullptr) all += text;
    all += '\n';
  }
  return code == SQLITE_DONE ? std::optional(std::move(all)) : std::nullopt;
}

std::int64_t ComponentCache::number_of(const char* question) {
  const auto text = text_of(question);
  return text ? std::strtoll(text->c_str(), nullptr, 10) : 0;
}

bool ComponentCache::has_table() {
  const auto all = text_of("SELECT sql FROM sqlite_master ORDER BY rowid");
  return all && *all == fmt::format("{}\n{}\n", kTable, kIndex);
}

// In an empty database, or one in which another process has just made it.
// False for any other, which is damaged.
bool ComponentCache::make_table() {
  std::optional<std::string> there;
  if (run("BEGIN IMMEDIATE")) {
    there = text_of("SELECT name FROM sqlite_master");
    const bool is_ready =
        has_table() || (there && there->empty() && run(kTable) && run(kIndex));
    if (is_ready && run("COMMIT")) return true;
  }
  const int code = sqlite3_errcode(base_.get());
  const std::string why = sqlite3_errmsg(base_.get());
  if (sqlite3_get_autocommit(base_.get()) == 0) run("ROLLBACK");
  const bool is_another = there && !there->empty();
  if (!is_another && !is_damage(code)) give_up(why);
  return false;
}

// Once: what is damaged again at once is so for another reason.
bool ComponentCache::make_anew() {
  if (is_made_anew_ || is_read_only_) {
    give_up("it is damaged");
    return false;
  }
  is_made_anew_ = true;
  find_.reset();
  sqlite3* const base = base_.get();
  sqlite3_db_config(base, SQLITE_DBCONFIG_DEFENSIVE, 0, nullptr);
  sqlite3_db_config(base, SQLITE_DBCONFIG_RESET_DATABASE, 1, nullptr);
  const bool is_empty = run("VACUUM");
  const std::string why = is_empty ? "" : sqlite3_errmsg(base);
  sqlite3_db_config(base, SQLITE_DBCONFIG_RESET_DATABASE, 0, nullptr);
  sqlite3_db_config(base, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  if (!is_empty) {
    give_up("it is damaged, and cannot be made anew: " + why);
    return false;
  }
  if (!has_table() && !make_table()) {
    if (!is_given_up_) give_up("it is damaged, and cannot be made anew");
    return false;
  }
  complaint_ = "it was damaged, and is made anew";
  return true;
}

bool ComponentCache::recover(int code) {
  code &= 0xff;
  if (is_damage(code)) {
    // As it was opened, from the beginning.
    if (!make_anew()) return false;
    close();
    return open();
  }
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED) {
    if (++times_busy_ >= kMostTimesBusy) give_up("somebody else holds it");
  } else if (code != SQLITE_NOMEM) {
    give_up(sqlite3_errmsg(base_.get()));
  }
  return false;
}

void ComponentCache::give_up(const std::string& why) {
  is_given_up_ = true;
  complaint_ = why;
  close();
  gathered_.clear();
  gathered_bytes_ = 0;
  used_.clear();
}

// --- Read --------------------------------------------------------------------

ContentHash ComponentCache::key_of(const ContentHash& content) const {
  std::vector<std::int32_t> both = build_;
  for (const std::uint64_t half : {content.low, content.high}) {
    both.push_back(static_cast<std::int32_t>(half >> 32));
    both.push_back(static_cast<std::int32_t>(half & 0xffffffff));
  }
  return hash_of(both);
}

std::optional<std::string> ComponentCache::find(const ContentHash& content) {
  const std::lock_guard lock(mutex_);
  if (!is_open()) return std::nullopt;
  const ContentHash key = key_of(content);
  const auto number = static_cast<std::int64_t>(key.low);
  sqlite3_bind_int64(find_.get(), 1, number);
  const int code = sqlite3_step(find_.get());
  std::optional<std::string> found;
  if (code == SQLITE_ROW && sqlite3_column_int64(find_.get(), 0) ==
                                static_cast<std::int64_t>(key.high)) {
    const std::int64_t used = sqlite3_column_int64(find_.get(), 1);
    const void* bytes = sqlite3_column_blob(find_.get(), 2);
    const int size = sqlite3_column_bytes(find_.get(), 2);
    if (bytes != nullptr && size > 0) {
      found.emplace(static_cast<const char*>(bytes),
                    static_cast<std::size_t>(size));
      ++counts_.found;
      const std::int64_t since = now() - used;
      if (since < 0 || since > kSecondsToKeepUsed) used_.push_back(number);
    }
  }
  sqlite3_reset(find_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) recover(code);
  return found;
}

void ComponentCache::refuse(const ContentHash&) {
  const std::lock_guard lock(mutex_);
  --counts_.found;
  ++counts_.damaged;
}

// --- Written -----------------------------------------------------------------

void ComponentCache::keep(const ContentHash& content, std::string bytes) {
  const std::lock_guard lock(mutex_);
  const std::size_t most =
      std::min<std::size_t>(kMostRowBytes, most_bytes_ / 8);
  if (is_given_up_ || is_read_only_ || bytes.size() > most) return;
  gathered_bytes_ += bytes.size();
  gathered_.emplace_back(key_of(content), std::move(bytes));
  if (gathered_bytes_ > std::min<std::size_t>(kGathered, most)) write_all();
}

void ComponentCache::write() {
  const std::lock_guard lock(mutex_);
  if (!gathered_.empty() || !used_.empty()) write_all();
}

// What somebody else's transaction keeps from being written is tried again with
// the next.
bool ComponentCache::write_all() {
  if (!is_open() || is_read_only_) {
    gathered_.clear();
    gathered_bytes_ = 0;
    used_.clear();
    return false;
  }
  const auto fail = [&] {
    const int code = sqlite3_errcode(base_.get());
    const std::string why = sqlite3_errmsg(base_.get());
    if (sqlite3_get_autocommit(base_.get()) == 0) run("ROLLBACK");
    const bool is_busy = code == SQLITE_BUSY && ++times_busy_ < kMostTimesBusy;
    if (is_busy && gathered_bytes_ < kMostGathered) return false;
    if (is_damage(code)) {
      return recover(code) && write_all();  // once: it is made anew once
    }
    if (code == SQLITE_FULL && !std::exchange(was_full_, true) &&
        run("BEGIN IMMEDIATE") && make_room(most_bytes_ / 2) && run("COMMIT")) {
      return write_all();
    }
    if (sqlite3_get_autocommit(base_.get()) == 0) run("ROLLBACK");
    is_read_only_ = true;
    complaint_ = "nothing new is kept: " + why;
    return false;
  };
  if (!run("BEGIN IMMEDIATE")) return fail();
  // A row may split two pages, though of many rows few do.
  const std::uint64_t pages =
      2 * std::min<std::uint64_t>(gathered_.size(), 1024);
  if (!make_room(2 * gathered_bytes_ + pages * kPageBytes)) return fail();
  const std::int64_t time = now();
  {
    const Statement add = made(
        "INSERT OR REPLACE INTO parts(id, rest, used, bytes) "
        "VALUES(?1, ?2, ?3, ?4)");
    if (add == nullptr) return fail();
    for (const auto& [key, bytes] : gathered_) {
      sqlite3_bind_int64(add.get(), 1, static_cast<std::int64_t>(key.low));
      sqlite3_bind_int64(add.get(), 2, static_cast<std::int64_t>(key.high));
      sqlite3_bind_int64(add.get(), 3, time);
      sqlite3_bind_blob(add.get(), 4, bytes.data(),
                        static_cast<int>(bytes.size()), SQLITE_STATIC);
      if (sqlite3_step(add.get()) != SQLITE_DONE) return fail();
      sqlite3_reset(add.get());
    }
  }
  {
    const Statement mark =
        made("UPDATE parts SET used = ?2 WHERE id = ?1 AND used <> ?2");
    if (mark == nullptr) return fail();
    for (const std::int64_t number : used_) {
      sqlite3_bind_int64(mark.get(), 1, number);
      sqlite3_bind_int64(mark.get(), 2, time);
      if (sqlite3_step(mark.get()) != SQLITE_DONE) return fail();
      sqlite3_reset(mark.get());
    }
  }
  if (!run("COMMIT")) return fail();
  was_full_ = false;
  counts_.added += gathered_.size();
  gathered_.clear();
  gathered_bytes_ = 0;
  used_.clear();
  return true;
}

// What was not used longest goes first, a quarter of all at a time. Pages that
// become free are written to again.
bool ComponentCache::make_room(std::uint64_t bytes) {
  const auto in_use = [&] {
    const std::int64_t pages =
        number_of("PRAGMA page_count") - number_of("PRAGMA freelist_count");
    return static_cast<std::uint64_t>(pages * kPageBytes);
  };
  if (in_use() + bytes <= most_bytes_) return true;
  const std::uint64_t target = most_bytes_ / 4 * 3;
  while (in_use() + bytes > target) {
    const bool is_less =
        run("DELETE FROM parts WHERE id IN (SELECT id FROM parts ORDER BY used "
            "LIMIT (SELECT count(*) / 4 + 1 FROM parts))");
    if (!is_less) return false;
    if (sqlite3_changes(base_.get()) == 0) break;
  }
  return true;
}

ComponentCache::Counts ComponentCache::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

std::string ComponentCache::complaint() const {
  const std::lock_guard lock(mutex_);
  return complaint_;
}

// --- The cache of the program ------------------------------------------------

namespace {

void warn(const Options& options, const std::string& complaint) {
  if (complaint.empty()) return;
  Diagnostic warning = file_error(
      "BT0004", "", fmt::format("--cache {}: {}", options.cache_dir, complaint),
      "what is told is the same, only later");
  warning.severity = Severity::Warning;
  show(options, {warning});
}

}  // namespace

std::optional<OpenCache> open_cache(const Options& options) {
  if (options.cache_dir.empty()) return OpenCache{};
  const std::string complaint = make_directory(options.cache_dir);
  if (!complaint.empty()) {
    complain("BT0004", "--cache: " + complaint);
    return std::nullopt;
  }
  if (build_identity().empty()) {
    warn(options, "the system does not say which btcheck this is");
    return OpenCache{};
  }
  const auto cache =
      std::make_shared<ComponentCache>(options.cache_dir, build_identity());
  cache->try_out();
  OpenCache opened{cache, cache->complaint()};
  warn(options, opened.told);
  ComponentStore::of_program()->keep_in(cache);
  return opened;
}

void close_cache(const Options& options, const OpenCache& opened) {
  const auto& [cache, told] = opened;
  if (cache == nullptr) return;
  ComponentStore::of_program()->keep_in(nullptr);
  cache->write();
  if (cache->complaint() != told) warn(options, cache->complaint());
  const auto [found, added, damaged] = cache->counts();
  if (!options.is_verbose || options.is_quiet || found + added + damaged == 0) {
    return;
  }
  tell(fmt::format("--cache: {} known, {} new, {} damaged\n", found, added,
                   damaged));
}

}  // namespace btcheck
