// The perspective camera of foot-bots and Spiris, which looks ahead, and of eye-bots, which looks down. The image of
// 640 by 480 pixels with its edges at the aperture is that of perspective_camera_equipped_entity.h of ARGoS3.
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_perspective_camera_sensor.h>

#include "argos3/plugin/device_parts.h"
#include "common/control_interface/ci_colour_blob_sensor.h"
#include "common/math/elementary.h"

namespace swarmanoid::argos3
{
namespace
{

constexpr double kColumns = 640;
constexpr double kRows = 480;

// The camera is off until it is enabled, as in ARGoS3.
class PerspectiveCamera : public SensorBridge, public argos::CCI_ColoredBlobPerspectiveCameraSensor
{
public:
  PerspectiveCamera(const DeviceSetup& setup, const CCI_ColourBlobSensor& ours, bool looks_down)
      : ours_(ours), looks_down_(looks_down)
  {
    const double aperture = DegreesToRadians(setup.options.GetNumber("camera_aperture", 30));
    const double aspect = kColumns / kRows;
    height_ = 2 * Sin(aperture) / Cos(aperture) / __builtin_sqrt(1 + aspect * aspect);
    Disable();
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void BeforeStep() override
  {
    m_sReadings.BlobList.clear();
    if (IsDisabled()) return;
    ++m_sReadings.Counter;
    OnDemand();
  }
  void Update() override
  {
    const auto blobs = ours_.GetAllBlobs();
    if (blobs_.size() < blobs.size()) blobs_.resize(blobs.size());
    for (std::size_t i = 0; i < blobs.size(); ++i)
      if (Draw(blobs[i], blobs_[i])) m_sReadings.BlobList.push_back(&blobs_[i]);
  }

private:
  // Returns false for a point outside the image.
  bool Draw(const CCI_ColourBlob& ours, SBlob& theirs) const
  {
    // The frame is that of the robot: x ahead, y to the left, z up.
    const SinCos angle = SinCosOf(ours.angle_rad);
    const SinCos elevation = SinCosOf(ours.elevation_rad);
    const Vector3 at(elevation.cos * angle.cos, elevation.cos * angle.sin, elevation.sin);
    const double along = looks_down_ ? -at.z() : at.x();
    const double up = looks_down_ ? at.x() : at.z();
    if (along <= 0) return false;
    const double pixels = kRows / height_;
    const double column = kColumns / 2 - pixels * at.y() / along;
    const double row = kRows / 2 - pixels * up / along;
    if (column <= -1 || column >= kColumns || row <= -1 || row >= kRows) return false;
    theirs = {argos::CColor(0xff000000U | ours.colour), static_cast<SInt32>(column), static_cast<SInt32>(row)};
    return true;
  }

  const CCI_ColourBlobSensor& ours_;
  const bool looks_down_;
  double height_ = 0;  // height of the image at a distance of 1
  std::vector<SBlob> blobs_;
};

}  // namespace

std::unique_ptr<SensorBridge> MakePerspectiveCamera(const DeviceSetup& setup)
{
  const bool looks_down = setup.robot.GetKind() == "eyebot";
  const char* type = looks_down ? "eyebot_pan_tilt_camera" : "footbot_perspective_camera";
  return std::make_unique<PerspectiveCamera>(setup, setup.robot.Sensor<CCI_ColourBlobSensor>(type), looks_down);
}

}  // namespace swarmanoid::argos3
