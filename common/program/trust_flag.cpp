#include "common/program/trust_flag.h"

#include <CLI/CLI.hpp>

#include "common/configuration/trust.h"

namespace swarmanoid
{

void AddTrustFlag(CLI::App& app)
{
  app.add_flag_callback(
      kTrustFlag, [] { TrustExperiments(); },
      "The experiment may write files anywhere and over others, and its Lua scripts may start programs "
      "(docs/security.md)");
}

}  // namespace swarmanoid
