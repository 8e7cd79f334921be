// EditedScripts: the scripts, in Lua or Python, of the controllers of an edited experiment. `swarmanoid edit` shows and
// saves them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/configuration/configuration_tree.h"
#include "launcher/editor/edited_file.h"

namespace swarmanoid
{

struct ControllerScript
{
  std::string name;  // as the experiment names it
  std::string file;  // the path after all links
  bool operator==(const ControllerScript&) const = default;
};

// Returns the scripts that the elements of <controllers> name, each once. A script is a file NAME.lua or NAME.py in or
// below the working folder, the folder of the experiment or its parent. `root`: the root element.
std::vector<ControllerScript> ScriptsOf(const ConfigurationNode& root, const std::string& folder);

class EditedScripts
{
public:
  // The functions below throw std::invalid_argument with a text for the user. `known` are the scripts of the
  // experiment; other files are refused.

  // Reads a script.
  std::string Read(const std::string& file, const std::vector<ControllerScript>& known);
  // Writes a script. `anyway`: even if another program has changed it since Read.
  void Save(const std::string& file, const std::string& text, bool anyway, const std::vector<ControllerScript>& known);

private:
  std::map<std::string, EditedFile> files_;  // the scripts that were read
};

}  // namespace swarmanoid
