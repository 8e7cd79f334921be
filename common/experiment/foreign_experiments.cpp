#include "common/experiment/foreign_experiments.h"

#include <map>

namespace swarmanoid
{
namespace
{

std::map<std::string, ExperimentConverter>& ConvertersByRoot()
{
  static std::map<std::string, ExperimentConverter> converters;
  return converters;
}

}  // namespace

void AddExperimentConverter(const std::string& root, ExperimentConverter converter)
{
  ConvertersByRoot()[root] = std::move(converter);
}

const ExperimentConverter* FindExperimentConverter(const std::string& root)
{
  const auto found = ConvertersByRoot().find(root);
  return found == ConvertersByRoot().end() ? nullptr : &found->second;
}

}  // namespace swarmanoid
