// What a fuzzer (tests/fuzz/<topic>_fuzzer.cpp) and the driver of the normal build have in common. A fuzzer defines
// LLVMFuzzerTestOneInput as libFuzzer wants it: any input is taken or refused in an orderly way; whatever breaks a
// promise ends in std::abort().
#pragma once

#include <cstdint>
#include <vector>

namespace swarmanoid::fuzz
{

using Input = std::vector<std::uint8_t>;

// The first inputs, from which the driver makes others, of a fuzzer whose formats would be unreadable as files of a
// corpus. Optional. `PROGRAM --write-corpus FOLDER` makes files of them for libFuzzer.
[[gnu::weak]] std::vector<Input> FirstInputs();

// Texts of the format that change much in few bytes: keys, words, separators. Optional.
[[gnu::weak]] std::vector<Input> Words();

}  // namespace swarmanoid::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count);
