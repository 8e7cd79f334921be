// CConvexHull: the triangles of the convex hull of points in space.
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
    CVector3 Normal;                      // outwards; its length is the area of the parallelogram of two edges
    Real Direction = 0;                   // a point is inside if its product with the normal is at most this
    std::array<UInt32, 3> VertexIndices;  // counter-clockwise, seen from outside
  };

  // It has no faces for fewer than four points, or for points of one plane.
  CConvexHull(const std::vector<CVector3>& points);
  const std::vector<SFace>& GetFaces() const { return faces_; }

private:
  std::vector<SFace> faces_;
};

}  // namespace argos
