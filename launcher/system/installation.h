// The positions of Swarmanoid's parts on this machine, found from the path of the running program.
#pragma once

#include <string>
#include <vector>

namespace swarmanoid
{

// Returns the path of this program.
std::string OwnProgram();
// Returns the folder of the programs. SWARMANOID_PROGRAM_DIR in the environment names another one.
std::string ProgramFolder();
// Returns the folder of what users copy: templates and samples.
std::string UserFilesFolder();
// Return the names of the sample experiments in order, and the file of one.
std::vector<std::string> SampleNames();
std::string SampleFile(const std::string& name);

}  // namespace swarmanoid
