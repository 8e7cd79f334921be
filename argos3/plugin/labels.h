// Finds and calls classes that a library written for ARGoS3 registered.
#pragma once

#include <argos3/core/utility/configuration/argos_exception.h>

#include <string>
#include <vector>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"
#include "common/plugins/plugin_library.h"

namespace swarmanoid::argos3
{

// Lets users' libraries that are loaded later find the names of our API and of this library without linking it, as in
// ARGoS3.
void ShareNames(const std::string& library);
// Loads libraries, separated by colons, before others that depend on them. An error of one is reported when its label
// is requested.
void LoadBefore(const std::string& libraries);

// Loads the library that `file` of an element names, and returns what it registered under the element's label. Throws
// ConfigurationError.
template <class Registry>
auto FindLabel(const TConfigurationTree& element, const std::string& file, const std::string& what, Registry registry,
               const std::string& label_name = "label")
{
  LoadBefore("");
  const PluginLibrary& library = LoadPluginLibrary(element.GetText(file), {});
  ShareNames(library.path);
  if (!library.error.empty()) throw ConfigurationError(element.ValueLocation(file), library.error);
  const std::string label = element.GetText(label_name);
  const auto& known = registry();
  if (const auto found = known.find(label); found != known.end()) return found->second;
  std::vector<std::string> labels;
  for (const auto& [name, create] : known) labels.push_back(name);
  throw ConfigurationError(element.ValueLocation(label_name),
                           "the library " + library.path + " registers no " + what + " " + Quoted(label) +
                               "; registered: " + Listed(labels) + DidYouMean(label, labels));
}

// Turns exceptions of Init into mistakes of the file.
template <class Call>
void Calling(const SourceLocation& place, Call call)
{
  try
  {
    call();
  }
  catch (const argos::CARGoSException& mistake)
  {
    // The exceptions of GetNode… name their place.
    const std::string what = mistake.what();
    if (what.starts_with(place.Text() + ": ")) throw ConfigurationError(what);
    throw ConfigurationError(place, what);
  }
}

}  // namespace swarmanoid::argos3
