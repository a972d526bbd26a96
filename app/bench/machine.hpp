// The machine that a measurement was made on, and the memory that this program has of it.
#pragma once

#include <cstdint>
#include <string>

namespace porosph::bench {

/// Processor, cores, vector units, memory and compiler in one line.
std::string describe_machine();

std::int64_t available_memory();  ///< that could be had without swapping [bytes]
std::int64_t resident_memory();   ///< of this program [bytes]

/// Gives freed memory back, so that what grows afterwards is what is used afterwards.
void release_free_memory();

}  // namespace porosph::bench
