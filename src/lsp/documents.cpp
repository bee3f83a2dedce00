// SPDX-License-Identifier: MIT
#include "lsp/documents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "cli/inputs/inputs.hpp"
#include "model/tree_file.hpp"
#include "text/numbers.hpp"
#include "text/utf8.hpp"

namespace btcheck::lsp {
namespace {

int hex_digit(char c) {
  if (is_digit(c)) return c - '0';
  const char small = lowered(c);
  return small >= 'a' && small <= 'f' ? small - 'a' + 10 : -1;
}

std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const int high =
        text[at] == '%' && at + 2 < text.size() ? hex_digit(text[at + 1]) : -1;
    const int low = high < 0 ? -1 : hex_digit(text[at + 2]);
    if (low < 0) {
      result += text[at];
    } else {
      result += static_cast<char>(high * 16 + low);
      at += 2;
    }
  }
  return result;
}

const JsonValue& document_in(const JsonValue& params) {
  const JsonValue* found = params.member("textDocument");
  if (found != nullptr) return *found;
  throw RpcError(rpc::kInvalidParams, "`textDocument` is needed");
}

}  // namespace

FileKind kind_of(std::string_view path, std::string_view text) {
  if (is_property_file(std::string(path))) return FileKind::Rules;
  if (path.ends_with(".leaves")) return FileKind::Leaves;
  if (path.ends_with(".btf")) return FileKind::Btf;
  if (is_xml_name(path)) return FileKind::Xml;
  return text.find("<root") != text.npos ? FileKind::Xml : FileKind::Other;
}

std::string path_of(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  std::string_view rest = colon == uri.npos ? uri : uri.substr(colon + 1);
  if (rest.starts_with("//")) {
    const std::size_t path = rest.find('/', 2);
    rest = path == rest.npos ? std::string_view() : rest.substr(path);
  }
  rest = rest.substr(0, rest.find_first_of("?#"));
  std::string path = decoded(rest);
  if (!path.starts_with('/')) path.insert(0, "/");
  return std::filesystem::path(path).lexically_normal().string();
}

std::string uri_of(std::string_view path) {
  std::string uri = "file://";
  for (const char c : path) {
    const bool is_plain =
        is_letter(c) || is_digit(c) ||
        std::string_view("/-._~").find(c) != std::string::npos;
    if (is_plain) {
      uri += c;
    } else {
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return uri;
}

std::string Documents::open(const JsonValue& params) {
  const JsonValue& told = document_in(params);
  Document document;
  document.uri = needed_text(told, "uri");
  document.path = path_of(document.uri);
  document.version = as_number<long>(told.word("version")).value_or(0);
  document.text = needed_text(told, "text");
  document.kind = kind_of(document.path, document.text.text());
  std::string path = document.path;
  all_[path] = std::move(document);
  return path;
}

std::string Documents::change(const JsonValue& params, Encoding encoding) {
  const JsonValue& told = document_in(params);
  const auto found = all_.find(path_of(needed_text(told, "uri")));
  if (found == all_.end()) {
    throw RpcError(rpc::kInvalidParams, "the document is not open");
  }
  Document& document = found->second;
  const JsonValue* changes = params.member("contentChanges");
  if (changes == nullptr) {
    throw RpcError(rpc::kInvalidParams, "`contentChanges` is needed");
  }
  for (const JsonValue& change : changes->items) {
    std::string text = needed_text(change, "text");
    if (change.member("range") != nullptr) {
      const Range range = range_in(change, "range");
      const auto lines = document.lines();
      const std::size_t begin = lines->offset(range.begin, encoding);
      const std::size_t end =
          std::max(begin, lines->offset(range.end, encoding));
      std::string whole = document.text;
      whole.replace(begin, end - begin, text);
      text = std::move(whole);
    }
    document.text = std::move(text);
  }
  document.version =
      as_number<long>(told.word("version")).value_or(document.version + 1);
  document.kind = kind_of(document.path, document.text.text());
  return document.path;
}

std::string Documents::close(const JsonValue& params) {
  std::string path = path_of(needed_text(document_in(params), "uri"));
  all_.erase(path);
  return path;
}

const Document* Documents::find(const std::string& path) const {
  const auto found = all_.find(path);
  return found == all_.end() ? nullptr : &found->second;
}

std::string Documents::uri(const std::string& path) const {
  const Document* open = find(path);
  return open == nullptr ? uri_of(path) : open->uri;
}

Buffers Documents::buffers() const {
  Buffers all;
  for (const auto& [path, document] : all_) all[path] = document.text;
  return all;
}

}  // namespace btcheck::lsp
