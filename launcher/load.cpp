#include "launcher/load.h"

#include <fmt/format.h>

#include <cstdio>

#include "common/space/terrain/terrain.h"
#include "controller_host/device.h"
#include "engine_worker/engine_worker.h"
#include "launcher/builtins.h"
#include "launcher/usage_error.h"
#include "visualiser/render.h"

namespace swarmanoid
{
namespace
{

// Every process of a run reads the maps of terrains; what is wrong with them is said before any of them starts.
bool TerrainsAreGood(const Experiment& experiment)
{
  bool good = true;
  for (const EntityConfiguration& entity : experiment.entities)
  {
    if (entity.kind != EntityKind::kTerrain) continue;
    try
    {
      LoadTerrain(entity, experiment.folder);
    }
    catch (const ConfigurationError& error)
    {
      good = false;
      fmt::print(stderr, "{}\n", error.what());
    }
  }
  return good;
}

}  // namespace

void RegisterBuiltins()
{
  RegisterBuiltinEngines();
  RegisterBuiltinDevices();
  RegisterBuiltinRenderers();
}

std::unique_ptr<Experiment> LoadOrComplain(const std::string& file, const LoadOptions& options)
{
  RegisterBuiltins();
  LoadedExperiment loaded = LoadExperimentFile(file, options);
  for (const Diagnostic& error : loaded.errors) fmt::print(stderr, "{}\n", error.Text());
  if (!loaded.experiment)
    fmt::print(stderr, "{}: {}\n", file,
               loaded.errors.size() == 1 ? "1 error" : fmt::format("{} errors", loaded.errors.size()));
  if (loaded.experiment && !TerrainsAreGood(*loaded.experiment)) return nullptr;
  return std::move(loaded.experiment);
}

std::pair<std::string, std::string> SplitSetting(const std::string& text)
{
  const std::size_t sign = text.find('=');
  if (sign == std::string::npos || sign == 0)
    throw UsageError(fmt::format("--set {}: write PATH=VALUE, for example --set framework.maxclock=100", text));
  return {text.substr(0, sign), text.substr(sign + 1)};
}

}  // namespace swarmanoid
