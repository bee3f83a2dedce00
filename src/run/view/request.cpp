// SPDX-License-Identifier: MIT
#include "run/view/request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "text/numbers.hpp"

namespace btcheck {
namespace {

// Takes as long wherever the difference is.
bool is_same(std::string_view given, std::string_view token) {
  if (given.size() != token.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < token.size(); ++i) {
    difference |= static_cast<unsigned char>(given[i]) ^
                  static_cast<unsigned char>(token[i]);
  }
  return difference == 0;
}

// Of "a=1&b=2"; "" where it is not there.
std::string_view parameter(std::string_view query, std::string_view name) {
  while (!query.empty()) {
    const std::string_view part = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(part.size() + 1, query.size()));
    if (part.starts_with(name) && part.substr(name.size()).starts_with('=')) {
      return part.substr(name.size() + 1);
    }
  }
  return {};
}

// The names that a browser on this machine has for the server.
bool is_ours(std::string_view host, std::uint16_t port) {
  for (const std::string_view name : {"127.0.0.1", "localhost"}) {
    if (host == fmt::format("{}:{}", name, port)) return true;
    if (port == 80 && host == name) return true;
  }
  return false;
}

bool is_from_here(const LiveRequest& request, std::uint16_t port) {
  if (request.hosts.size() != 1 || !is_ours(request.hosts[0], port)) {
    return false;
  }
  const std::string own = fmt::format("http://{}", request.hosts[0]);
  return std::ranges::all_of(request.origins,
                             [&](std::string_view one) { return one == own; });
}

}  // namespace

std::string LiveAddress::text() const {
  return fmt::format("http://127.0.0.1:{}/?token={}", port, token);
}

std::string random_token() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 4; ++i) {
    token += fmt::format("{:08x}", static_cast<std::uint32_t>(random()));
  }
  return token;
}

LiveAnswer answer_to(const LiveRequest& request, const LiveAddress& address,
                     std::size_t runs) {
  const auto refused = [](unsigned status) {
    return LiveAnswer{status, std::nullopt};
  };
  if (!is_from_here(request, address.port)) return refused(403);
  if (request.method != "GET") return refused(405);
  const std::size_t sign = request.target.find('?');
  std::string_view path = request.target.substr(0, sign);
  const std::string_view query = sign == std::string_view::npos
                                     ? std::string_view()
                                     : request.target.substr(sign + 1);
  const bool is_list = runs != 1 && path == "/";
  std::size_t run = 0;
  if (runs != 1 && !is_list) {
    const std::size_t end = std::min(path.find('/', 1), path.size());
    const auto number = as_number<std::size_t>(path.substr(1, end - 1));
    if (!number || *number < 1 || *number > runs) return refused(404);
    run = *number - 1;
    path.remove_prefix(end);
  }
  if (path != "/" && path != "/events") return refused(404);
  if (!is_same(parameter(query, "token"), address.token)) return refused(403);
  if (is_list) return {200, std::nullopt, std::nullopt};
  if (path == "/") return {200, std::nullopt, run};
  // Who has heard a part of it goes on there.
  if (const auto place = LiveRun::place_of(request.last_event_id)) {
    return {200, *place, run};
  }
  const auto chapter = as_number<std::uint64_t>(parameter(query, "chapter"));
  return {200, LiveRun::Place{chapter.value_or(0), 0}, run};
}

}  // namespace btcheck
