// `swarmanoid new`: makes the files of a new controller, experiment or user directory from the templates.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "launcher/commands.h"
#include "launcher/exit_codes.h"
#include "launcher/installation.h"
#include "launcher/template_files.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

const char* const kMakeUserDirectory =
    "make a user directory first and go there:\n  swarmanoid new user my_robots && cd my_robots";

// The user directory that we are in: the nearest folder upwards that has controllers/ and build.sh.
fs::path UserDirectory()
{
  for (fs::path folder = fs::current_path();; folder = folder.parent_path())
  {
    if (fs::is_directory(folder / "controllers") && fs::exists(folder / "build.sh")) return folder;
    if (folder == folder.root_path()) return {};
  }
}

TemplateNames NamesFor(const std::string& name)
{
  if (!IsIdentifier(name))
    throw UsageError(
        fmt::format("'{}' cannot be a name: use small letters, digits and '_', starting with a letter, "
                    "for example wall_follower",
                    name));
  return {name, ClassName(name)};
}

void MakeFile(const std::string& from, const fs::path& to, const TemplateNames& names)
{
  const fs::path source = fs::path(UserFilesFolder()) / "templates" / from;
  WriteFromTemplate(source, to, names);
  fmt::print("  {}\n", fs::relative(to).string());
}

int NewController(const std::string& name)
{
  const TemplateNames names = NamesFor(name);
  const fs::path user = UserDirectory();
  if (user.empty()) throw UsageError(std::string("this is no user directory; ") + kMakeUserDirectory);
  const fs::path folder = user / "controllers" / name;
  const fs::path experiment = user / "experiments" / (name + ".xml");
  RefuseExisting(folder);
  RefuseExisting(experiment);
  fmt::print("Made controller {}:\n", name);
  MakeFile("controller/controller.h.in", folder / (name + ".h"), names);
  MakeFile("controller/controller.cpp.in", folder / (name + ".cpp"), names);
  MakeFile("controller/experiment.xml.in", experiment, names);
  fmt::print("Next:\n  {}\n  swarmanoid run {}\n", ("." / fs::relative(user / "build.sh")).string(),
             fs::relative(experiment).string());
  return kDone;
}

int NewExperiment(const std::string& name)
{
  const TemplateNames names = NamesFor(name);
  const fs::path user = UserDirectory();
  const fs::path file = (user.empty() ? fs::current_path() : user / "experiments") / (name + ".xml");
  RefuseExisting(file);
  fmt::print("Made experiment {}:\n", name);
  MakeFile("experiment/experiment.xml.in", file, names);
  fmt::print("Next:\n  swarmanoid run {}\n", fs::relative(file).string());
  return kDone;
}

// A script makes user directories, since build_framework does it before anything is built.
int NewUser(const std::string& directory)
{
  const std::string script = fs::path(UserFilesFolder()) / "user_scripts" / "create_user_directory.sh";
  RefuseExisting(directory);
  execl(script.c_str(), script.c_str(), directory.c_str(), nullptr);
  throw std::runtime_error(fmt::format("cannot start '{}': {}", script, std::strerror(errno)));
}

}  // namespace

void AddNewCommand(CLI::App& app, int& exit_code)
{
  CLI::App* verb = app.add_subcommand("new", "Make a user directory, a controller or an experiment to start from");
  verb->require_subcommand(1);
  verb->footer(
      "Examples:\n"
      "  swarmanoid new user my_robots && cd my_robots\n"
      "  swarmanoid new controller wall_follower\n"
      "  swarmanoid new experiment first_try");

  auto name = std::make_shared<std::string>();
  CLI::App* controller =
      verb->add_subcommand("controller", "A footbot controller and an experiment with it, in a user directory");
  controller->add_option("NAME", *name, "Name of the controller: small letters, digits and '_'")->required();
  controller->footer("Example:\n  swarmanoid new controller wall_follower");
  controller->callback([name, &exit_code] { exit_code = NewController(*name); });

  CLI::App* experiment = verb->add_subcommand("experiment", "An experiment file with a few robots in a walled arena");
  experiment->add_option("NAME", *name, "Name of the experiment: small letters, digits and '_'")->required();
  experiment->footer("Example:\n  swarmanoid new experiment first_try");
  experiment->callback([name, &exit_code] { exit_code = NewExperiment(*name); });

  CLI::App* user = verb->add_subcommand("user", "A directory for your own controllers and experiments");
  user->add_option("DIRECTORY", *name, "The directory to make")->required();
  user->footer("Example:\n  swarmanoid new user my_robots");
  user->callback([name, &exit_code] { exit_code = NewUser(*name); });
}

}  // namespace swarmanoid
