// What becomes of memory that is freed.
#pragma once

#include <malloc.h>

namespace porosph {

/// From now on the process keeps what it frees for what it allocates next. By default the C library returns
/// large arrays to the system and takes them back page by page, which costs soil that flows a tenth of its
/// time: each renewal of the reference makes all arrays of the last one anew.
inline void keep_freed_memory() {
  constexpr int most = 1 << 30;  // bytes
  mallopt(M_MMAP_THRESHOLD, most);
  mallopt(M_TRIM_THRESHOLD, most);
}

}  // namespace porosph
