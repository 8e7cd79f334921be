// Problem: ODE knows no map of solid cells, and its heightfield lies on its side.
//
// Method: a height terrain becomes an ODE heightfield that is turned upright. A map of cells becomes a class of geoms
// of our own. Spheres and capsules meet its cells one by one (voxel_contacts.h). Bodies with flat faces meet boxes that
// cells around them were merged to, and contacts on covered faces are dropped. Rays walk through the cells.
//
// Invariant: contacts beyond ODE's room for them are the shallowest.
#include "engine_worker/engines/dynamics3d/terrain_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "common/math/elementary.h"
#include "engine_worker/engines/dynamics3d/collide.h"
#include "engine_worker/engines/dynamics3d/voxel_contacts.h"

namespace swarmanoid::dynamics3d
{
namespace
{

// ODE works in memory of the geom and of its heights, so that each copy has both.
class HeightfieldShape : public TerrainShape
{
public:
  HeightfieldShape(const HeightTerrain& terrain, const Pose& pose);
  ~HeightfieldShape() override;
  HeightfieldShape(const HeightfieldShape&) = delete;
  HeightfieldShape& operator=(const HeightfieldShape&) = delete;
  dGeomID MakeGeom();

private:
  Vector3 low_, high_;
  int columns_, rows_;
  std::vector<double> heights_;
  RawPose pose_;
  std::mutex mutex_;  // of copies_
  std::vector<dHeightfieldDataID> copies_;
};

struct VoxelShape : public TerrainShape
{
  VoxelShape(std::shared_ptr<const VoxelTerrain> solid, const Pose& in_engine)
      : terrain(std::move(solid)), pose(in_engine), inverse(in_engine.Inverse())
  {
  }

  std::shared_ptr<const VoxelTerrain> terrain;  // shared with the other roles of the process
  Pose pose;
  Pose inverse;
};

// The memory that a thread works in.
struct VoxelWork
{
  VoxelWork() : box(dCreateBox(nullptr, 1, 1, 1)) {}
  ~VoxelWork() { dGeomDestroy(box); }
  VoxelWork(const VoxelWork&) = delete;
  VoxelWork& operator=(const VoxelWork&) = delete;

  dGeomID box;  // stands for one box of cells after the other
  std::vector<VoxelContact> found;
  std::vector<CellBox> boxes;
  std::vector<bool> taken;
};

VoxelWork& WorkOfThread()
{
  thread_local VoxelWork work;
  return work;
}

// ODE's heightfield lies in its x-z plane with y up and its middle at the origin: turned upright, its rows run towards
// -y.
HeightfieldShape::HeightfieldShape(const HeightTerrain& terrain, const Pose& pose)
    : low_(terrain.Low()), high_(terrain.High()), columns_(terrain.Columns()), rows_(terrain.Rows())
{
  heights_.reserve(terrain.Heights().size());
  for (int row = rows_ - 1; row >= 0; --row)
    for (int column = 0; column < columns_; ++column) heights_.push_back(terrain.Height(column, row));
  const Vector3 size = high_ - low_;
  pose_ = RawOf(pose.Compose({Vector3(size.x() / 2, size.y() / 2, 0), QuaternionFromEuler({kPi / 2, 0, 0})}));
}

HeightfieldShape::~HeightfieldShape()
{
  for (const dHeightfieldDataID copy : copies_) dGeomHeightfieldDataDestroy(copy);
}

dGeomID HeightfieldShape::MakeGeom()
{
  const dHeightfieldDataID heights = dGeomHeightfieldDataCreate();
  const Vector3 size = high_ - low_;
  const double thickness = 1;  // m below the lowest point that still pushes up
  dGeomHeightfieldDataBuildDouble(heights, heights_.data(), 0, size.x(), size.y(), columns_, rows_, 1, 0, thickness, 0);
  dGeomHeightfieldDataSetBounds(heights, low_.z(), high_.z());
  const dGeomID geom = dCreateHeightfield(nullptr, heights, 1);
  dGeomSetPosition(geom, pose_.position[0], pose_.position[1], pose_.position[2]);
  dGeomSetQuaternion(geom, pose_.quaternion);
  const std::lock_guard lock(mutex_);
  copies_.push_back(heights);
  return geom;
}

VoxelShape& ShapeOf(dGeomID geom) { return **static_cast<VoxelShape* const*>(dGeomGetClassData(geom)); }

// Writes the contacts in the frame of the engine. If there are more than ODE has room for, the deepest ones are kept.
int Hand(const VoxelShape& shape, std::vector<VoxelContact>& found, dGeomID voxels, dGeomID other, int flags,
         dContactGeom* contacts, int skip)
{
  const std::size_t room = static_cast<std::size_t>(flags & 0xffff);
  if (found.size() > room)
  {
    std::stable_sort(found.begin(), found.end(),
                     [](const VoxelContact& a, const VoxelContact& b) { return a.depth > b.depth; });
    found.resize(room);
  }
  char* slot = reinterpret_cast<char*>(contacts);
  for (const VoxelContact& contact : found)
  {
    // The first geom, into which the normal points, is the voxels.
    *reinterpret_cast<dContactGeom*>(slot) = ContactAt(
        shape.pose.Apply(contact.point), -(shape.pose.orientation * contact.normal), contact.depth, voxels, other);
    slot += skip;
  }
  return static_cast<int>(found.size());
}

// The corners of a box of the engine, in the frame of the map, lie between `low` and `high`.
void BoundsInMap(const VoxelShape& shape, const std::array<double, 6>& box, Vector3& low, Vector3& high)
{
  low = Vector3::Constant(dInfinity);
  high = Vector3::Constant(-dInfinity);
  for (int k = 0; k < 8; ++k)
  {
    const Vector3 corner =
        shape.inverse.Apply({box[(k & 1) != 0 ? 1 : 0], box[(k & 2) != 0 ? 3 : 2], box[(k & 4) != 0 ? 5 : 4]});
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
}

CellBox CellsOf(const VoxelShape& shape, const std::array<double, 6>& box)
{
  Vector3 low;
  Vector3 high;
  BoundsInMap(shape, box, low, high);
  return CellsAround(*shape.terrain, low, high);
}

int CollideSphere(dGeomID voxels, dGeomID sphere, int flags, dContactGeom* contacts, int skip)
{
  const VoxelShape& shape = ShapeOf(voxels);
  std::vector<VoxelContact>& found = WorkOfThread().found;
  found.clear();
  FindVoxelContacts(*shape.terrain, shape.inverse.Apply(VectorOf(dGeomGetPosition(sphere))),
                    dGeomSphereGetRadius(sphere), found);
  return Hand(shape, found, voxels, sphere, flags, contacts, skip);
}

// Treats the capsule as a row of spheres. Neighbours are at most a radius apart, or half a cell if that is more.
int CollideCapsule(dGeomID voxels, dGeomID capsule, int flags, dContactGeom* contacts, int skip)
{
  const VoxelShape& shape = ShapeOf(voxels);
  std::vector<VoxelContact>& found = WorkOfThread().found;
  found.clear();
  dReal radius = 0;
  dReal length = 0;
  dGeomCapsuleGetParams(capsule, &radius, &length);
  const dReal* r = dGeomGetRotation(capsule);
  const Vector3 axis(r[2], r[6], r[10]);
  const Vector3 centre = VectorOf(dGeomGetPosition(capsule));
  const int spheres = 1 + static_cast<int>(std::ceil(length / std::max(radius, shape.terrain->CellSize() / 2)));
  for (int k = 0; k < spheres; ++k)
  {
    const double along = spheres > 1 ? length * (static_cast<double>(k) / (spheres - 1) - 0.5) : 0;
    FindVoxelContacts(*shape.terrain, shape.inverse.Apply(centre + axis * along), radius, found);
  }
  return Hand(shape, found, voxels, capsule, flags, contacts, skip);
}

// Finds the contacts of a box, a cylinder or a hull. The cells around it are merged to boxes, so that a floor under it
// is one box.
int CollideConvex(dGeomID voxels, dGeomID body, int flags, dContactGeom* contacts, int skip)
{
  const VoxelShape& shape = ShapeOf(voxels);
  std::vector<VoxelContact>& found = WorkOfThread().found;
  found.clear();
  const VoxelTerrain& terrain = *shape.terrain;
  std::array<double, 6> around;
  dGeomGetAABB(body, around.data());
  Vector3 low;
  Vector3 high;
  BoundsInMap(shape, around, low, high);
  VoxelWork& work = WorkOfThread();
  const RawPose raw = RawOf(shape.pose);
  dGeomSetQuaternion(work.box, raw.quaternion);
  MergeCells(terrain, CellsAround(terrain, low, high), work.taken, work.boxes);
  for (const CellBox& cells : work.boxes)
  {
    const auto corner = [&](const std::array<int, 3>& cell, int more) -> Vector3
    { return terrain.Low() + terrain.CellSize() * Vector3(cell[0] + more, cell[1] + more, cell[2] + more); };
    const Vector3 from = corner(cells.low, 0);
    const Vector3 to = corner(cells.high, 1);
    if ((from.array() > high.array()).any() || (to.array() < low.array()).any()) continue;
    const Vector3 size = to - from;
    const Vector3 centre = shape.pose.Apply((from + to) / 2);
    dGeomBoxSetLengths(work.box, size.x(), size.y(), size.z());
    dGeomSetPosition(work.box, centre.x(), centre.y(), centre.z());
    std::array<dContactGeom, kMaximumContacts> touching;
    const int count = Collide(work.box, body, touching);
    for (const dContactGeom& contact : std::span(touching).first(static_cast<std::size_t>(count)))
    {
      const Vector3 point = shape.inverse.Apply(VectorOf(contact.pos));
      const Vector3 normal = shape.inverse.orientation * -VectorOf(contact.normal);
      if (!IsCovered(terrain, cells, point, normal)) found.push_back({point, normal, contact.depth});
    }
  }
  return Hand(shape, found, voxels, body, flags, contacts, skip);
}

int CollideRay(dGeomID voxels, dGeomID ray, int, dContactGeom* contacts, int)
{
  const VoxelShape& shape = ShapeOf(voxels);
  dVector3 start;
  dVector3 direction;
  dGeomRayGet(ray, start, direction);
  const Vector3 from = VectorOf(start);
  const Vector3 along = VectorOf(direction);
  const double length = dGeomRayGetLength(ray);
  const auto hit = shape.terrain->SegmentHit(shape.inverse.Apply(from), shape.inverse.Apply(from + along * length));
  if (!hit) return 0;
  const double distance = *hit * length;
  *contacts = ContactAt(from + along * distance, along, distance, voxels, ray);
  return 1;
}

dColliderFn* ColliderWith(int other_class)
{
  if (other_class == dSphereClass) return &CollideSphere;
  if (other_class == dCapsuleClass) return &CollideCapsule;
  if (other_class == dRayClass) return &CollideRay;
  if (other_class == dBoxClass || other_class == dCylinderClass || other_class == dConvexClass) return &CollideConvex;
  return nullptr;
}

void BoxAround(dGeomID geom, dReal box[6])
{
  const VoxelShape& shape = ShapeOf(geom);
  const Vector3 size = shape.terrain->High() - shape.terrain->Low();
  Vector3 low = Vector3::Constant(dInfinity);
  Vector3 high = Vector3::Constant(-dInfinity);
  for (int k = 0; k < 8; ++k)
  {
    const Vector3 corner((k & 1) != 0 ? size.x() : 0, (k & 2) != 0 ? size.y() : 0, (k & 4) != 0 ? size.z() : 0);
    const Vector3 at = shape.pose.Apply(shape.terrain->Low() + corner);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    box[2 * axis] = low[axis];
    box[2 * axis + 1] = high[axis];
  }
}

// ODE keeps its classes for the process; few can be made.
int VoxelClass()
{
  static std::once_flag once;
  static int number = -1;
  std::call_once(once,
                 []
                 {
                   dGeomClass description{};
                   description.bytes = sizeof(VoxelShape*);
                   description.collider = &ColliderWith;
                   description.aabb = &BoxAround;
                   number = dCreateGeomClass(&description);
                 });
  return number;
}

}  // namespace

std::unique_ptr<TerrainShape> AddHeightfield(OdeWorld& world, std::uint32_t entity,
                                             std::shared_ptr<const HeightTerrain> terrain, const Pose& pose)
{
  auto shape = std::make_unique<HeightfieldShape>(*terrain, pose);
  world.BeginEntity(entity);
  world.AddSolid(shape->MakeGeom(), -1, ELayer::kStatic, ESurface::kTerrain);
  world.CopyForWorlds([heights = shape.get()] { return heights->MakeGeom(); });
  return shape;
}

std::unique_ptr<TerrainShape> AddVoxels(OdeWorld& world, std::uint32_t entity,
                                        std::shared_ptr<const VoxelTerrain> terrain, const Pose& pose)
{
  auto shape = std::make_unique<VoxelShape>(std::move(terrain), pose);
  const dGeomID geom = dCreateGeom(VoxelClass());
  *static_cast<VoxelShape**>(dGeomGetClassData(geom)) = shape.get();
  world.BeginEntity(entity);
  world.AddSolid(geom, -1, ELayer::kVoxels, ESurface::kTerrain);
  return shape;
}

double CellSizeOf(dGeomID voxels) { return ShapeOf(voxels).terrain->CellSize(); }

bool ReachesCells(dGeomID voxels, const std::array<double, 6>& box)
{
  const VoxelShape& shape = ShapeOf(voxels);
  const CellBox cells = CellsOf(shape, box);
  for (int z = cells.low[2]; z <= cells.high[2]; ++z)
    for (int y = cells.low[1]; y <= cells.high[1]; ++y)
      for (int x = cells.low[0]; x <= cells.high[0]; ++x)
        if (shape.terrain->IsOccupied(x, y, z)) return true;
  return false;
}

}  // namespace swarmanoid::dynamics3d
