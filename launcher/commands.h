// The verbs of the `swarmanoid` command. Each adds itself to the command line; when it is the one asked for, it leaves
// its exit code in `exit_code`.
#pragma once

#include "common/program/usage_error.h"
#include "roles/builtins.h"

namespace CLI
{
class App;
}

namespace swarmanoid
{

void AddRunCommand(CLI::App& app, int& exit_code);
void AddResumeCommand(CLI::App& app, int& exit_code);
void AddReplayCommand(CLI::App& app, int& exit_code);
void AddDiffCommand(CLI::App& app, int& exit_code);
void AddInspectCommand(CLI::App& app, int& exit_code);
void AddExportCommand(CLI::App& app, int& exit_code);
void AddAttachCommand(CLI::App& app, int& exit_code);
void AddControlCommand(CLI::App& app, int& exit_code);
void AddShareCommand(CLI::App& app, int& exit_code);
void AddCheckCommand(CLI::App& app, int& exit_code);
void AddEditCommand(CLI::App& app, int& exit_code);
void AddConvertCommand(CLI::App& app, int& exit_code);
void AddListCommand(CLI::App& app, int& exit_code);
void AddDemoCommand(CLI::App& app, int& exit_code);
void AddDoctorCommand(CLI::App& app, int& exit_code);
void AddNewCommand(CLI::App& app, int& exit_code);

}  // namespace swarmanoid
