// SPDX-License-Identifier: MIT
//
// What the parameters of a request ask for, and the files that it may read.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/call.hpp"
#include "api/fields.hpp"
#include "cli/inputs/file_sources.hpp"
#include "cli/options/options.hpp"
#include "serve/message.hpp"

namespace btcheck {

// What holds for all requests of this process: its roots, and the limits of one
// request. Set once, before the first.
struct Service {
  Options options;
  double seconds = 0;       // the most of one call; 0: no limit
  std::uint64_t bytes = 0;  // that one search may store; 0: no limit
};
const Service& service();
void begin_service(Service service);

// Files of the file system as a command reads them, and texts instead of some.
class ServedSources final : public v1::CallSources {
 public:
  // The buffers are named as `buffer_name` does it. The options must outlive
  // it.
  ServedSources(const Options& options, std::string settings, Buffers buffers)
      : options_(options),
        settings_(std::move(settings)),
        buffers_(std::move(buffers)) {}

  Result<InputFile> text(const std::string& name) override;
  Result<InputFile> named(const std::string& name) override;
  NearestFile with_tree(std::string_view tree,
                        const std::string& from) override;
  std::string package(std::string_view name, const std::string& from) override;
  const XmlProject& project() const override;
  bool is_of_one_program() const override { return false; }
  std::optional<v1::NamedText> settings(const std::string& tree) override;

  // The settings that were read, for those who keep results; "" for none.
  const std::string& settings_text() const { return settings_text_; }
  // The text that a change of lines is made in.
  Result<InputFile> file(const std::string& name) const;

 private:
  const Options& options_;
  const std::string settings_;  // "": of the tree's folder, or above it
  const Buffers buffers_;
  std::string settings_text_;
  std::optional<FileSources> files_;  // since the tree is known
};

// The members of `params` that requests have, `others` beside them. Throws
// RpcError for what nobody knows or what does not fit.
struct AskedTree {
  v1::Fields fields;
  std::unique_ptr<ServedSources> sources;
};
AskedTree asked_by(const JsonValue& params,
                   const std::vector<std::string>& others);

// The names that asked_by knows.
std::vector<std::string> request_names();

// What the calls of api/call.hpp answer, or have answered about the same
// inputs: the last reports are kept.
v1::Report checked_once(const AskedTree& asked, v1::Monitor& monitor);
v1::Report linted_once(const AskedTree& asked, v1::Monitor& monitor);

}  // namespace btcheck
