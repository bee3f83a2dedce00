// SPDX-License-Identifier: MIT
#include "groot2/robot.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "groot2/fake_publisher.hpp"

namespace btcheck::groot2::robot_test {
namespace {

using namespace std::string_literals;
using namespace std::chrono_literals;
using enum LogStatus;

// Writes down what it hears.
class Notes : public Listener {
 public:
  bool is_over() override { return is_over_; }
  void waits(std::string_view why) override { note("waits: ", why); }
  void is_back() override { note("back", ""); }
  std::vector<Diagnostic> begins(const BehaviorLog& log,
                                 const EntryValues& entries) override {
    std::string text = log.tree;
    for (const LogTransition& record : log.transitions) text += told(record);
    for (const auto& [name, value] : entries) {
      text += " " + name + "=" + value;
    }
    xml_ = log.xml;
    note("begins: ", text);
    return {};
  }
  void goes_on(std::span<const LogTransition> records) override {
    for (const LogTransition& record : records) note("", told(record));
  }
  void knows_entries(const EntryValues& entries) override {
    const std::lock_guard lock(mutex_);
    entries_ = entries;
  }
  void ends(std::string_view why) override { note("ends: ", why); }
  void is_injected(std::size_t fault) override {
    note("injected ", std::to_string(fault));
  }
  void stands_at(std::size_t fault) override {
    note("stands at ", std::to_string(fault));
  }
  bool may_go_on(std::size_t) override { return may_go_on_; }

  void end() { is_over_ = true; }
  std::atomic<bool> may_go_on_ = false;

  bool has(std::string_view text) {
    const std::lock_guard lock(mutex_);
    return all_.find(text) != std::string::npos;
  }
  std::string all() {
    const std::lock_guard lock(mutex_);
    return all_;
  }
  EntryValues entries() {
    const std::lock_guard lock(mutex_);
    return entries_;
  }
  std::string xml_;

 private:
  static std::string told(const LogTransition& record) {
    return " " + std::to_string(record.uid) + ":" +
           std::string(
               kLogStatusNames[static_cast<std::size_t>(record.before)]) +
           ">" +
           std::string(kLogStatusNames[static_cast<std::size_t>(record.after)]);
  }
  void note(std::string_view what, std::string_view text) {
    const std::lock_guard lock(mutex_);
    all_ += std::string(what) + std::string(text) + "\n";
  }

  std::atomic<bool> is_over_ = false;
  std::mutex mutex_;
  std::string all_;
  EntryValues entries_;
};

// A robot that is followed on a thread.
struct Followed {
  explicit Followed(const Address& address, Following how = {})
      : following(std::move(how)),
        robot(context, address, following, notes),
        thread([this] { found = robot.follow(); }) {}
  ~Followed() { end(); }

  void end() {
    notes.end();
    if (thread.joinable()) thread.join();
  }
  // That it ends by itself.
  std::string error(std::chrono::seconds patience = 15s) {
    const auto until = std::chrono::steady_clock::now() + patience;
    while (found.empty() && std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(5ms);
    }
    end();
    REQUIRE(found.size() == 1);
    return found[0].code + ": " + found[0].message;
  }
  bool hears(std::string_view text, std::chrono::seconds patience = 10s) {
    const auto until = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < until) {
      if (notes.has(text)) return true;
      std::this_thread::sleep_for(2ms);
    }
    INFO(notes.all());
    return false;
  }

  Context context;
  Following following;
  Notes notes;
  std::vector<Diagnostic> found;
  Robot robot;
  std::thread thread;
};

void tick(FakePublisher& publisher) {
  publisher.set(1, Running);
  publisher.set(2, Success);
  publisher.set(3, Failure);
  publisher.set(2, Idle);
  publisher.set(3, Idle);
  publisher.set(1, Failure);
  publisher.set(1, Idle);
  publisher.wait(20'000);
}

// One that answers requests of that kind in its own way.
FakePublisher::Answer in_place_of(
    char kind, std::function<FakePublisher::Parts(const std::string&)> said) {
  return [kind, said = std::move(said)](
             const FakePublisher::Parts& request,
             const std::string& head) -> std::optional<FakePublisher::Parts> {
    if (request[0].size() != 6 || request[0][1] != kind) return std::nullopt;
    return said(head);
  };
}

}  // namespace

TEST_CASE("a robot is recorded from where it stands") {
  FakePublisher publisher;
  publisher.set(1, Running);
  publisher.set(2, Success);
  publisher.set(3, Running);
  Followed robot(publisher.address());
  CHECK(
      robot.hears("begins: Fake 1:IDLE>RUNNING 2:IDLE>SUCCESS "
                  "3:IDLE>RUNNING\n"));
  publisher.set(3, Failure);
  CHECK(robot.hears("3:RUNNING>FAILURE"));
  publisher.set(2, Idle);
  publisher.set(3, Idle);
  publisher.set(1, Failure);
  publisher.set(1, Idle);
  CHECK(robot.hears("1:FAILURE>IDLE"));
  CHECK(publisher.is_recording());
  robot.end();
  CHECK(!publisher.is_recording());
  CHECK(robot.found.empty());
  CHECK(robot.notes.all() ==
        "begins: Fake 1:IDLE>RUNNING 2:IDLE>SUCCESS 3:IDLE>RUNNING\n"
        " 3:RUNNING>FAILURE\n 2:SUCCESS>IDLE\n 3:FAILURE>IDLE\n"
        " 1:RUNNING>FAILURE\n 1:FAILURE>IDLE\nends: btcheck listens no "
        "longer\n");
}

TEST_CASE("nothing is lost of a robot that is busy while it begins") {
  FakePublisher publisher;
  std::atomic<bool> is_over = false;
  std::thread busy([&] {
    while (!is_over) {
      tick(publisher);
      std::this_thread::sleep_for(300us);
    }
  });
  Followed robot(publisher.address());
  CHECK(robot.hears("1:FAILURE>IDLE"));
  std::this_thread::sleep_for(1500ms);  // some comparisons
  is_over = true;
  busy.join();
  std::this_thread::sleep_for(100ms);
  robot.end();
  // Each record goes on from the status that the one before has led to.
  const std::string all = robot.notes.all();
  CHECK(all.find("ends: changes") == std::string::npos);
  std::map<char, std::string> status;
  std::size_t records = 0;
  for (std::size_t at = all.find('\n'); at < all.size();) {
    const std::size_t end = all.find('\n', at + 1);
    const std::string line = all.substr(at + 1, end - at - 1);
    at = end;
    if (!line.starts_with(' ')) continue;
    const std::size_t sign = line.find('>');
    const std::string before = line.substr(3, sign - 3);
    if (status.contains(line[1])) {
      CHECK(status[line[1]] == before);
    }
    status[line[1]] = line.substr(sign + 1);
    ++records;
  }
  CHECK(records > 1000);
}

TEST_CASE("a robot that is not there yet is waited for") {
  std::uint16_t port = 0;
  { port = FakePublisher().port(); }
  Followed robot({"127.0.0.1", port});
  CHECK(robot.hears("waits: nobody answers there yet"));
  FakePublisher publisher(port);
  CHECK(robot.hears("back\nbegins: Fake"));
}

TEST_CASE("a program that is started anew is another recording") {
  auto publisher = std::make_unique<FakePublisher>();
  const std::uint16_t port = publisher->port();
  Followed robot({"127.0.0.1", port});
  CHECK(robot.hears("begins: Fake"));
  publisher.reset();
  CHECK(robot.hears("waits: it does not answer any more"));
  FakePublisher other(port);
  CHECK(robot.hears("back\nends: the program was started anew\nbegins: Fake"));
}

TEST_CASE("a connection that was lost and found again goes on") {
  std::atomic<bool> is_silent = false;
  FakePublisher publisher(
      0,
      [&](const FakePublisher::Parts& request,
          const std::string&) -> std::optional<FakePublisher::Parts> {
        // What is asked for changes is told them later.
        if (is_silent && request[0][1] != 't') return FakePublisher::Parts{};
        return std::nullopt;
      });
  Followed robot(publisher.address());
  CHECK(robot.hears("begins: Fake"));
  is_silent = true;
  CHECK(robot.hears("waits: it does not answer any more"));
  publisher.set(2, Running);
  is_silent = false;
  CHECK(robot.hears("back"));
  CHECK(robot.hears(" 2:IDLE>RUNNING"));
  CHECK(!robot.notes.has("ends"));
}

TEST_CASE("changes that somebody else takes are missed") {
  FakePublisher publisher;
  Followed robot(publisher.address());
  CHECK(robot.hears("begins: Fake"));
  std::atomic<bool> is_over = false;
  std::thread thief([&] {
    while (!is_over) {
      publisher.set(2, Running);
      publisher.forget_changes();
      std::this_thread::sleep_for(1ms);
      publisher.set(2, Idle);
    }
  });
  CHECK(robot.hears("ends: changes were lost"));
  is_over = true;
  thief.join();
}

TEST_CASE("more changes than are kept are missed, and in the end it gives up") {
  FakePublisher publisher;
  Followed robot(publisher.address());
  CHECK(robot.hears("begins: Fake"));
  std::atomic<bool> is_over = false;
  std::thread busy([&] {
    while (!is_over) {
      for (int i = 0; i < 1200; ++i) publisher.set(2, i % 2 ? Idle : Running);
      std::this_thread::sleep_for(60ms);
    }
  });
  CHECK(robot.error(60s).starts_with(
      "BT1905: changes were lost 5 times within seconds: "));
  CHECK(robot.notes.has("ends: changes were lost: 1000 came at once"));
  is_over = true;
  busy.join();
}

TEST_CASE("entries, by their names below their trees") {
  FakePublisher publisher;
  publisher.set_tree(
      "<root BTCPP_format=\"4\">"
      "<BehaviorTree ID=\"Fake\" _fullpath=\"\"><SubTree ID=\"Arm\" "
      "_fullpath=\"Arm::1\" _uid=\"1\"/></BehaviorTree>"
      "<BehaviorTree ID=\"Arm\" _fullpath=\"Arm::1\"><a _uid=\"2\"/>"
      "</BehaviorTree></root>");
  publisher.set_entries(
      "\x82\xA4"
      "Fake\x81\xA1"
      "b\x4C\xA6"
      "Arm::1\x81\xA1p\xC3"s);
  Followed robot(publisher.address(), {{}, true});
  CHECK(robot.hears("begins: Fake Arm::1/p=true b=76\n"));
  CHECK(publisher.told('B').at(0) == "Fake;Arm::1");
  publisher.set_entries(
      "\x81\xA4"
      "Fake\x81\xA1"
      "b\x4D"s);
  const auto until = std::chrono::steady_clock::now() + 5s;
  while (robot.notes.entries() != EntryValues{{"b", "77"}} &&
         std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(5ms);
  }
  CHECK(robot.notes.entries() == EntryValues{{"b", "77"}});
}

TEST_CASE("faults are hooks that are taken back") {
  FakePublisher publisher;
  Following following;
  following.faults = {*fault_in("b fails").fault, *break_in("a").fault};
  Followed robot(publisher.address(), following);
  CHECK(robot.hears("begins: Fake"));
  const auto until = std::chrono::steady_clock::now() + 5s;
  while (publisher.told('I').size() < 2 &&
         std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(5ms);
  }
  CHECK(publisher.told('I') ==
        std::vector<std::string>{insert_text({3, false, true, Failure}),
                                 insert_text({2, true, false, Failure})});
  CHECK(robot.notes.xml_.ends_with(
      "<!-- recorded by btcheck watch; on purpose: b fails; break a -->\n"));
  std::this_thread::sleep_for(300ms);  // the publisher knows who listens
  publisher.reach(3);
  CHECK(robot.hears("injected 0"));
  publisher.reach(2);
  CHECK(robot.hears("stands at 1"));
  CHECK(publisher.told('U').empty());
  robot.notes.may_go_on_ = true;
  while (publisher.told('U').empty() &&
         std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(5ms);
  }
  CHECK(publisher.told('U') == std::vector<std::string>{unlock_text(2)});
  robot.end();
  CHECK(publisher.told('R') ==
        std::vector<std::string>{remove_text(3), remove_text(2)});
  CHECK(robot.found.empty());
}

TEST_CASE("a fault from a tick on waits for it") {
  FakePublisher publisher;
  Following following;
  following.faults = {*fault_in("b fails always from tick 3").fault};
  Followed robot(publisher.address(), following);
  CHECK(robot.hears("begins: Fake"));
  tick(publisher);
  tick(publisher);
  std::this_thread::sleep_for(300ms);
  CHECK(publisher.told('I').empty());
  tick(publisher);
  const auto until = std::chrono::steady_clock::now() + 5s;
  while (publisher.told('I').empty() &&
         std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(5ms);
  }
  CHECK(publisher.told('I') ==
        std::vector<std::string>{insert_text({3, false, false, Failure})});
}

TEST_CASE("faults at nodes that are not there") {
  for (const auto& [text, error] :
       {std::pair("c fails", "BT1906: unknown node `c`"),
        std::pair("root fails", "BT1906: unknown node `root`")}) {
    FakePublisher publisher;
    Following following;
    following.faults = {*fault_in(text).fault};
    Followed robot(publisher.address(), following);
    CHECK(robot.error() == error);
    CHECK(publisher.told('I').empty());
  }
  FakePublisher publisher;
  Following following;
  following.faults = {*fault_in("b fails").fault, *break_in("b").fault};
  Followed robot(publisher.address(), following);
  CHECK(robot.error() == "BT1907: `b` is named twice");
}

TEST_CASE("servers that say what no publisher says") {
  const auto error = [](char kind,
                        std::function<FakePublisher::Parts(std::string)> said) {
    FakePublisher publisher(0, in_place_of(kind, std::move(said)));
    Followed robot(publisher.address(), {{}, true});
    const std::string text = robot.error();
    CHECK(text.size() < 1200);
    return text.substr(0, 6);
  };
  // Other heads: too short, other version, other request, three parts.
  CHECK(error('T', [](const std::string&) { return Parts{"hello"}; }) ==
        "BT1902");
  CHECK(error('T', [](const std::string& head) {
          return Parts{"\x03" + head.substr(1), ""};
        }) == "BT1902");
  CHECK(error('T', [](const std::string& head) {
          return Parts{head.substr(0, 2) + "xxxx" + head.substr(6), ""};
        }) == "BT1902");
  CHECK(error('T', [](const std::string& head) {
          return Parts{head, "", ""};
        }) == "BT1902");
  CHECK(error('T', [](const std::string& head) { return Parts(50, head); }) ==
        "BT1902");
  CHECK(error('T', [](const std::string&) {
          return Parts{"error", std::string(100'000, '\xFF')};
        }) == "BT1902");
  // Trees: none, garbage, no uids, twice the same, endless depth, no UTF-8.
  const std::vector<std::string> trees = {
      "",
      "garbage",
      "\xFF\xFE\x00\x01"s,
      "<root/>",
      "<root><BehaviorTree ID=\"T\"><a/></BehaviorTree></root>",
      "<root><BehaviorTree ID=\"T\"><S _uid=\"1\"><a _uid=\"1\"/></S>"
      "</BehaviorTree></root>",
      "<root><BehaviorTree ID=\"T\"><a _uid=\"70000\"/></BehaviorTree></root>",
      [] {
        std::string deep = "<root><BehaviorTree ID=\"T\">";
        for (int i = 0; i < 200'000; ++i) deep += "<a _uid=\"1\">";
        return deep;
      }()};
  for (const std::string& xml : trees) {
    CAPTURE(xml.substr(0, 80));
    CHECK(error('T', [&](const std::string& head) {
            return Parts{head, xml};
          }) == "BT1903");
  }
  // Statuses, changes, blackboards and beginnings.
  for (const auto& [kind, payload] :
       {std::pair('S', "\1"s), std::pair('S', "\x09\x00\x01"s),
        std::pair('S', "\x01\x00\x07"s), std::pair('t', "123"s),
        std::pair('t', "\0\0\0\0\0\0\x09\0\1"s),
        std::pair('t', "\0\0\0\0\0\0\2\0\x63"s),
        std::pair('t', std::string(90'000, '\0')), std::pair('B', "\xC1"s),
        std::pair('B', "\x81\xA1m\x81\xA1v"s + std::string(100'000, '\x91')),
        std::pair('r', "soon"s), std::pair('r', "-5"s), std::pair('r', ""s)}) {
    const std::string& text = payload;
    CAPTURE(text.substr(0, 20));
    CHECK(error(kind, [&](const std::string& head) {
            return Parts{head, text};
          }).starts_with("BT190"));
  }
}

TEST_CASE("a server that is another one with each answer") {
  char turn = 0;
  FakePublisher publisher(
      0,
      [&](const FakePublisher::Parts& request,
          const std::string& head) -> std::optional<FakePublisher::Parts> {
        if (request[0][1] != 'S') return std::nullopt;
        return FakePublisher::Parts{head.substr(0, 21) + ++turn, ""};
      });
  Followed robot(publisher.address());
  CHECK(robot.error().starts_with("BT1903: it was started anew "));
}

TEST_CASE("a server that never answers") {
  FakePublisher publisher(0,
                          [](const FakePublisher::Parts&, const std::string&) {
                            return FakePublisher::Parts{};
                          });
  Following following;
  following.patience = 100ms;
  Followed robot(publisher.address(), following);
  CHECK(robot.error().starts_with(
      "BT1902: somebody listens there, and has not answered"));
}

TEST_CASE("a message larger than any is not taken") {
  FakePublisher publisher(0, in_place_of('T', [](const std::string& head) {
                            return Parts{head, std::string(70 << 20, 'x')};
                          }));
  Following following;
  following.patience = 300ms;
  Followed robot(publisher.address(), following);
  CHECK(robot.error().starts_with("BT1902: "));
}

TEST_CASE("non-UTF-8 in names is taken as it is anywhere else") {
  FakePublisher publisher;
  publisher.set_tree(
      "<root><BehaviorTree ID=\"T\"><a name=\"\xC3\x28\x1B[2J\" _uid=\"1\"/>"
      "</BehaviorTree></root>");
  Followed robot(publisher.address());
  CHECK(robot.hears("begins: T"));
}

}  // namespace btcheck::groot2::robot_test
