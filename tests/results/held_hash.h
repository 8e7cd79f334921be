// Returns the hash of a name in tests/results/hashes.toml, which an experiment must have.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

#include "test_folders.h"

namespace swarmanoid::test
{

// Returns 0 if the table has no such row.
inline std::uint64_t HeldHash(const std::string& name)
{
  std::ifstream table(SWARMANOID_SOURCE_FOLDER "/tests/results/hashes.toml");
  const std::string start = name + " = \"";
  for (std::string line; std::getline(table, line);)
    if (line.starts_with(start)) return std::stoull(line.substr(start.size(), 16), nullptr, 16);
  return 0;
}

}  // namespace swarmanoid::test
