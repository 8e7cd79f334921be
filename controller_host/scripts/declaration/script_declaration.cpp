#include "controller_host/scripts/declaration/script_declaration.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "common/configuration/parameter_table.h"
#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

constexpr std::array<std::pair<std::string_view, ParameterType>, 7> kTypes{{{"number", ParameterType::kNumber},
                                                                            {"integer", ParameterType::kInteger},
                                                                            {"boolean", ParameterType::kBoolean},
                                                                            {"text", ParameterType::kText},
                                                                            {"choice", ParameterType::kChoice},
                                                                            {"colour", ParameterType::kColour},
                                                                            {"path", ParameterType::kPath}}};

[[noreturn]] void Fail(const std::string& parameter, const std::string& what)
{
  throw std::runtime_error("the parameter " + Quoted(parameter) + " " + what);
}

double NumberOf(const std::string& parameter, const DeclaredField& field)
{
  const auto number = ParseNumber(field.values.front().text);
  if (!number)
    Fail(parameter, "has the " + field.name + " " + Quoted(field.values.front().text) + ", which is no number");
  return *number;
}

ParameterType TypeNamed(const std::string& parameter, const std::string& name)
{
  std::vector<std::string> names;
  for (const auto& [type, value] : kTypes)
  {
    if (type == name) return value;
    names.emplace_back(type);
  }
  Fail(parameter, "has no type " + Quoted(name) + "; the types are: " + Listed(names) + DidYouMean(name, names));
}

}  // namespace

ParameterSpec SpecFrom(const std::string& parameter, const std::vector<DeclaredField>& fields)
{
  ParameterSpec spec{.name = parameter, .default_value = std::nullopt};
  if (parameter == kScriptParameter) Fail(parameter, "is the script itself; choose another name");
  for (const DeclaredField& field : fields)
    if (field.name == "default" && !field.values.empty()) spec.type = field.values.front().type;
  for (const DeclaredField& field : fields)
  {
    if (field.name != "choices" && field.values.size() != 1)
      Fail(parameter, "has no single value as its " + field.name);
    if (field.name == "default")
      spec.default_value = field.values.front().text;
    else if (field.name == "unit")
      spec.unit = field.values.front().text;
    else if (field.name == "description")
      spec.description = field.values.front().text;
    else if (field.name == "minimum")
      spec.minimum = NumberOf(parameter, field);
    else if (field.name == "maximum")
      spec.maximum = NumberOf(parameter, field);
    else if (field.name == "type")
      spec.type = TypeNamed(parameter, field.values.front().text);
    else if (field.name == "choices")
    {
      spec.type = ParameterType::kChoice;
      for (const DeclaredValue& choice : field.values) spec.choices.push_back(choice.text);
    }
    else
    {
      const std::vector<std::string> known{"default", "unit", "description", "minimum", "maximum", "type", "choices"};
      Fail(parameter,
           "has no field " + Quoted(field.name) + "; the fields are: " + Listed(known) + DidYouMean(field.name, known));
    }
  }
  return spec;
}

void CompleteDeclaration(std::vector<ParameterSpec>& specs)
{
  std::ranges::sort(specs, {}, &ParameterSpec::name);
  if (const std::string mistake = MistakeInTable(specs); !mistake.empty()) throw std::runtime_error(mistake);
}

std::vector<ParameterSpec> ReadScriptDeclaration(const TConfigurationTree& parameters, const std::string& folder,
                                                 std::vector<ParameterSpec> (*read)(const std::string& file,
                                                                                    const std::string& path))
{
  const std::string name(TrimBlanks(parameters.Value(kScriptParameter).value_or("")));
  if (name.empty()) return {};
  const std::string path = (std::filesystem::path(folder) / name).lexically_normal().string();
  try
  {
    return read(ShownScript(path), path);
  }
  catch (const std::runtime_error& error)
  {
    throw ConfigurationError(parameters.ValueLocation(kScriptParameter), error.what());
  }
}

std::string ShownScript(const std::string& path)
{
  std::error_code none;
  const auto relative = std::filesystem::path(path).lexically_relative(std::filesystem::current_path(none));
  return relative.empty() || *relative.begin() == ".." ? path : relative.string();
}

}  // namespace swarmanoid
