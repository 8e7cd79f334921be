// OnDemandSensor: a sensor whose readings are computed when a controller asks for them. A controller that reads a
// camera only in some states, or never, pays only for its use. It is a second base class of a SensorBatch.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "controller_host/split_sensor.h"

namespace swarmanoid
{

// Readings follow from the state of the space at the tick and from random numbers named by robot and tick. So the time
// and the order of their computation change no bit. Update computes the readings that were used in the last two ticks,
// in all threads. Others are computed on request.
//
// A request between the control steps of two ticks gets the readings of the robot's step. If the controller did not ask
// in its step, it gets readings of the present space. Readings that were computed ahead are dropped, so that the result
// depends on the controller alone.
class OnDemandSensor : public SplitSensor
{
public:
  // To be called by what a controller holds of robot k, before it hands out readings. Control steps of different robots
  // may ask at the same time, and threads of one controller.
  void Want(std::size_t k)
  {
    const std::atomic_ref robot(robots_asked_[k]);
    const std::uint8_t bits = robot.load(std::memory_order_acquire);
    if ((bits & there_) == 0) [[unlikely]]
      return Make(k);
    robot.store(static_cast<std::uint8_t>(bits | asked_), std::memory_order_relaxed);
  }
  // Must be called after the control steps of a tick.
  void EndSteps();

protected:
  // Prepares for `robots` robots. All readings are computed ahead in the first tick.
  void InitDemand(std::size_t robots);
  // Does the work of Update: refreshes the data that batches share, then computes the readings that are due.
  void MakeAhead();
  // Return whether MakeDue must compute the readings of robot k, and whether it must compute all.
  bool IsDue(std::size_t k) const { return due_[k] != 0; }
  bool AllAreDue() const { return all_are_due_; }

private:
  // Makes the readings of all robots that are due.
  virtual void MakeDue() = 0;
  // Computes the readings of one robot on request and returns true. If it returns false, the readings of all robots
  // without readings are computed together.
  virtual bool MakeAlone(std::size_t) { return false; }

  // Says which are due, and whether there are any.
  bool BeginSteps();
  void Make(std::size_t k);
  void MakeRest();

  // The bits of a robot's state.
  static constexpr std::uint8_t kAsked = 1;        // its controller asked in its step
  static constexpr std::uint8_t kThere = 2;        // readings of this tick
  static constexpr std::uint8_t kAskedBefore = 4;  // its controller asked in the step before
  static constexpr std::uint8_t kBetween = 8;      // readings that were made between control steps

  std::vector<std::uint8_t> robots_asked_;
  std::vector<std::uint8_t> due_;
  std::uint8_t there_ = 0;  // the bits, of which one says that readings need not be made now
  std::uint8_t asked_ = 0;  // the bits to set when readings are requested now
  bool in_steps_ = false;
  bool all_are_due_ = false;
  std::mutex making_;  // guards the members below and those that MakeAlone uses
  std::atomic<bool> rest_is_there_{false};
};

}  // namespace swarmanoid
