// SPDX-License-Identifier: MIT
//
// Hostile texts, and what is left of them.
#include "report/formats/escapes.hpp"

#include <doctest/doctest.h>

#include <string>

namespace btcheck::escapes_test {
namespace {

TEST_CASE("a plain text stays what it is") {
  const std::string text = "Über\t`a` → \U0001F600\nnext";
  CHECK(plain_text(text) == text);
}

TEST_CASE("control characters and broken bytes become question marks") {
  CHECK(plain_text("a\x01z") == "a?z");
  CHECK(plain_text(std::string("a\0z", 3)) == "a?z");
  CHECK(plain_text("\x1b[31mred") == "?[31mred");
  CHECK(plain_text("\x7f") == "?");
  CHECK(plain_text("\xc2\x85") == "?");             // a control of Latin-1
  CHECK(plain_text("\xff\xfe") == "??");            // never UTF-8
  CHECK(plain_text("\xc3") == "?");                 // cut off
  CHECK(plain_text("\xc0\xaf") == "??");            // longer than need be
  CHECK(plain_text("\xed\xa0\x80") == "???");       // half a pair
  CHECK(plain_text("\xef\xbf\xbf") == "?");         // U+FFFF
  CHECK(plain_text("\xf4\x90\x80\x80") == "????");  // beyond Unicode
  CHECK(plain_text("\xef\xbf\xbdx") == "\xef\xbf\xbdx");
}

TEST_CASE("lines end with a line feed") {
  CHECK(plain_text("a\r\nb") == "a\nb");
  CHECK(plain_text("a\rb") == "a?b");
  CHECK(plain_text("a\r") == "a?");
}

TEST_CASE("XML's marks are written as entities") {
  CHECK(xml_text("a < b && c > \"d\"\n]]>") ==
        "a &lt; b &amp;&amp; c &gt; &quot;d&quot;\n]]&gt;");
  CHECK(xml_attribute("a < \"b\"\n\tc") == "a &lt; &quot;b&quot;&#10;&#9;c");
  CHECK(xml_text("\x0b") == "?");
}

TEST_CASE("nothing leaves a workflow command") {
  CHECK(xml_text("::a\nb::c\n \t::d\n\n") == "&#58;:a\nb::c\n \t&#58;:d\n\n");
  CHECK(github_message("50%\n::error::no") == "50%25%0A::error::no");
  CHECK(github_message("a\r\nb, c: d") == "a%0Ab, c: d");
  CHECK(github_property("a,b:c%\n") == "a%2Cb%3Ac%25%0A");
}

TEST_CASE("a SARIF message has neither arguments nor links") {
  CHECK(sarif_message("x in {0}") == "x in {{0}}");
  CHECK(sarif_message("[](a => <> b)") == "[] (a => <> b)");
  CHECK(sarif_message("[](a) [](b)") == "[] (a) [] (b)");
  CHECK(sarif_message("within [0,2]") == "within [0,2]");
}

TEST_CASE("a file is named from the root of the repository") {
  CHECK(path_from("/r", "/r", "t.btf") == "t.btf");
  CHECK(path_from("/r", "/r", "./trees/../t.btf") == "t.btf");
  CHECK(path_from("/r", "/r/robot", "t.btf") == "robot/t.btf");
  CHECK(path_from("/r", "/r/robot", "../t.btf") == "t.btf");
  CHECK(path_from("/r", "/r", "/r/trees/t.btf") == "trees/t.btf");
  CHECK(path_from("/r", "/r", "/elsewhere/t.btf") == "/elsewhere/t.btf");
  CHECK(path_from("/r", "/r", "../t.btf") == "../t.btf");
  CHECK(path_from("/other", "/r", "t.btf") == "t.btf");
}

TEST_CASE("a path becomes a URI reference") {
  CHECK(uri_of("trees/t.btf") == "trees/t.btf");
  CHECK(uri_of("my trees/ü#1.btf") == "my%20trees/%C3%BC%231.btf");
  CHECK(uri_of("a:b%") == "a%3Ab%25");
  CHECK(uri_of("/tmp/a b") == "file:///tmp/a%20b");
}

TEST_CASE("fingerprints are those of FNV-1a") {
  CHECK(fingerprint("") == "cbf29ce484222325");
  CHECK(fingerprint("a") == "af63dc4c8601ec8c");
  CHECK(fingerprint("foobar") == "85944171f73967e8");
}

}  // namespace
}  // namespace btcheck::escapes_test
