// SPDX-License-Identifier: MIT
//
// Places and elements of texts that are being written, against what is known
// otherwise: every place counted again, every file read by tinyxml2.
#include <doctest/doctest.h>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "file_text.hpp"
#include "lsp/texts/lines.hpp"
#include "lsp/texts/xml_scan.hpp"
#include "model/btcpp/xml_text.hpp"
#include "text/utf8.hpp"

namespace btcheck::lsp_texts_test {

namespace fs = std::filesystem;
using lsp::Encoding;
using lsp::Lines;
using lsp::Position;
using lsp::Shift;
using lsp::XmlScan;

namespace {

std::string random_text(std::mt19937& chance, std::size_t most) {
  static const std::vector<std::string> kPieces = {
      "a", "<", "ü", "𝄞", "\n", "\r\n", "\r", " ", "\xff", "漢", "\""};
  std::string text;
  const std::size_t count = chance() % most;
  for (std::size_t i = 0; i < count; ++i) {
    text += kPieces[chance() % kPieces.size()];
  }
  return text;
}

// By counting from the beginning.
Position counted(std::string_view text, std::size_t offset, Encoding encoding) {
  Position place;
  for (std::size_t at = 0; at < offset;) {
    const CodePoint point = decode(text, at);
    const bool is_last_return =
        text[at] == '\r' && (at + 1 == text.size() || text[at + 1] != '\n');
    at += point.length;
    if (text[at - 1] == '\n' || is_last_return) {
      ++place.line;
      place.character = 0;
    } else if (text[at - 1] != '\r') {
      place.character += encoding == Encoding::Utf8 ? point.length
                         : encoding == Encoding::Utf16 && point.value > 0xFFFF
                             ? 2
                             : 1;
    }
  }
  return place;
}

std::vector<fs::path> xml_files() {
  std::vector<fs::path> all;
  const std::string root = std::string(BTCHECK_EXAMPLES) + "/..";
  for (const char* folder : {"/examples", "/tests"}) {
    for (const auto& each : fs::recursive_directory_iterator(root + folder)) {
      if (each.path().extension() == ".xml") all.push_back(each.path());
    }
  }
  return all;
}

}  // namespace

TEST_CASE("a place is what counting from the beginning says") {
  std::mt19937 chance(20261128);
  for (int round = 0; round < 500; ++round) {
    const std::string text = random_text(chance, 60);
    const Lines lines(text);
    for (const Encoding encoding :
         {Encoding::Utf8, Encoding::Utf16, Encoding::Utf32}) {
      for (std::size_t at = 0; at <= text.size();) {
        CAPTURE(text);
        CAPTURE(at);
        const Position place = lines.position(at, encoding);
        // Between the two bytes of an end of line nobody points.
        const bool is_within = at > 0 && at < text.size() &&
                               text[at - 1] == '\r' && text[at] == '\n';
        if (!is_within) {
          CHECK(place == counted(text, at, encoding));
          CHECK(lines.offset(place, encoding) == at);
        }
        at += at < text.size() ? decode(text, at).length : 1;
      }
    }
  }
}

TEST_CASE("what both texts have stays where it is") {
  std::mt19937 chance(7);
  int untouched = 0;
  for (int round = 0; round < 2000; ++round) {
    const std::string before = random_text(chance, 30);
    const std::size_t begin = before.empty() ? 0 : chance() % before.size();
    const std::size_t end = begin + chance() % (before.size() - begin + 1);
    const std::string put = random_text(chance, 8);
    const std::string after =
        before.substr(0, begin) + put + before.substr(end);
    const Shift shift(before, after);
    const TextStretch head{0, begin};
    const TextStretch tail{end, before.size()};
    const auto text_of = [&](TextStretch part) {
      return std::string(shift.moved(part).in(after));
    };
    CAPTURE(before);
    CAPTURE(after);
    // Where the part put in is like its neighbours, the change may be seen
    // beside its place; what it does not touch keeps its text.
    const TextStretch part = shift.part();
    if (head.end <= part.begin) CHECK(text_of(head) == before.substr(0, begin));
    if (tail.begin >= part.end) {
      ++untouched;
      CHECK(text_of(tail) == before.substr(end));
    }
  }
  CHECK(untouched > 1000);
}

TEST_CASE("whole files are scanned as they are read") {
  std::size_t count = 0;
  for (const fs::path& path : xml_files()) {
    const std::string text = file_text(path.string());
    const btcpp::ParsedXml parsed(text);
    if (!parsed.value) continue;
    const XmlScan scan(text);
    CAPTURE(path);
    REQUIRE(scan.elements().size() == parsed.value->size());
    for (std::size_t i = 0; i < scan.elements().size(); ++i) {
      const btcpp::XmlElement& known = (*parsed.value)[i];
      const lsp::ScannedElement& found = scan[i];
      CAPTURE(known.name);
      CAPTURE(known.span.line);
      CHECK(scan.name(i) == known.name);
      CHECK(found.start_tag.begin == known.start_tag.begin);
      CHECK(found.start_tag.end == known.start_tag.end);
      CHECK(found.end_tag.size() == known.end_tag.size());
      CHECK(found.children == known.children);
      REQUIRE(found.attributes.size() == known.attributes.size());
      for (std::size_t k = 0; k < known.attributes.size(); ++k) {
        CHECK(scan.text(found.attributes[k].name) == known.attributes[k].name);
        CHECK(found.attributes[k].value.begin ==
              known.attributes[k].value_part.begin);
        CHECK(found.attributes[k].value.end ==
              known.attributes[k].value_part.end);
      }
      ++count;
    }
  }
  MESSAGE(count << " elements");
  CHECK(count > 5000);
}

}  // namespace btcheck::lsp_texts_test
