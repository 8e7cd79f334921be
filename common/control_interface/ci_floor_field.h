// The fields on the floor that robots write and read, such as a virtual pheromone: the actuator and the sensor with the
// type label "floor_field". The <floor_field> elements of the arena declare the fields, which have numbers in the order
// of the file.
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

// The part of both devices that knows the fields of the experiment.
class CCI_FloorFieldNames
{
public:
  // Returns the ids of the fields, in the order of their numbers.
  virtual std::span<const std::string> GetFields() const = 0;
  // Returns the number of the field with that id. Throws std::out_of_range if there is none.
  std::size_t FieldOf(std::string_view id) const
  {
    const auto fields = GetFields();
    for (std::size_t k = 0; k < fields.size(); ++k)
      if (fields[k] == id) return k;
    throw std::out_of_range("there is no floor field '" + std::string(id) + "'");
  }

protected:
  ~CCI_FloorFieldNames() = default;
  void RequireField(std::size_t field) const
  {
    if (field >= GetFields().size())
      throw std::out_of_range("floor field " + std::to_string(field) + " of " + std::to_string(GetFields().size()));
  }
};

class CCI_FloorFieldActuator : public CCI_ActuatorOf<CCI_FloorFieldActuator>, public CCI_FloorFieldNames
{
public:
  // Sets the amount that the robot deposits in a second, at the point that the experiment file states. A negative rate
  // takes away, down to 0. The rate stays until it is set again. Throws std::out_of_range for a field that does not
  // exist.
  void SetRate(double amount_per_s, std::size_t field = 0)
  {
    RequireField(field);
    Set(field, amount_per_s);
  }

  static void Declare(Declaration& columns)
  {
    columns.Set({{"rate #", "1/s"}}, &SetNumbers,
                [](const CCI_FloorFieldActuator& actuator) { return actuator.GetFields().size(); });
  }

protected:
  virtual void Set(std::size_t field, double amount_per_s) = 0;

private:
  static void SetNumbers(CCI_FloorFieldActuator& actuator, std::span<const double> values)
  {
    for (std::size_t k = 0; k < values.size(); ++k) actuator.Set(k, values[k]);
  }
};

class CCI_FloorFieldSensor : public CCI_SensorOf<CCI_FloorFieldSensor>, public CCI_FloorFieldNames
{
public:
  // A Reading belongs to one of the points of the sensor.
  struct Reading
  {
    double value = 0;       // 1/m²
    double gradient_x = 0;  // 1/m³, to the front of the robot
    double gradient_y = 0;  // 1/m³, to its left
  };

  // Returns the number of points, which the experiment file states.
  virtual std::size_t PointCount() const = 0;
  // Returns the readings of all fields, field after field, each at the points in the order of the file. They are valid
  // until the next control step.
  virtual std::span<const Reading> GetAllReadings() const = 0;
  // Returns the readings of one field. Throws std::out_of_range for a field that does not exist.
  std::span<const Reading> GetReadings(std::size_t field = 0) const
  {
    RequireField(field);
    return GetAllReadings().subspan(field * PointCount(), PointCount());
  }

  static void Declare(Declaration& columns)
  {
    columns.AddEach(&CCI_FloorFieldSensor::GetAllReadings, CCI_Field({"value #", "1/m2"}, &Reading::value),
                    CCI_Field({"gradient x #", "1/m3"}, &Reading::gradient_x),
                    CCI_Field({"gradient y #", "1/m3"}, &Reading::gradient_y));
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FloorFieldActuator;
using swarmanoid::CCI_FloorFieldSensor;
