// Reads the links and joints of a URDF file into the frame of its root link, with all joints at zero. Only
// urdf_kind.cpp uses it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/configuration/configuration_tree.h"
#include "common/experiment/load_experiment.h"

namespace swarmanoid
{

struct UrdfShape
{
  enum class Form : std::uint8_t
  {
    kBox,       // size: lengths along x, y, z
    kCylinder,  // about z; size: radius, radius, length
    kSphere,    // size: radius, three times
    kMesh       // content of `file`; size: the scale along x, y, z. The hull of `corners` collides
  };
  Form form = Form::kBox;
  Vector3 size = Vector3::Zero();  // m
  Pose pose{};                     // in the frame of the link
  std::optional<std::uint32_t> colour{};
  std::string file{};
  std::vector<Vector3> corners{};  // m, in the frame of the shape
  SourceLocation location{};
};

struct UrdfLink
{
  std::string name{};
  double mass = 0;                           // kg
  std::optional<Eigen::Matrix3d> inertia{};  // kg m², about the centre of mass, in the frame of the link
  Vector3 centre_of_mass = Vector3::Zero();  // m, in the frame of the link
  std::vector<UrdfShape> visual{};
  std::vector<UrdfShape> collision{};
  Pose pose{};  // in the frame of the root link
  SourceLocation location{};
};

struct UrdfLimit
{
  std::optional<double> lower{}, upper{};  // rad or m
  std::optional<double> effort{};          // N m or N
  std::optional<double> velocity{};        // rad/s or m/s
  SourceLocation location{};
};

struct UrdfJoint
{
  std::string name{};
  std::string type{};
  std::string parent{};
  std::string child{};
  Pose origin{};                    // the pose of the child in the frame of the parent
  Vector3 axis = Vector3::UnitX();  // in the frame of the child
  std::optional<UrdfLimit> limit{};
  double damping = 0;   // N m s/rad or N s/m
  double friction = 0;  // N m or N
  SourceLocation location{};
};

struct UrdfLinks
{
  std::vector<UrdfLink> links{};
  std::vector<UrdfJoint> joints{};
  std::size_t root = 0;
  SourceLocation location{};  // the position of <robot>

  const UrdfLink& LinkOf(const std::string& name) const;
};

// Reads the links from the text of `file`, whose folder is the start of the paths of meshes. Mistakes go into `errors`,
// content without effect into `notes`.
UrdfLinks ReadUrdfLinks(const TConfigurationTree& robot, const std::string& file, std::vector<Diagnostic>& errors,
                        std::vector<Diagnostic>& notes);

}  // namespace swarmanoid
