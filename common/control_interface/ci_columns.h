// The columns of a device: the numbers that it reads or is set to. Each has a name, a unit, a range, and a function
// that reads it from the interface of the device. The interface declares them once. Python, Lua, the topics of ROS 2,
// the inspectors, `swarmanoid inspect`, `swarmanoid list plugins` and the tests use this declaration.
//
//   class CCI_CompassSensor : public CCI_SensorOf<CCI_CompassSensor>
//   {
//   public:
//     virtual double GetHeading() const = 0;
//     static void Declare(Declaration& columns) { columns.Add({"heading", "rad"}, &CCI_CompassSensor::GetHeading); }
//   };
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/control_interface/ci_colour.h"

namespace swarmanoid
{

class CCI_Device;

// One number that a device reads or is set to, as a column of a table. It is the same at every tick, and for all robots
// with the same device.
struct CCI_Column
{
  enum class For
  {
    kEverybody,
    kPrograms,  // users are shown something shorter
    kPeople     // follows from columns for programs
  };

  std::string name;    // "left"; "led #": one of several, whose number from 0 takes the place of '#'
  std::string unit{};  // "m/s"; empty for plain numbers. "colour": 0xRRGGBB, 0 is off. "yes/no": 1 or 0
  // The range of the values, noise included.
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool may_be_infinite = false;  // infinity is a reading, too: nothing was found. People are not shown it
  bool hides_zero = false;       // people are not shown zeros
  For audience = For::kEverybody;

  // Returns "left [rad/s]" or "colour": the name with its unit.
  std::string Title() const
  {
    const bool has_unit = !unit.empty() && unit != "colour" && unit != "yes/no";
    return has_unit ? name + " [" + unit + "]" : name;
  }
  bool IsFor(For reader) const { return audience == For::kEverybody || audience == reader; }
};

// Returns the column for each byte of a message.
inline CCI_Column ByteColumn() { return {.name = "byte #", .minimum = 0, .maximum = 255, .hides_zero = true}; }

// Calls send(bytes) with a message in numbers: `numbers` has the count of bytes, followed by the bytes.
template <std::size_t kMost, class Send>
void SendNumbers(std::span<const double> numbers, Send send)
{
  std::array<std::uint8_t, kMost> bytes{};
  for (std::size_t i = 0; i < kMost; ++i) bytes[i] = static_cast<std::uint8_t>(std::clamp(numbers[1 + i], 0.0, 255.0));
  send(std::span<const std::uint8_t>(bytes).first(static_cast<std::size_t>(std::clamp<double>(numbers[0], 0, kMost))));
}

// Neighbouring columns that are repeated together: "depth 0", "colour 0", "depth 1" and so on.
struct CCI_ColumnGroup
{
  std::vector<CCI_Column> columns;
  std::size_t count = 1;                                                // repetitions; 0: count_of returns them
  std::function<std::size_t(const CCI_Device&)> count_of{};             // set if the count differs between devices
  std::function<void(const CCI_Device&, std::vector<double>&)> read{};  // for readings: appends the numbers
  // Gives the column of one repetition its own name and unit, if the device knows them.
  std::function<void(const CCI_Device&, std::size_t, CCI_Column&)> adapt{};
  // For readings that devices keep as spans of doubles: find_rows(devices, width, rows) writes where the numbers of
  // each device are. It returns the number of devices, or the position of the first one that has another count than
  // `width`.
  std::function<std::size_t(std::span<const CCI_Device* const>, std::size_t, const double**)> find_rows{};

  std::size_t CountOf(const CCI_Device& device) const { return count == 0 ? count_of(device) : count; }
  bool IsFor(CCI_Column::For audience) const { return columns.front().IsFor(audience); }
};

// The declaration of an interface, in the form for programs that show devices.
struct CCI_Columns
{
  // The readings that exist at every tick.
  std::vector<CCI_ColumnGroup> readings;
  // The readings whose count differs between ticks, such as blobs or packets. `row_name` names one of them, and `row`
  // has its columns. `read_rows` appends row after row. `read_row_ids` appends the ids of the entities that the rows
  // are about.
  std::string row_name;
  std::vector<CCI_ColumnGroup> row;
  std::function<void(const CCI_Device&, CCI_Column::For, std::vector<double>&)> read_rows;
  std::function<void(const CCI_Device&, std::vector<std::string>&)> read_row_ids;
  // The columns that an actuator is set to, all at once. set(devices, values) has a row of values for each device.
  std::vector<CCI_ColumnGroup> settings;
  std::function<void(std::span<CCI_Device* const>, std::span<const double>)> set;
};

// The count of numbers in a reading of a type; 0 means that its size gives the count.
template <class Value>
inline constexpr std::size_t kNumbersIn = std::is_arithmetic_v<Value> || std::is_enum_v<Value> ? 1 : 0;
template <class Number, std::size_t kSize>
inline constexpr std::size_t kNumbersIn<std::array<Number, kSize>> = kSize;
template <class Number, std::size_t kSize>
inline constexpr std::size_t kNumbersIn<std::span<Number, kSize>> = kSize == std::dynamic_extent ? 0 : kSize;
// Whether a reading is a span of doubles.
template <class Value>
inline constexpr bool kIsSpan = false;
template <std::size_t kSize>
inline constexpr bool kIsSpan<std::span<const double, kSize>> = true;

// It describes a column of the items of a list, and how it is read: by a member or a function of the item, or by a
// function of the device and the item. A range has the same size for all items.
template <class Get>
struct CCI_Field
{
  CCI_Field(CCI_Column of, Get by) : column(std::move(of)), get(std::move(by)) {}

  CCI_Column column;
  Get get;
};

// The class with which the interface `Device` writes its declaration. Readings are numbers, switches, enumerations, or
// ranges.
template <class Device>
class CCI_ColumnsOf : public CCI_Columns
{
public:
  // Adds a reading, or each number of a range. `count` is the number of columns for a range of variable size; missing
  // numbers become zeros. A member function that returns a span of doubles spares CCI_Batch a copy.
  template <class Get>
  CCI_ColumnsOf& Add(CCI_Column column, Get get, std::size_t count = kNumbersIn<ResultOf<Get>>)
  {
    const auto read = [get, count](const CCI_Device& device, std::vector<double>& values)
    {
      const std::size_t end = values.size() + count;
      Append(values, std::invoke(get, This(device)));
      if (count != 0) values.resize(end, 0);
    };
    readings.push_back({{std::move(column)}, count, SizeOf(get), read});
    if (count == kNumbersIn<ResultOf<Get>>) readings.back().find_rows = FindRows(get);
    return *this;
  }
  // Adds a reading that is a range with a number for each of these columns.
  template <class Get>
  CCI_ColumnsOf& AddAll(std::vector<CCI_Column> columns, Get get)
  {
    const auto read = [get](const CCI_Device& device, std::vector<double>& values)
    { Append(values, std::invoke(get, This(device))); };
    readings.push_back({std::move(columns), 1, {}, read, {}, FindRows(get)});
    return *this;
  }
  // Adds columns that are repeated as often as a range has numbers for them. adapt(device, repetition, column) gives
  // each its name and unit.
  template <class Get, class Adapt>
  CCI_ColumnsOf& AddNamed(std::vector<CCI_Column> columns, Get get, Adapt adapt)
  {
    const std::size_t width = columns.size();
    const auto count = [get, width](const CCI_Device& device)
    { return std::size(std::invoke(get, This(device))) / width; };
    const auto read = [get](const CCI_Device& device, std::vector<double>& values)
    { Append(values, std::invoke(get, This(device))); };
    readings.push_back({std::move(columns), 0, count, read, Adapted(adapt), FindRows(get)});
    return *this;
  }
  // Gives the columns of the last setting their names and units, as AddNamed does.
  template <class Adapt>
  CCI_ColumnsOf& NameSettings(Adapt adapt)
  {
    settings.back().adapt = Adapted(adapt);
    return *this;
  }
  // Adds the fields of each item of a range, which must have the same number of items at every tick.
  template <class Get, class... Gets>
  CCI_ColumnsOf& AddEach(Get get, CCI_Field<Gets>... fields)
  {
    std::vector<CCI_Column> columns{fields.column...};
    const auto read = [read_all = ReadItems(get, fields...), audience = columns.front().audience](
                          const CCI_Device& device, std::vector<double>& values)
    { read_all(device, audience, values); };
    readings.push_back({std::move(columns), 0, SizeOf(get), read});
    return *this;
  }

  // Declares the rows: one for each item of a range. `name` is that of one row, such as "blob".
  template <class Get, class... Gets>
  CCI_ColumnsOf& AddRows(std::string name, Get get, CCI_Field<Gets>... fields)
  {
    using Item = std::remove_cvref_t<decltype(*std::begin(std::declval<const ResultOf<Get>&>()))>;
    row_name = std::move(name);
    (row.push_back(RowGroup<Item>(fields)), ...);
    read_rows = ReadItems(get, fields...);
    return *this;
  }
  // Declares the ids of rows. `id` returns the id of the entity that an item is about.
  template <class Get, class Id>
  CCI_ColumnsOf& AddRowIds(Get get, Id id)
  {
    read_row_ids = [get, id](const CCI_Device& device, std::vector<std::string>& ids)
    {
      for (const auto& item : std::invoke(get, This(device))) ids.emplace_back(std::invoke(id, item));
    };
    return *this;
  }

  // Declares the settings of an actuator. `by` is a member function with an argument for each column; colours are
  // std::uint32_t.
  template <class... Arguments>
  CCI_ColumnsOf& Set(const std::vector<CCI_Column>& columns, void (Device::*by)(Arguments...))
  {
    return Set(columns,
               [by](Device& device, std::span<const double> values)
               {
                 auto next = values.begin();
                 const std::tuple<Arguments...> all{Argument<Arguments>(next)...};
                 std::apply([&](const auto&... each) { (device.*by)(each...); }, all);
               });
  }
  // Declares the settings of an actuator. `by` is a function of the actuator and a number for each column. `count` is
  // an integer or a function of the actuator: it repeats a column whose name has a '#'.
  template <class By, class Count = std::size_t>
  CCI_ColumnsOf& Set(const std::vector<CCI_Column>& columns, By by, Count count = {})
  {
    for (const CCI_Column& column : columns)
    {
      CCI_ColumnGroup& group = settings.emplace_back(CCI_ColumnGroup{{column}});
      if (column.name.find('#') == std::string::npos) continue;
      if constexpr (std::is_integral_v<Count>)
        group.count = count;
      else
        group = {{column}, 0, [count](const CCI_Device& device) { return std::invoke(count, This(device)); }};
    }
    set = [by](std::span<CCI_Device* const> devices, std::span<const double> values)
    {
      const std::size_t width = values.size() / std::max<std::size_t>(devices.size(), 1);
      for (CCI_Device* const device : devices)
      {
        by(static_cast<Device&>(*device), values.first(width));
        values = values.subspan(width);
      }
    };
    return *this;
  }

private:
  template <class Get>
  using ResultOf = std::remove_cvref_t<std::invoke_result_t<Get, const Device&>>;

  template <class Adapt>
  static std::function<void(const CCI_Device&, std::size_t, CCI_Column&)> Adapted(Adapt adapt)
  {
    return [adapt](const CCI_Device& device, std::size_t repetition, CCI_Column& column)
    { adapt(This(device), repetition, column); };
  }

  static const Device& This(const CCI_Device& device) { return static_cast<const Device&>(device); }

  template <class Value>
  static void Append(std::vector<double>& values, const Value& value)
  {
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>)
      values.push_back(static_cast<double>(value));
    else
      values.insert(values.end(), std::begin(value), std::end(value));
  }
  // Returns the function for find_rows. It is empty unless the readings are a span of doubles from a member function.
  template <class Get>
  static std::function<std::size_t(std::span<const CCI_Device* const>, std::size_t, const double**)> FindRows(Get get)
  {
    if constexpr (std::is_member_function_pointer_v<Get> && kIsSpan<ResultOf<Get>>)
      return [get](std::span<const CCI_Device* const> devices, std::size_t width, const double** rows) -> std::size_t
      {
        for (std::size_t k = 0; k < devices.size(); ++k)
        {
          const std::span<const double> row = std::invoke(get, This(*devices[k]));
          if (row.size() != width) return k;
          rows[k] = row.data();
        }
        return devices.size();
      };
    else
      return {};
  }
  // Returns a function that gives the size of a range, or an empty function if the type determines the size.
  template <class Get>
  static std::function<std::size_t(const CCI_Device&)> SizeOf(Get get)
  {
    if constexpr (kNumbersIn<ResultOf<Get>> != 0)
      return {};
    else
      return [get](const CCI_Device& device) { return std::size(std::invoke(get, This(device))); };
  }

  template <class Get, class Item>
  static decltype(auto) FieldOf(const Get& get, const CCI_Device& device, const Item& item)
  {
    if constexpr (std::is_invocable_v<const Get&, const Item&>)
      return std::invoke(get, item);
    else
      return std::invoke(get, This(device), item);
  }
  template <class Get, class... Gets>
  static auto ReadItems(Get get, CCI_Field<Gets>... fields)
  {
    return [get, fields...](const CCI_Device& device, CCI_Column::For audience, std::vector<double>& values)
    {
      for (const auto& item : std::invoke(get, This(device)))
        ((fields.column.IsFor(audience) ? Append(values, FieldOf(fields.get, device, item)) : void()), ...);
    };
  }
  template <class Item, class Get>
  static CCI_ColumnGroup RowGroup(const CCI_Field<Get>& field)
  {
    using Value = std::remove_cvref_t<decltype(FieldOf(field.get, std::declval<const CCI_Device&>(),
                                                       std::declval<const Item&>()))>;
    if constexpr (kNumbersIn<Value> != 0)
      return {{field.column}, kNumbersIn<Value>};
    else
      return {{field.column}, 0, [get = field.get](const CCI_Device& device) {
                return std::size(FieldOf(get, device, Item{}));
              }};
  }

  template <class Type>
  static Type Argument(std::span<const double>::iterator& next)
  {
    const double value = *next++;
    if constexpr (std::is_same_v<Type, std::uint32_t>)
      return CCI_Colour::FromNumber(value);
    else
      return value;
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_Column;
using swarmanoid::CCI_Field;
