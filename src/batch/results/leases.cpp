// SPDX-License-Identifier: MIT
//
// A sign is `HOST PROCESS START PLACE COUNT`: whoever is at the same PLACE sees
// the same processes, and a process number that was given again has another
// START. The count is written into the file that was made, wherever its name
// leads by now.
#include "batch/results/leases.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <random>
#include <sstream>
#include <utility>

#include "batch/results/seal.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

// So many times does a process count on within the patience of others.
constexpr double kCounts = 10;
// Who has counted on within this part of it surely lives.
constexpr double kRecent = 3 / kCounts;

// Of a small file; nothing where there is none, "" where it cannot be read.
std::optional<std::string> small_text(const std::string& name) {
  const OpenFile file(name, O_RDONLY | O_NONBLOCK);
  if (!file.is_open() && errno == ENOENT) return std::nullopt;
  std::array<char, 4096> block{};
  const ssize_t count = file.is_open() ? file.read(block) : 0;
  return std::string(block.data(),
                     static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
}

std::string first_word(const std::string& text) {
  return text.substr(0, text.find_first_of(" \n"));
}

// Which processes are seen here: the boot of the machine, and the namespace of
// process numbers. "" where the system does not say.
std::string place() {
  const auto boot = small_text("/proc/sys/kernel/random/boot_id");
  std::error_code fault;
  const fs::path names = fs::read_symlink("/proc/self/ns/pid", fault);
  if (!boot || fault) return {};
  return first_word(*boot) + '/' + names.string();
}

// When the process was started, as the system counts; "" where there is none,
// or none any more but for its number.
std::string start_of(const std::string& process) {
  const auto text = small_text("/proc/" + process + "/stat");
  const std::size_t end = text ? text->rfind(')') : std::string::npos;
  if (end == std::string::npos) return {};
  std::istringstream words(text->substr(end + 1));
  constexpr int kState = 3;
  constexpr int kStart = 22;
  std::string word;
  for (int i = kState; i <= kStart && words >> word; ++i) {
    if (i == kState && (word == "Z" || word == "X")) return {};
  }
  return word;
}

struct Sign {
  std::string host, process, start, place;
};

std::optional<Sign> sign_in(const std::string& text) {
  std::istringstream words(text);
  Sign sign;
  std::string count;
  words >> sign.host >> sign.process >> sign.start >> sign.place >> count;
  const bool is_whole = !words.fail() && sign.process.find_first_not_of(
                                             "0123456789") == std::string::npos;
  return is_whole ? std::optional(sign) : std::nullopt;
}

Sign own_sign() {
  const std::string process = std::to_string(::getpid());
  const std::string host = plain_word(host_name(), "-.");
  const std::string start = start_of(process);
  const std::string here = place();
  return {host.empty() ? "-" : host, process, start.empty() ? "-" : start,
          here.empty() ? "-" : here};
}

}  // namespace

Leases::~Leases() {
  if (sign_) ::unlink(sign_name(name_).c_str());
}

std::string Leases::begin() {
  const Sign own = own_sign();
  place_ = own.place;
  std::random_device random;
  name_ = fmt::format("{}-{}-{:08x}{:08x}", own.host, own.process, random(),
                      random());
  sign_ =
      std::make_unique<OpenFile>(sign_name(name_), O_WRONLY | O_CREAT | O_EXCL);
  if (!sign_->is_open()) {
    const int reason = errno;
    sign_.reset();
    return fmt::format("cannot write into `{}`: {}", folder_,
                       std::generic_category().message(reason));
  }
  said_ =
      fmt::format("{} {} {} {}", own.host, own.process, own.start, own.place);
  keep_alive();
  return {};
}

void Leases::keep_alive() {
  const auto now = Clock::now();
  const std::chrono::duration<double> passed = now - last_count_;
  if (!sign_ || (count_ > 0 && passed.count() < patience_ / kCounts)) return;
  last_count_ = now;
  const std::string text = fmt::format("{} {:020}\n", said_, ++count_);
  // What cannot be written is not seen, and others take over.
  [[maybe_unused]] const ssize_t written =
      ::pwrite(sign_->number(), text.data(), text.size(), 0);
}

std::string Leases::lease_name(const std::string& key, int number) const {
  return fmt::format("{}/{}.{}.lease", folder_, key, number);
}

std::string Leases::sign_name(const std::string& owner) const {
  return fmt::format("{}/{}.alive", folder_, owner);
}

int Leases::last_lease(const std::string& key) const {
  int last = 0;
  while (::access(lease_name(key, last + 1).c_str(), F_OK) == 0) ++last;
  return last;
}

bool Leases::claim(const std::string& key) {
  if (!sign_) return true;
  const int last = last_lease(key);
  if (last > 0 && holder_by(lease_name(key, last)) != Holder::Nobody) {
    return false;
  }
  const OpenFile lease(lease_name(key, last + 1), O_WRONLY | O_CREAT | O_EXCL);
  if (!lease.is_open()) return errno != EEXIST;
  if (last > 0 && ::access(lease_name(key, last).c_str(), F_OK) != 0) {
    // Another one has taken over before, and is done.
    ::unlink(lease_name(key, last + 1).c_str());
    return false;
  }
  if (!lease.write(name_ + '\n')) clear(key);  // the disk is full
  return true;
}

void Leases::release(const std::string& key) {
  const int last = last_lease(key);
  if (last == 0 || name_.empty()) return;
  const auto lease = small_text(lease_name(key, last));
  if (lease && first_word(*lease) == name_) clear(key);
}

void Leases::clear(const std::string& key) const {
  for (int i = 1; ::unlink(lease_name(key, i).c_str()) == 0; ++i) {
  }
}

KeptResults::Holder Leases::holder_of(const std::string& key) {
  const int last = last_lease(key);
  return last == 0 ? Holder::Nobody : holder_by(lease_name(key, last));
}

KeptResults::Holder Leases::holder_by(const std::string& lease) {
  const auto text = small_text(lease);
  if (!text) return Holder::Unclear;  // done this moment: look again
  const std::string owner = first_word(*text);
  // A lease that is half there, or that no btcheck has written, names nobody.
  if (owner.empty() || plain_word(owner, "-._") != owner) {
    return holder_by_age(lease, *text);
  }
  const auto sign = small_text(sign_name(owner));
  if (!sign) return Holder::Nobody;
  const Holder by_age = holder_by_age(lease, *text + *sign);
  const auto said = sign_in(*sign);
  if (!said || said->place != place_ || place_ == "-") return by_age;
  if (start_of(said->process) != said->start) return Holder::Nobody;
  return by_age == Holder::Unclear ? Holder::Alive : by_age;
}

KeptResults::Holder Leases::holder_by_age(const std::string& lease,
                                          std::string text) {
  const auto now = Clock::now();
  Seen& seen = seen_.try_emplace(lease, Seen{text, now}).first->second;
  if (seen.text != text) seen = {std::move(text), now, true};
  const std::chrono::duration<double> unchanged = now - seen.since;
  if (unchanged.count() >= patience_) return Holder::Nobody;
  return seen.has_changed && unchanged.count() < kRecent * patience_
             ? Holder::Alive
             : Holder::Unclear;
}

std::string Leases::holder_name(const std::string& key) const {
  const int last = last_lease(key);
  if (last == 0) return {};
  const auto lease = small_text(lease_name(key, last));
  const std::string owner = lease ? first_word(*lease) : std::string();
  const auto sign = small_text(sign_name(plain_word(owner, "-._")));
  const auto said = sign ? sign_in(*sign) : std::nullopt;
  return said ? fmt::format("{}, process {}", one_line(said->host),
                            said->process)
              : "a process that is gone";
}

}  // namespace btcheck
