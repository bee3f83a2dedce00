// SPDX-License-Identifier: MIT
//
// What libzmq asks the C library for, where btcheck is linked statically.
// glibc's own getaddrinfo, getpwuid and getgrgid load what /etc/nsswitch.conf
// names, at the versions of the machine where the program was built. So
// addresses are read here: numbers, the names of /etc/hosts, and what the name
// server says. script/libraries compiles libzmq with these names for theirs.
#include <arpa/inet.h>
#include <arpa/nameser.h>
#include <grp.h>
#include <netdb.h>
#include <netinet/in.h>
#include <pwd.h>
#include <resolv.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <variant>

namespace {

using Address = std::variant<in_addr, in6_addr>;

std::optional<Address> number_in(const std::string& text, bool takes_six) {
  in_addr four;
  if (::inet_pton(AF_INET, text.c_str(), &four) == 1) return four;
  in6_addr six;
  if (takes_six && ::inet_pton(AF_INET6, text.c_str(), &six) == 1) return six;
  return std::nullopt;
}

std::optional<Address> address_in_hosts(const std::string& name,
                                        bool takes_six) {
  std::ifstream hosts("/etc/hosts");
  for (std::string line; std::getline(hosts, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string number;
    words >> number;
    for (std::string word; words >> word;) {
      if (word != name) continue;
      if (auto found = number_in(number, takes_six)) return found;
    }
  }
  return std::nullopt;
}

std::optional<Address> answered(const std::string& name, ns_type type,
                                std::size_t size) {
  std::array<unsigned char, 4096> answer;
  const int length = ::res_search(name.c_str(), ns_c_in, type, answer.data(),
                                  static_cast<int>(answer.size()));
  ns_msg message;
  if (length < 0 || length > static_cast<int>(answer.size()) ||
      ::ns_initparse(answer.data(), length, &message) != 0) {
    return std::nullopt;
  }
  for (int i = 0; i < ns_msg_count(message, ns_s_an); ++i) {
    ns_rr record;
    if (::ns_parserr(&message, ns_s_an, i, &record) != 0) return std::nullopt;
    if (ns_rr_type(record) != type || ns_rr_rdlen(record) != size) continue;
    if (type == ns_t_a) {
      in_addr four;
      std::memcpy(&four, ns_rr_rdata(record), size);
      return four;
    }
    in6_addr six;
    std::memcpy(&six, ns_rr_rdata(record), size);
    return six;
  }
  return std::nullopt;
}

std::optional<Address> address_of(const std::string& name, bool takes_six) {
  if (auto found = number_in(name, takes_six)) return found;
  if (auto found = address_in_hosts(name, takes_six)) return found;
  if (auto found = answered(name, ns_t_a, sizeof(in_addr))) return found;
  if (!takes_six) return std::nullopt;
  return answered(name, ns_t_aaaa, sizeof(in6_addr));
}

struct Found {
  addrinfo info;
  sockaddr_storage place;
};

}  // namespace

extern "C" {

int btcheck_getaddrinfo(const char* name, const char*, const addrinfo* hints,
                        addrinfo** result) {
  const bool wants_six = hints != nullptr && hints->ai_family == AF_INET6;
  const auto address = address_of(name == nullptr ? "" : name, wants_six);
  if (!address) return EAI_NONAME;
  auto* found = static_cast<Found*>(std::calloc(1, sizeof(Found)));
  if (found == nullptr) return EAI_MEMORY;
  found->info.ai_socktype = hints == nullptr ? SOCK_STREAM : hints->ai_socktype;
  found->info.ai_addr = reinterpret_cast<sockaddr*>(&found->place);
  const auto* four = std::get_if<in_addr>(&*address);
  if (four != nullptr && !wants_six) {
    auto* place = reinterpret_cast<sockaddr_in*>(&found->place);
    place->sin_family = AF_INET;
    place->sin_addr = *four;
    found->info.ai_addrlen = sizeof(sockaddr_in);
  } else {
    auto* place = reinterpret_cast<sockaddr_in6*>(&found->place);
    place->sin6_family = AF_INET6;
    if (four != nullptr) {  // as ::ffff:127.0.0.1
      place->sin6_addr.s6_addr[10] = 0xFF;
      place->sin6_addr.s6_addr[11] = 0xFF;
      std::memcpy(place->sin6_addr.s6_addr + 12, four, sizeof(in_addr));
    } else {
      place->sin6_addr = std::get<in6_addr>(*address);
    }
    found->info.ai_addrlen = sizeof(sockaddr_in6);
  }
  found->info.ai_family = found->place.ss_family;
  *result = &found->info;
  return 0;
}

void btcheck_freeaddrinfo(addrinfo* found) { std::free(found); }

passwd* btcheck_getpwuid(uid_t) { return nullptr; }
group* btcheck_getgrgid(gid_t) { return nullptr; }

}  // extern "C"
