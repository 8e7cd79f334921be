#include "launcher/command/completion.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>
#include <utility>

#include "common/errors/exit_codes.h"
#include "common/experiment/load_experiment.h"
#include "common/messages/control_verbs.h"
#include "common/plugins/catalogue.h"
#include "common/program/standard_output.h"
#include "common/run/access/run_directory.h"
#include "launcher/command/sub_command.h"
#include "launcher/plugin_text.h"
#include "launcher/system/installation.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kFiles = ":files";
constexpr const char* kExperimentFiles = ":files .xml";

class Completer
{
public:
  Completer(const CLI::App& app, std::vector<std::string> words) : command_(&app), words_(std::move(words))
  {
    typed_ = words_.back();
    words_.pop_back();
    for (const std::string& word : words_) Read(word);
  }

  std::vector<std::string> Take()
  {
    if (value_of_ != nullptr)
      OfferValues(*value_of_);
    else if (typed_.starts_with("-"))
      OfferOptions();
    else
      OfferWords();
    return std::move(offered_);
  }

private:
  void Read(const std::string& word)
  {
    if (std::exchange(value_of_, nullptr) != nullptr) return;
    if (word.starts_with("-"))
    {
      if (word.find('=') != std::string::npos) return;
      for (const CLI::Option* option : command_->get_options())
        if (!option->get_positional() && option->check_name(word) && option->get_items_expected_max() > 0)
          value_of_ = option;
      return;
    }
    for (const CLI::App* next : command_->get_subcommands([](const CLI::App*) { return true; }))
      if (next->get_name() == word)
      {
        path_ += (path_.empty() ? "" : " ") + word;
        command_ = next;
        return;
      }
    given_.push_back(word);
  }

  void Offer(const std::string& word, const std::string& meaning = "")
  {
    if (!word.starts_with(typed_)) return;
    std::string line = meaning.substr(0, meaning.find('\n'));
    offered_.push_back(line.empty() ? word : word + "\t" + line);
  }

  void OfferOptions()
  {
    for (const CLI::Option* option : command_->get_options())
      for (const std::string& name : option->get_lnames()) Offer("--" + name, option->get_description());
  }

  void OfferValues(const CLI::Option& option)
  {
    const std::string type = option.get_type_name();
    if (option.check_name("--set")) return OfferSettings();
    if (option.check_name("--engine"))
    {
      RegisterBuiltins();
      return OfferPlugins(PluginKind::kEngine);
    }
    if (type == "FILE") return offered_.emplace_back(kFiles), void();
    std::istringstream choices(type);
    if (type.find('|') != std::string::npos)
      for (std::string choice; std::getline(choices, choice, '|');) Offer(choice);
  }

  // Offers the values of the experiment file on the command line.
  void OfferSettings()
  {
    if (given_.empty()) return;
    RegisterBuiltins();
    const LoadedExperiment loaded = LoadExperimentFile(given_.front());
    if (!loaded.experiment) return;
    std::istringstream rows(SettingRows(*loaded.experiment));
    for (std::string row; std::getline(rows, row);)
    {
      const std::size_t meaning = row.rfind('\t');
      Offer(row.substr(0, row.find('=') + 1), row.substr(meaning + 1));
    }
  }

  void OfferRuns()
  {
    for (const LocalRun& run : FindLocalRuns()) Offer(run.experiment, "domain " + std::to_string(run.domain));
  }

  void OfferPlugins(PluginKind kind)
  {
    for (const std::string& label : PluginCatalogue::Instance().Labels(kind)) Offer(label);
  }

  void OfferWords()
  {
    for (const CLI::App* next : command_->get_subcommands([](const CLI::App*) { return true; }))
      Offer(next->get_name(), next->get_description());
    if (path_ == "attach" && given_.empty())
    {
      RegisterBuiltins();
      for (const std::string& label : PluginCatalogue::Instance().Labels(PluginKind::kRenderer))
        Offer(label.substr(0, label.rfind("_render")));
    }
    else if (path_ == "attach")
    {
      OfferRuns();
    }
    else if (path_ == "share")
    {
      if (given_.empty()) OfferRuns();
    }
    else if (path_ == "control")
    {
      if (given_.empty()) OfferRuns();
      for (const ControlVerb& verb : ControlVerbs())
        if (verb.who <= Asker::kMember) Offer(verb.name, verb.help);
    }
    else if (path_ == "list plugins")
    {
      RegisterBuiltins();
      for (const PluginKind kind :
           {PluginKind::kEngine, PluginKind::kSensor, PluginKind::kActuator, PluginKind::kRenderer})
        OfferPlugins(kind);
    }
    else if (path_ == "convert" || path_ == "install" || path_ == "pack" || path_ == "list packages")
    {
      if (given_.empty()) offered_.emplace_back(kFiles);
    }
    else if (path_ == "demo")
    {
      for (const std::string& name : SampleNames()) Offer(name);
    }
    else if (given_.empty() &&
             (path_ == "run" || path_ == "check" || path_ == "edit" || path_ == "list settings" || path_ == "sweep"))
    {
      offered_.emplace_back(kExperimentFiles);
    }
  }

  const CLI::App* command_;
  std::vector<std::string> words_;
  std::string typed_;
  std::string path_;                       // path of the sub-command: "list plugins"
  std::vector<std::string> given_;         // words that are neither commands nor options
  const CLI::Option* value_of_ = nullptr;  // the option that the next word is for
  std::vector<std::string> offered_;
};

}  // namespace

std::vector<std::string> Completions(const CLI::App& app, const std::vector<std::string>& words)
{
  return Completer(app, words.empty() ? std::vector<std::string>{""} : words).Take();
}

int PrintCompletions(const std::vector<std::string>& words)
{
  int exit_code = kExitDone;
  CLI::App app("", "swarmanoid");
  AddSubCommands(app, exit_code);
  for (const std::string& line : Completions(app, words)) fmt::print("{}\n", line);
  return ExitCodeWithOutput(kExitDone);
}

}  // namespace swarmanoid
