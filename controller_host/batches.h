// The devices of a controller host: each a batch over all robots of a controller. Inside this folder alone.
#pragma once

#include <algorithm>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

#include "common/activity/shared_activity.h"
#include "common/messages/attribute_changes.h"
#include "common/threads/worker_pool.h"
#include "controller_host/controller_host.h"
#include "controller_host/device.h"
#include "controller_host/on_demand_sensor.h"

namespace swarmanoid
{

// The slice of a host's channel values that belongs to the robots of one batch.
struct ChannelSlice
{
  std::vector<std::size_t> offsets;  // of each robot within the values of the message
  int width = 0;
};

struct ControllerHost::Batches
{
  static constexpr int kWhole = -1;

  struct Sensor
  {
    std::unique_ptr<SensorBatch> batch;
    ChannelSlice slice;
    Actor actor;
    int part = kWhole;                                 // of a device that is split among threads: which of them runs it
    std::pair<std::uint32_t, std::uint32_t> number{};  // of the controller, and of its sensor
    std::vector<std::size_t> robots{};                 // places in robots_
    OnDemandSensor* on_demand = nullptr;               // the batch, if its readings are made so
  };
  struct Actuator
  {
    std::unique_ptr<ActuatorBatch> batch;
    ChannelSlice slice;
    Actor actor;
    const DeviceConfiguration* device = nullptr;
    std::vector<std::uint32_t> robots;
    std::vector<std::size_t> places{};  // in robots_
  };
  struct Failure
  {
    std::exception_ptr what;
    Actor actor;
  };

  std::vector<Sensor> sensors;
  std::vector<Actuator> actuators;
  AttributeOrder order;
  WorkerPool* pool = nullptr;               // none: one thread does it all
  bool split = false;                       // some sensor is
  std::vector<Failure> failures;            // of sensors, by thread
  std::vector<std::exception_ptr> stopped;  // what stopped the controllers of a thread
};

template <class Do>
void ControllerHost::ForEachCommand(std::uint32_t entity, Do use) const
{
  for (const ChannelBlock& block : layout_.commands)
  {
    const auto place = std::lower_bound(block.entities.begin(), block.entities.end(), entity);
    if (place == block.entities.end() || *place != entity) continue;
    const auto width = static_cast<std::size_t>(block.width);
    const std::size_t first = block.offset + static_cast<std::size_t>(place - block.entities.begin()) * width;
    use(first, first + width);
  }
}

}  // namespace swarmanoid
