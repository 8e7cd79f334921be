#include "launcher/editor/known_controllers.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"
#include "common/configuration/xml_outline.h"
#include "common/configuration/xml_reader.h"
#include "launcher/system/installation.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargest = 1'000'000;  // bytes of a file that is looked into
constexpr std::size_t kMostFiles = 200;

std::vector<std::string> FilesFor(const std::string& folder)
{
  std::vector<std::string> files;
  std::error_code none;
  for (fs::directory_iterator each(folder, none), end; !none && each != end && files.size() < kMostFiles;
       each.increment(none))
    if (each->path().extension() == ".xml" && each->is_regular_file(none) && each->file_size(none) < kLargest)
      files.push_back(each->path().string());
  std::ranges::sort(files);
  for (const std::string& name : SampleNames()) files.push_back(SampleFile(name));
  return files;
}

// Returns the value of an attribute or an element with a text.
std::string ValueIn(const std::string& text, const XmlElement& element, std::string_view name)
{
  for (const XmlElement::Attribute& attribute : element.attributes)
    if (attribute.name == name) return std::string(attribute.value.Of(text));
  const XmlElement* child = element.FindChild(name);
  return child == nullptr ? "" : std::string(TrimBlanks(child->content.Of(text)));
}

void AddFrom(const std::string& file, std::map<std::string, KnownController>& known)
{
  const std::string text = ReadTextFile(file);
  const XmlElement root = OutlineOf(text, file);
  for (const XmlElement& section : root.children)
    if (section.name == "controllers")
      for (const XmlElement& controller : section.children)
        if (const std::string library = ValueIn(text, controller, "library"); !library.empty())
          known.try_emplace(controller.name,
                            KnownController{controller.name, library, fs::path(file).filename().string(),
                                            std::string(controller.whole.Of(text))});
}

}  // namespace

std::vector<KnownController> KnownControllers(const std::string& folder)
{
  std::map<std::string, KnownController> known;
  for (const std::string& file : FilesFor(folder))
  {
    try
    {
      AddFrom(file, known);
    }
    catch (const ConfigurationError&)
    {
      continue;  // it is no XML
    }
  }
  std::vector<KnownController> list;
  for (auto& [tag, controller] : known) list.push_back(std::move(controller));
  return list;
}

}  // namespace swarmanoid
