// The controllers that the editor offers: those of the samples and of other experiments in the folder of the file, with
// their libraries, devices and parameters. No library is loaded for them.
#pragma once

#include <string>
#include <vector>

namespace swarmanoid
{

struct KnownController
{
  std::string tag;
  std::string library;
  std::string file;  // where it was found, without its folder
  std::string xml;   // the whole element
};

// Returns each tag once, in alphabetical order. Experiments in `folder` go before samples.
std::vector<KnownController> KnownControllers(const std::string& folder);

}  // namespace swarmanoid
