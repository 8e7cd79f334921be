#include "common/space/attributes.h"

namespace swarmanoid
{

std::span<const AttributeSpec> AttributesOf(EntityKind kind) { return DescriptionOf(kind).attributes; }

int AttributeCount(EntityKind kind)
{
  int count = 0;
  for (const AttributeSpec& spec : AttributesOf(kind)) count += spec.count;
  return count;
}

const AttributeSpec* FindAttribute(EntityKind kind, std::string_view name)
{
  for (const AttributeSpec& spec : AttributesOf(kind))
    if (spec.name == name) return &spec;
  return nullptr;
}

int AttributeOffset(EntityKind kind, std::string_view name)
{
  int offset = 0;
  for (const AttributeSpec& spec : AttributesOf(kind))
  {
    if (spec.name == name) return offset;
    offset += spec.count;
  }
  return -1;
}

}  // namespace swarmanoid
