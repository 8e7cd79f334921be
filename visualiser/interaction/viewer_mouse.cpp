// The actions of the mouse on the camera and on entities.
#include <fmt/format.h>

#include <cmath>

#include "common/math/elementary.h"
#include "common/space/space.h"
#include "visualiser/interaction/viewer.h"
#include "visualiser/scene/picking.h"

namespace swarmanoid
{
namespace
{

constexpr double kClickReach = 4;  // pixels that a click may move
constexpr double kDegreesPerPixel = 0.3;
constexpr double kWheelFactor = 0.88;
constexpr double kWheelTurn = 15;  // degrees that a wheel step turns a moved entity
constexpr double kFarPivot = 10;   // m, if the camera does not look at the floor

}  // namespace

Vector3 Viewer::Pivot() const
{
  if (follows && shown.scene.selected) return Space().GetPose(*shown.scene.selected).position;
  const double size = GetExperiment().arena_size.head<2>().norm();
  const Vector3 floor = PointOnFloor(camera.RayThrough(width_ / 2.0, height_ / 2.0, width_, height_), 0, kFarPivot);
  // A floor point near the horizon is too far away to turn about.
  return (floor - camera.position).norm() < 2 * size + kFarPivot ? floor
                                                                 : camera.position + kFarPivot * camera.Forward();
}

double Viewer::MetresPerPixel(const Vector3& at) const
{
  const double depth = std::max((at - camera.position).dot(camera.Forward()), 0.05);
  return 2 * depth * std::tan(DegreesToRadians(camera.field_of_view) / 2) / height_;
}

void Viewer::MousePress(MouseButton button, double x, double y, bool ctrl, bool shift)
{
  if (drag_ != Drag::kNone) return;
  drag_button_ = button;
  drag_ctrl_ = ctrl;
  drag_x_ = x;
  drag_y_ = y;
  drag_ = button == MouseButton::kLeft ? Drag::kClick : Drag::kPan;
  if (button != MouseButton::kLeft || !shift) return;

  const Ray ray = camera.RayThrough(x, y, width_, height_);
  const std::optional<Pick> pick = PickEntity(Space(), ray);
  if (!pick) return;
  Select(pick->entity);
  StartMove(pick->entity);
}

void Viewer::StartMove(std::uint32_t entity)
{
  drag_ = Drag::kNone;
  const CSwarmanoidSpaceEntity& body = Space().GetEntity(entity);
  if (!CanMove()) return SayWhyNotMoved();
  if (!body.IsMovable()) return Say(fmt::format("'{}' stands fast: it cannot be moved", body.GetId()), true);
  drag_ = Drag::kEntity;
  move_ = Move{entity, body.GetPose()};
  const Ray ray = camera.RayThrough(drag_x_, drag_y_, width_, height_);
  move_offset_ = body.GetPosition() - PointOnFloor(ray, body.GetPosition().z(), kFarPivot);
}

void Viewer::MouseMove(double x, double y)
{
  const double right = x - drag_x_;
  const double down = y - drag_y_;
  if (drag_ == Drag::kClick && std::hypot(right, down) > kClickReach) drag_ = Drag::kOrbit;
  if (drag_ == Drag::kNone || drag_ == Drag::kClick) return;
  drag_x_ = x;
  drag_y_ = y;
  if (drag_ == Drag::kOrbit)
  {
    camera.Orbit(Pivot(), right * kDegreesPerPixel, down * kDegreesPerPixel);
    whole_arena_ = false;
  }
  else if (drag_ == Drag::kPan)
  {
    const double scale = MetresPerPixel(Pivot());
    camera.Pan(-right * scale, down * scale);
    whole_arena_ = false;
  }
  else if (move_)
  {
    Vector3& place = move_->pose.position;
    const double height = place.z();
    const Vector3& arena = GetExperiment().arena_size;
    place = PointOnFloor(camera.RayThrough(x, y, width_, height_), height, kFarPivot) + move_offset_;
    place = Vector3(std::clamp(place.x(), 0.0, arena.x()), std::clamp(place.y(), 0.0, arena.y()), height);
  }
}

void Viewer::MouseRelease(MouseButton button)
{
  if (button != drag_button_) return;
  if (drag_ == Drag::kClick) Click(drag_x_, drag_y_, drag_ctrl_);
  if (drag_ == Drag::kEntity && move_) MoveEntity(move_->entity, move_->pose);
  move_.reset();
  drag_ = Drag::kNone;
}

void Viewer::Click(double x, double y, bool ctrl)
{
  if (const std::optional<Pick> pick = PickEntity(Space(), camera.RayThrough(x, y, width_, height_)))
    Select(pick->entity, ctrl);
  else
    Deselect();
}

void Viewer::Wheel(double notches, double x, double y)
{
  if (move_)
  {
    const double turn = DegreesToRadians(kWheelTurn * notches);
    move_->pose.orientation = (QuaternionFromYaw(turn) * move_->pose.orientation).normalized();
    return;
  }
  // The camera zooms towards the point under the mouse.
  Vector3 at = Pivot();
  if (!follows)
  {
    const double reach = (at - camera.position).norm();
    const Vector3 floor = PointOnFloor(camera.RayThrough(x, y, width_, height_), 0, reach);
    if ((floor - camera.position).norm() < 3 * reach) at = floor;
  }
  camera.Zoom(at, std::pow(kWheelFactor, notches));
  whole_arena_ = false;
}

}  // namespace swarmanoid
