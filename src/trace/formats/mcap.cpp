// SPDX-License-Identifier: MIT
//
// Layout after the MCAP specification, version 0: a record is its kind, the
// length of what follows, and that. Schemas and channels come before messages;
// there is no summary, and the file is small enough to be read from its start.
#include "trace/formats/recordings.hpp"

#include <boost/crc.hpp>
#include <utility>
#include <vector>

#include "text/json.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/little_endian.hpp"
#include "trace/run/mcap_records.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostChannels = 0xFFFF;

// What follows the length of a record.
class Body {
 public:
  Body& number(std::uint64_t value, std::size_t count) {
    append_number(bytes_, value, count);
    return *this;
  }
  Body& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  // After its length.
  Body& text(std::string_view text) { return number(text.size(), 4).raw(text); }
  Body& map(
      const std::vector<std::pair<std::string_view, std::string>>& pairs) {
    Body body;
    for (const auto& [key, value] : pairs) {
      body.text(key).text(valid_utf8(value));
    }
    return text(body.bytes_);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

// A part of a topic's name.
std::string topic_word(std::string_view name) { return plain_word(name, "-"); }

class McapWriter {
 public:
  explicit McapWriter(const RecordedRun& run) : run_(run), bytes_(kMcapMagic) {}

  std::string write(int passes) {
    write_header();
    write_schemas();
    write_channels();
    std::uint64_t time = kMcapBegin;
    std::size_t before = kNoState;
    for (const Passing& passing : unrolled(run_, passes)) {
      write_state(passing, before, time);
      before = passing.state;
      time += kMcapStep;
    }
    write_end();
    return std::move(bytes_);
  }

 private:
  enum Schema : std::uint16_t { kPhase = 1, kValue, kAtom, kStep };

  void record(McapRecord kind, const Body& body) {
    append_number(bytes_, static_cast<unsigned char>(kind), 1);
    append_number(bytes_, body.bytes().size(), 8);
    bytes_ += body.bytes();
  }

  void write_header() {
    record(McapRecord::Header, Body().text("").text("btcheck"));
    record(McapRecord::Metadata,
           Body().text("btcheck").map({{"tree", run_.tree},
                                       {"property", run_.property},
                                       {"formula", run_.formula},
                                       {"verdict", run_.verdict},
                                       {"why", run_.why}}));
  }

  void write_schema(Schema number, std::string_view name, const Json& fields) {
    const Json schema{
        {"$schema", "https://json-schema.org/draft/2020-12/schema"},
        {"title", name},
        {"type", "object"},
        {"properties", fields}};
    record(McapRecord::Schema, Body()
                                   .number(number, 2)
                                   .text(name)
                                   .text("jsonschema")
                                   .text(schema.text()));
  }

  void write_schemas() {
    const Json text{{"type", "string"}};
    const Json truth{{"type", "boolean"}};
    const Json number{{"type", "integer"}};
    const Json any = Json::object();  // a text or a number
    write_schema(kPhase, "btcheck.Phase",
                 {{"status", text}, {"stale", truth}, {"tick", number}});
    write_schema(kValue, "btcheck.Value", {{"value", any}, {"tick", number}});
    write_schema(kAtom, "btcheck.Atom",
                 {{"text", text}, {"value", truth}, {"tick", number}});
    write_schema(kStep, "btcheck.Step",
                 {{"step", text},
                  {"event", text},
                  {"chosen", truth},
                  {"tick", number},
                  {"state", number}});
  }

  void write_channel(std::size_t number, Schema schema,
                     const std::string& topic) {
    if (number > kMostChannels) return;
    record(
        McapRecord::Channel,
        Body().number(number, 2).number(schema, 2).text(topic).text("json").map(
            {}));
  }

  void write_channels() {
    write_channel(1, kStep, "/step");
    for (std::size_t n = 0; n < run_.nodes.size(); ++n) {
      const RecordedNode& node = run_.nodes[n];
      write_channel(kFirstNode + n, kPhase,
                    "/bt/" + std::to_string(n) + "_" + topic_word(node.type) +
                        "_" + topic_word(node.name));
    }
    for (std::size_t v = 0; v < run_.variables.size(); ++v) {
      write_channel(first_variable_ + v, kValue,
                    "/variables/" + topic_word(run_.variables[v]));
    }
    for (std::size_t a = 0; a < run_.atoms.size(); ++a) {
      write_channel(first_atom_ + a, kAtom,
                    "/property/" + std::to_string(a + 1));
    }
  }

  void message(std::size_t channel, std::uint64_t time, const Json& value) {
    if (channel > kMostChannels) return;
    record(McapRecord::Message, Body()
                                    .number(channel, 2)
                                    .number(sequence_++, 4)
                                    .number(time, 8)
                                    .number(time, 8)
                                    .raw(value.text()));
  }

  void write_state(const Passing& passing, std::size_t before,
                   std::uint64_t time) {
    const RecordedState& state = run_.states[passing.state];
    const RecordedState* last =
        before == kNoState ? nullptr : &run_.states[before];
    // Where the loop begins anew, another step has led to its first state.
    const bool is_back = last != nullptr && before + 1 != passing.state;
    const RecordedStep& step = is_back ? run_.back : state;
    message(1, time,
            {{"step", step.step},
             {"event", step.event},
             {"chosen", step.is_chosen},
             {"tick", passing.tick},
             {"state", passing.state}});
    write_phases(state, last, passing.tick, time);
    for (std::size_t v = 0; v < run_.variables.size(); ++v) {
      if (last != nullptr && last->values[v] == state.values[v]) continue;
      message(first_variable_ + v, time,
              {{"value", value_of(run_, state, v)}, {"tick", passing.tick}});
    }
    for (std::size_t a = 0; a < run_.atoms.size(); ++a) {
      const bool holds = state.atoms[a];
      if (last != nullptr && last->atoms[a] == holds) continue;
      message(
          first_atom_ + a, time,
          {{"text", run_.atoms[a]}, {"value", holds}, {"tick", passing.tick}});
    }
  }

  void write_phases(const RecordedState& state, const RecordedState* last,
                    int tick, std::uint64_t time) {
    for (std::size_t n = 0; n < run_.nodes.size(); ++n) {
      if (last != nullptr && last->phases[n] == state.phases[n] &&
          last->is_stale[n] == state.is_stale[n]) {
        continue;
      }
      message(kFirstNode + n, time,
              {{"status", phase_name(state.phases[n])},
               {"stale", bool{state.is_stale[n]}},
               {"tick", tick}});
    }
  }

  void write_end() {
    record(McapRecord::DataEnd, Body().number(mcap_checksum(bytes_), 4));
    const std::size_t footer = bytes_.size();
    // Neither a summary nor its offsets.
    record(McapRecord::Footer, Body().raw(std::string(20, '\0')));
    // The checksum is of the summary and of the footer up to itself.
    bytes_.resize(bytes_.size() - 4);
    append_number(bytes_,
                  mcap_checksum(std::string_view(bytes_).substr(footer)), 4);
    bytes_ += kMcapMagic;
  }

  // Channels are numbered from 1: /step, nodes, variables, atoms.
  static constexpr std::size_t kFirstNode = 2;

  const RecordedRun& run_;
  const std::size_t first_variable_ = kFirstNode + run_.nodes.size();
  const std::size_t first_atom_ = first_variable_ + run_.variables.size();
  std::string bytes_;
  std::uint32_t sequence_ = 0;
};

}  // namespace

std::string mcap_bytes(const RecordedRun& run, int passes) {
  return McapWriter(run).write(passes);
}

std::uint32_t mcap_checksum(std::string_view bytes) {
  boost::crc_32_type sum;
  sum.process_bytes(bytes.data(), bytes.size());
  return sum.checksum();
}

}  // namespace btcheck
