#include "launcher/command/renderer_words.h"

#include <CLI/CLI.hpp>

#include "common/configuration/configuration_tree.h"
#include "common/plugins/catalogue.h"
#include "launcher/command/completion.h"
#include "launcher/original_command.h"
#include "simulation/register_all.h"
#include "visualiser/renderer_options.h"

namespace swarmanoid
{

void AddOptionsOfKind(CLI::App& verb, std::size_t position, std::vector<std::string>& parameters)
{
  std::vector<std::string> words = OriginalCommand();
  if (words.size() > 1 && words[1] == kCompleteFlag) words.erase(words.begin() + 1);
  if (words.size() < 3 || words[1] != verb.get_name()) return;
  RegisterBuiltins();
  for (std::size_t i = 2; i < words.size(); ++i)
    for (const std::string& label : PluginCatalogue::Instance().Labels(PluginKind::kRenderer))
      if (label == words[i] || label == words[i] + "_render")
        return AddRendererOptions(verb, FindRenderer(label), parameters);
  if (words.size() < position + 3 || words[position + 2].starts_with("-")) return;
  try
  {
    AddRendererOptions(verb, FindRenderer(words[position + 2]), parameters);
  }
  catch (const ConfigurationError&)
  {
    // The command reports the mistake of this word.
  }
}

}  // namespace swarmanoid
