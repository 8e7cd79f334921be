// CCI_BatchController: a controller whose control steps are made by one call for many robots, with readings and
// commands as tables. It is faster than a call for each robot if a step is short. Robots that the simulator calls one
// by one (real robots, robots with on_failure or time_budget_ms) step by the same code, with the same results.
//
//   void ControlSteps(CCI_Batch& robots) override
//   {
//     const CCI_Readings proximity = robots.Readings("footbot_proximity");
//     const CCI_Commands wheels = robots.Commands("footbot_wheels");
//     for (std::size_t k = 0; k < robots.Size(); ++k)
//     {
//       wheels[k][0] = 5;                                   // rad/s
//       wheels[k][1] = proximity[k][0] > 0.1 ? -5 : 5;
//     }
//   }
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/control_interface/ci_controller.h"

namespace swarmanoid
{

// The readings of a sensor of all robots of a batch: a row for each robot, with the columns of the sensor in the order
// and the units of `swarmanoid list plugins`. Valid until ControlSteps returns.
class CCI_Readings
{
public:
  CCI_Readings(std::span<const double* const> rows, std::size_t columns) : rows_(rows.data()), columns_(columns) {}

  std::size_t Columns() const { return columns_; }
  // Returns the row of robot k, which need not follow that of robot k - 1 in memory.
  std::span<const double> operator[](std::size_t k) const { return {rows_[k], columns_}; }

private:
  const double* const* rows_;
  std::size_t columns_;
};

// The commands for an actuator of all robots of a batch: a row for each robot, with all columns of the actuator. The
// actuators get them when ControlSteps returns. An actuator keeps its settings if no number of its row is written.
// Otherwise all numbers of the row must be written, and finite. Numbers outside a range are clamped to it.
class CCI_Commands
{
public:
  CCI_Commands(std::span<double> table, std::size_t columns) : table_(table.data()), columns_(columns) {}

  std::size_t Columns() const { return columns_; }
  std::span<double> operator[](std::size_t k) const { return {table_ + k * columns_, columns_}; }

private:
  double* table_;
  std::size_t columns_;
};

// The robots whose control steps are made together, in the order of the space. All have the same controller class,
// parameters and devices.
class CCI_Batch
{
public:
  CCI_Batch() = default;
  CCI_Batch(CCI_Batch&&) = default;
  CCI_Batch& operator=(CCI_Batch&&) = default;

  std::size_t Size() const { return controllers_.size(); }
  CCI_Robot& Robot(std::size_t k) const { return *controllers_[k]->GetRobot(); }
  // Returns the controller of robot k, which keeps what the robot must remember. `Controller` is the class of all
  // controllers of the batch.
  template <class Controller>
  Controller& Of(std::size_t k) const
  {
    return static_cast<Controller&>(*controllers_[k]);
  }

  // Return the table of a device by its type label ("footbot_wheels"). Each call of a step returns the same table.
  // Throw CCI_DeviceError if the robots do not have the device, if it has no columns at every tick, or if robots of
  // different kinds have different numbers of columns.
  CCI_Readings Readings(std::string_view sensor);
  CCI_Commands Commands(std::string_view actuator);

  // The functions below are for the runtime. A step is Clear, Add for each robot, Begin, the control steps, and
  // SetCommands. Tables keep their memory while the same controllers are added.
  void Clear() { next_ = 0; }
  void Add(CCI_Controller& controller)
  {
    if (next_ < controllers_.size() && controllers_[next_] == &controller)
      ++next_;
    else
      Replace(controller);
  }
  void Begin();
  void SetCommands();
  std::span<CCI_Controller* const> Controllers() const { return controllers_; }
  // Returns the robot whose device failed in this step, or 0.
  std::size_t FailedRobot() const { return failed_; }

private:
  struct Sensors
  {
    std::string type;
    std::size_t columns = 0;
    const CCI_ColumnGroup* in_place = nullptr;  // the columns, if the devices keep them as spans
    std::vector<const CCI_Device*> devices{};
    std::vector<const double*> rows{};
    std::vector<double> copies{};  // of readings that are not kept in place
    bool is_read = false;          // in this step
  };
  struct Actuators
  {
    std::string type;
    std::size_t columns = 0;
    std::vector<CCI_Device*> devices{};
    std::vector<double> table{};
    bool is_used = false;  // in this step
  };

  void Replace(CCI_Controller& controller);
  template <class Table, class Find>
  void Fill(Table& table, const char* what, const Find& find);
  Sensors& SensorsOf(std::string_view type);
  Actuators& ActuatorsOf(std::string_view type);
  void Read(Sensors& sensors);
  void CopyRows(Sensors& sensors);
  [[noreturn]] void RefuseColumns(const char* what, const std::string& type, std::size_t first, std::size_t columns,
                                  std::size_t k);
  [[noreturn]] void RefuseReadings(const Sensors& sensors, std::size_t k);
  [[noreturn]] void RefuseCommands(const Actuators& actuators, std::size_t k, std::span<const double> row);

  std::vector<CCI_Controller*> controllers_;
  std::size_t next_ = 0;    // controllers that were added since Clear
  std::size_t failed_ = 0;  // in this step
  std::vector<Sensors> sensors_;
  std::vector<Actuators> actuators_;
};

class CCI_BatchController : public CCI_Controller
{
public:
  // Makes the control steps of some robots of one entry of <controllers>, called on the controller of the first one.
  // The result of a robot must not depend on the other robots of the call, since a cluster and threads divide them.
  // Robots outside the arena, switched off or stopped are not in the call. If StepsInParallel returns true, threads may
  // make calls for different robots at the same time.
  virtual void ControlSteps(CCI_Batch& robots) = 0;

  // Makes the step of this robot alone.
  void ControlStep() final;

private:
  std::unique_ptr<CCI_Batch> alone_;  // made by the first ControlStep
};

}  // namespace swarmanoid

using swarmanoid::CCI_Batch;
using swarmanoid::CCI_BatchController;
using swarmanoid::CCI_Commands;
using swarmanoid::CCI_Readings;
