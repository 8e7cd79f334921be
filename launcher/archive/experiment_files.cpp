#include "launcher/archive/experiment_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <regex>
#include <set>

#include "common/configuration/regular_file.h"
#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "common/experiment/mesh_files.h"
#include "common/program/usage_error.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr std::size_t kLongestPath = 1024;
constexpr std::uint64_t kMostTextBytes = std::uint64_t{64} << 20U;
// Values of these names are no files that the experiment reads.
constexpr std::array<std::string_view, 7> kNoFiles{"id",     "library",         "controller", "name",
                                                   "folder", "controller_path", "plugin_path"};
constexpr std::string_view kPackage = "package://";

class FileCollector
{
public:
  explicit FileCollector(const fs::path& folder) : folder_(folder) { folders_.insert(folder.string()); }

  void AddOfElement(const ConfigurationNode& element)
  {
    if (element.name == "visualisations") return;
    for (const ConfigurationNode::Attribute& attribute : element.attributes) AddValue(attribute.name, attribute.value);
    if (element.children.empty()) AddValue(element.name, element.text);
    for (const auto& child : element.children) AddOfElement(*child);
  }

  void Add(const fs::path& path)
  {
    const fs::path normal = path.lexically_normal();
    if (!files_.insert(normal.string()).second) return;
    folders_.insert(normal.parent_path().string());
    if (normal.extension() == ".lua") AddOfScript(normal);
    if (normal.extension() == ".py") AddOfPython(normal);
    if (normal.extension() == ".urdf") AddOfUrdf(normal);
  }

  ExperimentFiles Take() const
  {
    fs::path root = *folders_.begin();
    const auto holds = [&root](const std::string& folder)
    {
      const fs::path relative = fs::path(folder).lexically_relative(root);
      return !relative.empty() && *relative.begin() != "..";
    };
    while (!std::ranges::all_of(folders_, holds)) root = root.parent_path();
    return {root.string(), {files_.begin(), files_.end()}, {absolute_.begin(), absolute_.end()}};
  }

private:
  static bool IsFile(const fs::path& path)
  {
    std::error_code none;
    return fs::is_regular_file(path, none);
  }

  void AddValue(const std::string& name, const std::string& value)
  {
    if (value.empty() || value.size() > kLongestPath || std::ranges::find(kNoFiles, name) != kNoFiles.end()) return;
    const fs::path path(value);
    if (!IsFile(folder_ / path)) return;
    if (path.is_absolute()) absolute_.insert(value);
    Add(folder_ / path);
  }

  // Adds the files that a Lua script loads or reads by a name in quotes. Names start at the folder of the script.
  void AddOfScript(const fs::path& script)
  {
    static const std::regex call(R"((require|dofile|loadfile|io\.open|io\.lines)\s*\(?\s*["']([^"'\n]+)["'])");
    const std::string text = ReadRegularFile(script.string(), kMostTextBytes);
    for (std::sregex_iterator found(text.begin(), text.end(), call), end; found != end; ++found)
    {
      std::string name = (*found)[2];
      std::vector<std::string> names{name};
      if ((*found)[1] == "require")
      {
        std::ranges::replace(name, '.', '/');
        names = {name + ".lua", name + "/init.lua"};
      }
      for (const std::string& one : names)
        if (fs::path(one).is_relative() && IsFile(script.parent_path() / one)) Add(script.parent_path() / one);
    }
  }

  // Adds the modules beside a script in Python, and the files that it reads by a name in quotes.
  void AddOfPython(const fs::path& script)
  {
    static const std::regex module(R"((^|\n)\s*(from|import)\s+([\w.]+))");
    static const std::regex file(R"((open|load|loadtxt|genfromtxt)\s*\(\s*["']([^"'\n]+)["'])");
    const std::string text = ReadRegularFile(script.string(), kMostTextBytes);
    std::vector<std::string> names;
    for (std::sregex_iterator found(text.begin(), text.end(), module), end; found != end; ++found)
    {
      std::string name = (*found)[3];
      std::ranges::replace(name, '.', '/');
      names.insert(names.end(), {name + ".py", name + "/__init__.py"});
    }
    for (std::sregex_iterator found(text.begin(), text.end(), file), end; found != end; ++found)
      names.push_back((*found)[2]);
    for (const std::string& name : names)
      if (fs::path(name).is_relative() && IsFile(script.parent_path() / name)) Add(script.parent_path() / name);
  }

  void AddOfUrdf(const fs::path& urdf)
  {
    static const std::regex mesh(R"re(filename\s*=\s*["']([^"'\n]+)["'])re");
    const std::string text = ReadRegularFile(urdf.string(), kMostTextBytes);
    for (std::sregex_iterator found(text.begin(), text.end(), mesh), end; found != end; ++found)
    {
      const std::string name = (*found)[1];
      const std::string path = FindUrdfMesh(name, urdf.string());
      if (path.empty()) continue;
      if (name.starts_with("file:"))
        throw UsageError(
            fmt::format("{} names the mesh {} by an absolute path, which other machines do not have: name "
                        "it relative to the URDF file, and run the experiment again",
                        Quoted(urdf.string()), Quoted(name)));
      Add(path);
      // The folder of a package is searched by its name, so it must be below the root.
      if (name.starts_with(kPackage))
        folders_.insert(path.substr(0, path.size() - (name.size() - kPackage.size()) - 1));
    }
  }

  fs::path folder_;
  std::set<std::string> folders_;
  std::set<std::string> files_;
  std::set<std::string> absolute_;
};

}  // namespace

ExperimentFiles FilesOf(const Experiment& experiment, const std::vector<std::string>& more)
{
  FileCollector files(experiment.folder);
  files.AddOfElement(*ReadXml(experiment.effective_xml, experiment.name));
  for (const std::string& path : more)
  {
    if (const std::string mistake = FileMistake(path); !mistake.empty())
      throw UsageError(fmt::format("--file {}: {}", Quoted(path), mistake));
    files.Add(fs::absolute(path));
  }
  return files.Take();
}

}  // namespace swarmanoid
