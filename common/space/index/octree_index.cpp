// In large, sparse arenas a grid has mostly empty cells. The tree has leaves of one size, and only where points are.
// The nodes are those of OctoMap (A. Hornung et al., "OctoMap: an efficient probabilistic 3D mapping framework based on
// octrees", Autonomous Robots 34, 2013). A leaf holds the number of its bucket of points. An update compares the key of
// each point with its last one and moves only the points that have changed their leaf.
//
// Invariants: each point is in the bucket of the leaf of its key; no bucket in the tree is empty; a result has the
// entities in ascending order, whatever the order in the buckets.
#include "common/space/index/octree_index.h"

// OctoMap's iterators derive from std::iterator, which Clang reports as deprecated.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
#include <octomap/AbstractOcTree.h>
#include <octomap/OcTreeBaseImpl.h>
#include <octomap/OcTreeDataNode.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cmath>

namespace swarmanoid
{
namespace
{

constexpr std::uint32_t kNoBucket = 0xffffffffU;
constexpr int kDepth = 16;
constexpr double kKeyOrigin = 32768;
constexpr double kLastKey = 65535;
// Measurements showed that leaves of a third of a sensor's usual reach are the fastest.
constexpr double kLeaf = 1.0;

// The value of a leaf is the number of its bucket of points.
class Node : public octomap::OcTreeDataNode<std::uint32_t>
{
public:
  Node() : OcTreeDataNode(kNoBucket) {}
  std::uint32_t Bucket() const { return value; }
  void SetBucket(std::uint32_t bucket) { value = bucket; }
  bool HasChildArray() const { return children != nullptr; }
  // OctoMap does not free the array of a node whose last child was deleted, so this does.
  void FreeChildArray()
  {
    delete[] children;
    children = nullptr;
  }
};

struct Key
{
  std::array<std::uint16_t, 3> k{};
  bool operator==(const Key&) const = default;
};

}  // namespace

class OctreeIndex::Tree : public octomap::OcTreeBaseImpl<Node, octomap::AbstractOcTree>
{
public:
  explicit Tree(double leaf_m) : OcTreeBaseImpl(leaf_m), leaf_(leaf_m) {}
  Tree* create() const override { return new Tree(leaf_); }
  std::string getTreeType() const override { return "SwarmanoidEntityOcTree"; }

  Key KeyOf(double x, double y, double z) const { return {{Axis(x), Axis(y), Axis(z)}}; }

  void Update(const PointArrays& points)
  {
    if (keys_.size() != points.Size()) Rebuild(points);
    for (std::size_t i = 0; i < keys_.size(); ++i)
    {
      const Key key = KeyOf(points.x[i], points.y[i], points.z[i]);
      if (key == keys_[i]) continue;
      Remove(static_cast<std::uint32_t>(i), keys_[i]);
      Insert(static_cast<std::uint32_t>(i), key);
      keys_[i] = key;
    }
  }

  template <class Accept>
  void Collect(const Vector3& low, const Vector3& high, Accept accept, std::vector<std::uint32_t>& found) const
  {
    found.clear();
    if (root == nullptr) return;
    const Key first = KeyOf(low.x(), low.y(), low.z());
    const Key last = KeyOf(high.x(), high.y(), high.z());
    Descend(root, {0, 0, 0}, 1U << kDepth, first, last, accept, found);
    std::sort(found.begin(), found.end());
  }

private:
  std::uint16_t Axis(double coordinate) const
  {
    const double key = std::floor(coordinate / leaf_) + kKeyOrigin;
    if (!(key > 0)) return 0;  // also what is not a number
    return static_cast<std::uint16_t>(std::min(key, kLastKey));
  }

  static unsigned ChildOf(const Key& key, int depth)
  {
    const int bit = kDepth - 1 - depth;
    return ((key.k[0] >> bit) & 1U) | (((key.k[1] >> bit) & 1U) << 1) | (((key.k[2] >> bit) & 1U) << 2);
  }

  void Rebuild(const PointArrays& points)
  {
    clear();
    buckets_.clear();
    free_buckets_.clear();
    keys_.resize(points.Size());
    for (std::size_t i = 0; i < keys_.size(); ++i)
    {
      keys_[i] = KeyOf(points.x[i], points.y[i], points.z[i]);
      Insert(static_cast<std::uint32_t>(i), keys_[i]);
    }
  }

  void Insert(std::uint32_t point, const Key& key)
  {
    if (root == nullptr)
    {
      root = new Node();
      ++tree_size;
    }
    Node* node = root;
    for (int depth = 0; depth < kDepth; ++depth)
    {
      const unsigned child = ChildOf(key, depth);
      node = nodeChildExists(node, child) ? getNodeChild(node, child) : createNodeChild(node, child);
    }
    if (node->Bucket() == kNoBucket) node->SetBucket(NewBucket());
    buckets_[node->Bucket()].push_back(point);
  }

  void Remove(std::uint32_t point, const Key& key)
  {
    std::array<Node*, kDepth + 1> path{};
    path[0] = root;
    for (int depth = 0; depth < kDepth; ++depth) path[depth + 1] = getNodeChild(path[depth], ChildOf(key, depth));

    std::vector<std::uint32_t>& bucket = buckets_[path[kDepth]->Bucket()];
    *std::find(bucket.begin(), bucket.end(), point) = bucket.back();
    bucket.pop_back();
    if (!bucket.empty()) return;

    // Removes an empty leaf, and every node above it that has no other leaf.
    free_buckets_.push_back(path[kDepth]->Bucket());
    for (int depth = kDepth - 1; depth >= 0; --depth)
    {
      deleteNodeChild(path[depth], ChildOf(key, depth));
      if (nodeHasChildren(path[depth])) return;
      path[depth]->FreeChildArray();
    }
  }

  std::uint32_t NewBucket()
  {
    if (!free_buckets_.empty())
    {
      const std::uint32_t bucket = free_buckets_.back();
      free_buckets_.pop_back();
      return bucket;
    }
    buckets_.emplace_back();
    return static_cast<std::uint32_t>(buckets_.size() - 1);
  }

  template <class Accept>
  void Descend(const Node* node, std::array<std::uint32_t, 3> corner, std::uint32_t width, const Key& first,
               const Key& last, Accept& accept, std::vector<std::uint32_t>& found) const
  {
    if (width == 1)
    {
      for (const std::uint32_t point : buckets_[node->Bucket()])
        if (accept(point)) found.push_back(point);
      return;
    }
    if (!node->HasChildArray()) return;
    const std::uint32_t half = width / 2;
    for (unsigned child = 0; child < 8; ++child)
    {
      std::array<std::uint32_t, 3> low = corner;
      bool overlaps = true;
      for (unsigned axis = 0; axis < 3; ++axis)
      {
        low[axis] += ((child >> axis) & 1U) * half;
        overlaps &= low[axis] <= last.k[axis] && low[axis] + half > first.k[axis];
      }
      if (overlaps && nodeChildExists(node, child))
        Descend(getNodeChild(node, child), low, half, first, last, accept, found);
    }
  }

  double leaf_;
  std::vector<Key> keys_;
  std::vector<std::vector<std::uint32_t>> buckets_;
  std::vector<std::uint32_t> free_buckets_;
};

OctreeIndex::OctreeIndex() : leaf_m_(kLeaf), tree_(std::make_unique<Tree>(kLeaf)) {}

OctreeIndex::~OctreeIndex() = default;

void OctreeIndex::Update(const PointArrays& points)
{
  points_ = points;
  tree_->Update(points);
}

void OctreeIndex::FindWithin(const Vector3& centre, double radius, std::vector<std::uint32_t>& found) const
{
  const Vector3 reach = Vector3::Constant(radius);
  const double limit = radius * radius;
  tree_->Collect(
      centre - reach, centre + reach,
      [&](std::uint32_t i)
      {
        const double dx = points_.x[i] - centre.x();
        const double dy = points_.y[i] - centre.y();
        const double dz = points_.z[i] - centre.z();
        return dx * dx + dy * dy + dz * dz <= limit;
      },
      found);
}

void OctreeIndex::FindInBox(const Vector3& low, const Vector3& high, std::vector<std::uint32_t>& found) const
{
  tree_->Collect(
      low, high,
      [&](std::uint32_t i)
      {
        return points_.x[i] >= low.x() && points_.x[i] <= high.x() && points_.y[i] >= low.y() &&
               points_.y[i] <= high.y() && points_.z[i] >= low.z() && points_.z[i] <= high.z();
      },
      found);
}

}  // namespace swarmanoid
