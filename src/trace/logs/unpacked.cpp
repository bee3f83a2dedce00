// SPDX-License-Identifier: MIT
//
// Recordings are packed by zstd or lz4, a chunk at a time. A packed chunk says
// how large it is, and may lie: what comes out is counted, never believed.
#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <new>
#include <span>

#include "trace/logs/flaws.hpp"
#include "trace/logs/ros_recording.hpp"

namespace btcheck {
namespace {

// What one call of a library has done.
struct Done {
  std::size_t read = 0;     // bytes, of what is packed
  std::size_t written = 0;  // bytes
  bool is_end = false;      // of a frame
};

// Calls go_on(packed, into) until all is unpacked.
template <class GoOn>
std::string unpacked(std::string_view packed, std::size_t most,
                     const Limits& limits, const GoOn& go_on) {
  constexpr std::size_t kStep = std::size_t{1} << 16;
  std::string bytes;
  for (;;) {
    keep_limits(limits, 2 * bytes.size());  // while it is moved
    const std::size_t before = bytes.size();
    bytes.resize(before + std::min(kStep, most - before + 1));
    const Done done = go_on(packed, std::span(bytes).subspan(before));
    bytes.resize(before + done.written);
    packed.remove_prefix(done.read);
    if (bytes.size() > most) throw damage("more is packed than is announced");
    if (packed.empty() && done.is_end) return bytes;
    const bool is_stuck = done.read + done.written == 0;
    if (is_stuck) throw damage("what is packed breaks off");
  }
}

}  // namespace

std::string zstd_unpacked(std::string_view packed, std::size_t most,
                          const Limits& limits) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(
      ZSTD_createDCtx(), &ZSTD_freeDCtx);
  if (!context) throw std::bad_alloc();
  return unpacked(
      packed, most, limits, [&](std::string_view from, std::span<char> to) {
        ZSTD_inBuffer in{from.data(), from.size(), 0};
        ZSTD_outBuffer out{to.data(), to.size(), 0};
        const std::size_t left =
            ZSTD_decompressStream(context.get(), &out, &in);
        if (ZSTD_isError(left) != 0) {
          throw damage(fmt::format("zstd: {}", ZSTD_getErrorName(left)));
        }
        return Done{in.pos, out.pos, left == 0};
      });
}

std::string lz4_unpacked(std::string_view packed, std::size_t most,
                         const Limits& limits) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION))) {
    throw std::bad_alloc();
  }
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)>
      context(made, &LZ4F_freeDecompressionContext);
  return unpacked(
      packed, most, limits, [&](std::string_view from, std::span<char> to) {
        std::size_t read = from.size();
        std::size_t written = to.size();
        const std::size_t left = LZ4F_decompress(
            context.get(), to.data(), &written, from.data(), &read, nullptr);
        if (LZ4F_isError(left) != 0) {
          throw damage(fmt::format("lz4: {}", LZ4F_getErrorName(left)));
        }
        return Done{read, written, left == 0};
      });
}

bool is_zstd(std::string_view bytes) {
  return bytes.starts_with("\x28\xB5\x2F\xFD");
}

}  // namespace btcheck
