// Reading an experiment file: all mistakes at once, each with its place and cure.
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
  std::string message;  // what is wrong; what is allowed; did you mean …

  std::string Text() const { return location.Text() + ": " + message; }
};

using ExperimentSettings = std::vector<std::pair<std::string, std::string>>;  // path and value, as for --set

struct LoadOptions
{
  ExperimentSettings settings;
  // Whether what runs the experiment is on this machine: the libraries of the controllers are loaded and must register
  // the tags, and the maps of terrains must be there.
  bool check_files = true;
  // For editors: what can be made of a file with mistakes, beside them. Values that are wrong have their defaults; only
  // to be looked at.
  bool even_if_wrong = false;
  // The framework and the engines without their entities, for those who need to know no more: of a large swarm it takes
  // a hundredth of the time and the memory. Mistakes elsewhere are not looked for.
  bool engines_alone = false;
};

// Either an experiment or errors; both with even_if_wrong, unless nothing can be made of the file.
struct LoadedExperiment
{
  std::unique_ptr<Experiment> experiment;
  std::vector<Diagnostic> errors;
  // With the experiment: where the elements of its effective text stand in what the user wrote. Put behind that text,
  // it lets whoever reads it name the user's places.
  std::string places;
};

// Call DescribeBuiltins before; the tables of all plug-ins decide what the file may contain.
LoadedExperiment LoadExperimentFile(const std::string& path, const LoadOptions& options = {});
// The same from text, as a role gets it from the space server; `folder` resolves relative paths.
LoadedExperiment LoadExperimentText(const std::string& text, const std::string& file_name, const std::string& folder,
                                    const LoadOptions& options = {});

}  // namespace swarmanoid
