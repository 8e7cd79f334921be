// The declaration of a parameter by a script, whatever its language. A script declares a default alone, or fields:
// speed = {default = 0.1, unit = "m/s", minimum = 0, maximum = 0.3}.
#pragma once

#include <string>
#include <vector>

#include "common/configuration/parameter.h"

namespace swarmanoid
{

inline constexpr const char* kScriptParameter = "script";

// A number, text or boolean of a script, as an experiment file writes it.
struct DeclaredValue
{
  ParameterType type = ParameterType::kNumber;  // kNumber, kText or kBoolean
  std::string text{};
};

struct DeclaredField
{
  std::string name;  // "default", "unit", "description", "minimum", "maximum", "type" or "choices"
  std::vector<DeclaredValue> values{};
};

// Throws std::runtime_error for a field that does not exist or is wrong.
ParameterSpec SpecFrom(const std::string& parameter, const std::vector<DeclaredField>& fields);

// Sorts the parameters by name. Throws std::runtime_error if the table contradicts itself.
void CompleteDeclaration(std::vector<ParameterSpec>& specs);

// Calls read(file, path) with the script that <parameters> names: `file` is its name for messages. A std::runtime_error
// becomes a ConfigurationError at the name of the script. Returns nothing if no script is named.
std::vector<ParameterSpec> ReadScriptDeclaration(const TConfigurationTree& parameters, const std::string& folder,
                                                 std::vector<ParameterSpec> (*read)(const std::string& file,
                                                                                    const std::string& path));

// Returns the path relative to the working folder if it is below it.
std::string ShownScript(const std::string& path);

}  // namespace swarmanoid
