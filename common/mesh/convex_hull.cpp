// qhull (C. B. Barber, D. P. Dobkin and H. Huhdanpaa, "The Quickhull algorithm for convex hulls", ACM Transactions on
// Mathematical Software 22(4), 1996) finds the faces. It orders them and their corners by addresses in memory, which
// differ between processes. So each face is turned to begin with its lowest point, the faces are sorted, and the points
// that remain are numbered in ascending order. A hull of too many corners is replaced by that of its farthest points in
// evenly spread directions. Mass and inertia are sums over the tetrahedra between the faces and an inner point.
//
// Invariants: equal points give equal bits in every process; each edge lies between exactly two faces; no corner lies
// in front of a face.
#include "common/mesh/convex_hull.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "common/math/elementary.h"

extern "C"
{
#include <libqhull_r/qhull_ra.h>
}

namespace swarmanoid
{
namespace
{

using Loop = std::vector<std::uint32_t>;

constexpr double kEven = 1e-5;      // relative to the size: the tolerance for corners of one face
constexpr double kFlattest = 1e-3;  // relative to the size: a thinner body counts as flat

// Runs qhull. Faces returns the faces as lists of points, in an order that depends only on the points. qhull itself
// orders neighbours by the addresses of its allocations, which may differ between processes.
class Quickhull
{
public:
  explicit Quickhull(std::span<const Vector3> points, double size) : errors_(open_memstream(&text_, &length_))
  {
    for (const Vector3& point : points)
      for (const double value : {point.x(), point.y(), point.z()}) coordinates_.push_back(value);
    qh_zero(&qh_, errors_);
    const std::string command = fmt::format("qhull C-{:.3e}", kEven * size);
    std::string writable = command;
    failed_ = qh_new_qhull(&qh_, 3, static_cast<int>(points.size()), coordinates_.data(), False, writable.data(),
                           nullptr, errors_) != 0;
  }
  ~Quickhull()
  {
    qh_freeqhull(&qh_, !qh_ALL);
    int kept = 0;
    int total = 0;
    qh_memfreeshort(&qh_, &kept, &total);
    std::fclose(errors_);
    std::free(text_);
  }
  Quickhull(const Quickhull&) = delete;
  Quickhull& operator=(const Quickhull&) = delete;

  bool Failed() const { return failed_; }

  std::vector<Loop> Faces()
  {
    std::vector<Loop> faces;
    for (const facetT* facet = qh_.facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next)
    {
      setT* const around = qh_facet3vertex(&qh_, const_cast<facetT*>(facet));
      Loop loop;
      const int count = qh_setsize(&qh_, around);
      for (int k = 0; k < count; ++k)
        loop.push_back(static_cast<std::uint32_t>(qh_pointid(&qh_, static_cast<vertexT*>(around->e[k].p)->point)));
      qh_settempfree_all(&qh_);
      std::rotate(loop.begin(), std::ranges::min_element(loop), loop.end());
      faces.push_back(std::move(loop));
    }
    std::ranges::sort(faces);
    return faces;
  }

private:
  char* text_ = nullptr;
  std::size_t length_ = 0;
  std::FILE* errors_;
  std::vector<double> coordinates_;
  qhT qh_{};
  bool failed_ = false;
};

Vector3 MeanOf(std::span<const Vector3> points)
{
  Vector3 sum = Vector3::Zero();
  for (const Vector3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

double SizeOf(std::span<const Vector3> points)
{
  Eigen::AlignedBox3d box;
  for (const Vector3& point : points) box.extend(point);
  return box.sizes().maxCoeff();
}

// Returns twice the area of a loop times its normal (M. E. Newell), in any position.
Vector3 NewellNormal(const Loop& loop, const std::vector<Vector3>& corners)
{
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k < loop.size(); ++k)
    sum += (corners[loop[k]] - corners[loop[0]]).cross(corners[loop[(k + 1) % loop.size()]] - corners[loop[0]]);
  return sum;
}

void AddFaces(std::vector<Loop> loops, ConvexHull& hull)
{
  const Vector3 inside = MeanOf(hull.corners);
  for (Loop& loop : loops)
  {
    Vector3 normal = NewellNormal(loop, hull.corners);
    if (normal.dot(hull.corners[loop[0]] - inside) < 0)
    {
      std::reverse(loop.begin() + 1, loop.end());
      normal = -normal;
    }
    ConvexHull::Face face;
    face.normal = normal / std::sqrt(normal.squaredNorm());
    face.distance = -std::numeric_limits<double>::infinity();
    for (const Vector3& corner : hull.corners) face.distance = std::max(face.distance, face.normal.dot(corner));
    face.corners = std::move(loop);
    hull.faces.push_back(std::move(face));
  }
}

// Adds the edges. Returns false if the faces do not close.
bool AddEdges(ConvexHull& hull)
{
  // The key is an edge in the direction in which a face runs through it; the value is that face.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> face_beside;
  for (std::uint32_t f = 0; f < hull.faces.size(); ++f)
  {
    const Loop& loop = hull.faces[f].corners;
    for (std::size_t k = 0; k < loop.size(); ++k)
      if (!face_beside.emplace(std::pair(loop[k], loop[(k + 1) % loop.size()]), f).second) return false;
  }
  for (const auto& [edge, face] : face_beside)
  {
    const auto back = face_beside.find({edge.second, edge.first});
    if (back == face_beside.end()) return false;
    if (edge.first < edge.second) hull.edges.push_back({{edge.first, edge.second}, {face, back->second}});
  }
  return true;
}

void AddMass(ConvexHull& hull)
{
  const Vector3 apex = MeanOf(hull.corners);
  double six_volumes = 0;
  Vector3 first = Vector3::Zero();                   // 24 times the integral of x
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // 120 times the integral of x times x
  for (const ConvexHull::Face& face : hull.faces)
  {
    for (std::size_t k = 2; k < face.corners.size(); ++k)
    {
      const Vector3 a = hull.corners[face.corners[0]] - apex;
      const Vector3 b = hull.corners[face.corners[k - 1]] - apex;
      const Vector3 c = hull.corners[face.corners[k]] - apex;
      const double six = a.dot(b.cross(c));
      const Vector3 sum = a + b + c;
      six_volumes += six;
      first += six * sum;
      second += six * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
  }
  hull.volume = six_volumes / 6;
  const Vector3 centre = first / (4 * six_volumes);
  hull.centre = apex + centre;
  const Eigen::Matrix3d about_centre = second / 120 - hull.volume * centre * centre.transpose();
  hull.inertia = about_centre.trace() * Eigen::Matrix3d::Identity() - about_centre;
}

// Returns the farthest points in directions that are spread evenly over the sphere (a spiral by the golden angle).
std::vector<Vector3> FarthestPoints(const std::vector<Vector3>& points)
{
  std::vector<Vector3> directions;
  for (const Eigen::Index axis : {0, 1, 2})
    for (const double side : {1.0, -1.0}) directions.push_back(side * Vector3::Unit(axis));
  const std::size_t spiral = kMostHullCorners - directions.size();
  for (std::size_t k = 0; k < spiral; ++k)
  {
    const double z = 1 - (2 * static_cast<double>(k) + 1) / static_cast<double>(spiral);
    const double across = std::sqrt(1 - z * z);
    const SinCos turn = SinCosOf(2.399963229728653 * static_cast<double>(k));
    directions.emplace_back(across * turn.cos, across * turn.sin, z);
  }
  std::vector<std::size_t> chosen;
  for (const Vector3& direction : directions)
  {
    std::size_t farthest = 0;
    for (std::size_t k = 1; k < points.size(); ++k)
      if (direction.dot(points[k]) > direction.dot(points[farthest])) farthest = k;
    chosen.push_back(farthest);
  }
  std::ranges::sort(chosen);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  std::vector<Vector3> few;
  for (const std::size_t k : chosen) few.push_back(points[k]);
  return few;
}

// Returns whether the points span more than a plane, line or point.
bool FillSpace(std::span<const Vector3> points, double size)
{
  const auto farthest = [&](const auto& distance_of)
  {
    Vector3 best = points[0];
    for (const Vector3& point : points)
      if (distance_of(point) > distance_of(best)) best = point;
    return best;
  };
  const Vector3 a = points[0];
  const Vector3 b = farthest([&](const Vector3& p) { return (p - a).squaredNorm(); });
  const Vector3 c = farthest([&](const Vector3& p) { return (p - a).cross(b - a).squaredNorm(); });
  const Vector3 normal = (b - a).cross(c - a);
  const double length = std::sqrt(normal.squaredNorm());
  if (!(length > kFlattest * size * size)) return false;
  double low = 0;
  double high = 0;
  for (const Vector3& point : points)
  {
    const double height = normal.dot(point - a) / length;
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return high - low > kFlattest * size;
}

// Drops the points that belong to no face.
std::vector<Loop> Renumbered(std::vector<Loop> loops, std::span<const Vector3> points, std::vector<Vector3>& corners)
{
  std::map<std::uint32_t, std::uint32_t> numbers;
  for (const Loop& loop : loops)
    for (const std::uint32_t point : loop) numbers.emplace(point, 0);
  for (auto& [point, number] : numbers)
  {
    number = static_cast<std::uint32_t>(corners.size());
    corners.push_back(points[point]);
  }
  for (Loop& loop : loops)
    for (std::uint32_t& point : loop) point = numbers.at(point);
  return loops;
}

}  // namespace

double ConvexHull::DepthOf(const Vector3& point) const
{
  double depth = std::numeric_limits<double>::infinity();
  for (const Face& face : faces) depth = std::min(depth, face.distance - face.normal.dot(point));
  return depth;
}

ConvexHull HullOf(std::span<const Vector3> points)
{
  if (points.size() < 4) throw std::invalid_argument("a body needs at least four corners");
  for (const Vector3& point : points)
    if (!point.allFinite()) throw std::invalid_argument("a corner is at no place");
  const double size = SizeOf(points);
  if (!(size > 0) || !FillSpace(points, size)) throw std::invalid_argument("its corners lie in one plane");

  Quickhull quickhull(points, size);
  if (quickhull.Failed()) throw std::invalid_argument("its corners make no hull");
  ConvexHull hull;
  std::vector<Loop> loops = Renumbered(quickhull.Faces(), points, hull.corners);
  if (hull.corners.size() > kMostHullCorners) return HullOf(FarthestPoints(hull.corners));
  AddFaces(std::move(loops), hull);
  if (!AddEdges(hull)) throw std::invalid_argument("its corners make no closed hull");
  AddMass(hull);
  return hull;
}

}  // namespace swarmanoid
