#include "common/space/entities_by_kind.h"

#include <stdexcept>
#include <string>

#include "common/space/entity.h"
#include "common/space/space.h"

namespace swarmanoid
{

std::vector<std::uint32_t> GetEntitiesByKind(const CSwarmanoidSpace& space, std::string_view tag)
{
  const auto kind = KindOfTag(tag);
  if (!kind) throw std::invalid_argument("there is no kind of entity '" + std::string(tag) + "'");
  std::vector<std::uint32_t> entities;
  for (std::uint32_t e = 0; e < space.Size(); ++e)
    if (space.GetEntity(e).GetKind() == *kind) entities.push_back(e);
  return entities;
}

}  // namespace swarmanoid
