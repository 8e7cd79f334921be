// Sensors whose readings are made when a controller asks for them: one that reads the camera in some of its states
// alone, or lists a device that it never reads, costs no more than it uses. Base of a SensorBatch besides.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "controller_host/split_sensor.h"

namespace swarmanoid
{

// Readings follow from the state of the space at the tick and from random numbers that are named by robot and tick, so
// it changes no bit of them when they are made, nor who else asks. What was asked for in the last two ticks is made
// ahead, by Update and all threads that there are; the rest when it is asked for.
//
// Who asks between the control steps of two ticks gets what the controller got in its step, or, if it did not ask, what
// the space says now: what others had made ahead is forgotten, so that this depends on the controller alone.
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
  // After the control steps of a tick.
  void EndSteps();

protected:
  // Of so many robots; all are made ahead in the first tick.
  void InitDemand(std::size_t robots);
  // All that Update does: makes new what the batches share, then the readings that are due.
  void MakeAhead();
  // Which are to be made by MakeDue, and whether that is all of them.
  bool IsDue(std::size_t k) const { return due_[k] != 0; }
  bool AllAreDue() const { return all_are_due_; }

private:
  // Makes the readings of all robots that are due.
  virtual void MakeDue() = 0;
  // Of one robot, when it is asked for. Whether that was done; otherwise those of all robots that have none are made:
  // for sensors that make them together.
  virtual bool MakeAlone(std::size_t) { return false; }

  // Says which are due, and whether there are any.
  bool BeginSteps();
  void Make(std::size_t k);
  void MakeRest();

  // Of what each robot has: bits.
  static constexpr std::uint8_t kAsked = 1;        // its controller asked in its step
  static constexpr std::uint8_t kThere = 2;        // readings of this tick
  static constexpr std::uint8_t kAskedBefore = 4;  // its controller asked in the step before
  static constexpr std::uint8_t kBetween = 8;      // readings that were made between control steps

  std::vector<std::uint8_t> robots_asked_;
  std::vector<std::uint8_t> due_;
  std::uint8_t there_ = 0;  // the bits, of which one says that readings need not be made now
  std::uint8_t asked_ = 0;  // those that are set when they are asked for now
  bool in_steps_ = false;
  bool all_are_due_ = false;
  std::mutex making_;  // what follows, and what MakeAlone uses
  std::atomic<bool> rest_is_there_{false};
};

}  // namespace swarmanoid
