#include "common/experiment/foreign_experiments.h"

#include <algorithm>
#include <map>
#include <utility>

#include "common/experiment/source_places.h"

namespace swarmanoid
{
namespace
{

struct ForeignFiles
{
  ExperimentConverter convert;
  ExperimentReader read;
};

std::map<std::string, ForeignFiles>& FilesByRoot()
{
  static std::map<std::string, ForeignFiles> files;
  return files;
}

// Returns the name of the first element; empty if none begins.
std::string NameOfRoot(std::string_view text)
{
  while (true)
  {
    text.remove_prefix(std::min(text.find('<'), text.size()));
    if (text.size() < 2) return {};
    const bool is_comment = text.starts_with("<!--");
    if (!is_comment && text[1] != '!' && text[1] != '?') break;
    const std::string_view end = is_comment ? "-->" : ">";
    text.remove_prefix(std::min(text.find(end), text.size()));
  }
  text.remove_prefix(1);
  return std::string(text.substr(0, text.find_first_of(" \t\r\n/>")));
}

}  // namespace

void AddExperimentConverter(const std::string& root, ExperimentConverter converter, ExperimentReader reader)
{
  FilesByRoot()[root] = {std::move(converter), std::move(reader)};
}

const ExperimentConverter* FindExperimentConverter(const std::string& root)
{
  const auto found = FilesByRoot().find(root);
  return found == FilesByRoot().end() ? nullptr : &found->second.convert;
}

bool IsForeignExperiment(std::string_view text) { return FilesByRoot().contains(NameOfRoot(text)); }

std::shared_ptr<const ConfigurationNode> ReadExperimentXml(const std::string& text, const std::string& file_name)
{
  try
  {
    return ReadXmlWithPlaces(text, file_name);
  }
  catch (const ConfigurationError&)
  {
    const auto files = FilesByRoot().find(NameOfRoot(text));
    if (files == FilesByRoot().end()) throw;
    if (auto root = files->second.read(text, file_name)) return root;
    throw;
  }
}

}  // namespace swarmanoid
