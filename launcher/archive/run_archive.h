// An archive of a run: one tar.gz file with all that is needed to run it again on another machine and to compare each
// state. `swarmanoid archive` writes it, `swarmanoid reproduce` reads it. Its first member is archive.json, which lists
// all others with their sizes and digests; they follow in the order of their names.
//
//   archive.json       the versions, builds of libraries, the first and last tick, the list of the other members
//   events.csv         the requests of users, if there were any
//   experiment.xml     the experiment with all settings applied
//   files/…            the files that it names, with the same paths from each other
//   hashes.txt         the hashes of all ticks that the run has, as --hash-log writes them
//   journal/…          the journal, if the user asked for it or the run needs it
//   manifest.json      as in the folder of the run
//   page.html          a page that plays the run, if the user asked for it
//   start              the checkpoint that the run began with, if it did not begin at tick 0
//
// All members stand below one folder that has the name of the experiment. Unpacked, it is the folder of a run.
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/checkpoint/library_builds.h"
#include "launcher/archive/archive_members.h"

namespace swarmanoid
{

// Change the version with each change that a reader of the version before does not understand.
inline constexpr unsigned kArchiveVersion = 1;

inline constexpr const char* kArchiveIndex = "archive.json";
inline constexpr const char* kArchivedHashes = "hashes.txt";
inline constexpr const char* kArchivedStart = "start";
inline constexpr const char* kArchivedPage = "page.html";

// what() names the archive and the reason.
class ArchiveError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// The content of archive.json.
struct ArchiveIndex
{
  std::string experiment;
  std::uint64_t seed = 0;
  // The program that made the run: version, commit, and the builds of all that computed its state.
  std::string version;
  std::string revision;
  std::vector<LibraryBuild> builds;
  std::uint64_t first_tick = 0;  // with a hash
  std::uint64_t last_tick = 0;
  // False if the run was killed, or went on when it was archived. Then the last tick is not its end.
  bool has_ended = false;
  // The files that the experiment names by absolute paths, and their members.
  std::map<std::string, std::string> moved;
  std::vector<ArchiveMember> members;  // ascending by name

  std::string Text() const;
  // Throws std::runtime_error with the reason if the text is no index, or if a name in it is not allowed.
  static ArchiveIndex Parse(const std::string& text);
  bool Has(const std::string& name) const;
};

// Unpacks an archive into an empty folder of this process. Each member is checked: its place in the list, its size and
// its digest. Program code is refused, since an archive has none. Throws ArchiveError. An archive from anywhere may be
// read: nothing outside the folder is written, and no more than the list says and the disk has.
ArchiveIndex UnpackArchive(const std::string& path, const std::string& folder);

}  // namespace swarmanoid
