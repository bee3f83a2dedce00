// SPDX-License-Identifier: MIT
//
// Pictures of a state and of a run: what is in them, and that it fits.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "model/btcpp/xml_text.hpp"
#include "trace/pictures/pictures.hpp"
#include "trace/recorded_run_maker.hpp"
#include "trace/run/recorded_run.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck::pictures_test {
namespace {

// A tree with at least so many nodes, names of all lengths, and one tick.
RecordedRun large_run(std::size_t nodes) {
  std::mt19937 random(11);
  BtcppEngine engine;
  const auto top = engine.add("Sequence", "all of it", 0);
  while (engine.run().nodes.size() < nodes) {
    std::size_t left = 12;
    add_random_tree(engine, random, top, left);
  }
  for (RecordedNode& node : engine.run().nodes) {
    node.name += std::string(random() % 40, 'm');
  }
  engine.tick([](std::uint32_t) { return LogStatus::Success; });
  return engine.run();
}

// Every state has its phases in turn, so that all of them occur.
RecordedRun run_of_all_phases() {
  RecordedRun run = looping_run();
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    for (std::size_t n = 0; n < run.nodes.size(); ++n) {
      run.states[i].phases[n] =
          static_cast<Phase>((i + n) % kPhaseNames.size());
      run.states[i].is_stale[n] = (i + n) % 3 == 0;
    }
  }
  return run;
}

// The numbers after x, y, width, height of each rect, in the order of the text.
struct Rect {
  double x, y, width, height;
};

bool touch(const Rect& a, const Rect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
         b.y < a.y + a.height;
}

bool is_within(const Rect& inner, const Rect& outer) {
  return outer.x <= inner.x && outer.y <= inner.y &&
         inner.x + inner.width <= outer.x + outer.width &&
         inner.y + inner.height <= outer.y + outer.height;
}

// A picture taken apart.
struct Picture {
  std::vector<Rect> boxes;   // of nodes and of the legend
  std::vector<Rect> frames;  // around trees
  std::vector<Rect> texts;   // as wide as they can be
  std::string page_size;
};

double number(const btcpp::XmlElement& element, const char* attribute) {
  const std::string* value = element.value(attribute);
  REQUIRE(value != nullptr);
  return std::stod(*value);
}

constexpr double kBoxHeight = 20;  // of nodes, and of nothing else

Picture taken_apart(const std::string& svg) {
  Picture picture;
  const auto elements = btcpp::ParsedXml(svg).value;
  REQUIRE(elements);
  picture.page_size = *elements->front().value("width");
  for (const btcpp::XmlElement& element : *elements) {
    if (element.name == "rect" && *element.value("width") != "100%") {
      const Rect rect{number(element, "x"), number(element, "y"),
                      number(element, "width"), number(element, "height")};
      const bool is_box = rect.height == kBoxHeight;
      (is_box ? picture.boxes : picture.frames).push_back(rect);
    }
  }
  const std::regex text("<text x=\"([0-9.]+)\" y=\"([0-9.]+)\"[^>]*>([^<]*)<");
  for (std::sregex_iterator at(svg.begin(), svg.end(), text), end; at != end;
       ++at) {
    std::string letters = (*at)[3];
    letters = std::regex_replace(letters, std::regex("&[a-z]+;"), "x");
    picture.texts.push_back(
        {std::stod((*at)[1]), std::stod((*at)[2]) - 9,
         kLetterWidth * static_cast<double>(letter_count(letters)), 11});
  }
  return picture;
}

std::size_t touching(const std::vector<Rect>& rects) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < rects.size(); ++i) {
    for (std::size_t j = i + 1; j < rects.size(); ++j) {
      count += touch(rects[i], rects[j]);
    }
  }
  return count;
}

// Of the texts, those on the edge of a rect.
std::size_t crossing(const std::vector<Rect>& texts,
                     const std::vector<Rect>& rects) {
  std::size_t count = 0;
  for (const Rect& text : texts) {
    for (const Rect& rect : rects) {
      count += touch(text, rect) && !is_within(text, rect);
    }
  }
  return count;
}

void check_fits(const std::string& svg) {
  const Picture picture = taken_apart(svg);
  CHECK(touching(picture.boxes) == 0);
  CHECK(touching(picture.frames) == 0);
  CHECK(touching(picture.texts) == 0);
  CHECK(crossing(picture.texts, picture.boxes) == 0);
  CHECK(crossing(picture.texts, picture.frames) == 0);
  for (const Rect& frame : picture.frames) {
    CHECK(frame.x + frame.width <= std::stod(picture.page_size));
  }
}

TEST_CASE("nodes are called as in rules, control nodes have their sign") {
  RecordedRun run = looping_run();
  const auto labels = [&] { return node_labels(run); };
  CHECK(labels()[0] == "main (BehaviorTree)");
  CHECK(labels()[1] == "? ReactiveFallback2");
  CHECK(labels()[2] == "good?");
  run.nodes[1].name = run.nodes[2].name = "again";
  CHECK(labels()[1] == "? again@2 (ReactiveFallback)");
  CHECK(labels()[2] == "again@3");
  run.nodes[1].type = "Inverter";
  CHECK(labels()[1] == "again@2 (Inverter)");
}

TEST_CASE("a state in Graphviz's language") {
  RecordedRun run = looping_run();
  CHECK(dot_text(run, run.states.size() - 1) ==
        R"dot(digraph run {
  rankdir=LR;
  ordering=out;
  label="VIOLATED p, tick 3, step )dot" +
            std::to_string(run.states.size() - 1) + R"dot(";
  labelloc=t;
  fontname="Helvetica";
  node [shape=box, fontname="Helvetica", fontsize=10, height=0.3, color="#5b6470"];
  edge [color="#5b6470", arrowsize=0.5];
  n0 [label="↻ main (BehaviorTree)", tooltip="BehaviorTree main, line 1", style="filled", fillcolor="#ffd24a", fontcolor="#14181f"];
  n1 [label="↻ ? ReactiveFallback2", tooltip="ReactiveFallback ReactiveFallback2, line 2", style="filled", fillcolor="#ffd24a", fontcolor="#14181f"];
  n2 [label="✗ good?", tooltip="Condition good?, line 3", style="filled,rounded", fillcolor="#ec5b5b", fontcolor="#14181f"];
  n3 [label="↻ go \"home\"", tooltip="Action go \"home\", line 4", style="filled,rounded", fillcolor="#ffd24a", fontcolor="#14181f"];
  n0 -> n1;
  n1 -> n2;
  n1 -> n3;
}
)dot");
  run.states[5].phases[2] = Phase::Success;
  run.states[5].is_stale[2] = true;
  CHECK(dot_text(run, 5).find("style=\"filled,rounded,dashed\", "
                              "fillcolor=\"#cdecd8\", fontcolor=\"#414a55\"") !=
        std::string::npos);
}

TEST_CASE("a state in Mermaid's language") {
  RecordedRun run = looping_run();
  run.nodes[2].name = "<b>\"#1\"";
  run.states.back().is_stale[3] = true;
  const std::string text = mermaid_text(run, run.states.size() - 1);
  CHECK(text.starts_with(
      "flowchart LR\n"
      "  n0[\"↻ main (BehaviorTree)\"]:::running\n"
      "  n1[\"↻ ? ReactiveFallback2\"]:::running\n"
      "  n2(\"✗ #60;b#62;#34;#35;1#34;\"):::failure\n"
      "  n3(\"↻ go #34;home#34;\"):::running_before\n"
      "  n0 --> n1\n"
      "  n1 --> n2\n"
      "  n1 --> n3\n"
      "  classDef unvisited fill:#ffffff,color:#5b6470,stroke:#5b6470\n"
      "  classDef unvisited_before "));
  for (const std::string_view phase : kPhaseNames) {
    CHECK(text.find("classDef " + std::string(phase) + " fill:") !=
          std::string::npos);
  }
}

// The relative luminance of WCAG 2 of "#rrggbb".
double luminance(std::string_view color) {
  double sum = 0;
  constexpr std::array<double, 3> kWeights = {0.2126, 0.7152, 0.0722};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string part(color.substr(1 + 2 * i, 2));
    const double value = std::stoi(part, nullptr, 16) / 255.0;
    sum += kWeights[i] * (value <= 0.03928
                              ? value / 12.92
                              : std::pow((value + 0.055) / 1.055, 2.4));
  }
  return sum;
}

double contrast(std::string_view one, std::string_view other) {
  const double a = luminance(one) + 0.05;
  const double b = luminance(other) + 0.05;
  return a > b ? a / b : b / a;
}

TEST_CASE("every phase has a colour and a glyph of its own, all legible") {
  std::set<std::string_view> fills;
  std::set<std::string_view> glyphs;
  std::set<std::string> shapes;
  for (std::size_t p = 0; p < kPhaseNames.size(); ++p) {
    const PhaseLook& look = look_of(static_cast<Phase>(p));
    CAPTURE(kPhaseNames[p]);
    fills.insert(look.fill);
    glyphs.insert(look.glyph);
    shapes.insert(std::string(look.lines) + "," + std::string(look.spots));
    CHECK(letter_count(look.glyph) == 1);
    CHECK(contrast(look.fill, look.ink) >= 4.5);
    CHECK(contrast(faded(look.fill), kFadedInk) >= 4.5);
    CHECK(faded(look.fill).size() == 7);
  }
  CHECK(fills.size() == kPhaseNames.size());
  CHECK(glyphs.size() == kPhaseNames.size());
  CHECK(shapes.size() == kPhaseNames.size());
  CHECK(faded("#000000") == "#b3b3b3");
  CHECK(faded("#ffffff") == "#ffffff");
}

TEST_CASE("a state as SVG shows each node in its colour") {
  RecordedRun run = run_of_all_phases();
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    const std::string svg = svg_text(run, i);
    for (std::size_t n = 0; n < run.nodes.size(); ++n) {
      const auto phase = static_cast<std::size_t>(run.states[i].phases[n]);
      const bool is_stale = run.states[i].is_stale[n];
      const PhaseLook& look = look_of(run.states[i].phases[n]);
      const std::string title =
          "<title>" + run.nodes[n].type + " " + xml_escaped(run.nodes[n].name) +
          ", line " + std::to_string(n + 1) + ": " +
          std::string(kPhaseNames[phase]) +
          (is_stale ? " in an earlier tick" : "") + "</title>";
      const std::size_t at = svg.find(title);
      REQUIRE(at != std::string::npos);
      const std::string node = svg.substr(at, svg.find("</g>\n<g", at) - at);
      const std::string fill =
          is_stale ? faded(look.fill) : std::string(look.fill);
      CHECK(node.find("fill=\"" + fill + "\"") != std::string::npos);
      CHECK((node.find("stroke-dasharray") != std::string::npos) == is_stale);
      const std::string glyph(look.lines.empty() ? look.spots : look.lines);
      CHECK(node.find("d=\"" + glyph + "\"") != std::string::npos);
    }
    check_fits(svg);
  }
}

TEST_CASE("a picture says what it is of") {
  RecordedRun run = looping_run();
  run.formula = "a < b && \"c\"";
  const std::string svg = svg_text(run, run.lost);
  CHECK(svg.find("<title>VIOLATED p</title>") != std::string::npos);
  CHECK(svg.find(">a &lt; b &amp;&amp; &quot;c&quot;</text>") !=
        std::string::npos);
  CHECK(svg.find(">nobody looks at the battery</text>") != std::string::npos);
  CHECK(svg.find(">battery = Low, level = 20</text>") != std::string::npos);
  CHECK(svg.find(">t.btf</text>") != std::string::npos);
}

TEST_CASE("a film strip has a frame for each tick") {
  const RecordedRun run = looping_run();
  const std::string svg = svg_strip(run);
  const Picture picture = taken_apart(svg);
  CHECK(picture.frames.size() == 3);
  CHECK(picture.boxes.size() == 3 * run.nodes.size() + kPhaseNames.size() + 1);
  CHECK(svg.find(">tick 1</text>") != std::string::npos);
  CHECK(svg.find(">tick 2, lost here</text>") != std::string::npos);
  CHECK(svg.find(">tick 3, repeats for ever</text>") != std::string::npos);
  CHECK(svg.find(">good? -&gt; failure</text>") != std::string::npos);
  CHECK(svg.find(">battery = Good, level = 10</text>") != std::string::npos);
  check_fits(svg);
}

TEST_CASE("many choices of a tick are counted") {
  BtcppEngine engine;
  const auto sequence = engine.add("Sequence", "s", 0);
  for (int i = 1; i <= 9; ++i) {
    engine.add("Action", "a" + std::to_string(i), sequence);
  }
  engine.tick([](std::uint32_t) { return LogStatus::Success; });
  const std::string svg = svg_strip(engine.run());
  CHECK(svg.find(">a7 -&gt; success</text>") != std::string::npos);
  CHECK(svg.find(">and 2 more</text>") != std::string::npos);
  CHECK(svg.find(">a8 -&gt; success</text>") == std::string::npos);
  check_fits(svg);
}

TEST_CASE("frames that matter are marked in words and by their border") {
  RecordedRun run = looping_run();
  run.trigger = run.lost - 1;
  run.trigger_words = "asked here, not answered";
  const std::string svg = svg_strip(run);
  CHECK(svg.find(">tick 1, asked here, not answered</text>") !=
        std::string::npos);
  CHECK(svg.find("stroke=\"#c62828\"") != std::string::npos);
  run.verdict = "HOLDS";
  const std::string witness = svg_strip(run);
  CHECK(witness.find(">tick 2, shown here</text>") != std::string::npos);
  CHECK(witness.find("stroke=\"#c62828\"") == std::string::npos);
  CHECK(witness.find("stroke=\"#17693a\"") != std::string::npos);
  check_fits(svg);
}

TEST_CASE("a long run is a strip with a gap that is named") {
  RecordedRun run = looping_run();
  run.loop = run.lost = kNoState;
  const std::vector<RecordedState> once = run.states;
  for (int tick = 4; tick <= 100; ++tick) {
    run.states.push_back(once.back());
    run.states.back().tick = tick;
  }
  const std::string svg = svg_strip(run);
  CHECK(taken_apart(svg).frames.size() == 60);
  CHECK(svg.find(">tick 30</text>") != std::string::npos);
  CHECK(svg.find(">tick 31</text>") == std::string::npos);
  CHECK(svg.find(">tick 71, after 40 ticks that are left out</text>") !=
        std::string::npos);
  CHECK(svg.find(">tick 100</text>") != std::string::npos);
  check_fits(svg);
}

TEST_CASE("trees of forty and of 330 nodes do not overlap") {
  for (const std::size_t nodes : {40u, 330u}) {
    const RecordedRun run = large_run(nodes);
    REQUIRE(run.nodes.size() >= nodes);
    check_fits(svg_text(run, run.states.size() / 2));
    check_fits(svg_strip(run));
  }
}

TEST_CASE("names of any kind leave a picture whole") {
  RecordedRun run = looping_run();
  run.nodes[1].name = "]]>&<\"'\x01\xff\n second line";
  run.nodes[2].name = std::string(300, 'w');
  run.nodes[3].name = "größe 日本";
  run.property = "<p>";
  run.why = "\xc3\x28 & so";
  run.variables[0] = "</text>";
  const std::string svg = svg_strip(run);
  check_fits(svg);
  CHECK(svg.find("]]&gt;&amp;&lt;&quot;&apos;??") != std::string::npos);
  CHECK(svg.find("second line") == std::string::npos);
  CHECK(svg.find('\x01') == std::string::npos);
  CHECK(svg.find(std::string(29, 'w') + "…<") != std::string::npos);
  CHECK(svg.find("größe 日本") != std::string::npos);
  for (const std::string& text : {dot_text(run, 3), mermaid_text(run, 3)}) {
    CHECK(text.find('\x01') == std::string::npos);
    CHECK(text.find('\xff') == std::string::npos);
  }
}

TEST_CASE("a shortened text ends in an ellipsis and counts code points") {
  CHECK(shortened("größe", 5) == "größe");
  CHECK(shortened("größe", 4) == "grö…");
  CHECK(shortened("größe", 1) == "…");
  CHECK(letter_count("größe…") == 6);
  CHECK(one_line("a\tb\x1b\r\nc") == "a b?");
  CHECK(plain_word("a-b_1 größe", "-") == "a-b_1_gr__e");
}

}  // namespace
}  // namespace btcheck::pictures_test
