#include "python/module/space_rows.h"

#include <fmt/format.h>

#include "common/space/attributes.h"
#include "common/space/space.h"

namespace py = pybind11;

namespace swarmanoid::python
{

std::vector<std::string> IdsOf(const CSwarmanoidSpace& space)
{
  std::vector<std::string> ids;
  for (std::size_t e = 0; e < space.Size(); ++e) ids.push_back(space.GetEntity(e).GetId());
  return ids;
}

std::vector<std::string> KindsOf(const CSwarmanoidSpace& space)
{
  std::vector<std::string> kinds;
  for (std::size_t e = 0; e < space.Size(); ++e) kinds.emplace_back(TagName(space.GetEntity(e).GetKind()));
  return kinds;
}

py::tuple SlotOf(const CSwarmanoidSpace& space, std::size_t index, const std::string& attribute)
{
  if (index >= space.Size()) throw py::index_error("no such entity");
  const CSwarmanoidSpaceEntity& entity = space.GetEntity(index);
  const AttributeSpec* spec = FindAttribute(entity.GetKind(), attribute);
  if (spec != nullptr) return py::make_tuple(entity.SlotOf(attribute), spec->count);
  std::string known;
  for (const AttributeSpec& other : AttributesOf(entity.GetKind())) known += fmt::format(" {}", other.name);
  throw py::key_error(fmt::format("'{}' has no attribute '{}'; it has:{}", entity.GetId(), attribute, known));
}

}  // namespace swarmanoid::python
