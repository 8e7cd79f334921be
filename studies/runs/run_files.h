// The files in the folder of a run, for the transfer from the machine that ran it to the folder of its study.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/serialisation/fields.h"

namespace swarmanoid
{

struct RunFiles
{
  std::vector<std::pair<std::string, std::vector<char>>> files;  // path below the folder of the run, and content
  std::vector<std::string> left_out;                             // files beyond `most` bytes

  // Returns all regular files below a folder, the log first; none if the folder does not exist.
  static RunFiles Collect(const std::string& folder, std::uint64_t most_bytes);
  // Writes the files into a folder, and replaces an existing one. Throws std::runtime_error with the name of the file.
  void Keep(const std::string& folder) const;

  // Reads what WriteFields wrote. Throws std::runtime_error if a path leads out of the folder.
  static RunFiles Read(ByteReader& bytes);

  template <class Archive, class Files>
  static void Visit(Archive& archive, Files& all)
  {
    archive.List(all.files,
                 [&](auto& file)
                 {
                   archive.Text(file.first);
                   archive.Array(file.second);
                 });
    archive.List(all.left_out, [&](auto& name) { archive.Text(name); });
  }
};

}  // namespace swarmanoid
