// Runs of one study may be mixed from several machines only if each machine would compute the same numbers. So a setup
// states version, revision, the study's text, hashes of all experiment files, and the builds of Swarmanoid's and the
// users' libraries; another machine compares them with its own and refuses to take part at the first difference, with
// the cure. Libraries become known only when an experiment is loaded, so points are loaded until every level of every
// factor was seen once (50 at most).
#include "studies/runs/study_setup.h"

#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <map>

#include "common/checkpoint/library_builds.h"
#include "common/configuration/regular_file.h"
#include "common/configuration/xml_reader.h"
#include "common/plugins/elf_file.h"
#include "common/plugins/plugin_library.h"
#include "common/serialisation/fields.h"
#include "common/version/version.h"
#include "studies/metrics/recorder.h"

namespace swarmanoid
{
namespace
{

// At most so many points are loaded to test that all files exist; the others differ only in numbers.
constexpr std::size_t kMostLoaded = 50;

using BuildsByName = std::map<std::string, std::string>;

struct Setup
{
  std::string text, name, folder;              // of the study
  std::map<std::string, std::uint64_t> files;  // hashes of the experiment files
  BuildsByName builds;

  static void Visit(auto& archive, auto& setup)
  {
    archive.Text(setup.text);
    archive.Text(setup.name);
    archive.Text(setup.folder);
    archive.Map(setup.files,
                [&](auto& file, auto& hash)
                {
                  archive.Text(file);
                  archive.Number(hash);
                });
    archive.Map(setup.builds,
                [&](auto& name, auto& build)
                {
                  archive.Text(name);
                  archive.Text(build);
                });
  }
};

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
  Setup setup{study.text, study.name, study.folder, {}, BuildsOf(study, design)};
  for (const std::string& file : design.ExperimentFiles())
  {
    const std::string text = ReadTextFile(file);
    setup.files[file] = XXH3_64bits(text.data(), text.size());
  }
  WriteFields(bytes, setup);
  return bytes.Bytes();
}

std::unique_ptr<Study> TakeUp(std::span<const char> setup)
{
  ByteReader bytes(setup);
  const std::string version = bytes.GetText();
  const std::string revision = bytes.GetText();
  CompareVersions(version, revision);
  const auto wanted = ReadFields<Setup>(bytes);
  for (const auto& [file, hash] : wanted.files) CompareFile(file, hash);
  LoadedStudy loaded = LoadStudyText(wanted.text, wanted.name + ".xml", wanted.folder);
  if (!loaded.study) throw StudyRefused(loaded.errors.front().Text());
  CompareBuilds(wanted.builds, BuildsOf(*loaded.study, Design(*loaded.study)), revision);
  return std::move(loaded.study);
}

}  // namespace swarmanoid
