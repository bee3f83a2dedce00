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
#include "trace/pictures/written.hpp"
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
constexpr std::size_t kLongestAlone = 60;  // in a drawing of the tree alone
constexpr double kAloneScale = 1.25;
constexpr double kBoxHeight = 20;
constexpr double kRow = 26;
constexpr double kColumnGap = 26;
constexpr double kGlyphRoom = 22;  // left of the label
constexpr double kRightRoom = 8;

struct NodeBox {
  std::string label;   // no longer than the box
  std::string detail;  // below it; "" for none
  double x = 0;        // of the upper left corner
  double y = 0;
  double width = 0;
  bool is_leaf = false;
};

struct TreeLayout {
  std::vector<NodeBox> boxes;  // by number of the node
  double box_height = kBoxHeight;
  double width = 0;
  double height = 0;
};

// From left to right, a column for each depth, as wide as its widest label, and
// a row for each leaf; a node stands at the middle of its children. The rows of
// a subtree follow one another, so no two boxes touch. Of the tree alone, boxes
// say more, and have no room for a glyph.
TreeLayout laid_out(const RecordedRun& run, bool is_alone) {
  const Children children = children_of(run);
  const WrittenNodes written(run);
  const std::vector<std::string> labels = node_labels(run);
  const std::size_t count = run.nodes.size();
  const std::size_t longest = is_alone ? kLongestAlone : kLongestLabel;
  const double glyph_room = is_alone ? kRightRoom : kGlyphRoom;
  TreeLayout layout;
  layout.boxes.resize(count);
  if (is_alone) layout.box_height += kLine - 2;
  const double row_height = kRow - kBoxHeight + layout.box_height;
  std::vector<std::size_t> depth(count, 0);
  std::vector<double> column_width;
  double row = 0;
  for (std::size_t n = 0; n < count; ++n) {
    if (run.nodes[n].parent) depth[n] = depth[*run.nodes[n].parent] + 1;
    NodeBox& box = layout.boxes[n];
    box.is_leaf = children[n].empty();
    box.label = shortened(labels[n], longest);
    if (is_alone) box.detail = shortened(one_line(written.at(n)), longest);
    if (column_width.size() <= depth[n]) column_width.resize(depth[n] + 1, 0);
    const double letters = static_cast<double>(
        std::max(letter_count(box.label), letter_count(box.detail)));
    column_width[depth[n]] =
        std::max(column_width[depth[n]],
                 glyph_room + letters * kLetterWidth + kRightRoom);
    if (box.is_leaf) box.y = row_height * row++;
  }
  std::vector<double> column_begin;
  for (const double width : column_width) {
    column_begin.push_back(layout.width);
    layout.width += width + kColumnGap;
  }
  layout.width = std::max(0.0, layout.width - kColumnGap);
  layout.height = std::max(0.0, row * row_height - (kRow - kBoxHeight));
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

// Curves from the boxes to those of their children.
std::string edges(const TreeLayout& layout, const Children& children, double x,
                  double y) {
  const double middle = layout.box_height / 2;
  std::string drawn;
  for (std::size_t n = 0; n < layout.boxes.size(); ++n) {
    const NodeBox& from = layout.boxes[n];
    for (const std::uint32_t child : children[n]) {
      const NodeBox& to = layout.boxes[child];
      const double begin = x + from.x + from.width;
      const double bend = (begin + x + to.x) / 2;
      drawn += fmt::format(
          "<path d=\"M{0:g} {1:g}C{2:g} {1:g} {2:g} {3:g} {4:g} {3:g}\" "
          "fill=\"none\" stroke=\"#aab3bd\"/>\n",
          begin, y + from.y + middle, bend, y + to.y + middle, x + to.x);
    }
  }
  return drawn;
}

// The beginning of a picture, which is shown `scale` times as large as it is
// measured.
std::string page_begin(double width, double height, double scale,
                       std::string_view title, std::string_view about) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" "
      "height=\"{1:g}\" viewBox=\"0 0 {2:g} {3:g}\" role=\"img\" "
      "font-family=\"DejaVu Sans Mono, Menlo, Consolas, monospace\" "
      "font-size=\"11\" fill=\"{4}\">\n<title>{5}</title>\n"
      "<desc>{6}</desc>\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#ffffff\"/>\n",
      scale * width, scale * height, width, height, kInk, xml_escaped(title),
      xml_escaped(about));
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
        layout_(laid_out(run, false)),
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
    svg_ = page_begin(width, height, 1, title, run_.why);
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
    svg_ += edges(layout_, children_, x, y);
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

// A box with all that is written of its node.
std::string plain_box(const RecordedNode& node, const NodeBox& at,
                      double height, double x, double y) {
  const double left = x + at.x + kRightRoom;
  const double line = y + at.y + (at.detail.empty() ? height / 2 + 4 : 14);
  std::string drawn = fmt::format(
      "<g><title>{} {}, {}line {}</title>\n<rect x=\"{:g}\" y=\"{:g}\" "
      "width=\"{:g}\" height=\"{:g}\" rx=\"{}\" fill=\"{}\" "
      "stroke=\"{}\"/>\n",
      xml_escaped(node.type), xml_escaped(node.name),
      node.file.empty() ? "" : xml_escaped(node.file) + ", ", node.line,
      x + at.x, y + at.y, at.width, height, at.is_leaf ? 10 : 2,
      at.is_leaf ? "#ffffff" : kFrameFill, kLineColor);
  drawn += text_line(left, line, at.width, at.label,
                     at.is_leaf ? "" : "font-weight=\"bold\"");
  if (!at.detail.empty()) {
    drawn += text_line(left, line + kLine - 2, at.width, at.detail,
                       fmt::format("fill=\"{}\"", kLineColor));
  }
  return drawn + "</g>\n";
}

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

std::string svg_tree(const RecordedRun& run) {
  const TreeLayout layout = laid_out(run, true);
  const double top = kMargin + kLine + 8;
  std::string svg =
      page_begin(layout.width + 2 * kMargin, top + layout.height + kMargin,
                 kAloneScale, run.tree, "a behavior tree");
  svg += text_line(kMargin, kMargin + 10, layout.width, run.tree,
                   "font-weight=\"bold\"");
  svg += edges(layout, children_of(run), kMargin, top);
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    svg += plain_box(run.nodes[n], layout.boxes[n], layout.box_height, kMargin,
                     top);
  }
  return svg + "</svg>\n";
}

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
