// SPDX-License-Identifier: MIT
//
// Layout after the MCAP specification, version 0: a record is its kind, the
// length of what follows, and that. Schemas and channels come before messages;
// there is no summary, and the file is small enough to be read from its start.
#include "trace/formats/mcap.hpp"

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "trace/run/little_endian.hpp"
#include "trace/run/run_walk.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// Keys keep the order in which they are written.
using Json = nlohmann::ordered_json;

constexpr std::string_view kMagic = "\x89MCAP0\r\n";
constexpr std::size_t kMostChannels = 0xFFFF;

enum Kind : unsigned char {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kMetadata = 0x0C,
  kDataEnd = 0x0F
};

std::string dumped(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// A text after its length.
void append_text(std::string& to, std::string_view text) {
  append_number(to, text.size(), 4);
  to += text;
}

void append_map(
    std::string& to,
    const std::vector<std::pair<std::string_view, std::string>>& pairs) {
  std::string body;
  for (const auto& [key, value] : pairs) {
    append_text(body, key);
    // Bytes that are no UTF-8 are replaced on the way.
    append_text(body, Json::parse(dumped(value)).get<std::string>());
  }
  append_text(to, body);
}

// A part of a topic's name.
std::string topic_word(std::string_view name) { return plain_word(name, "-"); }

struct Field {
  const char* name;
  const char* type;  // of JSON; "any" where it may be a text or a number
};

std::string schema_text(std::string_view title,
                        const std::vector<Field>& fields) {
  Json properties = Json::object();
  for (const Field& field : fields) {
    Json& property = properties[field.name];
    property = Json::object();
    if (std::string_view(field.type) != "any") property["type"] = field.type;
  }
  return dumped({{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", title},
                 {"type", "object"},
                 {"properties", std::move(properties)}});
}

class McapWriter {
 public:
  explicit McapWriter(const RecordedRun& run) : run_(run), bytes_(kMagic) {}

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

  void record(Kind kind, std::string_view body) {
    append_number(bytes_, kind, 1);
    append_number(bytes_, body.size(), 8);
    bytes_ += body;
  }

  void write_header() {
    std::string header;
    append_text(header, "");
    append_text(header, "btcheck");
    record(kHeader, header);
    std::string metadata;
    append_text(metadata, "btcheck");
    append_map(metadata, {{"tree", run_.tree},
                          {"property", run_.property},
                          {"formula", run_.formula},
                          {"verdict", run_.verdict},
                          {"why", run_.why}});
    record(kMetadata, metadata);
  }

  void write_schema(Schema number, std::string_view name,
                    const std::vector<Field>& fields) {
    std::string body;
    append_number(body, number, 2);
    append_text(body, name);
    append_text(body, "jsonschema");
    append_text(body, schema_text(name, fields));
    record(kSchema, body);
  }

  void write_schemas() {
    write_schema(
        kPhase, "btcheck.Phase",
        {{"status", "string"}, {"stale", "boolean"}, {"tick", "integer"}});
    write_schema(kValue, "btcheck.Value",
                 {{"value", "any"}, {"tick", "integer"}});
    write_schema(
        kAtom, "btcheck.Atom",
        {{"text", "string"}, {"value", "boolean"}, {"tick", "integer"}});
    write_schema(kStep, "btcheck.Step",
                 {{"step", "string"},
                  {"event", "string"},
                  {"chosen", "boolean"},
                  {"tick", "integer"},
                  {"state", "integer"}});
  }

  // Channels are numbered from 1: /step, nodes, variables, atoms.
  std::size_t node_channel(std::size_t node) const { return 2 + node; }
  std::size_t variable_channel(std::size_t variable) const {
    return node_channel(run_.nodes.size()) + variable;
  }
  std::size_t atom_channel(std::size_t atom) const {
    return variable_channel(run_.variables.size()) + atom;
  }

  void write_channel(std::size_t number, Schema schema,
                     const std::string& topic) {
    if (number > kMostChannels) return;
    std::string body;
    append_number(body, number, 2);
    append_number(body, schema, 2);
    append_text(body, topic);
    append_text(body, "json");
    append_map(body, {});
    record(kChannel, body);
  }

  void write_channels() {
    write_channel(1, kStep, "/step");
    for (std::size_t n = 0; n < run_.nodes.size(); ++n) {
      const RecordedNode& node = run_.nodes[n];
      write_channel(node_channel(n), kPhase,
                    "/bt/" + std::to_string(n) + "_" + topic_word(node.type) +
                        "_" + topic_word(node.name));
    }
    for (std::size_t v = 0; v < run_.variables.size(); ++v) {
      write_channel(variable_channel(v), kValue,
                    "/variables/" + topic_word(run_.variables[v]));
    }
    for (std::size_t a = 0; a < run_.atoms.size(); ++a) {
      write_channel(atom_channel(a), kAtom,
                    "/property/" + std::to_string(a + 1));
    }
  }

  void message(std::size_t channel, std::uint64_t time, const Json& value) {
    if (channel > kMostChannels) return;
    std::string body;
    append_number(body, channel, 2);
    append_number(body, sequence_++, 4);
    append_number(body, time, 8);
    append_number(body, time, 8);
    body += dumped(value);
    record(kMessage, body);
  }

  void write_state(const Passing& passing, std::size_t before,
                   std::uint64_t time) {
    const RecordedState& state = run_.states[passing.state];
    const RecordedState* last =
        before == kNoState ? nullptr : &run_.states[before];
    // Where the loop begins anew, another step has led to its first state.
    const bool is_back = last != nullptr && before + 1 != passing.state;
    message(1, time,
            {{"step", is_back ? run_.back : state.step},
             {"event", is_back ? run_.back_event : state.event},
             {"chosen", is_back ? run_.back_is_chosen : state.is_chosen},
             {"tick", passing.tick},
             {"state", passing.state}});
    write_phases(state, last, passing.tick, time);
    for (std::size_t v = 0; v < run_.variables.size(); ++v) {
      if (last != nullptr && last->values[v] == state.values[v]) continue;
      message(variable_channel(v), time,
              {{"value", value(v, state.values[v])}, {"tick", passing.tick}});
    }
    for (std::size_t a = 0; a < run_.atoms.size(); ++a) {
      const bool holds = state.atoms[a];
      if (last != nullptr && last->atoms[a] == holds) continue;
      message(
          atom_channel(a), time,
          {{"text", run_.atoms[a]}, {"value", holds}, {"tick", passing.tick}});
    }
  }

  void write_phases(const RecordedState& state, const RecordedState* last,
                    int tick, std::uint64_t time) {
    for (std::size_t n = 0; n < run_.nodes.size(); ++n) {
      const bool is_stale = state.is_stale[n];
      if (last != nullptr && last->phases[n] == state.phases[n] &&
          last->is_stale[n] == is_stale) {
        continue;
      }
      message(
          node_channel(n), time,
          {{"status", kPhaseNames[static_cast<std::size_t>(state.phases[n])]},
           {"stale", is_stale},
           {"tick", tick}});
    }
  }

  Json value(std::size_t variable, const std::string& text) const {
    if (!run_.is_number[variable]) return text;
    std::int64_t number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
  }

  void write_end() {
    std::string data_end;
    append_number(data_end, mcap_checksum(bytes_), 4);
    record(kDataEnd, data_end);
    const std::size_t footer = bytes_.size();
    record(kFooter, std::string(20, '\0'));  // neither summary nor its offsets
    // The checksum is of the summary and of the footer up to itself.
    bytes_.resize(bytes_.size() - 4);
    append_number(bytes_,
                  mcap_checksum(std::string_view(bytes_).substr(footer)), 4);
    bytes_ += kMagic;
  }

  const RecordedRun& run_;
  std::string bytes_;
  std::uint32_t sequence_ = 0;
};

}  // namespace

std::string mcap_bytes(const RecordedRun& run, int passes) {
  return McapWriter(run).write(passes);
}

std::uint32_t mcap_checksum(std::string_view bytes) {
  static const auto kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) {
        value = (value >> 1) ^ ((value & 1u) != 0 ? 0xEDB88320u : 0u);
      }
      table[i] = value;
    }
    return table;
  }();
  std::uint32_t sum = 0xFFFFFFFFu;
  for (const char c : bytes) {
    sum = (sum >> 8) ^ kTable[(sum ^ static_cast<unsigned char>(c)) & 0xFFu];
  }
  return ~sum;
}

}  // namespace btcheck
