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

class HeightfieldShape : public TerrainShape
{
public:
  HeightfieldShape() : heights_(dGeomHeightfieldDataCreate()) {}
  ~HeightfieldShape() override { dGeomHeightfieldDataDestroy(heights_); }
  HeightfieldShape(const HeightfieldShape&) = delete;
  HeightfieldShape& operator=(const HeightfieldShape&) = delete;
  dHeightfieldDataID Heights() const { return heights_; }

private:
  dHeightfieldDataID heights_;
};

struct VoxelShape : public TerrainShape
{
  VoxelShape(std::shared_ptr<const VoxelTerrain> solid, const Pose& in_engine)
      : terrain(std::move(solid)), pose(in_engine), inverse(in_engine.Inverse()), box(dCreateBox(nullptr, 1, 1, 1))
  {
    const RawPose raw = RawOf(pose);
    dGeomSetQuaternion(box, raw.quaternion);
  }
  ~VoxelShape() override { dGeomDestroy(box); }
  VoxelShape(const VoxelShape&) = delete;
  VoxelShape& operator=(const VoxelShape&) = delete;

  std::shared_ptr<const VoxelTerrain> terrain;  // shared with the other roles of the process
  Pose pose;
  Pose inverse;
  dGeomID box;  // stands for one box of cells after the other
  // Memory to work in.
  std::vector<VoxelContact> found;
  std::vector<CellBox> boxes;
  std::vector<bool> taken;
};

VoxelShape& ShapeOf(dGeomID geom) { return **static_cast<VoxelShape* const*>(dGeomGetClassData(geom)); }

// Contacts with the frame of the engine, the deepest ones if there are too many.
int Hand(VoxelShape& shape, dGeomID voxels, dGeomID other, int flags, dContactGeom* contacts, int skip)
{
  std::vector<VoxelContact>& found = shape.found;
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
    auto& out = *reinterpret_cast<dContactGeom*>(slot);
    const Vector3 point = shape.pose.Apply(contact.point);
    const Vector3 normal = shape.pose.orientation * contact.normal;
    for (int k = 0; k < 3; ++k)
    {
      out.pos[k] = point[k];
      out.normal[k] = -normal[k];  // into the first geom, the voxels
    }
    out.depth = contact.depth;
    out.g1 = voxels;
    out.g2 = other;
    out.side1 = out.side2 = -1;
    slot += skip;
  }
  return static_cast<int>(found.size());
}

int CollideSphere(dGeomID voxels, dGeomID sphere, int flags, dContactGeom* contacts, int skip)
{
  VoxelShape& shape = ShapeOf(voxels);
  shape.found.clear();
  FindVoxelContacts(*shape.terrain, shape.inverse.Apply(VectorOf(dGeomGetPosition(sphere))),
                    dGeomSphereGetRadius(sphere), shape.found);
  return Hand(shape, voxels, sphere, flags, contacts, skip);
}

// A capsule is met as a row of spheres, half a radius apart at most a cell.
int CollideCapsule(dGeomID voxels, dGeomID capsule, int flags, dContactGeom* contacts, int skip)
{
  VoxelShape& shape = ShapeOf(voxels);
  shape.found.clear();
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
    FindVoxelContacts(*shape.terrain, shape.inverse.Apply(centre + axis * along), radius, shape.found);
  }
  return Hand(shape, voxels, capsule, flags, contacts, skip);
}

// A box, a cylinder or a hull meets the cells around it merged to boxes, so that a floor under it is one.
int CollideConvex(dGeomID voxels, dGeomID body, int flags, dContactGeom* contacts, int skip)
{
  VoxelShape& shape = ShapeOf(voxels);
  shape.found.clear();
  const VoxelTerrain& terrain = *shape.terrain;
  dReal around[6];
  dGeomGetAABB(body, around);
  Vector3 low = Vector3::Constant(dInfinity);
  Vector3 high = Vector3::Constant(-dInfinity);
  for (int k = 0; k < 8; ++k)
  {
    const Vector3 corner =
        shape.inverse.Apply({around[(k & 1) != 0 ? 1 : 0], around[(k & 2) != 0 ? 3 : 2], around[(k & 4) != 0 ? 5 : 4]});
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  MergeCells(terrain, CellsAround(terrain, low, high), shape.taken, shape.boxes);
  for (const CellBox& cells : shape.boxes)
  {
    const auto corner = [&](const std::array<int, 3>& cell, int more) -> Vector3
    { return terrain.Low() + terrain.CellSize() * Vector3(cell[0] + more, cell[1] + more, cell[2] + more); };
    const Vector3 from = corner(cells.low, 0);
    const Vector3 to = corner(cells.high, 1);
    if ((from.array() > high.array()).any() || (to.array() < low.array()).any()) continue;
    const Vector3 size = to - from;
    const Vector3 centre = shape.pose.Apply((from + to) / 2);
    dGeomBoxSetLengths(shape.box, size.x(), size.y(), size.z());
    dGeomSetPosition(shape.box, centre.x(), centre.y(), centre.z());
    std::array<dContactGeom, kMaximumContacts> touching;
    const int count = Collide(shape.box, body, touching);
    for (const dContactGeom& contact : std::span(touching).first(static_cast<std::size_t>(count)))
    {
      const Vector3 point = shape.inverse.Apply(VectorOf(contact.pos));
      const Vector3 normal = shape.inverse.orientation * -VectorOf(contact.normal);
      if (!IsCovered(terrain, cells, point, normal)) shape.found.push_back({point, normal, contact.depth});
    }
  }
  return Hand(shape, voxels, body, flags, contacts, skip);
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
  const Vector3 point = from + along * distance;
  for (int k = 0; k < 3; ++k)
  {
    contacts->pos[k] = point[k];
    contacts->normal[k] = along[k];
  }
  contacts->depth = distance;
  contacts->g1 = voxels;
  contacts->g2 = ray;
  contacts->side1 = contacts->side2 = -1;
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
  auto shape = std::make_unique<HeightfieldShape>();
  // ODE's heightfield lies in its x-z plane with y up and its middle at the origin: turned upright, its rows run
  // towards -y.
  const int columns = terrain->Columns();
  const int rows = terrain->Rows();
  std::vector<double> turned;
  turned.reserve(terrain->Heights().size());
  for (int row = rows - 1; row >= 0; --row)
    for (int column = 0; column < columns; ++column) turned.push_back(terrain->Height(column, row));
  const Vector3 size = terrain->High() - terrain->Low();
  const double thickness = 1;  // m below the lowest point that still pushes up
  dGeomHeightfieldDataBuildDouble(shape->Heights(), turned.data(), 1, size.x(), size.y(), columns, rows, 1, 0,
                                  thickness, 0);
  dGeomHeightfieldDataSetBounds(shape->Heights(), terrain->Low().z(), terrain->High().z());

  const dGeomID geom = dCreateHeightfield(nullptr, shape->Heights(), 1);
  const RawPose raw =
      RawOf(pose.Compose({Vector3(size.x() / 2, size.y() / 2, 0), QuaternionFromEuler({kPi / 2, 0, 0})}));
  dGeomSetPosition(geom, raw.position[0], raw.position[1], raw.position[2]);
  dGeomSetQuaternion(geom, raw.quaternion);
  world.BeginEntity(entity);
  world.AddSolid(geom, -1, ELayer::kStatic, ESurface::kTerrain);
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

}  // namespace swarmanoid::dynamics3d
