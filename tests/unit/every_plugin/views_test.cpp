// All views of a device, Python, Lua, ROS 2, inspectors, recorded runs and lists, have the columns that its interface
// declares. Columns for programs or for people alone are listed here, with what the others have instead.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "common/control_interface/ci_device.h"
#include "controller_host/device.h"
#include "tests/unit/every_plugin/small_scene.h"

namespace swarmanoid
{
namespace
{

const std::set<std::string>& OneSidedColumns()
{
  static const std::set<std::string> columns{
      // An image is too large for people: they see its middle and the nearest.
      "depth_camera depth #",
      "depth_camera colour #",
      "depth_camera depth in the middle",
      "depth_camera colour in the middle",
      "depth_camera nearest",
      "range_scanner distance #",
      "range_scanner nearest",
      "range_scanner angle of the nearest",
      // People read the heading, which follows from the orientation.
      "positioning qx",
      "positioning qy",
      "positioning qz",
      "positioning qw",
      "positioning heading",
      // Long messages: people see how long they are.
      "range_and_bearing further byte #",
      "range_and_bearing further bytes",
      // Programs set actuators and do not read them.
      "radio waiting",
      "eyebot_propellers target x",
      "eyebot_propellers target y",
      "eyebot_propellers target z",
      "eyebot_propellers target yaw",
  };
  return columns;
}

void Check(const std::string& device, const std::vector<CCI_ColumnGroup>& groups, std::set<std::string>& one_sided)
{
  for (const CCI_ColumnGroup& group : groups)
    for (const CCI_Column& column : group.columns)
    {
      EXPECT_EQ(column.audience, group.columns.front().audience) << device << " " << column.name;
      if (column.audience != CCI_Column::For::kEverybody) one_sided.insert(device + " " + column.name);
      // A target that may be absent is shown to people in its parts, without a number.
      if (column.audience == CCI_Column::For::kPeople) continue;
      EXPECT_EQ(column.name.find('#') != std::string::npos, group.count != 1)
          << device << " '" << column.name << "': names have a '#' if the column is repeated";
    }
}

// A switch is 0 or 1, and a colour has 24 bits. What may be negative reaches as far to the other side.
void CheckRanges(const std::string& device, const std::vector<CCI_ColumnGroup>& groups)
{
  for (const CCI_ColumnGroup& group : groups)
    for (const CCI_Column& column : group.columns)
    {
      const std::string name = device + " " + column.name;
      EXPECT_LT(column.minimum, column.maximum) << name;
      if (column.unit == "yes/no" || column.unit == "colour")
      {
        EXPECT_EQ(column.minimum, 0) << name;
        EXPECT_EQ(column.maximum, column.unit == "colour" ? 0xffffff : 1) << name;
      }
      if (column.minimum < 0)
      {
        EXPECT_EQ(column.maximum, -column.minimum) << name;
      }
    }
}

TEST(Views, RangesOfColumnsAreThoseOfTheirUnits)
{
  RegisterEverything();
  for (const PluginKind kind : {PluginKind::kSensor, PluginKind::kActuator})
    for (const std::string& label : PluginCatalogue::Instance().Labels(kind))
      if (const CCI_Columns* columns = FindColumns(kind, label))
        for (const auto* groups : {&columns->readings, &columns->row, &columns->settings}) CheckRanges(label, *groups);
}

TEST(Views, EachDeviceDeclaresColumnsAndNoneIsMissingInAView)
{
  RegisterEverything();
  std::set<std::string> one_sided;
  for (const PluginKind kind : {PluginKind::kSensor, PluginKind::kActuator})
    for (const std::string& label : PluginCatalogue::Instance().Labels(kind))
    {
      const CCI_Columns* columns = FindColumns(kind, label);
      ASSERT_NE(columns, nullptr) << PluginKindName(kind) << " " << label << " declares no columns";
      const bool is_sensor = kind == PluginKind::kSensor;
      EXPECT_EQ(columns->settings.empty(), is_sensor) << label;
      EXPECT_EQ(columns->set == nullptr, is_sensor) << label;
      EXPECT_TRUE(!is_sensor || !columns->readings.empty() || !columns->row.empty()) << label;
      Check(label, columns->readings, one_sided);
      Check(label, columns->row, one_sided);
      Check(label, columns->settings, one_sided);
    }
  EXPECT_EQ(one_sided, OneSidedColumns());
}

}  // namespace
}  // namespace swarmanoid
