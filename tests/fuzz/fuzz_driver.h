// The common part of the fuzzers (tests/fuzz/<topic>_fuzzer.cpp) and of the driver in the normal build. A fuzzer
// defines LLVMFuzzerTestOneInput for libFuzzer: any input is accepted, or refused with an error. A broken promise ends
// in std::abort().
#pragma once

#include <cstdint>
#include <vector>

namespace swarmanoid::fuzz
{

using Input = std::vector<std::uint8_t>;

// Optional: the first inputs, from which the driver makes others, for formats that would be unreadable as files of a
// corpus. `PROGRAM --write-corpus FOLDER` makes files of them for libFuzzer.
[[gnu::weak]] std::vector<Input> FirstInputs();

// Optional: texts of the format that change much with few bytes: keys, words, separators.
[[gnu::weak]] std::vector<Input> Words();

}  // namespace swarmanoid::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count);
