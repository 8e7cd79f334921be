#include "studies/study_setup.h"

#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <map>

#include "common/checkpoint/library_builds.h"
#include "common/configuration/regular_file.h"
#include "common/configuration/xml_reader.h"
#include "common/plugins/elf_file.h"
#include "common/plugins/library.h"
#include "common/serialisation/bytes.h"
#include "common/version/version.h"
#include "studies/recorder.h"

namespace swarmanoid
{
namespace
{

// At most so many points are loaded to test that all files exist; the others differ only in numbers.
constexpr std::size_t kMostLoaded = 50;

using BuildsByName = std::map<std::string, std::string>;

// Returns the builds of the libraries that measure, and of the experiments' libraries. Throws StudyRefused if an
// experiment cannot be loaded here.
BuildsByName BuildsOf(const Study& study, const Design& design)
{
  BuildsByName builds;
  for (const char* own : {"simulation", "studies"})
  {
    const std::string file =
        fmt::format("libswarmanoid_{}.so.{}.{}", own, SWARMANOID_VERSION_MAJOR, SWARMANOID_VERSION_MINOR);
    try
    {
      builds[file] = BuildOfLibrary(OwnLibraryFolder() + "/" + file);
    }
    catch (const FileError& error)
    {
      throw StudyRefused(fmt::format("cannot read its '{}': {}", file, error.what()));
    }
  }
  for (const std::size_t point : design.PointsOfAllLevels(kMostLoaded))
  {
    LoadOptions changes;
    changes.settings = design.SettingsOf(point);
    changes.settings.emplace_back("framework.seed", std::to_string(study.seeds.front()));
    const LoadedExperiment loaded = LoadExperimentFile(design.ExperimentOf(point), changes);
    if (!loaded.errors.empty()) throw StudyRefused(loaded.errors.front().Text());
    try
    {
      const Recorder tried(study, *loaded.experiment);
    }
    catch (const ConfigurationError& error)
    {
      throw StudyRefused(error.what());
    }
    for (const LibraryBuild& build : LibraryBuildsOf(*loaded.experiment)) builds[build.name] = build.build;
  }
  return builds;
}

void CompareVersions(const std::string& version, const std::string& revision)
{
  if (version == Version()) return;
  throw StudyRefused(fmt::format("its Swarmanoid has version {}{}, that of the study {}{}; install the same on both",
                                 Version(), *GitRevision() == 0 ? "" : fmt::format(" ({})", GitRevision()), version,
                                 revision.empty() ? "" : fmt::format(" ({})", revision)));
}

void CompareFile(const std::string& path, std::uint64_t hash)
{
  std::string text;
  try
  {
    text = ReadTextFile(path);
  }
  catch (const ConfigurationError& error)
  {
    throw StudyRefused(
        fmt::format("{}; a study needs its files under the same path on each machine: copy their folder, "
                    "or share it",
                    error.what()));
  }
  if (XXH3_64bits(text.data(), text.size()) != hash)
    throw StudyRefused(fmt::format("its '{}' is another one than that of the study; copy that one", path));
}

void CompareBuilds(const BuildsByName& wanted, const BuildsByName& own, const std::string& revision)
{
  for (const auto& [name, build] : wanted)
  {
    const auto found = own.find(name);
    const std::string there = found == own.end() || found->second.empty() ? "none" : found->second;
    if (there == build || build.empty()) continue;
    if (name == kSwarmanoidBuild)
      throw StudyRefused(
          fmt::format("its Swarmanoid is another build (revision '{}' there, '{}' here), whose results "
                      "may differ; install the same on both",
                      GitRevision(), revision));
    throw StudyRefused(fmt::format("{} is another one there ({}) than here ({}), and results may differ; copy the file",
                                   NameInText({name, build}), there.substr(0, 16), build.substr(0, 16)));
  }
}

}  // namespace

std::string NameOfThisHost()
{
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  return name;
}

// Version and revision come first in all versions of this format.
std::vector<char> SetupOf(const Study& study, const Design& design)
{
  ByteWriter bytes;
  bytes.PutText(Version());
  bytes.PutText(GitRevision());
  bytes.PutText(study.text);
  bytes.PutText(study.name);
  bytes.PutText(study.folder);
  const std::vector<std::string> files = design.ExperimentFiles();
  bytes.Put(static_cast<std::uint64_t>(files.size()));
  for (const std::string& file : files)
  {
    const std::string text = ReadTextFile(file);
    bytes.PutText(file);
    bytes.Put(static_cast<std::uint64_t>(XXH3_64bits(text.data(), text.size())));
  }
  const BuildsByName builds = BuildsOf(study, design);
  bytes.Put(static_cast<std::uint64_t>(builds.size()));
  for (const auto& [name, build] : builds)
  {
    bytes.PutText(name);
    bytes.PutText(build);
  }
  return bytes.Bytes();
}

std::unique_ptr<Study> TakeUp(std::span<const char> setup)
{
  ByteReader bytes(setup);
  const std::string version = bytes.GetText();
  const std::string revision = bytes.GetText();
  CompareVersions(version, revision);
  const std::string text = bytes.GetText();
  const std::string name = bytes.GetText();
  const std::string folder = bytes.GetText();
  for (auto count = bytes.Get<std::uint64_t>(); count > 0; --count)
  {
    const std::string file = bytes.GetText();
    CompareFile(file, bytes.Get<std::uint64_t>());
  }
  BuildsByName builds;
  for (auto count = bytes.Get<std::uint64_t>(); count > 0; --count)
  {
    const std::string library = bytes.GetText();
    builds[library] = bytes.GetText();
  }
  LoadedStudy loaded = LoadStudyText(text, name + ".xml", folder);
  if (!loaded.study) throw StudyRefused(loaded.errors.front().Text());
  CompareBuilds(builds, BuildsOf(*loaded.study, Design(*loaded.study)), revision);
  return std::move(loaded.study);
}

}  // namespace swarmanoid
