// SPDX-License-Identifier: MIT
#include "serve/asked.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <filesystem>
#include <list>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/process_limits.hpp"
#include "explore/components/component_store.hpp"
#include "project/content.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;
using Kind = JsonValue::Kind;

Service& the_service() {
  static Service one;
  return one;
}

// As it is seen from here, where it lies below: one file has one name.
std::string nearest_name(const std::string& name) {
  const fs::path path = fs::path(name).lexically_normal();
  if (!path.is_absolute()) return path.string();
  const fs::path near = path.lexically_relative(current_directory());
  return near.empty() || *near.begin() == ".." ? path.string() : near.string();
}

// Files that are protocols or devices are nobody's to read here.
Result<InputFile> refused_stream(const std::string& name) {
  return {std::nullopt,
          {file_error("BT0002", name, fmt::format("`{}` is no file", name))}};
}

bool is_stream(const std::string& name) {
  return name == "-" || is_given(name);
}

// --- Parameters ------------------------------------------------------------

[[noreturn]] void refuse(const std::string& why) {
  throw RpcError(rpc::kInvalidParams, why);
}

std::string scalar(const std::string& name, const JsonValue& value) {
  if (value.is(Kind::Text) || value.is(Kind::Flag) || value.is(Kind::Number)) {
    return value.text;
  }
  refuse(fmt::format("`{}` does not fit", name));
}

bool names_a_file(std::string_view field) {
  return field == "tree" || field == "settings" || field == "script" ||
         field == "rules" || field == "leaves" || field == "models";
}

void set_one(const std::string& name, const JsonValue& value,
             v1::Fields& fields) {
  const std::string word = scalar(name, value);
  v1::set_field(name, names_a_file(name) ? nearest_name(word) : word, fields);
}

void set(const std::string& name, const JsonValue& value, v1::Fields& fields) {
  if (!value.is(Kind::List)) return set_one(name, value, fields);
  if (!v1::is_list_field(name)) refuse(fmt::format("`{}` is one text", name));
  for (const JsonValue& each : value.items) set_one(name, each, fields);
}

Buffers buffers_of(const JsonValue& params) {
  Buffers buffers;
  if (const JsonValue* files = params.member("files")) {
    if (!files->is(Kind::Object)) refuse("`files` has texts by their names");
    for (std::size_t i = 0; i < files->items.size(); ++i) {
      if (!files->items[i].is(Kind::Text)) {
        refuse("`files` has texts by their names");
      }
      buffers[buffer_name(files->names[i])] = files->items[i].text;
    }
  }
  if (params.member("text") != nullptr) {
    buffers[buffer_name(needed_text(params, "tree"))] =
        needed_text(params, "text");
  }
  return buffers;
}

// A request may ask for less than the process allows, never for more.
template <class Number>
void bound(Number most, Number& asked) {
  if (most > 0 && (asked == 0 || asked > most)) asked = most;
}

}  // namespace

const Service& service() { return the_service(); }

void begin_service(Service service) { the_service() = std::move(service); }

// --- Sources ----------------------------------------------------------------

// The tree is the first that is asked for.
Result<InputFile> ServedSources::named(const std::string& name) {
  if (is_stream(name)) return refused_stream(name);
  if (files_) return files_->named(name);
  return file(name);
}

Result<InputFile> ServedSources::text(const std::string& name) {
  if (is_stream(name)) return refused_stream(name);
  return files_ ? files_->text(name) : file(name);
}

Result<InputFile> ServedSources::file(const std::string& name) const {
  const auto buffer = buffers_.find(buffer_name(name));
  if (buffer != buffers_.end()) return {InputFile{name, buffer->second}, {}};
  return read_file_in(options_.roots, name);
}

NearestFile ServedSources::with_tree(std::string_view tree,
                                     const std::string& from) {
  return files_ ? files_->with_tree(tree, from) : NearestFile{};
}

std::string ServedSources::package(std::string_view name,
                                   const std::string& from) {
  return files_ ? files_->package(name, from) : std::string();
}

const XmlProject& ServedSources::project() const {
  static const XmlProject none;
  return files_ ? files_->project() : none;
}

std::optional<v1::NamedText> ServedSources::settings(const std::string& tree) {
  const auto read = file(tree);
  if (read.value) {
    files_.emplace(*read.value, options_, &buffers_);
  }
  const std::string name =
      settings_.empty() ? settings_file(options_, tree) : settings_;
  if (name.empty()) return std::nullopt;
  const auto buffer = buffers_.find(buffer_name(name));
  auto found = buffer != buffers_.end()
                   ? Result<InputFile>{InputFile{name, buffer->second}, {}}
               : settings_.empty() ? text_of_settings(options_, name)
                                   : read_file_in(options_.roots, name);
  if (!found.value) {
    throw std::invalid_argument(found.diagnostics.front().message);
  }
  settings_text_ = name + '\n' + found.value->text.text();
  return v1::NamedText{name, found.value->text};
}

// --- Requests ---------------------------------------------------------------

std::vector<std::string> request_names() {
  std::vector<std::string> names = v1::field_names();
  // Decided by where files lie.
  std::erase(names, "one_program");
  std::erase(names, "directory");
  names.insert(names.end(), {"text", "files"});
  return names;
}

AskedTree asked_by(const JsonValue& params,
                   const std::vector<std::string>& others) {
  std::vector<std::string> known = request_names();
  known.insert(known.end(), others.begin(), others.end());
  refuse_others(params, known);
  needed_text(params, "tree");
  AskedTree asked;
  for (std::size_t i = 0; i < params.names.size(); ++i) {
    const std::string& name = params.names[i];
    if (name == "text" || name == "files" ||
        std::ranges::count(others, name) > 0) {
      continue;
    }
    set(name, params.items[i], asked.fields);
  }
  v1::Request& request = asked.fields.request;
  request.directory = current_directory();
  bound(service().seconds, request.seconds);
  bound(service().bytes, request.bytes);
  bound(service().options.max_states, request.states);
  request.threads = std::min(request.threads, core_count());
  asked.sources = std::make_unique<ServedSources>(
      service().options, asked.fields.settings, buffers_of(params));
  return asked;
}

// --- Reports that are known -----------------------------------------------

namespace {

// The last ones that were asked for.
class Recent {
 public:
  std::optional<v1::Report> find(const std::string& content) {
    const std::scoped_lock lock(mutex_);
    const auto found = by_content_.find(content);
    if (found == by_content_.end()) return std::nullopt;
    order_.splice(order_.begin(), order_, found->second);
    return order_.front().report;
  }

  std::optional<v1::Report> last(const std::string& tree) {
    const std::scoped_lock lock(mutex_);
    const auto found = std::ranges::find_if(
        order_, [&](const Entry& each) { return each.report.tree == tree; });
    if (found == order_.end()) return std::nullopt;
    return found->report;
  }

  // Where the process holds too much, no report may be to blame.
  void forget() {
    const std::scoped_lock lock(mutex_);
    by_content_.clear();
    order_.clear();
    bytes_ = 0;
    ::malloc_trim(0);
  }

  void keep(const std::string& content, const v1::Report& report) {
    const std::scoped_lock lock(mutex_);
    if (content.size() > kMostBytes / 8 || by_content_.contains(content)) {
      return;
    }
    order_.push_front({content, report});
    by_content_[order_.front().content] = order_.begin();
    bytes_ += content.size();
    while (order_.size() > kMost || bytes_ > kMostBytes) {
      bytes_ -= order_.back().content.size();
      by_content_.erase(order_.back().content);  // a view of what goes next
      order_.pop_back();
    }
  }

 private:
  static constexpr std::size_t kMost = 32;
  static constexpr std::size_t kMostBytes = std::size_t{64} << 20;

  struct Entry {
    std::string content;
    v1::Report report;
  };

  std::mutex mutex_;
  std::list<Entry> order_;  // the one that was asked for last first
  std::map<std::string_view, std::list<Entry>::iterator> by_content_;
  std::size_t bytes_ = 0;  // of contents
};

class Known final : public v1::KnownReports {
 public:
  Known(std::string_view call, const ServedSources& sources)
      : call_(call), sources_(sources) {
    if (limits_of_command().overdrawn() == Spent::Memory) {
      recent().forget();
      ComponentStore::of_program()->forget();
    }
  }

  std::optional<v1::Report> find(const v1::Request& request,
                                 const v1::Inputs& inputs) override {
    return recent().find(content(request, inputs));
  }
  std::optional<v1::Report> last(const v1::Request& request) override {
    return recent().last(request.tree);
  }
  void keep(const v1::Request& request, const v1::Inputs& inputs,
            const v1::Report& report) override {
    recent().keep(content(request, inputs), report);
  }

 private:
  static Recent& recent() {
    static Recent all;
    return all;
  }

  // Threads decide nothing, nor does the time: what is not whole is not kept. A
  // bound on states may keep a repair from being tried.
  std::string content(const v1::Request& request,
                      const v1::Inputs& inputs) const {
    Content all;
    all.add(call_);
    all.add(inputs.tree);
    all.add(inputs.rules);
    all.add(sources_.settings_text());
    all.add(fmt::format("{} {} {} {} {}", request.ticks, request.tries_repairs,
                        request.states, request.bytes, request.directory));
    return all.text();
  }

  const std::string_view call_;
  const ServedSources& sources_;
};

}  // namespace

v1::Report checked_once(const AskedTree& asked, v1::Monitor& monitor) {
  Known known("check", *asked.sources);
  return v1::checked(asked.fields.request, *asked.sources, &monitor, &known);
}

v1::Report linted_once(const AskedTree& asked, v1::Monitor& monitor) {
  Known known("lint", *asked.sources);
  return v1::linted(asked.fields.request, *asked.sources, &monitor, &known);
}

}  // namespace btcheck
