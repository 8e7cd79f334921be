// Makes the archive of a run from its folder (run_archive.h). Used by `swarmanoid archive`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "launcher/archive/run_archive.h"

namespace swarmanoid
{

struct ArchiveRequest
{
  std::string run;     // its folder
  std::string output;  // the new file; empty: named after the folder, in the working folder
  bool journal = false;
  bool page = false;               // with a page that plays the run
  std::vector<std::string> files;  // that code of the experiment reads, beside those that the experiment names
};

struct MadeArchive
{
  std::string path;
  std::string digest;  // SHA-256 of the file
  std::uint64_t bytes = 0;
  std::uint64_t hashes = 0;
  ArchiveIndex index;
};

// Equal runs and requests give equal bytes. Throws UsageError with the cure if the folder is no run, if its experiment
// or a file of it has changed since, or if the run has no hash; std::runtime_error if the file cannot be written.
// Returns without a path if the user interrupts it.
MadeArchive MakeArchive(const ArchiveRequest& request);

}  // namespace swarmanoid
