// SPDX-License-Identifier: MIT
//
// What is known of contents, kept where it outlives the process: the folder of
// --cache, for one.
#pragma once

#include <optional>
#include <string>

#include "explore/components/component_store.hpp"

namespace btcheck {

// Any number of threads may use it. It need not keep anything, nor for long;
// who asks it believes none of its bytes (component_bytes.hpp).
class KeptContents {
 public:
  virtual ~KeptContents() = default;
  KeptContents(const KeptContents&) = delete;
  KeptContents& operator=(const KeptContents&) = delete;

  // What has been kept of it; nothing where that is not known.
  virtual std::optional<std::string> find(const ContentHash& content) = 0;
  virtual void keep(const ContentHash& content, std::string bytes) = 0;
  // What `find` has given was not what can have been kept.
  virtual void refuse(const ContentHash& content) = 0;
  // What is gathered has to be there for others from now on.
  virtual void write() = 0;

 protected:
  KeptContents() = default;
};

}  // namespace btcheck
