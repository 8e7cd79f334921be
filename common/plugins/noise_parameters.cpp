#include "common/plugins/noise_parameters.h"

#include <string_view>
#include <utility>

#include "common/plugins/parameter_checks.h"

namespace swarmanoid
{
namespace
{

using enum ParameterType;

constexpr std::string_view kKind = "noise_kind";

// Checks one set of noise parameters: those with `prefix`.
void CheckSet(const Parameters& parameters, const std::string& prefix, std::vector<ConfigurationError>& mistakes)
{
  const TConfigurationTree& tree = parameters.Tree();
  const auto is_given = [&](const char* name) { return parameters.IsGiven(prefix + name); };
  const auto quoted = [&](const char* name) { return "'" + prefix + name + "'"; };
  const std::string of = " of <" + tree.Name() + ">";
  if (!is_given("noise_kind"))
  {
    for (const char* name : {"noise_mean", "noise_deviation", "noise_range"})
      if (is_given(name))
      {
        mistakes.emplace_back(
            tree.ValueLocation(prefix + name),
            quoted(name) + of + " has no effect without " + quoted("noise_kind") +
                "; give that too: uniform, gaussian or truncated_gaussian, or none to switch the noise off");
        return;
      }
    return;
  }
  const std::string kind = parameters.Text(prefix + "noise_kind");
  if (kind == "truncated_gaussian")
  {
    for (const char* name : {"noise_deviation", "noise_range"})
      if (!is_given(name))
      {
        mistakes.emplace_back(tree.ValueLocation(prefix + "noise_kind"),
                              quoted("noise_kind") + of + " is truncated_gaussian, which needs " +
                                  quoted("noise_deviation") + " and " + quoted("noise_range") + "; give " +
                                  quoted(name) + " too, or take gaussian, which needs no range");
        return;
      }
    return;
  }
  const char* needed = kind == "uniform" ? "noise_range" : kind == "gaussian" ? "noise_deviation" : nullptr;
  if (needed == nullptr || is_given(needed) || is_given("noise_mean")) return;
  mistakes.emplace_back(tree.ValueLocation(prefix + "noise_kind"),
                        quoted("noise_kind") + of + " is " + kind + ", which changes nothing without " +
                            quoted(needed) + "; give that, or " + quoted("noise_mean"));
}

}  // namespace

std::vector<ParameterSpec> NoiseParameters(const std::string& of, const std::string& unit, const std::string& prefix)
{
  return {
      {.name = prefix + "noise_kind",
       .type = kChoice,
       .unit = "",
       .default_value = "none",
       .description = "Kind of the noise added to " + of + ".",
       .choices = {"none", "uniform", "gaussian", "truncated_gaussian"}},
      {prefix + "noise_mean", kNumber, unit, "0", "Mean of the noise on " + of + ": a systematic error.", -1e6, 1e6},
      {prefix + "noise_deviation", kNumber, unit, "0", "Standard deviation of Gaussian noise on " + of + ".", 0, 1e6},
      {prefix + "noise_range", kNumber, unit, "0",
       "Uniform noise lies within the mean +- this. Gaussian noise beyond it is put onto its border where it is not 0; "
       "truncated Gaussian noise is drawn from within it.",
       0, 1e6}};
}

std::vector<ParameterSpec> ColourNoiseParameters()
{
  return NoiseParameters("red, green and blue of what is lit", "1/255");
}

void CheckNoiseOf(PluginKind kind, const PluginDescription& device)
{
  std::vector<std::string> prefixes;
  for (const ParameterSpec& parameter : device.parameters)
    if (parameter.name.ends_with(kKind))
      prefixes.push_back(parameter.name.substr(0, parameter.name.size() - kKind.size()));
  if (prefixes.empty()) return;
  ParameterChecks::Instance().Add(kind, device,
                                  [prefixes = std::move(prefixes)](const Parameters& parameters)
                                  {
                                    std::vector<ConfigurationError> mistakes;
                                    for (const std::string& prefix : prefixes) CheckSet(parameters, prefix, mistakes);
                                    return mistakes;
                                  });
}

}  // namespace swarmanoid
