// Cameras with colour blob extraction: the visible blobs in the field of view, for all robots of a batch. The base of
// the cameras of all robots and of the pie camera. blob_sources.h has the sources of blobs. Generic.
#pragma once

#include <memory>
#include <vector>

#include "common/control_interface/ci_colour_blob_sensor.h"
#include "controller_host/device.h"
#include "controller_host/devices/cameras/blob_sources.h"
#include "controller_host/devices/noise.h"
#include "controller_host/devices/sensing/sight_lines.h"
#include "controller_host/on_demand_sensor.h"

namespace swarmanoid
{

// The position and direction of a camera in the frame of its robot.
struct CameraModel
{
  enum class View
  {
    kDown,  // also by a mirror above: all around, below the eye
    kAhead,
    kTurned  // where AxisOf says
  };
  View view = View::kDown;
  Vector3 eye = Vector3::Zero();  // m
  double aperture = 0;            // rad, from the axis to the border of the view
  double range = 0;               // m: along the floor (kDown), along the line of sight (otherwise)
  // The view is not a cone but, as in ARGoS3, what is in a square along the axes of the space: its half side is the
  // height of the eye times the tangent of the aperture, at most `range`, whatever the height of a blob. For kDown.
  bool is_square = false;
};

class ColourCamera : public SensorBatch, public OnDemandSensor
{
public:
  void Update(const ChannelView&) override { MakeAhead(); }
  void RefreshShared(WorkerPool* pool) override;
  double Reach() const override;

protected:
  // Takes <aperture> and <range> from the parameters. What controllers hold has to Want its blobs.
  void InitCamera(const DeviceSetup& setup, CameraModel model);

  // The visible blobs of several robots, one robot after the other, in lanes. The arrays have room for more behind
  // `count`.
  struct Seen
  {
    std::size_t count = 0;
    std::vector<double> x, y, z;        // m, from the eye, in the frame of the robot
    std::vector<double> angle;          // rad, about the robot's z axis, -pi..pi
    std::vector<double> distance;       // m, in the plane of the robot's base
    std::vector<std::uint32_t> source;  // its number in Sources()

    void Reserve(std::size_t blobs);
    Vector3 Place(std::size_t i) const { return {x[i], y[i], z[i]}; }
  };
  // Called before some calls of Extract: computes more about all that were seen.
  virtual void Measure(const Seen&) {}
  // Called once for each robot, which sees the blobs from `first` to before `behind`.
  virtual void Extract(std::size_t k, const Seen& seen, std::size_t first, std::size_t behind) = 0;
  // Returns the direction of the camera of robot k in the robot's frame, for cameras that turn (kTurned).
  virtual Vector3 AxisOf(std::size_t) const { return Vector3::UnitX(); }
  const BlobSources& Sources() const { return *sources_; }

  CameraModel model_;
  const CSwarmanoidSpace* space_ = nullptr;
  std::vector<std::uint32_t> robots_;

private:
  struct View
  {
    Vector3 eye;           // m, in the space
    double half_side = 0;  // m, of a square view
    bool is_upright;
    Heading heading;          // where it is upright
    Eigen::Matrix3d to_body;  // if it is not
  };
  struct Viewed
  {
    std::size_t k, behind;  // the end of the blobs that robot k sees
  };

  void MakeDue() override;
  bool MakeAlone(std::size_t k) override;
  View ViewOf(std::uint32_t robot) const;
  void Look(std::size_t k);
  void ExtractAll();
  void LookDown(const View& view);
  void LookAnywhere(const View& view);
  void Add(std::size_t source, const View& view);
  void KeepSeen(std::size_t first);
  void KeepFreeInView(std::size_t first);
  void KeepWithinCones(std::size_t first, const Vector3& eye);
  bool IsInView(const Vector3& place) const;
  template <class IsIn>
  std::size_t KeepInView(std::span<const std::int32_t> found, const View& view, std::size_t first, const IsIn& is_in);

  std::shared_ptr<SensorWorld> world_;
  std::shared_ptr<BlobSources> sources_;
  std::unique_ptr<SightLines> lines_;
  std::vector<std::int32_t> place_of_entity_;  // k of an entity, or -1
  double tangent_ = 0;                         // of the aperture
  Vector3 axis_;                               // of the robot that looks, if it is turned
  Seen seen_;
  std::vector<Viewed> viewed_;
  std::vector<std::int32_t> found_;  // numbers of sources
};

}  // namespace swarmanoid
