// CConvexHull: the triangles around points in space.
#pragma once

#include <argos3/core/utility/math/vector3.h>

#include <array>

namespace argos
{

class CConvexHull
{
public:
  struct SFace
  {
    SFace(const std::vector<CVector3>& points, UInt32 a, UInt32 b, UInt32 c)
        : Normal((points[b] - points[a]).CrossProduct(points[c] - points[a])),
          Direction(Normal.DotProduct(points[a])),
          VertexIndices{{a, b, c}}
    {
    }
    CVector3 Normal;                      // outwards, as long as the parallelogram of two edges is large
    Real Direction = 0;                   // a point is within if its product with the normal is not more
    std::array<UInt32, 3> VertexIndices;  // counter-clockwise, seen from outside
  };

  // No faces around fewer than four points, or points of one plane.
  CConvexHull(const std::vector<CVector3>& points);
  const std::vector<SFace>& GetFaces() const { return faces_; }

private:
  std::vector<SFace> faces_;
};

}  // namespace argos
