// SPDX-License-Identifier: MIT
//
// What the C++ runtime in libbtcheck.so asks when an exception is thrown: which
// loaded file a place of the code belongs to. glibc answers from 2.35 on; with
// this answer, which is that of older ones, the library runs with 2.34, too.
#include <dlfcn.h>
#include <link.h>

#include <cstddef>

namespace {

struct Question {
  ElfW(Addr) place;
  dl_find_object* answer;
};

int is_in(dl_phdr_info* file, std::size_t, void* asked) {
  const Question& question = *static_cast<Question*>(asked);
  bool is_here = false;
  ElfW(Addr) frames = 0;
  for (int i = 0; i < file->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = file->dlpi_phdr[i];
    const ElfW(Addr) begin = file->dlpi_addr + part.p_vaddr;
    if (part.p_type == PT_GNU_EH_FRAME) frames = begin;
    is_here |= part.p_type == PT_LOAD && question.place >= begin &&
               question.place - begin < part.p_memsz;
  }
  if (!is_here) return 0;
  question.answer->dlfo_eh_frame = reinterpret_cast<void*>(frames);
  return frames != 0 ? 1 : -1;
}

}  // namespace

extern "C" int _dl_find_object(void* place, dl_find_object* answer) noexcept {
  *answer = {};
  Question question{reinterpret_cast<ElfW(Addr)>(place), answer};
  return dl_iterate_phdr(is_in, &question) == 1 ? 0 : -1;
}
