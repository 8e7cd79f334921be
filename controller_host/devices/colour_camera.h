// Cameras with colour blob extraction: which blobs are in the field of view and not hidden, for all robots of a batch.
// The base of the cameras of all robots and of the pie camera; see blob_sources.h for what they see. Generic.
#pragma once

#include <memory>
#include <vector>

#include "common/control_interface/ci_colour_blob_sensor.h"
#include "controller_host/device.h"
#include "controller_host/devices/blob_sources.h"
#include "controller_host/devices/noise.h"
#include "controller_host/devices/sight_lines.h"

namespace swarmanoid
{

// Where a camera sits and looks, in the frame of its robot.
struct CameraModel
{
  enum class View
  {
    kDown,  // also by a mirror above: all around, below the eye
    kAhead
  };
  View view = View::kDown;
  Vector3 eye = Vector3::Zero();  // m
  double aperture = 0;            // rad, from the axis to the border of the view
  double range = 0;               // m: along the floor (kDown), along the line of sight (kAhead)
};

class ColourCamera : public SensorBatch
{
public:
  void Update(const ChannelView& channel) override;

protected:
  // <aperture> and <range> with these defaults.
  static std::vector<ParameterSpec> ViewParameters(const char* aperture_degrees, const char* range_m);
  void InitCamera(const DeviceSetup& setup, CameraModel model);

  // A blob in view at `place`, in the frame of the robot, relative to the eye.
  struct Seen
  {
    Vector3 place;
    std::uint32_t colour;
    double angle;  // rad, of the place about the robot's z axis, -pi..pi
    std::uint32_t owner;
    Vector3 offset;  // m, of the place along the axes of the space
  };
  // Called once for each robot: what it sees.
  virtual void Extract(std::size_t k, std::span<const Seen> blobs) = 0;

  CameraModel model_;
  const CSwarmanoidSpace* space_ = nullptr;
  std::vector<std::uint32_t> robots_;
  std::uint32_t stream_ = 0;

private:
  struct View
  {
    Vector3 eye;  // m, in the space
    Eigen::Matrix3d to_body;
    Heading heading;  // where it is upright
    bool is_upright;
  };

  void Look(std::size_t k);
  void LookDown(std::uint32_t robot, const View& view, double reach);
  void LookAnywhere(const View& view);
  void Add(const BlobSource& source, const View& view);
  bool IsInView(const Vector3& place) const;

  std::shared_ptr<SensorWorld> world_;
  std::shared_ptr<BlobSources> sources_;
  std::unique_ptr<SightLines> lines_;
  std::vector<std::int32_t> place_of_entity_;  // k of an entity, or -1
  double tangent_ = 0;                         // of the aperture
  std::vector<Seen> seen_;
  std::size_t count_ = 0;              // of those seen
  std::vector<std::int32_t> found_;    // numbers of sources
  std::vector<double> x_, y_, angle_;  // of those seen
};

}  // namespace swarmanoid
