// The option --trust of every program that runs code or scripts of an experiment (common/configuration/trust.h).
#pragma once

namespace CLI
{
class App;
}

namespace swarmanoid
{

void AddTrustFlag(CLI::App& app);

}  // namespace swarmanoid
