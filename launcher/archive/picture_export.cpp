#include "launcher/archive/picture_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "common/configuration/output_file.h"
#include "common/program/interrupts.h"
#include "common/program/usage_error.h"
#include "launcher/supervision/progress_display.h"
#include "simulation/register_all.h"
#include "visualiser/renderer_options.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint64_t kPicturesOfFilm = 100;
constexpr double kPicturesPerSecond = 10;

RenderConfiguration ConfigurationOf(const std::string& kind, const std::vector<std::string>& parameters)
{
  RegisterBuiltins();
  LetUserNameFiles();
  try
  {
    return ConfigureRenderer(FindRenderer(kind), parameters);
  }
  catch (const ConfigurationError& error)
  {
    throw UsageError(error.what());
  }
}

}  // namespace

PictureExport::PictureExport(const RecordedRun& run, const std::string& kind,
                             const std::vector<std::string>& parameters)
    : monitor_(run),
      assignment_(MakeAssignment(run.GetExperiment(), 1)),
      visualiser_(ConfigurationOf(kind, parameters), run.Space(), assignment_, ".", nullptr, &monitor_)
{
}

void CheckNewFile(const std::string& option, const std::string& path)
{
  if (path == "-") throw UsageError(option + ": name a file; only --csv and --mcap write to standard output");
  if (std::filesystem::exists(path))
    throw UsageError(fmt::format("{}: the file '{}' is there already; name another one", option, path));
}

std::vector<std::string> FilmParameters(const std::string& path, std::uint64_t ticks, std::uint64_t every,
                                        double tick_seconds)
{
  if (every == 0) every = std::max<std::uint64_t>(1, (ticks + kPicturesOfFilm - 1) / kPicturesOfFilm);
  const double speed = static_cast<double>(every) * tick_seconds * kPicturesPerSecond;
  return {"video=" + path, fmt::format("every={}", every), fmt::format("speed={}", speed), "size=640,480",
          "use_shadows=false"};
}

bool WritePageOf(const std::string& run_folder, const std::string& path)
{
  RecordedRun run(run_folder);
  PictureExport page(run, "page", {"file=" + path});
  WorkProgress progress("writing the page", run.LastTick() + 1 - run.FirstTick());
  while (!Interrupted() && run.Next())
  {
    progress.At(run.Space().GetTick() - run.FirstTick());
    page.Draw();
  }
  if (Interrupted()) return false;
  page.Finish();
  return true;
}

}  // namespace swarmanoid
