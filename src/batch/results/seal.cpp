// SPDX-License-Identifier: MIT
#include "batch/results/seal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <boost/uuid/detail/sha1.hpp>
#include <filesystem>
#include <initializer_list>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "cli/inputs/build.hpp"
#include "cli/options/interface.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kKeyLength = 32;

using Sha1 = boost::uuids::detail::sha1;

std::string sha1(std::initializer_list<std::string_view> parts) {
  Sha1 hash;
  for (const std::string_view part : parts) {
    hash.process_bytes(part.data(), part.size());
  }
  Sha1::digest_type words;
  hash.get_digest(words);
  std::string bytes;
  for (const auto word : words) {  // words in older releases of Boost, or bytes
    for (std::size_t shift = 8 * sizeof word; shift > 0; shift -= 8) {
      bytes += static_cast<char>(word >> (shift - 8));
    }
  }
  return bytes;
}

// HMAC-SHA-1 (RFC 2104).
std::string sealed(std::string_view secret, std::string_view text) {
  constexpr std::size_t kBlock = 64;
  std::string key =
      secret.size() > kBlock ? sha1({secret}) : std::string(secret);
  key.resize(kBlock);
  std::string inner = key;
  std::string outer = key;
  for (char& c : inner) c = static_cast<char>(c ^ 0x36);
  for (char& c : outer) c = static_cast<char>(c ^ 0x5c);
  std::string seal;
  for (const char c : sha1({outer, sha1({inner, text})})) {
    seal += fmt::format("{:02x}", static_cast<unsigned char>(c));
  }
  return seal;
}

}  // namespace

std::string content_hash(std::string_view text) {
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string host_name() {
  char name[256] = {};
  ::gethostname(name, sizeof name - 1);
  return name;
}

std::string heading() {
  std::error_code fault;
  return fmt::format("# btcheck {} (build {}) on {} in {}, process {}\n",
                     kVersion, build_identity(), host_name(),
                     std::filesystem::current_path(fault).string(), ::getpid());
}

std::string build_in(std::string_view heading) {
  constexpr std::string_view kBefore = "(build ";
  const std::size_t at = heading.find(kBefore);
  if (at == heading.npos) return {};
  const std::string_view rest = heading.substr(at + kBefore.size());
  return std::string(rest.substr(0, rest.find(')')));
}

std::string Seal::of(std::string_view text) const {
  return secret_.empty() ? content_hash(text) : sealed(secret_, text);
}

std::string Seal::line(std::string_view key, std::string_view tree) const {
  const std::string rest = fmt::format("{} {}", key, tree);
  return fmt::format("{} {}\n", of(rest), rest);
}

std::optional<SealedLine> Seal::opened(std::string_view line) const {
  const std::size_t seal = line.find(' ');
  if (seal == line.npos) return std::nullopt;
  const std::string_view rest = line.substr(seal + 1);
  if (rest.size() <= kKeyLength || rest[kKeyLength] != ' ' ||
      of(rest) != line.substr(0, seal)) {
    return std::nullopt;
  }
  return SealedLine{rest.substr(0, kKeyLength), rest.substr(kKeyLength + 1)};
}

}  // namespace btcheck
