// All programs that run code or scripts of an experiment have the option --trust (common/configuration/trust.h).
#pragma once

namespace CLI
{
class App;
}

namespace swarmanoid
{

void AddTrustFlag(CLI::App& app);

}  // namespace swarmanoid
