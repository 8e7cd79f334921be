// OctreeIndex: the oct-tree form of PositionalIndex. It is an OctoMap tree whose leaves hold the points within them. A
// point that stays in its leaf costs one comparison, and empty space costs nothing.
#pragma once

#include "common/space/index/positional_index.h"

namespace swarmanoid
{

class OctreeIndex : public PositionalIndex
{
public:
  OctreeIndex();
  ~OctreeIndex() override;

  void Update(const PointArrays& points) override;
  void FindWithin(const Vector3& centre, double radius, std::vector<std::uint32_t>& found) const override;
  void FindInBox(const Vector3& low, const Vector3& high, std::vector<std::uint32_t>& found) const override;
  const char* Name() const override { return "oct-tree"; }

protected:
  double Spacing() const override { return leaf_m_; }
  const PointArrays& Points() const override { return points_; }

private:
  class Tree;

  double leaf_m_;
  PointArrays points_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace swarmanoid
