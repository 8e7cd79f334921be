// `swarmanoid pack` and `swarmanoid install`: a user directory as a package for others, and packages of others.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "common/configuration/wording.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/program/shell_word.h"
#include "launcher/command/sub_command.h"
#include "launcher/packages/install_package.h"
#include "launcher/packages/installed_packages.h"
#include "launcher/packages/make_package.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

void PrintContent(const PackageManifest& manifest)
{
  for (const auto& [folder, names] : manifest.Content())
    fmt::print("  {:<12} {}\n", folder, Listed({names.begin(), names.end()}));
}

int Pack(const PackRequest& request)
{
  const MadePackage made = MakePackage(request);
  fmt::print("packed {} {} by {}, {}: {}\n", made.manifest.name, made.manifest.release, made.manifest.author,
             made.manifest.licence, made.path);
  PrintContent(made.manifest);
  fmt::print("SHA-256 {}\n", made.digest);
  PrintError("Next, for others: swarmanoid install {}\n", ShellWord(made.path));
  return kExitDone;
}

int Install(const InstallRequest& request)
{
  try
  {
    const InstalledPackage installed = InstallPackage(request);
    const PackageManifest& manifest = installed.manifest;
    const std::string folder = fs::relative(installed.folder);
    fmt::print("installed {} {} by {}, {}: {}\n", manifest.name, manifest.release, manifest.author, manifest.licence,
               folder);
    PrintContent(manifest);
    const auto content = manifest.Content();
    const auto experiments = content.find("experiments");
    if (manifest.HasSources())
      PrintError("Next, once you have read its sources, which run with your rights: {}\n",
                 ShellWord(fs::path(folder) / "build.sh"));
    if (experiments != content.end())
      PrintError("{}: swarmanoid run {}\n", manifest.HasSources() ? "Then" : "Next",
                 ShellWord(fs::path(folder) / "experiments" / *experiments->second.begin()));
    return kExitDone;
  }
  catch (const PackageError& error)
  {
    PrintError("{}\n", error.what());
    return kExitInvalidFile;
  }
}

void AddPackCommand(CLI::App& app, int& exit_code)
{
  auto request = std::make_shared<PackRequest>();
  CLI::App* verb = app.add_subcommand("pack", "Make a package of a user directory, for others to install");
  verb->add_option("DIRECTORY", request->directory, "The user directory")->capture_default_str();
  verb->add_option("--release", request->release, "Its number, such as 1.2");
  verb->add_option("--author", request->author, "Its author");
  verb->add_option("--licence", request->licence, "Its licence, such as MIT");
  verb->add_option("--summary", request->summary, "What it is, in one line");
  verb->add_option("--name", request->name, "Its name: small letters, digits and '_'; otherwise that of the directory");
  verb->add_option("--output", request->output, "The new file; otherwise NAME-RELEASE.tar.gz here")->type_name("FILE");
  verb->footer(
      "The package has controllers with their behaviours, devices, engines, entities, functions, renderers and "
      "experiments, as sources, with a digest of each file. The directory's package.json keeps the options for the "
      "next "
      "release.\n"
      "Examples:\n"
      "  swarmanoid pack my_robots --release 1.0 --author \"A. User\" --licence MIT\n"
      "  cd my_robots && swarmanoid pack --release 1.1");
  verb->callback([request, &exit_code] { exit_code = Pack(*request); });
}

void AddInstallCommand(CLI::App& app, int& exit_code)
{
  auto request = std::make_shared<InstallRequest>();
  CLI::App* verb = app.add_subcommand("install", "Put a package of another user beside your user directory");
  verb->add_option("PACKAGE", request->package,
                   "Its file, its folder, or its name in a folder of the environment variable SWARMANOID_PACKAGES")
      ->required();
  verb->add_option("--into", request->into, "The folder for it; otherwise the one that holds your user directory")
      ->type_name("FOLDER");
  verb->add_flag("--replace", request->replace, "In place of an installed release whose files are unchanged");
  verb->footer(
      "It becomes a user directory of its own, with experiments to run, and build.sh if it has sources. All names, "
      "sizes "
      "and digests are checked first.\n"
      "Exit codes: 0 installed; 2 it is there already, or not found; 3 the package is damaged or not allowed.\n"
      "Examples:\n"
      "  swarmanoid install foraging-1.2.tar.gz\n"
      "  SWARMANOID_PACKAGES=/srv/packages swarmanoid install foraging\n"
      "  swarmanoid install foraging-1.3.tar.gz --replace\n"
      "  swarmanoid list packages");
  verb->callback([request, &exit_code] { exit_code = Install(*request); });
}

const RegisterSubCommand kPack(17, "pack", AddPackCommand);
const RegisterSubCommand kInstall(18, "install", AddInstallCommand);

}  // namespace
}  // namespace swarmanoid
