// PictureExport: draws a run that has ended with a renderer that writes one file, a page or a film. `swarmanoid export`
// and `swarmanoid archive` use it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/messages/assignment.h"
#include "launcher/replay_monitor.h"
#include "visualiser/visualiser.h"

namespace swarmanoid
{

class PictureExport
{
public:
  // The run must outlive the object. `kind`: "page" or "image". `parameters`: "name=value". Throws UsageError if the
  // renderer is not part of this build, or for a wrong value.
  PictureExport(const RecordedRun& run, const std::string& kind, const std::vector<std::string>& parameters);

  // Draws the tick of the run.
  void Draw() { visualiser_.Draw(); }
  // Completes the file.
  void Finish() { visualiser_.Finish(); }

private:
  ReplayMonitor monitor_;
  Assignment assignment_;
  Visualiser visualiser_;
};

// Throws UsageError, which names the option, if the file exists.
void CheckNewFile(const std::string& option, const std::string& path);

// Returns the parameters of a film of so many ticks that lasts about ten seconds. `every`: ticks between two pictures,
// 0 for as many as make a hundred pictures.
std::vector<std::string> FilmParameters(const std::string& path, std::uint64_t ticks, std::uint64_t every,
                                        double tick_seconds);

// Writes the page of all ticks of the run. Returns false if the user interrupts it.
bool WritePageOf(const std::string& run_folder, const std::string& path);

}  // namespace swarmanoid
