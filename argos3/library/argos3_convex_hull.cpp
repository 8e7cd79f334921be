#include <argos3/core/utility/math/convex_hull.h>

namespace argos
{
namespace
{

using Faces = std::vector<CConvexHull::SFace>;
using Edge = std::pair<UInt32, UInt32>;

constexpr Real kFlat = 1e-6;  // a point so far outside still counts as inside

bool IsOutside(const CConvexHull::SFace& face, const CVector3& point)
{
  return face.Normal.DotProduct(point) > face.Direction + kFlat;
}

// Returns the faces of four points around a volume; none if there are no such points.
Faces Tetrahedron(const std::vector<CVector3>& points)
{
  const auto count = static_cast<UInt32>(points.size());
  for (UInt32 a = 0; a < count; ++a)
    for (UInt32 b = a + 1; b < count; ++b)
      for (UInt32 c = b + 1; c < count; ++c)
      {
        const CConvexHull::SFace face(points, a, b, c);
        if (face.Normal.Length() < kFlat) continue;
        for (UInt32 d = c + 1; d < count; ++d)
        {
          const Real above = face.Normal.DotProduct(points[d]) - face.Direction;
          if (Abs(above) < kFlat) continue;
          // Seen from d, which is below, a, b and c are counter-clockwise or clockwise.
          const UInt32 second = above < 0 ? b : c;
          const UInt32 third = above < 0 ? c : b;
          return {
              {points, a, second, third}, {points, a, d, second}, {points, second, d, third}, {points, third, d, a}};
        }
      }
  return {};
}

}  // namespace

// Adds point by point: the faces that the point is outside of are removed, and it is joined to the edges of the hole.
CConvexHull::CConvexHull(const std::vector<CVector3>& points) : faces_(Tetrahedron(points))
{
  if (faces_.empty()) return;
  for (UInt32 point = 0; point < points.size(); ++point)
  {
    std::set<Edge> edges;
    Faces kept;
    for (const SFace& face : faces_)
    {
      if (!IsOutside(face, points[point]))
      {
        kept.push_back(face);
        continue;
      }
      for (std::size_t i = 0; i < 3; ++i)
      {
        const UInt32 from = face.VertexIndices[i];
        const UInt32 to = face.VertexIndices[(i + 1) % 3];
        // An edge between two removed faces does not belong to the hole.
        if (edges.erase({to, from}) == 0) edges.insert({from, to});
      }
    }
    for (const Edge& edge : edges) kept.emplace_back(points, edge.first, edge.second, point);
    faces_ = std::move(kept);
  }
}

}  // namespace argos
