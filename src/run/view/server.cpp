// SPDX-License-Identifier: MIT
//
// One thread serves all clients, without waiting for any: a client has its
// place in the list of messages and is sent the next one when it has taken the
// last. Nobody else waits for this thread: who adds to the run posts a note.
#include "run/view/server.hpp"

#include <fcntl.h>

#include <atomic>
#include <boost/asio/dispatch.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "run/view/list_page.hpp"
#include "run/view/request.hpp"

namespace btcheck {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using boost::system::error_code;

// No process that is started gets the connection.
void keep_to_ourselves(int file) { ::fcntl(file, F_SETFD, FD_CLOEXEC); }

// What goes with every answer: nothing is kept, nothing is handed on, nothing
// is framed, and of the network the page may ask this server alone.
std::string headers(std::string_view type, std::string_view nonce) {
  return fmt::format(
      "Content-Type: {}; charset=utf-8\r\n"
      "Cache-Control: no-store\r\n"
      "Connection: close\r\n"
      "Content-Security-Policy: default-src 'none'; style-src "
      "'unsafe-inline'; script-src 'nonce-{}'; img-src data:; connect-src "
      "'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n"
      "Cross-Origin-Opener-Policy: same-origin\r\n"
      "Cross-Origin-Resource-Policy: same-origin\r\n"
      "Referrer-Policy: no-referrer\r\n"
      "X-Content-Type-Options: nosniff\r\n"
      "X-Frame-Options: DENY\r\n",
      type, nonce);
}

std::string whole_answer(unsigned status, std::string_view type,
                         std::string_view nonce, std::string_view body) {
  return fmt::format(
      "HTTP/1.1 {} {}\r\n{}{}Content-Length: {}\r\n\r\n{}", status,
      std::string(http::obsolete_reason(static_cast<http::status>(status))),
      headers(type, nonce), status == 405 ? "Allow: GET\r\n" : "", body.size(),
      body);
}

}  // namespace

// Where clients come in.
class LiveServer::Hall {
 public:
  Hall(std::vector<std::string> names, const ServerLimits& limits)
      : names_(std::move(names)),
        runs_(names_.size(), nullptr),
        limits_(limits),
        acceptor_(context_) {}

  ~Hall() {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (LiveRun* run = run_at(i)) run->on_news({});
    }
    if (!thread_.joinable()) return;
    context_.stop();
    thread_.join();
  }

  std::string open(std::uint16_t port) {
    const tcp::endpoint place(asio::ip::address_v4::loopback(), port);
    error_code fault;
    acceptor_.open(place.protocol(), fault);
    if (!fault) acceptor_.set_option(tcp::acceptor::reuse_address(true), fault);
    if (!fault) acceptor_.bind(place, fault);
    if (!fault) acceptor_.listen(static_cast<int>(limits_.connections), fault);
    if (fault) return fault.message();
    keep_to_ourselves(acceptor_.native_handle());
    address_ = {acceptor_.local_endpoint().port(), random_token()};
    accept();
    thread_ = std::thread([this] { serve(); });
    return "";
  }

  void show(std::size_t place, LiveRun& run) {
    {
      const std::lock_guard lock(mutex_);
      runs_[place] = &run;
    }
    run.on_news([this] { note_news(); });
  }

  std::string address() const { return address_.text(); }

  bool is_watched() {
    const std::lock_guard lock(mutex_);
    return listeners_ > 0 || is_awaited_;
  }

  void finish(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    all_told_.wait_for(lock, patience,
                       [this] { return listeners_ == 0 && !is_awaited_; });
  }

 private:
  class Guest;

  // Where memory runs out a client is lost, and never the run.
  void serve() {
    while (!context_.stopped()) {
      try {
        context_.run();
      } catch (const std::exception&) {
      }
    }
  }

  void accept() {
    acceptor_.async_accept([this](const error_code& fault, tcp::socket socket) {
      if (!fault) receive(std::move(socket));
      if (fault == asio::error::operation_aborted) return;
      if (!fault) return accept();
      // No descriptors are left, for instance: not at once again.
      pause_.expires_after(std::chrono::milliseconds(100));
      pause_.async_wait([this](const error_code& stopped) {
        if (!stopped) accept();
      });
    });
  }

  // Null where it is not there yet.
  LiveRun* run_at(std::size_t place) {
    const std::lock_guard lock(mutex_);
    return runs_[place];
  }
  std::string page(std::optional<std::size_t> place, std::string_view nonce);

  void receive(tcp::socket socket);
  void leave(const std::shared_ptr<Guest>& guest) { present_.erase(guest); }

  // By any thread; a note that is on its way is enough.
  void note_news() {
    if (has_news_.exchange(true)) return;
    asio::post(context_, [this] { spread_news(); });
  }
  void spread_news();

  // Somebody has got the page, and will listen; listens; has gone.
  enum class Visit { Page, Begin, End };
  void note(Visit visit) {
    const std::lock_guard lock(mutex_);
    is_awaited_ = visit == Visit::Page || (is_awaited_ && visit == Visit::End);
    if (visit == Visit::Begin) ++listeners_;
    if (visit == Visit::End) --listeners_;
    all_told_.notify_all();
  }

  const std::vector<std::string> names_;
  std::vector<LiveRun*> runs_;  // behind the mutex
  const ServerLimits limits_;
  LiveAddress address_;
  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer pause_{context_};
  std::set<std::shared_ptr<Guest>> present_;
  std::atomic<bool> has_news_ = false;
  std::thread thread_;

  std::mutex mutex_;
  std::condition_variable all_told_;
  int listeners_ = 0;
  bool is_awaited_ = false;
};

// One connection: a request, and its answer. Everything happens on the thread
// of the hall.
class LiveServer::Hall::Guest : public std::enable_shared_from_this<Guest> {
 public:
  Guest(Hall& hall, tcp::socket socket)
      : hall_(hall),
        stream_(std::move(socket)),
        buffer_(hall.limits_.header_bytes + 1024) {
    parser_.header_limit(static_cast<std::uint32_t>(hall.limits_.header_bytes));
  }

  void hear() {
    stream_.expires_after(hall_.limits_.to_ask);
    http::async_read(
        stream_, buffer_, parser_,
        [self = shared_from_this()](const error_code& fault, std::size_t) {
          if (fault) return self->leave();
          self->answer();
        });
  }

  // Something may be new.
  void look() {
    if (place_ && !is_writing_ && !is_gone_) go_on();
  }

 private:
  void answer() {
    const auto& asked = parser_.get();
    const auto all = [&](http::field name) {
      std::vector<std::string_view> values;
      const auto [begin, end] = asked.equal_range(name);
      for (auto one = begin; one != end; ++one) {
        values.push_back(view(one->value()));
      }
      return values;
    };
    const LiveAnswer found =
        answer_to({view(asked.method_string()), view(asked.target()),
                   all(http::field::host), all(http::field::origin),
                   view(asked["Last-Event-ID"])},
                  hall_.address_, hall_.names_.size());
    const std::string nonce = random_token();
    if (found.events) run_ = hall_.run_at(*found.run);
    if (run_ != nullptr) {
      place_ = found.events;
      hall_.note(Visit::Begin);
      watch_for_leaving();
      send(std::make_shared<const std::string>(
          "HTTP/1.1 200 OK\r\n" + headers("text/event-stream", nonce) +
          "\r\nretry: 500\n\n"));
    } else if (found.status == 200) {
      if (found.run && hall_.run_at(*found.run)) hall_.note(Visit::Page);
      send(std::make_shared<const std::string>(
          whole_answer(200, "text/html", nonce, hall_.page(found.run, nonce))));
    } else {
      send(std::make_shared<const std::string>(whole_answer(
          found.status, "text/plain", nonce,
          found.status == 403 ? "the address is not the one that btcheck has "
                                "printed\n"
                              : "there is nothing here\n")));
    }
  }

  static std::string_view view(beast::string_view text) {
    return {text.data(), text.size()};
  }

  // Nothing more is said by who listens; what comes all the same, an end for
  // instance, is the end.
  void watch_for_leaving() {
    stream_.expires_never();
    stream_.async_read_some(
        asio::buffer(&ignored_, 1),
        [self = shared_from_this()](const error_code&, std::size_t) {
          self->leave();
        });
  }

  void send(LiveRun::Message message) {
    is_writing_ = true;
    stream_.expires_after(hall_.limits_.to_listen);
    const auto bytes = asio::buffer(*message);
    asio::async_write(stream_, bytes,
                      [self = shared_from_this(), message = std::move(message)](
                          const error_code& fault, std::size_t) {
                        self->is_writing_ = false;
                        if (fault || !self->place_ || self->is_gone_) {
                          return self->leave();
                        }
                        self->go_on();
                      });
  }

  void go_on() {
    if (auto message = run_->next(*place_)) {
      send(std::move(message));
    } else if (run_->is_told(*place_)) {
      leave();
    }
  }

  void leave() {
    if (std::exchange(is_gone_, true)) return;
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_both, ignored);
    stream_.close();
    if (place_) hall_.note(Visit::End);
    hall_.leave(shared_from_this());
  }

  Hall& hall_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  LiveRun* run_ = nullptr;               // of who listens
  std::optional<LiveRun::Place> place_;  // likewise
  bool is_writing_ = false;
  bool is_gone_ = false;
  char ignored_ = 0;
};

void LiveServer::Hall::receive(tcp::socket socket) {
  if (present_.size() >= limits_.connections) return;  // and is closed
  keep_to_ourselves(socket.native_handle());
  auto guest = std::make_shared<Guest>(*this, std::move(socket));
  present_.insert(guest);
  guest->hear();
}

void LiveServer::Hall::spread_news() {
  has_news_ = false;
  const std::vector<std::shared_ptr<Guest>> guests(present_.begin(),
                                                   present_.end());
  for (const std::shared_ptr<Guest>& guest : guests) guest->look();
}

std::string LiveServer::Hall::page(std::optional<std::size_t> place,
                                   std::string_view nonce) {
  if (place) {
    if (const LiveRun* run = run_at(*place)) return run->page(nonce);
    return waiting_page(names_[*place]);
  }
  std::vector<ListedRun> listed;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    listed.push_back({names_[i], run_at(i) != nullptr});
  }
  return list_page(listed, address_.token);
}

LiveServer::LiveServer(LiveRun& run, const ServerLimits& limits)
    : LiveServer(std::vector<std::string>{""}, limits) {
  show(0, run);
}

LiveServer::LiveServer(std::vector<std::string> names,
                       const ServerLimits& limits)
    : hall_(std::make_unique<Hall>(std::move(names), limits)) {}

LiveServer::~LiveServer() = default;

std::string LiveServer::open(std::uint16_t port) { return hall_->open(port); }

void LiveServer::show(std::size_t place, LiveRun& run) {
  hall_->show(place, run);
}

std::string LiveServer::address() const { return hall_->address(); }

bool LiveServer::is_watched() const { return hall_->is_watched(); }

void LiveServer::finish(std::chrono::milliseconds patience) {
  hall_->finish(patience);
}

}  // namespace btcheck
