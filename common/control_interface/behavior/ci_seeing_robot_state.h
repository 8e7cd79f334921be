// CCI_SeeingRobotState: the part that the robot states of all three robots share: the blobs of a camera, and a ring of
// LEDs. Getters and setters of devices that the controller does not list throw CCI_DeviceError.
#pragma once

#include <array>
#include <vector>

#include "common/control_interface/behavior/ci_robot_state.h"
#include "common/control_interface/ci_colour_blob_sensor.h"
#include "common/control_interface/ci_led_ring_actuator.h"

namespace swarmanoid
{

template <class LedsActuator>
class CCI_SeeingRobotState : public CCI_RobotState
{
public:
  static constexpr unsigned NUM_LEDS = LedsActuator::NUM_LEDS;

  // Angles are in radians counter-clockwise from the front, distances in metres.
  const std::vector<CCI_ColourBlob>& GetColourBlobs() const
  {
    RequireSensor(camera_, camera_type_);
    return blobs_;
  }
  // Returns the nearest blob of that hue, or nullptr if none is in view.
  const CCI_ColourBlob* GetNearestColourBlob(std::uint32_t colour) const
  {
    return CCI_ColourBlobSensor::FindNearest(GetColourBlobs(), colour);
  }

  // Colours are 0xRRGGBB. The getter returns the colour that was last set on this state. An index beyond the ring
  // throws std::out_of_range.
  void SetAllLedColours(std::uint32_t colour)
  {
    RequireActuator(leds_, leds_type_);
    std::array<std::uint32_t, NUM_LEDS> colours{};
    colours.fill(colour);
    colours_.Set(colours);
  }
  void SetLedColour(unsigned led, std::uint32_t colour)
  {
    RequireActuator(leds_, leds_type_);
    auto colours = colours_.Get();
    colours.at(led) = colour;
    colours_.Set(colours);
  }
  std::uint32_t GetLedColour(unsigned led) const { return colours_.Get().at(led); }

protected:
  // The arguments are the types of the two devices; both texts must outlive the state.
  CCI_SeeingRobotState(CCI_Robot* robot, const char* camera_type, const char* leds_type)
      : CCI_RobotState(robot), camera_type_(camera_type), leds_type_(leds_type)
  {
  }

  void InitCommon()
  {
    CCI_RobotState::InitCommon();
    camera_ = FindSensor<CCI_ColourBlobSensor>(camera_type_);
    leds_ = FindActuator<LedsActuator>(leds_type_);
  }
  void ReadCommonSensors()
  {
    CCI_RobotState::ReadCommonSensors();
    if (camera_ == nullptr) return;
    const auto blobs = camera_->GetAllBlobs();
    blobs_.assign(blobs.begin(), blobs.end());
  }
  void WriteCommonActuators()
  {
    CCI_RobotState::WriteCommonActuators();
    colours_.Flush(
        [this](const auto& colours)
        {
          for (unsigned led = 0; led < NUM_LEDS; ++led) leds_->SetColour(led, colours[led]);
        });
  }

private:
  const char* camera_type_;
  const char* leds_type_;
  CCI_ColourBlobSensor* camera_ = nullptr;
  LedsActuator* leds_ = nullptr;
  std::vector<CCI_ColourBlob> blobs_;
  PendingValue<std::array<std::uint32_t, NUM_LEDS>> colours_;
};

}  // namespace swarmanoid
