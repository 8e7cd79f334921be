// `swarmanoid convert`: an experiment of ARGoS3, a world of Gazebo or Webots, or a floor plan as one of our
// experiments.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "argos3/converter/convert.h"
#include "common/configuration/regular_file.h"
#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "common/configuration/xml_writer.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/experiment/foreign_experiments.h"
#include "launcher/argos3_dry_run.h"
#include "launcher/command/sub_command.h"
#include "launcher/worlds/floor_plan.h"
#include "launcher/worlds/ros_map.h"
#include "launcher/worlds/sdf_world.h"
#include "launcher/worlds/webots_file.h"
#include "launcher/worlds/webots_world.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

struct ConvertRequest
{
  std::string file;
  std::string output;
  FloorPlanOptions plan;
  bool has_threshold = false;  // by the option
};

// Prints each mistake once.
int RefuseFor(const std::vector<Diagnostic>& mistakes)
{
  std::set<std::string> printed;
  for (const Diagnostic& mistake : mistakes)
    if (printed.insert(mistake.Text()).second) PrintError("{}\n", mistake.Text());
  return kExitInvalidFile;
}

int Write(const ConvertRequest& request, const std::string& text)
{
  if (request.output.empty())
  {
    fmt::print("{}", text);
    return kExitDone;
  }
  std::ofstream stream(request.output);
  if (!(stream << text).flush())
    throw UsageError("--output: the file '" + request.output + "' cannot be written: " + std::strerror(errno));
  return kExitDone;
}

int WriteWorld(const ConvertRequest& request, World world)
{
  if (!world.mistakes.empty())
  {
    PrintNotes(world.notes);
    return RefuseFor(world.mistakes);
  }
  const fs::path output = request.output.empty() ? fs::current_path() / "-" : fs::absolute(request.output);
  const std::string text =
      ExperimentOfWorld(world, {output.parent_path().lexically_normal().string(), fs::path(request.file).filename()});
  PrintNotes(world.notes);
  const auto counted = [](std::size_t count, const char* one, const char* many)
  { return fmt::format("{} {}", count, count == 1 ? one : many); };
  PrintError("{}: {}, {}\n", request.file, counted(world.bodies.size(), "body", "bodies"),
             counted(world.lights.size(), "light", "lights"));
  return Write(request, text);
}

int WritePlan(const ConvertRequest& request, const std::string& picture_file, const FloorPlanOptions& options,
              bool is_negated = false)
{
  if (!(options.resolution_m > 0))
    throw UsageError("--resolution: a floor plan needs the edge of its pixels in metres, such as --resolution 0.05");
  FloorPlan plan;
  try
  {
    GreyPicture picture = ReadPlanPicture(picture_file);
    if (is_negated)
      for (double& grey : picture.values) grey = 1 - grey;
    plan = PlanFromPicture(picture, options, fs::path(request.file).filename());
  }
  catch (const std::runtime_error& mistake)
  {
    PrintError("{}\n", mistake.what());
    return kExitInvalidFile;
  }
  PrintError("{}: {} x {} pixels, {:g} x {:g} m, {} walls\n", request.file, plan.columns, plan.rows,
             plan.columns * options.resolution_m, plan.rows * options.resolution_m, plan.walls);
  return Write(request, plan.experiment);
}

// The options of the command, if they are given, replace the values of the map.
int WriteMap(const ConvertRequest& request)
{
  const RosMap map = ReadRosMap(ReadTextFile(request.file), request.file);
  FloorPlanOptions options = request.plan;
  if (!(options.resolution_m > 0)) options.resolution_m = map.resolution_m;
  if (!request.has_threshold) options.threshold = 1 - map.occupied_threshold;
  options.remark =
      fmt::format(" The point 0, 0 is at {:g}, {:g} in the frame of the map.", map.origin.x(), map.origin.y());
  if (map.origin.z() != 0)
    PrintError("{}: note: the yaw of the origin, {:g} rad, is left out: rows of the picture are along x\n",
               request.file, map.origin.z());
  return WritePlan(request, fs::path(request.file).parent_path() / map.image, options, map.is_negated);
}

int WriteArgos3(const ConvertRequest& request, const ConfigurationNode& root)
{
  const ConvertedExperiment converted =
      ConvertArgos3(root, fs::absolute(request.file).parent_path().string(), RehearseArgos3);
  PrintNotes(converted.notes);
  if (!converted.mistakes.empty()) return RefuseFor(converted.mistakes);
  return Write(request, WriteXml(*converted.root));
}

// Returns whether a file begins as a picture does. A file that cannot be read is reported by the caller's next step.
bool IsPictureFile(const std::string& path)
{
  if (!FileMistake(path).empty()) return false;
  const std::vector<char> start = RegularFile(path).Read(0, 16);
  return IsPicture({start.data(), start.size()});
}

int Convert(const ConvertRequest& request)
{
  std::error_code none;
  if (!request.output.empty() && fs::equivalent(request.file, request.output, none))
    throw UsageError("--output: it is the file to convert; choose another name");
  try
  {
    if (IsPictureFile(request.file)) return WritePlan(request, request.file, request.plan);
    if (IsRosMapFile(request.file)) return WriteMap(request);
    if (request.plan.resolution_m > 0)
      throw UsageError(fmt::format("--resolution: {} is no PNG, JPEG, PGM or map of ROS", Quoted(request.file)));
    const std::string text = ReadTextFile(request.file);
    if (IsWebotsFile(text)) return WriteWorld(request, ReadWebotsWorld(text, request.file));
    const auto root = ReadExperimentXml(text, request.file);
    if (root->name == "sdf") return WriteWorld(request, ReadSdfWorld(*root, request.file));
    if (root->name == "argos-configuration") return WriteArgos3(request, *root);
    throw ConfigurationError(root->location, fmt::format("the root element is <{}>; that of ARGoS3 is "
                                                         "<argos-configuration>, that of SDF is <sdf>",
                                                         root->name));
  }
  catch (const ConfigurationError& mistake)
  {
    PrintError("{}\n", mistake.what());
    return kExitInvalidFile;
  }
}

void AddConvertCommand(CLI::App& app, int& exit_code)
{
  auto request = std::make_shared<ConvertRequest>();
  CLI::App* verb =
      app.add_subcommand("convert", "Write an experiment of ARGoS3, a world or a floor plan as one of ours");
  verb->add_option("FILE", request->file,
                   "An experiment of ARGoS3, a world of Gazebo (SDF) or Webots (.wbt), or a floor plan (PNG, JPEG, "
                   "PGM, map of ROS "
                   "in YAML)")
      ->required();
  verb->add_option("--output", request->output, "The file to write; without it the standard output")->type_name("FILE");
  FloorPlanOptions& plan = request->plan;
  verb->add_option("--resolution", plan.resolution_m, "Of a floor plan: the edge of a pixel in metres")
      ->type_name("METRES")
      ->check(CLI::Range(1e-6, 1e3).description(""));
  CLI::Option* threshold = verb->add_option("--threshold", plan.threshold,
                                            "Of a floor plan: darker pixels are walls, from 0 (black) to 1 (white)")
                               ->type_name("GREY")
                               ->check(CLI::Range(0.0, 1.0).description(""))
                               ->capture_default_str();
  verb->add_option("--height", plan.height_m, "Of a floor plan: the height of its walls in metres")
      ->type_name("METRES")
      ->check(CLI::Range(1e-3, 1e3).description(""))
      ->capture_default_str();
  verb->footer(
      "`swarmanoid run` and `check` read experiments of ARGoS3 directly; what is written here is to be changed and "
      "kept.\n"
      "Parts of a world that have no counterpart are left out, and named on standard error with file and line.\n"
      "Exit codes: 0 written; 3 the file cannot be read, or something in an experiment of ARGoS3 has no counterpart.\n"
      "Examples:\n"
      "  swarmanoid convert experiments/foraging.argos --output foraging.xml\n"
      "  swarmanoid convert warehouse.sdf --output warehouse.xml\n"
      "  swarmanoid convert maze.wbt --output maze.xml\n"
      "  swarmanoid convert office.png --resolution 0.05 --output office.xml\n"
      "  swarmanoid convert office.yaml --output office.xml");
  verb->callback(
      [request, threshold, &exit_code]
      {
        request->has_threshold = threshold->count() > 0;
        exit_code = Convert(*request);
      });
}

const RegisterSubCommand kConvert(14, "convert", AddConvertCommand);

}  // namespace
}  // namespace swarmanoid
