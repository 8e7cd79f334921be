#include "launcher/editor/edited_scripts.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "launcher/editor/edited_experiment.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

bool IsScript(const fs::path& path) { return path.extension() == ".lua" || path.extension() == ".py"; }

bool IsBelow(const fs::path& path, const fs::path& folder)
{
  const fs::path relative = path.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

class Collector
{
public:
  explicit Collector(const std::string& folder)
  {
    std::error_code none;
    for (const fs::path& each : {fs::current_path(none), fs::path(folder), fs::path(folder).parent_path()})
      if (const fs::path real = fs::canonical(each, none); !none) folders_.push_back(real);
  }

  void Add(const ConfigurationNode& element)
  {
    for (const ConfigurationNode::Attribute& attribute : element.attributes) AddValue(attribute.value);
    if (element.children.empty()) AddValue(element.text);
    for (const auto& child : element.children) Add(*child);
  }

  std::vector<ControllerScript> scripts;

private:
  void AddValue(const std::string& value)
  {
    if (!IsScript(value)) return;
    for (const fs::path& folder : folders_)
    {
      std::error_code none;
      const fs::path file = fs::canonical(folder / value, none);
      if (none || !fs::is_regular_file(file, none)) continue;
      const bool allowed = std::ranges::any_of(folders_, [&](const fs::path& each) { return IsBelow(file, each); });
      const bool known = std::ranges::any_of(scripts, [&](const auto& each) { return each.file == file.string(); });
      if (allowed && IsScript(file) && !known) scripts.push_back({value, file.string()});
      return;
    }
  }

  std::vector<fs::path> folders_;
};

void RequireKnown(const std::string& file, const std::vector<ControllerScript>& known)
{
  if (std::ranges::find(known, file, &ControllerScript::file) == known.end())
    RefuseEdit("no controller of the experiment has this script any more");
}

}  // namespace

std::vector<ControllerScript> ScriptsOf(const ConfigurationNode& root, const std::string& folder)
{
  Collector collector(folder);
  for (const auto& section : root.children)
    if (section->name == "controllers") collector.Add(*section);
  return std::move(collector.scripts);
}

std::string EditedScripts::Read(const std::string& file, const std::vector<ControllerScript>& known)
{
  RequireKnown(file, known);
  try
  {
    const EditedFile read(file);
    files_.insert_or_assign(file, read);
    return read.Text();
  }
  catch (const std::runtime_error& error)
  {
    RefuseEdit(error.what());
  }
}

void EditedScripts::Save(const std::string& file, const std::string& text, bool anyway,
                         const std::vector<ControllerScript>& known)
{
  RequireKnown(file, known);
  const auto found = files_.find(file);
  if (found == files_.end()) RefuseEdit("read the script first");
  if (found->second.HasChanged() && !anyway)
    RefuseEdit(fmt::format("not saved: another program has changed {}; read it again, or save over it", file));
  try
  {
    found->second.Write(text);
  }
  catch (const std::runtime_error& error)
  {
    RefuseEdit(error.what());
  }
}

}  // namespace swarmanoid
