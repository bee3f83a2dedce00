// SPDX-License-Identifier: MIT
//
// MessagePack: github.com/msgpack/msgpack/blob/master/spec.md. Numbers have the
// most significant byte first.
#include "groot2/entries.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "text/json.hpp"
#include "text/utf8.hpp"

namespace btcheck::groot2 {
namespace {

constexpr int kDeepest = 32;
constexpr std::size_t kLongestValue = 120;
constexpr std::size_t kMostShown = 2 * kLongestValue;
constexpr std::size_t kLongestKey = 200;
constexpr std::size_t kMostEntries = 10'000;

struct Flaw {
  std::string text;
};

class Packed {
 public:
  explicit Packed(std::string_view bytes) : bytes_(bytes) {}

  bool is_at_end() const { return at_ == bytes_.size(); }

  // The number of members of the map that stands here; nothing is there where
  // the engine has exported nothing.
  std::size_t map_size() {
    const unsigned tag = byte();
    if (tag == kNil) return 0;
    if (tag >= 0x80 && tag <= 0x8F) return tag & 0x0Fu;
    if (tag == 0xDE) return number(2);
    if (tag == 0xDF) return number(4);
    throw Flaw{fmt::format("byte {} is no map", at_ - 1)};
  }

  std::string key() {
    const unsigned tag = byte();
    const auto length = text_length(tag);
    if (!length) throw Flaw{fmt::format("byte {} is no name", at_ - 1)};
    return shown(piece(*length), kLongestKey);
  }

  // Behind the value; its text is added while it is not too long.
  void value(std::string& text, int depth = 0) {
    if (depth > kDeepest) {
      throw Flaw{fmt::format("values are nested deeper than {}", kDeepest)};
    }
    const unsigned tag = byte();
    if (const auto length = text_length(tag)) {
      const std::string_view whole = piece(*length);
      if (depth == 0) {
        text += shown(whole, kLongestValue);
      } else {
        add(text, Json(shown(whole, kLongestValue)).text());
      }
      return;
    }
    if (tag <= 0x7F) return add(text, std::to_string(tag));
    if (tag >= 0xE0) return add(text, std::to_string(int(tag) - 0x100));
    if (tag <= 0x8F) return members(tag & 0x0Fu, text, depth);
    if (tag <= 0x9F) return elements(tag & 0x0Fu, text, depth);
    switch (tag) {
      case kNil:
        return add(text, "null");
      case 0xC2:
        return add(text, "false");
      case 0xC3:
        return add(text, "true");
      case 0xC4:
      case 0xC5:
      case 0xC6:
        return bytes(number(std::size_t{1} << (tag - 0xC4)), text);
      case 0xC7:
      case 0xC8:
      case 0xC9: {
        const std::size_t length = number(std::size_t{1} << (tag - 0xC7));
        byte();  // the kind of extension
        return bytes(length, text);
      }
      case 0xCA:
        return add(text, fmt::format(
                             "{}", std::bit_cast<float>(
                                       static_cast<std::uint32_t>(number(4)))));
      case 0xCB:
        return add(
            text,
            fmt::format("{}", std::bit_cast<double>(std::uint64_t{number(8)})));
      case 0xCC:
      case 0xCD:
      case 0xCE:
      case 0xCF:
        return add(text,
                   std::to_string(number(std::size_t{1} << (tag - 0xCC))));
      case 0xD0:
        return add(text, std::to_string(static_cast<std::int8_t>(number(1))));
      case 0xD1:
        return add(text, std::to_string(static_cast<std::int16_t>(number(2))));
      case 0xD2:
        return add(text, std::to_string(static_cast<std::int32_t>(number(4))));
      case 0xD3:
        return add(text, std::to_string(static_cast<std::int64_t>(number(8))));
      case 0xD4:
      case 0xD5:
      case 0xD6:
      case 0xD7:
      case 0xD8:
        byte();
        return bytes(std::size_t{1} << (tag - 0xD4), text);
      case 0xDC:
        return elements(number(2), text, depth);
      case 0xDD:
        return elements(number(4), text, depth);
      case 0xDE:
        return members(number(2), text, depth);
      case 0xDF:
        return members(number(4), text, depth);
      default:
        throw Flaw{fmt::format("byte {} means nothing", at_ - 1)};
    }
  }

 private:
  static constexpr unsigned kNil = 0xC0;

  unsigned byte() { return static_cast<unsigned char>(piece(1)[0]); }

  std::string_view piece(std::size_t count) {
    if (count > bytes_.size() - at_) throw Flaw{"it is cut off"};
    const std::string_view found = bytes_.substr(at_, count);
    at_ += count;
    return found;
  }

  std::size_t number(std::size_t count) {
    std::size_t value = 0;
    for (const char one : piece(count)) {
      value = (value << 8) | static_cast<unsigned char>(one);
    }
    return value;
  }

  std::optional<std::size_t> text_length(unsigned tag) {
    if (tag >= 0xA0 && tag <= 0xBF) return tag & 0x1Fu;
    if (tag < 0xD9 || tag > 0xDB) return std::nullopt;
    return number(std::size_t{1} << (tag - 0xD9));
  }

  void elements(std::size_t count, std::string& text, int depth) {
    add(text, "[");
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) add(text, ",");
      value(text, depth + 1);
    }
    add(text, "]");
  }

  void members(std::size_t count, std::string& text, int depth) {
    add(text, "{");
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) add(text, ",");
      add(text, Json(key()).text() + ":");
      value(text, depth + 1);
    }
    add(text, "}");
  }

  void bytes(std::size_t count, std::string& text) {
    piece(count);
    add(text, fmt::format("({} bytes)", count));
  }

  static void add(std::string& text, std::string_view more) {
    if (text.size() < kLongestValue) text += more;
  }

  // One line of UTF-8.
  static std::string shown(std::string_view whole, std::size_t most) {
    std::string text = valid_utf8(unbroken(whole.substr(0, most)));
    return whole.size() > most ? text + "…" : text;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace

EntriesRead entries_in(std::string_view payload) {
  EntriesRead read;
  std::size_t count = 0;
  try {
    Packed packed(payload);
    for (std::size_t boards = packed.map_size(); boards > 0; --boards) {
      auto& board = read.boards[packed.key()];
      for (std::size_t left = packed.map_size(); left > 0; --left) {
        if (++count > kMostEntries) {
          throw Flaw{
              fmt::format("there are more than {} entries", kMostEntries)};
        }
        std::string& text = board[packed.key()];
        text.clear();
        packed.value(text);
        if (text.size() > kMostShown) {
          text = valid_utf8(std::string_view(text).substr(0, kMostShown));
        }
      }
    }
    if (!packed.is_at_end()) throw Flaw{"something follows its end"};
  } catch (const Flaw& flaw) {
    read.flaw = "what it says of blackboards is no MessagePack: " + flaw.text;
  }
  return read;
}

}  // namespace btcheck::groot2
