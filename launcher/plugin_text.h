// The output of `swarmanoid list` about plug-ins and their parameters, for users and for completion.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "common/experiment/experiment.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid
{

// "Physics engines", "Experiment functions".
std::string PluginKindTitle(PluginKind kind);

// Returns the label, with the implementation of a device: "footbot_wheels / dummy_footbot_wheels".
std::string PluginName(const PluginDescription& plugin);

// Returns several lines: a description, and a line for each parameter.
std::string PluginDetails(PluginKind kind, const PluginDescription& plugin);

// Returns text for programs: a line for each plug-in and one for each of its parameters, with fields separated by tabs.
// The fields are kind, label, implementation, parameter (empty for the plug-in itself), type, unit, default, least,
// largest, choices, text. The default is "required" for a parameter that has none.
std::string PluginRows(PluginKind kind, const PluginDescription& plugin);

// Returns text for programs: a line for each value that --set may change in an experiment, without the arena. It has
// PATH=VALUE with the present value, the allowed values, and the meaning, separated by tabs.
std::string SettingRows(const Experiment& experiment);

// Returns the same as objects.
nlohmann::ordered_json PluginJson(PluginKind kind, const PluginDescription& plugin);
nlohmann::ordered_json SettingsJson(const Experiment& experiment);

}  // namespace swarmanoid
