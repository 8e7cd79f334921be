// Reads an experiment file and returns all mistakes at once, each with its position and cure.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

struct Diagnostic
{
  SourceLocation location;
  std::string message;  // the mistake; the allowed values; did you mean …

  std::string Text() const { return location.Text() + ": " + message; }
};

using ExperimentSettings = std::vector<std::pair<std::string, std::string>>;  // path and value, as for --set

struct LoadOptions
{
  ExperimentSettings settings;
  // It is true if this machine runs the experiment. The libraries of the controllers are loaded and must register the
  // tags, and the maps of terrains must exist.
  bool check_files = true;
  // For editors: returns a file with mistakes as well as possible, beside the mistakes. Wrong values have their
  // defaults. The result is only for display.
  bool even_if_wrong = false;
  // Reads the framework and the engines without their entities. For a large swarm this takes a hundredth of the time
  // and memory. Mistakes elsewhere are not looked for.
  bool engines_alone = false;
};

// Either an experiment or errors. With even_if_wrong it has both, unless the file cannot be read at all.
struct LoadedExperiment
{
  std::unique_ptr<Experiment> experiment;
  std::vector<Diagnostic> errors;
  // With the experiment come the positions of the elements of its effective text in the user's files. Appended to that
  // text, they let readers report the user's positions.
  std::string places;
};

// Reads a file. Call DescribeBuiltins before, since the tables of all plug-ins decide what the file may contain.
LoadedExperiment LoadExperimentFile(const std::string& path, const LoadOptions& options = {});
// Reads a text, as a role gets it from the space server; `folder` resolves relative paths.
LoadedExperiment LoadExperimentText(const std::string& text, const std::string& file_name, const std::string& folder,
                                    const LoadOptions& options = {});

}  // namespace swarmanoid
