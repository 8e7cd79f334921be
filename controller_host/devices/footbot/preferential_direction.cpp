// The preferential direction of the footbot: it lights the LEDs of the ring nearest to a direction. The ring turns with
// the turret, so each tick selects the lit LEDs again. Generic.
#include "common/control_interface/ci_robot.h"
#include "common/control_interface/footbot/ci_footbot_preferential_direction_actuator.h"
#include "common/math/elementary.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

constexpr unsigned kLeds = 12;
constexpr double kFirstLed = kPi / 12;  // angle of LED 0 against the turret's front
constexpr double kSpacing = kPi / 6;

class Direction : public CCI_FootBotPreferentialDirectionActuator
{
public:
  void SetDirection(double angle, std::uint32_t colour) override
  {
    if (angle - angle != 0)
      throw CCI_DeviceError("footbot_preferential_direction was told the direction " + std::to_string(angle) +
                            "; it must be a finite number");
    angle_ = WrapAngle(angle);
    colour_ = colour & 0xffffff;
  }
  void HideDirection() override { colour_ = 0; }

  double angle_ = 0;
  double colour_ = 0;  // 0: no direction

protected:
  void ReadSettings(std::vector<double>& values) const override
  {
    values.insert(values.end(), {colour_ != 0 ? 1.0 : 0.0, angle_, colour_});
  }
};

class DirectionActuator : public AttributeActuator
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Bind(setup, {"led"});
    half_width_ = DegreesToRadians(setup.parameters.Number("width")) / 2;
    direction_noise_ = NoiseFrom(setup.parameters);
    directions_.resize(setup.robots.size());
    turret_slots_.clear();
    for (const std::uint32_t robot : setup.robots)
      turret_slots_.push_back(setup.space.GetEntity(robot).SlotOf("turret_angle"));
  }
  Direction* Actuator(std::size_t k) override { return &directions_[k]; }

  void Commit(const ChannelView& channel, AttributeChanges& changes) override
  {
    for (std::size_t k = 0; k < directions_.size(); ++k) Light(k);
    AttributeActuator::Commit(channel, changes);
  }

  void Expose(std::size_t k, ExposedValues& values) override
  {
    values.Add(directions_[k].colour_);
    values.Add(directions_[k].angle_);
  }
  void SaveState(std::size_t k, ByteWriter& state) const override
  {
    state.Put(directions_[k].angle_);
    state.Put(static_cast<std::uint32_t>(directions_[k].colour_));
  }
  void LoadState(std::size_t k, ByteReader& state) override
  {
    directions_[k].angle_ = state.Get<double>();
    directions_[k].colour_ = state.Get<std::uint32_t>();
  }

private:
  void Light(std::size_t k)
  {
    const Direction& direction = directions_[k];
    double on_ring = direction.angle_ - space_->Attributes()[turret_slots_[k]] - kFirstLed;
    if (direction_noise_.IsActive())
    {
      RandomStream random = streams_.Of(k);
      on_ring += direction_noise_.Sample(random);
    }
    double nearest = kPi;
    for (unsigned led = 0; led < kLeds; ++led) nearest = std::min(nearest, Away(on_ring, led));
    for (unsigned led = 0; led < kLeds; ++led)
    {
      const double away = Away(on_ring, led);
      ValuesOf(k)[led] = away <= half_width_ + 1e-9 || away <= nearest ? direction.colour_ : 0;
    }
  }
  static double Away(double on_ring, unsigned led) { return __builtin_fabs(WrapAngle(on_ring - led * kSpacing)); }

  double half_width_ = 0;
  NoiseModel direction_noise_;
  std::vector<Direction> directions_;
  std::vector<std::uint32_t> turret_slots_;
};

}  // namespace

const DeviceCode kPreferentialDirectionCode(
    [] { BindActuator<DirectionActuator>("footbot_preferential_direction", "led_ring_preferential_direction"); });

}  // namespace swarmanoid
