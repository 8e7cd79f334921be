// The moving links of robots, as triangles of the page's drawing. The page has a model of what does not move.
#pragma once

#include <map>
#include <vector>

#include "visualiser/scene/drawn_marks.h"
#include "visualiser/scene/mesh.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

class DrawnLinks
{
public:
  // The space outlives it.
  explicit DrawnLinks(const CSwarmanoidSpace& space);

  bool AreThere() const { return !robots_.empty(); }
  // Appends the links of all robots in the arena, where they are now, in the frame of the space. Faces that look up are
  // brighter. Of a crowd with more than kMostTriangles, the last robots have no links.
  void Add(std::vector<DrawnMarks::Triangle>& triangles) const;

  static constexpr std::size_t kMostTriangles = 50'000;

private:
  struct Robot
  {
    std::uint32_t entity;
    std::uint32_t first_slot;  // of the attribute of its first joint
  };

  const CSwarmanoidSpace& space_;
  std::vector<Robot> robots_;
  std::map<EntityKind, std::vector<Model>> models_;  // the base, then the links
};

}  // namespace swarmanoid
