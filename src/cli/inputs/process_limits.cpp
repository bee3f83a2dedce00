// SPDX-License-Identifier: MIT
#include "cli/inputs/process_limits.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <mutex>
#include <stop_token>
#include <system_error>
#include <thread>
#include <utility>

#include "cli/console/console.hpp"
#include "cli/console/writing.hpp"
#include "cli/inputs/files.hpp"
#include "explore/state/spent.hpp"

// AddressSanitizer keeps several times the program's own memory beside it.
#if defined(__SANITIZE_ADDRESS__)
#define BTCHECK_HAS_ASAN
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define BTCHECK_HAS_ASAN
#endif
#endif
#ifdef BTCHECK_HAS_ASAN
#include <sanitizer/allocator_interface.h>
#endif

namespace btcheck {
namespace {

using Clock = std::chrono::steady_clock;

// From the keyboard, from `timeout`, `docker stop` and a cancelled job, from a
// terminal that is closed, and from `ulimit -t`.
constexpr int kInterrupts[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU};

volatile std::sig_atomic_t interrupted = 0;
int interrupt_watches = 0;

extern "C" void on_interrupt(int signal) {
  if (interrupted != 0) {  // the second one kills
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  interrupted = 1;
}

// What nohup has ignored stays so. SIGINT does not: shells without job control
// ignore it for every program in the background.
void set_handler(int signal, void (*handler)(int)) {
  if (std::signal(signal, handler) == SIG_IGN && signal == SIGHUP) {
    std::signal(signal, SIG_IGN);
  }
}

constexpr double kLookInterval = 0.001;
constexpr std::uint64_t kLeastMeasured = std::uint64_t{64} << 20;
// Half of the second in which a command ends after its limit.
constexpr double kTelling = 0.5;

// The memory that the process holds now, in bytes; 0 if the system does not
// say.
#ifdef BTCHECK_HAS_ASAN

std::uint64_t held_bytes() { return __sanitizer_get_current_allocated_bytes(); }

#else

// The second number of /proc/self/statm: resident pages.
std::uint64_t held_bytes() {
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  std::array<char, 128> text{};
  const ssize_t length = ::read(file, text.data(), text.size() - 1);
  ::close(file);
  if (length <= 0) return 0;
  char* resident = nullptr;
  std::strtoull(text.data(), &resident, 10);
  return std::strtoull(resident, nullptr, 10) *
         static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

#endif

}  // namespace

// --- Signals ---------------------------------------------------------------

InterruptWatch::InterruptWatch() {
  if (interrupt_watches++ > 0) return;
  interrupted = 0;
  for (const int signal : kInterrupts) set_handler(signal, on_interrupt);
}

InterruptWatch::~InterruptWatch() {
  if (--interrupt_watches == 0) stand_down();
}

bool InterruptWatch::is_interrupted() { return interrupted != 0; }

// What came before that ends it as well.
void InterruptWatch::stand_down() {
  for (const int signal : kInterrupts) set_handler(signal, SIG_DFL);
}

// --- Limits ----------------------------------------------------------------

ProcessLimits::ProcessLimits() : start_(Clock::now()) {}

void ProcessLimits::allow(double timeout_seconds, std::uint64_t max_bytes) {
  timeout_ = timeout_seconds;
  max_bytes_ = std::max(max_bytes - max_bytes / 10, kLeastMeasured);
  all_bytes_ = std::max(max_bytes, kLeastMeasured);
}

void ProcessLimits::restart() {
  start_ = Clock::now();
  next_look_ = 0;
  stopped_at_.reset();
  is_heard_ = false;
}

double ProcessLimits::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_.load()).count();
}

// The kernel is asked at most once in a millisecond, for short searches ask far
// more often: in that time a few megabytes can be taken.
bool ProcessLimits::is_time_to_look() {
  const double now = seconds();
  if (now < next_look_) return false;
  next_look_ = now + kLookInterval;
  return true;
}

// What an earlier search has given back may still be with the allocator: it is
// asked to return that before anybody is stopped for it.
Spent ProcessLimits::spent_now() {
  Spent spent = Spent::Nothing;
  if (InterruptWatch::is_interrupted()) {
    spent = Spent::Interrupted;
  } else if (timeout_ > 0 && seconds() >= timeout_) {
    spent = Spent::Time;
  } else if (is_time_to_look() && held_bytes() > max_bytes_) {
    ::malloc_trim(0);
    if (held_bytes() > max_bytes_) spent = Spent::Memory;
  }
  if (spent == Spent::Nothing) return spent;
  if (!stopped_at_) stopped_at_ = seconds();
  is_heard_ = true;
  return spent;
}

StopReason ProcessLimits::reached() { return stop_reason(spent_now()); }

bool ProcessLimits::may_tell() {
  if (!stopped_at_) spent_now();
  return !stopped_at_ || seconds() - *stopped_at_ < kTelling;
}

bool ProcessLimits::has_spare() const {
  if (InterruptWatch::is_interrupted() || stopped_at_) return false;
  if (timeout_ > 0 && seconds() >= timeout_ / 2) return false;
  return held_bytes() <= max_bytes_ / 2;
}

Spent ProcessLimits::look() {
  if (stopped_at_ && seconds() - *stopped_at_ < kTelling) return Spent::Nothing;
  return spent_now();
}

Spent ProcessLimits::overdrawn() const {
  if (InterruptWatch::is_interrupted()) return Spent::Interrupted;
  if (timeout_ > 0 && seconds() >= timeout_) return Spent::Time;
  return held_bytes() > all_bytes_ ? Spent::Memory : Spent::Nothing;
}

ProcessLimits& limits_of_command() {
  static ProcessLimits limits;
  return limits;
}

// --- How it is told --------------------------------------------------------

Diagnostic spent_diagnostic(const BudgetSpent& spent, const std::string& file) {
  const bool is_asked_to_end = spent.spent() == Spent::Interrupted;
  const char* option =
      spent.spent() == Spent::Memory ? "--memory" : "--timeout";
  return file_error(
      "BT9003", file,
      fmt::format("UNDECIDED: {} while {}",
                  is_asked_to_end ? "interrupted"
                                  : fmt::format("{} was reached", option),
                  spent.doing()),
      is_asked_to_end
          ? ""
          : fmt::format("raise {}, or ask about a part of the tree", option));
}

// --- The last resort -------------------------------------------------------

namespace {

constexpr auto kGuardInterval = std::chrono::milliseconds(20);
// Of the time of the processor, so that a loaded machine is no reason; memory
// is taken faster than it is given back. Sanitizers make all of it longer.
#if defined(BTCHECK_HAS_ASAN) || defined(__SANITIZE_THREAD__)
constexpr double kSlow = 20;
#else
constexpr double kSlow = 1;
#endif
constexpr double kDeafFor = 0.4 * kSlow;
constexpr double kGrowsFor = 0.1 * kSlow;
// Once it has heard, and puts into words what there is.
constexpr double kTellsFor = 4 * kSlow;
constexpr double kTellsAbove = 2 * kSlow;
// On the clock, where the work waits for something.
constexpr double kWaits = 5;

double seconds_of_processor() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) +
         static_cast<double>(time.tv_nsec) * 1e-9;
}

[[noreturn]] void end_process(const BudgetSpent& spent,
                              const Guard::LastWords& last_words) {
  // What is being written is finished, unless nobody takes it.
  if (output_mutex().try_lock_for(std::chrono::seconds(1))) std::fflush(stdout);
  if (last_words) {
    last_words(spent);
  } else {
    tell(render(spent_diagnostic(spent, "")) + '\n');
  }
  ::_exit(3);
}

void look_on(const ProcessLimits& limits, const Guard::LastWords& last_words,
             const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any stopped;
  std::unique_lock lock(mutex);
  bool is_over = false;
  double since = 0;
  double worked = 0;
  while (!stop.stop_requested()) {
    stopped.wait_for(lock, stop, kGuardInterval, [] { return false; });
    const Spent spent = limits.overdrawn();
    if (spent == Spent::Nothing) is_over = false;
    if (spent == Spent::Nothing || stop.stop_requested()) continue;
    if (!is_over) {
      is_over = true;
      since = limits.seconds();
      worked = seconds_of_processor();
    }
    const bool is_memory = spent == Spent::Memory;
    const double most = limits.is_heard()
                            ? (is_memory ? kTellsAbove : kTellsFor)
                            : (is_memory ? kGrowsFor : kDeafFor);
    if (seconds_of_processor() - worked > most ||
        limits.seconds() - since > kWaits * most) {
      end_process({spent, limits.doing()}, last_words);
    }
  }
}

std::jthread guarding;

}  // namespace

Guard::Guard(const ProcessLimits& limits, LastWords last_words) {
  try {
    guarding = std::jthread(
        [&limits, last = std::move(last_words)](const std::stop_token& stop) {
          look_on(limits, last, stop);
        });
  } catch (const std::system_error&) {
    // The system gives no thread: then nobody looks on.
  }
}

void Guard::dismiss() { guarding = {}; }

std::uint64_t peak_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace btcheck
