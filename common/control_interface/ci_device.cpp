#include "common/control_interface/ci_device.h"

#include <algorithm>
#include <cmath>

namespace swarmanoid
{
namespace
{

using For = CCI_Column::For;

// The '#' of a name becomes a number.
std::string Numbered(const std::string& name, std::size_t number)
{
  const std::size_t place = name.find('#');
  return place == std::string::npos ? name : std::string(name).replace(place, 1, std::to_string(number));
}

std::vector<CCI_Column> ColumnsFor(For audience, const std::vector<CCI_ColumnGroup>& groups, const CCI_Device& device)
{
  std::vector<CCI_Column> columns;
  for (const CCI_ColumnGroup& group : groups)
  {
    if (!group.IsFor(audience)) continue;
    const std::size_t count = group.CountOf(device);
    for (std::size_t i = 0; i < count; ++i)
      for (const CCI_Column& column : group.columns)
      {
        columns.push_back(column);
        if (group.adapt)
          group.adapt(device, i, columns.back());
        else
          columns.back().name = Numbered(column.name, i);
      }
  }
  return columns;
}

// `start`: put before the name.
void Show(const std::vector<CCI_Column>& columns, std::span<const double> values, const std::string& start,
          std::vector<CCI_Reading>& readings)
{
  for (std::size_t i = 0; i < std::min(columns.size(), values.size()); ++i)
  {
    const CCI_Column& column = columns[i];
    if ((column.may_be_infinite && std::isinf(values[i])) || (column.hides_zero && values[i] == 0)) continue;
    readings.push_back({start + column.name, column.unit, values[i]});
  }
}

}  // namespace

const CCI_Columns& CCI_Device::Declared() const
{
  static const CCI_Columns none;
  return none;
}

std::vector<CCI_Column> CCI_Device::Columns() const { return ColumnsFor(For::kPrograms, Declared().readings, *this); }

std::vector<CCI_Column> CCI_Actuator::Columns() const { return ColumnsFor(For::kPrograms, Declared().settings, *this); }

void CCI_Device::ReadColumns(std::vector<double>& values) const
{
  for (const CCI_ColumnGroup& group : Declared().readings)
    if (group.IsFor(For::kPrograms)) group.read(*this, values);
}

std::vector<CCI_Column> CCI_Device::Rows() const { return ColumnsFor(For::kPrograms, Declared().row, *this); }

void CCI_Device::ReadRows(std::vector<double>& values) const
{
  if (Declared().read_rows) Declared().read_rows(*this, For::kPrograms, values);
}

void CCI_Device::ReadRowIds(std::vector<std::string>& ids) const
{
  if (Declared().read_row_ids) Declared().read_row_ids(*this, ids);
}

void CCI_Device::Describe(std::vector<CCI_Reading>& readings) const
{
  const CCI_Columns& all = Declared();
  std::vector<double> values;
  ReadSettings(values);
  Show(ColumnsFor(For::kPeople, all.settings, *this), values, "", readings);
  values.clear();
  for (const CCI_ColumnGroup& group : all.readings)
    if (group.IsFor(For::kPeople)) group.read(*this, values);
  Show(ColumnsFor(For::kPeople, all.readings, *this), values, "", readings);
  if (all.read_rows) DescribeRows(readings);
}

// The names of rows are such as "blob 0 distance", or "tag prey_3" if rows have ids and one column alone.
void CCI_Device::DescribeRows(std::vector<CCI_Reading>& readings) const
{
  std::vector<CCI_Column> columns = ColumnsFor(For::kPeople, Declared().row, *this);
  const bool has_names = columns.size() > 1;
  if (!has_names) columns.front().name.clear();
  std::vector<double> values;
  Declared().read_rows(*this, For::kPeople, values);
  std::vector<std::string> ids;
  ReadRowIds(ids);
  for (std::size_t row = 0; row * columns.size() < values.size(); ++row)
  {
    const std::string name = Declared().row_name + ' ' + (row < ids.size() ? ids[row] : std::to_string(row));
    Show(columns, std::span(values).subspan(row * columns.size()), has_names ? name + ' ' : name, readings);
  }
}

}  // namespace swarmanoid
