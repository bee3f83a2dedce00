// SPDX-License-Identifier: MIT
//
// A run that grows, served: over real sockets, as a browser, a stranger's page
// and a client that takes nothing would ask.
#include <doctest/doctest.h>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "run/view/request.hpp"
#include "run/view/server.hpp"
#include "trace/hand_made_drone.hpp"
#include "trace/live/live_run.hpp"

namespace btcheck::view_server_test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

const RecordedRun& whole() {
  static const RecordedRun run = drone_survey("", 1000);
  return run;
}

RecordedRun beginning() {
  RecordedRun run = whole();
  run.states.resize(1);
  return run;
}

std::span<const RecordedState> states(std::size_t from, std::size_t count) {
  return std::span(whole().states).subspan(from, count);
}

// The address taken apart.
struct Served {
  explicit Served(const LiveServer& server) : address(server.address()) {
    const std::size_t colon = address.rfind(':');
    port = std::stoi(address.substr(colon + 1));
    token = address.substr(address.find("token=") + 6);
  }
  std::string address;
  int port = 0;
  std::string token;
};

class Client {
 public:
  explicit Client(int port, int receive_buffer = 0) {
    file_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (receive_buffer > 0) {
      ::setsockopt(file_, SOL_SOCKET, SO_RCVBUF, &receive_buffer,
                   sizeof receive_buffer);
    }
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(static_cast<std::uint16_t>(port));
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(::connect(file_, reinterpret_cast<sockaddr*>(&place),
                      sizeof place) == 0);
  }
  ~Client() { ::close(file_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void say(const std::string& text) const {
    std::size_t at = 0;
    while (at < text.size()) {
      const ssize_t sent =
          ::send(file_, text.data() + at, text.size() - at, MSG_NOSIGNAL);
      if (sent <= 0) return;
      at += static_cast<std::size_t>(sent);
    }
  }
  // Until it is closed, `end` was read, or the time is over.
  std::string hear(const std::string& end = "",
                   std::chrono::milliseconds patience = 5s) {
    const Clock::time_point until = Clock::now() + patience;
    for (;;) {
      if (!end.empty() && heard_.find(end) != std::string::npos) return heard_;
      const auto rest = std::chrono::duration_cast<std::chrono::milliseconds>(
          until - Clock::now());
      pollfd asked{file_, POLLIN, 0};
      if (rest <= 0ms || ::poll(&asked, 1, static_cast<int>(rest.count())) <= 0)
        return heard_;
      char block[65536];
      const ssize_t got = ::recv(file_, block, sizeof block, 0);
      if (got <= 0) {
        is_closed_ = true;
        return heard_;
      }
      heard_.append(block, static_cast<std::size_t>(got));
    }
  }
  bool is_closed() const { return is_closed_; }

 private:
  int file_ = -1;
  std::string heard_;
  bool is_closed_ = false;
};

std::string request(const Served& served, const std::string& path,
                    const std::string& more = "",
                    const std::string& method = "GET",
                    const std::string& host = "127.0.0.1") {
  return fmt::format("{} {} HTTP/1.1\r\nHost: {}:{}\r\n{}\r\n", method, path,
                     host, served.port, more);
}

std::string answer(const Served& served, const std::string& words) {
  Client client(served.port);
  client.say(words);
  return client.hear();
}

// 200, 403, … or 0 where it was closed without a word.
int status(const std::string& answer) {
  return answer.size() < 12 ? 0 : std::stoi(answer.substr(9, 3));
}

std::string events_path(const Served& served, std::uint64_t chapter = 1) {
  return fmt::format("/events?token={}&chapter={}", served.token, chapter);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos;
       at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

}  // namespace

TEST_CASE("the page is served to who has the address, and to nobody else") {
  LiveRun run(beginning());
  LiveServer server(run);
  REQUIRE(server.open(0) == "");
  const Served served(server);
  CHECK(served.address == fmt::format("http://127.0.0.1:{}/?token={}",
                                      served.port, served.token));
  CHECK(served.token.size() == 32);
  const std::string path = "/?token=" + served.token;
  const std::string page = answer(served, request(served, path));
  CHECK(status(page) == 200);
  CHECK(page.find("\"live\":1,") != std::string::npos);
  CHECK(page.ends_with("</html>\n"));
  for (const char* header :
       {"Cache-Control: no-store", "X-Content-Type-Options: nosniff",
        "Referrer-Policy: no-referrer", "X-Frame-Options: DENY",
        "default-src 'none'", "frame-ancestors 'none'"}) {
    CHECK(page.find(header) != std::string::npos);
  }
  // The script of the page is the one that the policy allows.
  const std::size_t at = page.find("'nonce-") + 7;
  const std::string nonce = page.substr(at, page.find('\'', at) - at);
  CHECK(nonce.size() == 32);
  CHECK(count(page, fmt::format("<script nonce=\"{}\">", nonce)) == 1);
  const std::string again = answer(served, request(served, path));
  CHECK(again.find(nonce) == std::string::npos);

  const auto asked = [&](const std::string& where, const std::string& more = "",
                         const std::string& method = "GET",
                         const std::string& host = "127.0.0.1") {
    return status(answer(served, request(served, where, more, method, host)));
  };
  const std::string own = std::to_string(served.port);
  std::string wrong = served.token;
  wrong.back() = wrong.back() == '0' ? '1' : '0';
  CHECK(asked(path, "", "GET", "localhost") == 200);
  CHECK(asked(path, "Origin: http://127.0.0.1:" + own + "\r\n") == 200);
  // No token, a wrong one, a part of it, more than it.
  for (const std::string& token :
       {std::string(), wrong, served.token.substr(1), served.token + "0"}) {
    CHECK(asked("/?token=" + token) == 403);
    CHECK(asked("/events?chapter=1&token=" + token) == 403);
  }
  CHECK(asked("/") == 403);
  CHECK(asked("/events") == 403);
  // A name of somebody else's that leads here; his page that asks.
  CHECK(asked(path, "", "GET", "evil.example") == 403);
  CHECK(asked(path, "", "GET", "127.0.0.1.evil.example") == 403);
  CHECK(asked(path, "Host: evil.example\r\n") != 200);
  CHECK(asked(path, "Origin: http://evil.example\r\n") == 403);
  CHECK(asked(path, "Origin: null\r\n") == 403);
  CHECK(asked(path, "Origin: https://127.0.0.1:" + own + "\r\n") == 403);
  CHECK(asked(events_path(served), "Origin: http://evil.example\r\n") == 403);
  CHECK(status(answer(served, fmt::format("GET {} HTTP/1.1\r\nHost: "
                                          "127.0.0.1:1\r\n\r\n",
                                          path))) == 403);
  CHECK(status(answer(served, fmt::format("GET {} HTTP/1.0\r\n\r\n", path))) ==
        403);
  // Nothing else is there, and nothing can be done but read.
  for (const char* other : {"/index.html", "/../etc/passwd", "//", "/events/",
                            "http://127.0.0.1/", "*"}) {
    CHECK(asked(fmt::format("{}?token={}", other, served.token)) == 404);
  }
  for (const char* method : {"POST", "PUT", "DELETE", "HEAD", "OPTIONS"}) {
    CHECK(asked(path, "", method) == 405);
  }
}

TEST_CASE("several runs have a list, and a folder for each") {
  LiveRun run(beginning());
  LiveServer server({"groot2://arm:1667", "groot2://<b>&:1667"});
  REQUIRE(server.open(0) == "");
  const Served served(server);
  const auto page = [&](const std::string& path) {
    return answer(served, request(served, path + "?token=" + served.token));
  };
  const std::string list = page("/");
  CHECK(status(list) == 200);
  CHECK(list.find(fmt::format("<a href=\"/1/?token={}\">groot2://arm:1667</a>",
                              served.token)) != std::string::npos);
  CHECK(list.find("groot2://&lt;b&gt;&amp;:1667") != std::string::npos);
  CHECK(count(list, "nobody answers there yet") == 2);
  CHECK(list.find("http-equiv=\"refresh\"") != std::string::npos);
  // Until a run is there its page waits, and nobody waits for who reads it.
  CHECK(page("/2/").find("nobody answers there yet") != std::string::npos);
  CHECK(!server.is_watched());
  server.show(1, run);
  CHECK(count(page("/"), "nobody answers there yet") == 1);
  CHECK(page("/2/").find("\"live\":1,") != std::string::npos);
  CHECK(server.is_watched());
  Client client(served.port);
  client.say(request(served, "/2" + events_path(served)));
  client.hear("retry:");
  run.add(states(1, 1));
  CHECK(client.hear("id: 1-1").find("data: {") != std::string::npos);
  for (const char* path : {"/0/", "/3/", "/1x/", "/events", "/2", "/2//",
                           "/2/1/", "/18446744073709551617/"}) {
    CAPTURE(path);
    CHECK(status(page(path)) == 404);
  }
  CHECK(status(answer(served, request(served, "/2/"))) == 403);
  CHECK(status(answer(served, request(served, "/"))) == 403);
}

TEST_CASE("what is no request is closed") {
  LiveRun run(beginning());
  LiveServer server(run, {.connections = 2,
                          .header_bytes = 2048,
                          .to_ask = 200ms,
                          .to_listen = 200ms});
  REQUIRE(server.open(0) == "");
  const Served served(server);
  const std::string path = "/?token=" + served.token;
  // Too long a header, a body, noise.
  for (const std::string& words :
       {request(served, path, "X: " + std::string(5000, 'a') + "\r\n"),
        request(served, "/?" + std::string(5000, 'a')),
        request(served, path, "Content-Length: 5\r\n") + "hello",
        std::string(3000, '\0'), std::string("\r\n\r\n\r\n"),
        std::string("GET\r\n\r\n")}) {
    Client client(served.port);
    client.say(words);
    CHECK(status(client.hear()) == 0);
    CHECK(client.is_closed());
  }
  // Half a request; nothing at all.
  for (const std::string& words : {std::string("GET /"), std::string()}) {
    Client client(served.port);
    client.say(words);
    const Clock::time_point begin = Clock::now();
    CHECK(client.hear().empty());
    CHECK(client.is_closed());
    CHECK(Clock::now() - begin < 3s);
  }
  // More than a few at a time.
  {
    Client first(served.port);
    first.say(request(served, events_path(served)));
    CHECK(status(first.hear("\n\n")) == 200);
    Client second(served.port);
    second.say(request(served, events_path(served)));
    CHECK(status(second.hear("\n\n")) == 200);
    Client third(served.port);
    third.say(request(served, path));
    CHECK(third.hear().empty());
    CHECK(third.is_closed());
  }
  // Who has gone makes room.
  for (int i = 0; i < 40; ++i) {
    if (status(answer(served, request(served, path))) == 200) return;
    std::this_thread::sleep_for(25ms);
  }
  FAIL("nobody is let in any more");
}

TEST_CASE("who listens hears all of a run, early or late, and its end") {
  LiveRun run(beginning());
  LiveServer server(run);
  REQUIRE(server.open(0) == "");
  const Served served(server);
  Client early(served.port);
  early.say(request(served, events_path(served)));
  early.hear("retry: 500\n\n");
  for (std::size_t i = 1; i < 500; ++i) run.add(states(i, 1));
  early.hear("id: 1-499\n");
  Client late(served.port);
  late.say(request(served, events_path(served)));
  late.hear("id: 1-499\n");
  for (std::size_t i = 500; i < 1000; ++i) run.add(states(i, 1));
  // He has heard a part, and comes back.
  Client again(served.port);
  again.say(request(served, events_path(served), "Last-Event-ID: 1-700\r\n"));
  run.end("the tree ended with success in tick 9");
  const auto told = [](Client& client) {
    const std::string all = client.hear();
    CHECK(client.is_closed());
    CHECK(
        all.ends_with("id: 1-1000\nevent: end\ndata: \"the tree ended with "
                      "success in tick 9\"\n\n"));
    return all.substr(all.find("retry: 500\n\n"));
  };
  const std::string all = told(early);
  CHECK(count(all, "\ndata: {\"texts\":[") == 999);
  CHECK(told(late) == all);
  const std::string rest = told(again);
  CHECK(count(rest, "\ndata: {\"texts\":[") == 299);
  CHECK(all.ends_with(rest.substr(rest.find("id: 1-701\n"))));
  // It is over, and still told until the server goes.
  Client last(served.port);
  last.say(request(served, events_path(served)));
  CHECK(told(last) == all);
  const Clock::time_point begin = Clock::now();
  server.finish(5s);
  CHECK(Clock::now() - begin < 2s);
}

TEST_CASE("who takes nothing delays nobody, and is let go") {
  RecordedRun loud = beginning();
  loud.variables = {"x"};
  loud.is_number = {false};
  loud.states[0].values = {""};
  LiveRun run(loud);
  LiveServer server(run, {.to_listen = 3s});
  REQUIRE(server.open(0) == "");
  const Served served(server);
  Client deaf(served.port, 4096);
  deaf.say(request(served, events_path(served)));
  Client awake(served.port);
  awake.say(request(served, events_path(served)));
  std::string all;
  std::thread listening([&] { all = awake.hear("", 60s); });
  // 16 messages of a megabyte: more than any buffer on the way holds.
  Clock::duration longest{};
  RecordedState state = loud.states[0];
  for (int i = 0; i < 16; ++i) {
    state.values[0] = std::to_string(i) + std::string(1 << 20, 'x');
    const Clock::time_point begin = Clock::now();
    run.add({&state, 1});
    longest = std::max(longest, Clock::now() - begin);
  }
  run.end("over");
  CHECK(longest < 2s);  // packing takes its time, sending none
  listening.join();
  CHECK(awake.is_closed());
  CHECK(all.ends_with("data: \"over\"\n\n"));
  const Clock::time_point begin = Clock::now();
  server.finish(10s);
  CHECK(Clock::now() - begin < 5s);
  CHECK(deaf.hear().find("over") == std::string::npos);
  CHECK(deaf.is_closed());
}

TEST_CASE("a long run is told in chapters") {
  const std::size_t nodes = whole().nodes.size();
  LiveRun run(beginning(), 100 * nodes);
  LiveServer server(run);
  REQUIRE(server.open(0) == "");
  const Served served(server);
  Client first(served.port);
  first.say(request(served, events_path(served)));
  run.add(states(1, 120));
  first.hear("id: 1-1\n");
  run.add(states(121, 10));  // which the first chapter has no room for
  const std::string told = first.hear();
  CHECK(first.is_closed());
  CHECK(told.ends_with("event: anew\ndata: \n\n"));
  const std::string page =
      answer(served, request(served, "/?token=" + served.token));
  CHECK(page.find("\"live\":2,") != std::string::npos);
  CHECK(page.find("\"states\":[0,1]") != std::string::npos);
  // A page of the first chapter, and one that never was.
  for (const std::uint64_t chapter : {1u, 7u}) {
    CHECK(answer(served, request(served, events_path(served, chapter)))
              .ends_with("event: anew\ndata: \n\n"));
  }
  Client second(served.port);
  second.say(request(served, events_path(served, 2)));
  CHECK(count(second.hear("id: 2-1\n"), "\ndata: {") == 1);
}

TEST_CASE("a port that another has cannot be had") {
  LiveRun run(beginning());
  LiveServer first(run);
  REQUIRE(first.open(0) == "");
  LiveServer second(run);
  CHECK(second.open(static_cast<std::uint16_t>(Served(first).port)) ==
        "Address already in use");
}

TEST_CASE("tokens are not guessed") {
  std::vector<std::string> tokens;
  for (int i = 0; i < 1000; ++i) tokens.push_back(random_token());
  std::ranges::sort(tokens);
  CHECK(std::ranges::adjacent_find(tokens) == tokens.end());
  CHECK(std::ranges::all_of(tokens, [](const std::string& token) {
    return token.size() == 32 &&
           token.find_first_not_of("0123456789abcdef") == std::string::npos;
  }));
}

}  // namespace btcheck::view_server_test
