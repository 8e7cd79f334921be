// A compass: how it is simulated. Generic: the space knows the heading; no engine is asked.
#include "devices/compass/footbot_compass.h"

#include "common/math/elementary.h"
#include "controller_host/devices/value_devices.h"

using namespace swarmanoid;

// What the controller of one robot holds: a view of that robot's number.
class Compass : public CCI_FootBotCompassSensor
{
public:
  explicit Compass(const double* heading) : heading_(heading) {}
  double GetHeading() const override { return WrapAngle(*heading_); }

private:
  const double* heading_;
};

// The compasses of all robots of a host, one number each.
class CCompassSensor : public SensorsOf<ValueSensor, Compass>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Reset(setup, 1);
    noise_ = NoiseFrom(setup.parameters);
    declination_ = DegreesToRadians(setup.parameters.Number("declination"));
    MakeDevices();
  }
  void Update(const ChannelView&) override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
      *ValuesOf(k) = YawOf(space_->GetPose(robots_[k]).orientation) + declination_;
    AddNoise();
  }

  static PluginDescription Description()
  {
    PluginDescription compass;
    compass.label = "footbot_compass";
    compass.implementation = "pose_footbot_compass";
    compass.brief = "the heading in the arena";
    compass.robots = {"footbot"};
    compass.parameters = Joined({{.name = "declination",
                                  .unit = "degrees",
                                  .default_value = "0",
                                  .description = "Added to the heading: north is elsewhere."}},
                                NoiseParameters("the heading", "rad"));
    return compass;
  }

private:
  double declination_ = 0;  // rad
};

REGISTER_SENSOR(CCompassSensor, CCompassSensor::Description())
