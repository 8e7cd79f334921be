#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

std::vector<CCI_Column> NumberedColumns(std::size_t count, const std::string& prefix, CCI_Column like)
{
  std::vector<CCI_Column> columns;
  for (std::size_t i = 0; i < count; ++i)
  {
    like.name = prefix + std::to_string(i);
    columns.push_back(like);
  }
  return columns;
}

void CCI_Sensor::Describe(std::vector<CCI_Reading>& readings) const
{
  const std::vector<CCI_Column> columns = Columns();
  std::vector<double> values;
  ReadColumns(values);
  for (std::size_t i = 0; i < columns.size() && i < values.size(); ++i)
    readings.push_back({columns[i].name, columns[i].unit, values[i]});
}

}  // namespace swarmanoid
