// The verbs of the `swarmanoid` command that are about studies. Each adds itself as those of launcher/commands.h.
#pragma once

namespace CLI
{
class App;
}

namespace swarmanoid
{

void AddSweepCommand(CLI::App& app, int& exit_code);
void AddPlotCommand(CLI::App& app, int& exit_code);

}  // namespace swarmanoid
