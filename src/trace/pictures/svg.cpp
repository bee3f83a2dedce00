// SPDX-License-Identifier: MIT
//
// Labels are set in a monospaced font, so their widths are known here, and the
// boxes around them fit whatever font a viewer has. Glyphs are drawn and not
// set: not every machine has the characters.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <string_view>
#include <utility>
#include <vector>

#include "trace/pictures/pictures.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

constexpr double kMargin = 16;
constexpr double kLine = 16;  // of text
constexpr double kFramePadding = 12;
constexpr double kWidePage = 1800;  // for frames side by side
constexpr std::size_t kMostFrames = 60;
constexpr std::size_t kMostEvents = 8;  // lines of them
constexpr double kLeastWidth = 880;     // the legend fits

constexpr std::string_view kLoopFill = "#fdecec";
constexpr std::string_view kLostStroke = "#c62828";
constexpr std::string_view kShownStroke = "#17693a";
constexpr std::string_view kFrameFill = "#f7f9fb";
constexpr std::string_view kFrameStroke = "#d5dbe1";
constexpr std::string_view kInk = "#1b232c";

constexpr std::size_t kLongestLabel = 30;
constexpr double kBoxHeight = 20;
constexpr double kRow = 26;
constexpr double kColumnGap = 26;
constexpr double kGlyphRoom = 22;  // left of the label
constexpr double kRightRoom = 8;

struct NodeBox {
  std::string label;  // no longer than the box
  double x = 0;       // of the upper left corner
  double y = 0;
  double width = 0;
  bool is_leaf = false;
};

struct TreeLayout {
  std::vector<NodeBox> boxes;  // by number of the node
  double width = 0;
  double height = 0;
};

// From left to right, a column for each depth, as wide as its widest label, and
// a row for each leaf; a node stands at the middle of its children. The rows of
// a subtree follow one another, so no two boxes touch.
TreeLayout laid_out(const RecordedRun& run) {
  const Children children = children_of(run);
  const std::size_t count = run.nodes.size();
  TreeLayout layout;
  layout.boxes.resize(count);
  std::vector<std::size_t> depth(count, 0);
  std::vector<double> column_width;
  double row = 0;
  for (std::size_t n = 0; n < count; ++n) {
    if (run.nodes[n].parent) depth[n] = depth[*run.nodes[n].parent] + 1;
    NodeBox& box = layout.boxes[n];
    box.is_leaf = children[n].empty();
    box.label =
        shortened(node_label(run.nodes[n], !box.is_leaf), kLongestLabel);
    if (column_width.size() <= depth[n]) column_width.resize(depth[n] + 1, 0);
    const double letters = static_cast<double>(letter_count(box.label));
    column_width[depth[n]] =
        std::max(column_width[depth[n]],
                 kGlyphRoom + letters * kLetterWidth + kRightRoom);
    if (box.is_leaf) box.y = kRow * row++;
  }
  std::vector<double> column_begin;
  for (const double width : column_width) {
    column_begin.push_back(layout.width);
    layout.width += width + kColumnGap;
  }
  layout.width = std::max(0.0, layout.width - kColumnGap);
  layout.height = std::max(0.0, row * kRow - (kRow - kBoxHeight));
  for (std::size_t n = count; n-- > 0;) {  // children before parents
    NodeBox& box = layout.boxes[n];
    box.x = column_begin[depth[n]];
    box.width = column_width[depth[n]];
    if (box.is_leaf) continue;
    box.y = (layout.boxes[children[n].front()].y +
             layout.boxes[children[n].back()].y) /
            2;
  }
  return layout;
}

// A line of text that is cut to fit.
std::string text_line(double x, double y, double room, std::string_view text,
                      std::string_view style = {}) {
  const auto most =
      static_cast<std::size_t>(std::max(1.0, room / kLetterWidth));
  return fmt::format("<text x=\"{:g}\" y=\"{:g}\"{}{}>{}</text>\n", x, y,
                     style.empty() ? "" : " ", style,
                     xml_escaped(shortened(one_line(text), most)));
}

std::string glyph(Phase phase, double x, double y, std::string_view ink) {
  const PhaseLook& look = look_of(phase);
  std::string drawn =
      fmt::format("<g transform=\"translate({:g} {:g})\">", x, y);
  if (!look.lines.empty()) {
    drawn += fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.7\" "
        "stroke-linecap=\"round\" stroke-linejoin=\"round\"/>",
        look.lines, ink);
  }
  if (!look.spots.empty()) {
    drawn += fmt::format("<path d=\"{}\" fill=\"{}\"/>", look.spots, ink);
  }
  return drawn + "</g>\n";
}

std::string box(double x, double y, double width, double radius, Phase phase,
                bool is_stale) {
  const PhaseLook& look = look_of(phase);
  return fmt::format(
      "<rect x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" rx=\"{:g}\" "
      "fill=\"{}\" stroke=\"{}\"{}/>\n",
      x, y, width, kBoxHeight, radius, is_stale ? faded(look.fill) : look.fill,
      kLineColor, is_stale ? " stroke-dasharray=\"3 2\"" : "");
}

std::string variables_text(const RecordedRun& run, const RecordedState& state) {
  std::string text;
  for (std::size_t v = 0; v < run.variables.size(); ++v) {
    text += fmt::format("{}{} = {}", v > 0 ? ", " : "", run.variables[v],
                        state.values[v]);
  }
  return text;
}

// A picture of one state, with the lines of text above the tree.
struct Frame {
  std::size_t state = 0;
  std::string title;
  std::vector<std::string> lines;
  bool is_in_loop = false;
  bool is_decisive = false;  // the property is lost in it, or shown
};

// What stands above all frames, the title first.
std::vector<std::string> heading_lines(const RecordedRun& run) {
  std::vector<std::string> lines = {
      fmt::format("{} {}", run.verdict, run.property)};
  for (const std::string& line : {run.formula, run.why, run.tree}) {
    if (!line.empty() && line != run.property) lines.push_back(line);
  }
  return lines;
}

class SvgWriter {
 public:
  explicit SvgWriter(const RecordedRun& run)
      : run_(run),
        heading_(heading_lines(run)),
        layout_(laid_out(run)),
        children_(children_of(run)) {}

  std::string write(const std::vector<Frame>& frames, std::size_t per_row) {
    std::size_t most_lines = 0;
    for (const Frame& frame : frames) {
      most_lines = std::max(most_lines, frame.lines.size());
    }
    text_height_ = kLine * static_cast<double>(most_lines + 1) + 6;
    const double width = frame_width();
    const double height = layout_.height + text_height_ + 2 * kFramePadding;
    const double top = heading_height();
    const std::size_t rows = (frames.size() + per_row - 1) / per_row;
    const double page_width =
        std::max(kLeastWidth,
                 static_cast<double>(std::min(per_row, frames.size())) *
                         (width + kMargin) -
                     kMargin) +
        2 * kMargin;
    open_page(page_width, top + static_cast<double>(rows) * (height + kMargin));
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const std::size_t row = i / per_row;
      const std::size_t column = i % per_row;
      draw_frame(frames[i],
                 kMargin + static_cast<double>(column) * (width + kMargin),
                 top + static_cast<double>(row) * (height + kMargin), height);
    }
    return svg_ + "</svg>\n";
  }

  double frame_width() const { return layout_.width + 2 * kFramePadding; }

 private:
  double heading_height() const {
    return kMargin + kLine * static_cast<double>(heading_.size()) + 34;
  }

  void open_page(double width, double height) {
    const std::string& title = heading_.front();
    svg_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" "
        "height=\"{1:g}\" viewBox=\"0 0 {0:g} {1:g}\" role=\"img\" "
        "font-family=\"DejaVu Sans Mono, Menlo, Consolas, monospace\" "
        "font-size=\"11\" fill=\"{2}\">\n<title>{3}</title>\n"
        "<desc>{4}</desc>\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"#ffffff\"/>\n",
        width, height, kInk, xml_escaped(title), xml_escaped(run_.why));
    double y = kMargin + 10;
    for (const std::string& line : heading_) {
      svg_ += text_line(kMargin, y, width - 2 * kMargin, line,
                        line == title ? "font-weight=\"bold\"" : "");
      y += kLine;
    }
    draw_legend(y - 4);
  }

  void draw_legend(double y) {
    double x = kMargin;
    for (std::size_t p = 0; p < kPhaseNames.size(); ++p) {
      draw_sample(x, y, static_cast<Phase>(p), false, kPhaseNames[p]);
    }
    draw_sample(x, y, Phase::Success, true, "in an earlier tick");
  }

  // Moves x past itself.
  void draw_sample(double& x, double y, Phase phase, bool is_stale,
                   std::string_view word) {
    constexpr double kSide = kBoxHeight;
    const double letters = static_cast<double>(word.size());
    svg_ += box(x, y, kSide, 3, phase, is_stale);
    svg_ +=
        glyph(phase, x + 4, y + 4, is_stale ? kFadedInk : look_of(phase).ink);
    svg_ += text_line(x + kSide + 4, y + 14, 200, word);
    x += kSide + 14 + kLetterWidth * letters;
  }

  void draw_frame(const Frame& frame, double x, double y, double height) {
    svg_ += fmt::format(
        "<rect x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" rx=\"6\" "
        "fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
        x, y, frame_width(), height, frame.is_in_loop ? kLoopFill : kFrameFill,
        !frame.is_decisive           ? kFrameStroke
        : run_.verdict == "VIOLATED" ? kLostStroke
                                     : kShownStroke,
        frame.is_decisive ? 2 : 1);
    const double room = layout_.width;
    double line = y + kFramePadding + 10;
    svg_ += text_line(x + kFramePadding, line, room, frame.title,
                      "font-weight=\"bold\"");
    for (const std::string& text : frame.lines) {
      svg_ += text_line(x + kFramePadding, line += kLine, room, text);
    }
    draw_tree(run_.states[frame.state], x + kFramePadding,
              y + kFramePadding + text_height_);
  }

  void draw_tree(const RecordedState& state, double x, double y) {
    constexpr double kMiddle = kBoxHeight / 2;
    for (std::size_t n = 0; n < layout_.boxes.size(); ++n) {
      const NodeBox& from = layout_.boxes[n];
      for (const std::uint32_t child : children_[n]) {
        const NodeBox& to = layout_.boxes[child];
        const double begin = x + from.x + from.width;
        const double bend = (begin + x + to.x) / 2;
        svg_ += fmt::format(
            "<path d=\"M{0:g} {1:g}C{2:g} {1:g} {2:g} {3:g} {4:g} {3:g}\" "
            "fill=\"none\" stroke=\"#aab3bd\"/>\n",
            begin, y + from.y + kMiddle, bend, y + to.y + kMiddle, x + to.x);
      }
    }
    for (std::size_t n = 0; n < layout_.boxes.size(); ++n) {
      draw_node(n, state.phases[n], state.is_stale[n], x, y);
    }
  }

  void draw_node(std::size_t node, Phase phase, bool is_stale, double x,
                 double y) {
    const NodeBox& at = layout_.boxes[node];
    const RecordedNode& recorded = run_.nodes[node];
    const std::string_view ink = is_stale ? kFadedInk : look_of(phase).ink;
    svg_ += fmt::format("<g><title>{} {}, line {}: {}{}</title>\n",
                        xml_escaped(recorded.type), xml_escaped(recorded.name),
                        recorded.line, phase_name(phase),
                        is_stale ? " in an earlier tick" : "");
    svg_ +=
        box(x + at.x, y + at.y, at.width, at.is_leaf ? 10 : 2, phase, is_stale);
    svg_ += glyph(phase, x + at.x + 5, y + at.y + 4, ink);
    svg_ +=
        fmt::format("<text x=\"{:g}\" y=\"{:g}\" fill=\"{}\">{}</text>\n</g>\n",
                    x + at.x + 22, y + at.y + 14, ink, xml_escaped(at.label));
  }

  const RecordedRun& run_;
  const std::vector<std::string> heading_;
  const TreeLayout layout_;
  const Children children_;
  double text_height_ = 0;  // of the lines above a tree
  std::string svg_;
};

// What the world outside chose in states begin to end.
std::vector<std::string> chosen_lines(const RecordedRun& run, std::size_t begin,
                                      std::size_t end) {
  std::vector<std::string> lines;
  for (std::size_t i = begin; i <= end; ++i) {
    const RecordedState& state = run.states[i];
    if (state.is_chosen && !state.event.empty()) lines.push_back(state.event);
  }
  if (lines.size() > kMostEvents) {
    const std::size_t left_out = lines.size() - kMostEvents + 1;
    lines.resize(kMostEvents - 1);
    lines.push_back(fmt::format("and {} more", left_out));
  }
  return lines;
}

// The frame of states begin to end, which shows the last of them.
Frame framed(const RecordedRun& run, std::size_t begin, std::size_t end,
             const std::string& title) {
  const auto has = [&](std::size_t state) {
    return state != kNoState && begin <= state && state <= end;
  };
  Frame frame;
  frame.state = end;
  frame.title = title;
  frame.is_in_loop = run.loop != kNoState && end >= run.loop;
  frame.is_decisive = has(run.lost);
  if (frame.is_in_loop) frame.title += ", repeats for ever";
  if (has(run.trigger) && !run.trigger_words.empty()) {
    frame.title += ", " + run.trigger_words;
  }
  if (frame.is_decisive) {
    frame.title += run.verdict == "VIOLATED" ? ", lost here" : ", shown here";
  }
  const std::string variables = variables_text(run, run.states[end]);
  if (!variables.empty()) frame.lines.push_back(variables);
  return frame;
}

}  // namespace

std::string svg_text(const RecordedRun& run, std::size_t state) {
  assert(state < run.states.size());
  const RecordedState& shown = run.states[state];
  Frame frame = framed(run, state, state,
                       fmt::format("tick {}, step {}", shown.tick, state));
  frame.lines.push_back(shown.event.empty() ? shown.step : shown.event);
  return SvgWriter(run).write({frame}, 1);
}

std::string svg_strip(const RecordedRun& run) {
  const std::vector<std::size_t> ends = tick_ends(run);
  const std::size_t left_out =
      ends.size() > kMostFrames ? ends.size() - kMostFrames : 0;
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const bool is_gap = left_out > 0 && i == kMostFrames / 2;
    if (is_gap) i += left_out;
    const std::size_t begin = i == 0 ? 0 : ends[i - 1] + 1;
    const int tick = run.states[ends[i]].tick;
    Frame& frame = frames.emplace_back(
        framed(run, begin, ends[i], fmt::format("tick {}", tick)));
    std::ranges::move(chosen_lines(run, begin, ends[i]),
                      std::back_inserter(frame.lines));
    if (is_gap) {
      frame.title +=
          fmt::format(", after {} ticks that are left out", left_out);
    }
  }
  SvgWriter writer(run);
  const double per_row = kWidePage / (writer.frame_width() + kMargin);
  return writer.write(
      frames, std::max<std::size_t>(1, static_cast<std::size_t>(per_row)));
}

}  // namespace btcheck
