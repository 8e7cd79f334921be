// What a run left in its folder, on its way from the machine that ran it to the folder of its study.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/serialisation/bytes.h"

namespace swarmanoid
{

struct RunFiles
{
  std::vector<std::pair<std::string, std::vector<char>>> files;  // path below the folder of the run, and content
  std::vector<std::string> left_out;                             // there were more bytes than `most`

  // All regular files below a folder, the log first; none if it is not there.
  static RunFiles Collect(const std::string& folder, std::uint64_t most_bytes);
  // Into a folder, in whose place there may be another one. Throws std::runtime_error that names the file.
  void Keep(const std::string& folder) const;

  void Write(ByteWriter& bytes) const;
  // Throws std::runtime_error if a path leads out of the folder.
  static RunFiles Read(ByteReader& bytes);
};

}  // namespace swarmanoid
