// `swarmanoid edit`: an experiment file on the page in the browser.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <thread>

#include "common/configuration/wording.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/plugin_descriptions/renderers.h"
#include "common/program/interrupts.h"
#include "common/program/shell_word.h"
#include "common/program/trust_flag.h"
#include "common/program/usage_error.h"
#include "launcher/command/sub_command.h"
#include "launcher/editor/edit_session.h"
#include "launcher/showing.h"
#include "launcher/templates/new_files.h"
#include "simulation/register_all.h"
#include "visualiser/renderer_options.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kPause = 15ms;

struct EditOptions
{
  std::string file;
  std::vector<std::string> parameters;  // parameters of web_render, "name=value"
  bool open = false;
};

// Serves the page until Ctrl-C. If changes are not saved by then, serves until they are saved, or until a second
// Ctrl-C.
void Serve(EditSession& session, EditorPage& page)
{
  bool warned = false;
  while (!Interrupted() || !session.IsSaved())
  {
    if (Interrupted() && !warned)
    {
      warned = true;
      PrintError("there are changes that are not saved: save them on the page, or press Ctrl-C again to lose them\n");
    }
    page.Idle();
    session.Idle();
    std::this_thread::sleep_for(kPause);
  }
}

// Offers to make a missing file. Without a terminal it only says how. Returns whether there is a file then.
bool OfferToMake(const std::string& file)
{
  const std::filesystem::path path(file);
  std::error_code none;
  if (std::filesystem::exists(path, none)) return true;
  const std::string make = "swarmanoid new experiment " + ShellWord(path.stem());
  const bool can_make = path.extension() == ".xml" && !path.has_parent_path();
  if (!can_make || isatty(STDIN_FILENO) != 1 || isatty(STDERR_FILENO) != 1)
  {
    PrintError("{}: there is no such file; make one: {}\n", file, make);
    return false;
  }
  PrintError("There is no file {}. Make it, with a robot and walls? [Y/n] ", Quoted(file));
  std::string answer;
  std::getline(std::cin, answer);
  if (!answer.empty() && answer[0] != 'y' && answer[0] != 'Y') return false;
  NewExperiment(path.stem().string());
  // In a user directory it belongs to the folder of its experiments, which the line above names.
  return std::filesystem::exists(path, none);
}

int Edit(const EditOptions& options)
{
  RegisterBuiltins();
  if (!OfferToMake(options.file)) return kExitInvalidFile;
  std::vector<std::string> words = options.parameters;
  words.emplace_back("allow_control=true");
  const PluginDescription& description = FindRenderer("web_render");
  TConfigurationTree tree;
  try
  {
    tree = ConfigureRenderer(description, words).tree;
  }
  catch (const ConfigurationError& error)
  {
    throw UsageError(error.what());
  }
  try
  {
    const Parameters parameters(tree, description.parameters);
    const auto page = MakeEditorPage();
    EditSession session(options.file, *page);
    const std::string key = std::filesystem::canonical(options.file).string() + " edited";
    page->Open(parameters, key, session);
    CatchInterrupts(SecondInterrupt::kKills);
    session.Begin();
    for (const Diagnostic& mistake : session.GetExperiment().Mistakes()) PrintError("{}\n", mistake.Text());
    if (const std::string warning = page->Warning(); !warning.empty()) PrintError("warning: {}\n", warning);
    if (!page->Fingerprint().empty()) PrintError("certificate SHA-256 {}\n", page->Fingerprint());
    fmt::print("Edit it: {}\n", page->Url());
    std::fflush(stdout);
    if (options.open) OpenInBrowser(page->Url());
    Serve(session, *page);
  }
  catch (const ConfigurationError& error)
  {
    PrintError("{}\n", error.what());
    return kExitInvalidFile;
  }
  return kExitDone;
}

void AddEditCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<EditOptions>();
  CLI::App* verb = app.add_subcommand("edit", "Edit an experiment file on a page in the browser");
  verb->add_option("EXPERIMENT", options->file, "The experiment file (XML)")->required();
  verb->add_flag("--open", options->open, "Open the page in the browser");
  AddTrustFlag(*verb);
  for (const ParameterSpec& spec : WebRenderDescription().parameters)
    if (const std::string& name = spec.name;
        name == "port" || name == "address" || name == "tls" || name == "certificate")
      verb->add_option_function<std::string>(
              "--" + name,
              [options, name](const std::string& value) { options->parameters.push_back(name + "=" + value); },
              spec.description)
          ->type_name(name == "certificate" ? "FILE"
                      : name == "tls"       ? "auto|on|off"
                                            : "VALUE");
  verb->footer(
      "The page shows the start state: place, move, turn, resize and remove what is there, and fill in controllers, "
      "devices and engines by forms. Save writes the file; what was not changed stays as it was, byte for byte. Ctrl-C "
      "ends it.\n"
      "Examples:\n"
      "  swarmanoid edit my_experiment.xml --open\n"
      "  swarmanoid new experiment first_try && swarmanoid edit first_try.xml\n"
      "  swarmanoid edit my_experiment.xml --port 8080");
  verb->callback([options, &exit_code] { exit_code = Edit(*options); });
}

const RegisterSubCommand kEdit(13, "edit", AddEditCommand);

}  // namespace
}  // namespace swarmanoid
