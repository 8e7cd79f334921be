// Changes of attribute slots. Their slots ascend, and each is in the list once. The roles put their changes in order
// before they send them.
#pragma once

#include <span>

#include "common/math/zeroed_vector.h"
#include "idl/changed_attributes.h"

namespace swarmanoid
{

struct AttributeChanges : ChangedAttributes
{
  void Clear()
  {
    slots.clear();
    values.clear();
  }
  void Add(std::uint32_t slot, double value)
  {
    slots.push_back(slot);
    values.push_back(value);
  }

  // The changes that act before these and are not in the space yet (framework.ahead), in order; usually none. They are
  // not part of the message.
  const AttributeChanges* pending = nullptr;
};

// Puts changes in order; of values for one slot the last one counts. Keeps its scratch memory, so that steady running
// allocates nothing.
class AttributeOrder
{
public:
  void Apply(AttributeChanges& changes);

private:
  std::vector<std::uint64_t> places_;  // the slot above, the index below
  std::vector<std::uint64_t> merged_;
  AttributeChanges ordered_;
};

// Returns whether slots ascend, each with a value.
bool IsOrdered(const AttributeChanges& changes);

// Adds the values of `slots` (ascending) that differ from those of the space (`known`, all slots) after the pending
// changes. A slot that has a change already is added too, since the last reporter decides, even if it restores the old
// value.
void ReportChanges(std::span<const std::uint32_t> slots, std::span<const double> values,
                   const SparseVector<double>& known, AttributeChanges& changes);

}  // namespace swarmanoid
