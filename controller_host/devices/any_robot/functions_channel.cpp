// The robot's end of the channel to the experiment functions: messages are attributes of the robot, so they travel with
// the state, and its hash and checkpoints have them.
#include <stdexcept>
#include <string>
#include <utility>

#include "common/control_interface/ci_functions_channel.h"
#include "common/space/packet_attribute.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

static_assert(kMaxMessageBytes == kMostPacketBytes);

class Report : public CCI_ReportActuator
{
public:
  explicit Report(double* values) : values_(values) {}
  void ReportBytes(std::span<const std::uint8_t> bytes) override
  {
    if (bytes.size() > kMaxMessageBytes)
      throw std::length_error("a report of " + std::to_string(bytes.size()) + " bytes; it has at most " +
                              std::to_string(kMaxMessageBytes));
    PackPacket(AttributePacket(bytes), values_ + 1);
    is_told_ = true;
  }
  // Counts the report of a step, whatever it was overwritten with.
  void Count()
  {
    if (is_told_) values_[0] += 1;
    was_told_ = std::exchange(is_told_, false);
  }
  void Forget() { is_told_ = false; }

private:
  void ReadSettings(std::vector<double>& values) const override
  {
    const AttributePacket packet = UnpackedPacket(values_ + 1);
    values.insert(values.end(), {was_told_ ? 1.0 : 0.0, static_cast<double>(packet.length)});
    values.insert(values.end(), packet.bytes.begin(), packet.bytes.end());
  }

  double* values_;
  bool is_told_ = false;   // in this step
  bool was_told_ = false;  // in the one before
};

class ReportBatch : public ActuatorsOf<AttributeActuator, Report>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Bind(setup, {"report"});
    MakeDevices();
  }
  void Commit(const ChannelView& channel, AttributeChanges& changes) override
  {
    for (Report& report : devices_) report.Count();
    AttributeActuator::Commit(channel, changes);
  }
  void LoadState(std::size_t k, ByteReader& state) override
  {
    AttributeActuator::LoadState(k, state);
    devices_[k].Forget();
  }
};

class Instruction : public CCI_InstructionSensor
{
public:
  explicit Instruction(const double* values) : values_(values) {}
  bool IsNew() const override { return is_new_; }
  std::span<const std::uint8_t> GetBytes() const override { return packet_.Bytes(); }

  void Update(double& seen)
  {
    is_new_ = values_[0] != seen;
    seen = values_[0];
    packet_ = UnpackedPacket(values_ + 1);
  }

private:
  const double* values_;
  bool is_new_ = false;
  AttributePacket packet_;
};

class InstructionBatch : public SensorsOf<AttributeSensor, Instruction>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Bind(setup, {"instruction"});
    seen_.assign(robots_.size(), 0);
    MakeDevices();
  }
  void Update(const ChannelView& channel) override
  {
    AttributeSensor::Update(channel);
    for (std::size_t k = 0; k < robots_.size(); ++k) devices_[k].Update(seen_[k]);
  }
  void SaveState(std::size_t k, ByteWriter& state) const override { state.Put(seen_[k]); }
  void LoadState(std::size_t k, ByteReader& state) override { seen_[k] = state.Get<double>(); }

private:
  std::vector<double> seen_;  // by robot: how many instructions it has had
};

}  // namespace

const DeviceCode kFunctionsChannelCode(
    []
    {
      BindActuator<ReportBatch>("report", "generic_report");
      BindSensor<InstructionBatch>("instruction", "generic_instruction");
    });

}  // namespace swarmanoid
