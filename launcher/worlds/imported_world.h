// The content of a world file of another simulator, as `swarmanoid convert` turns it into an experiment. The readers of
// the formats (sdf_world.h, webots_world.h, floor_plan.h) fill it. One thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/configuration/configuration_tree.h"
#include "common/experiment/load_experiment.h"
#include "common/math/pose.h"

namespace swarmanoid
{

struct WorldBody
{
  enum class Form
  {
    kBox,
    kCylinder,
    kMesh
  };

  std::string name;  // any text; the experiment gets an id that is made from it
  SourceLocation location;
  Form form = Form::kBox;
  Pose pose;  // of the centre, x and y in the frame of the file
  Vector3 size =
      Vector3::Zero();  // m: edges of a box or of the box around a mesh; radius, radius, height of a cylinder
  std::string mesh;     // the path of its file
  bool movable = false;
  double mass_kg = 0;        // 0: unknown
  double density_kg_m3 = 0;  // of a mesh without a mass; 0: unknown
  std::optional<std::uint32_t> colour;
  std::optional<double> friction;
  std::optional<double> restitution;
};

struct WorldLight
{
  std::string name;
  SourceLocation location;
  Vector3 position = Vector3::Zero();
  double intensity = 1;
  std::uint32_t colour = 0xffffff;
};

struct World
{
  std::vector<WorldBody> bodies;
  std::vector<WorldLight> lights;
  Vector3 gravity = Vector3(0, 0, -9.81);  // m/s²
  std::vector<Diagnostic> mistakes;        // values that cannot be read; then no experiment is written
  std::vector<Diagnostic> notes;           // parts that the experiment leaves out or changes

  // Adds a body of a mesh file, scaled along its axes, at the pose of the file's origin. Adds a note instead if the
  // file cannot be read or has no volume.
  void AddMesh(WorldBody body, const std::string& path, const Vector3& scale, const Pose& origin);
};

// The mesh files of an experiment are named from the folder of its file.
struct WorldOutput
{
  std::string folder;  // of the experiment's file, absolute
  std::string source;  // the name of the world file, for the comment at the start
};

// Returns the comment at the start of an experiment that is made from a file. `about` says how, without two hyphens.
std::string ConvertedComment(const std::string& source, const std::string& about);

// Returns the text of an experiment with the bodies and lights of a world, in the engine dynamics3d. The arena begins
// at 0, 0, so whole metres are added to x and y. Bodies whose position is below the floor z = 0 become notes.
std::string ExperimentOfWorld(World& world, const WorldOutput& output);

}  // namespace swarmanoid
