// Problem: for each robot, find the coloured sources in the field of view that no body hides.
//
// Method: sources are collected from the bodies around the eye and from those on no movable body. A test of the cone of
// view comes before the lines of sight, since it is cheaper. For an upright robot that looks straight down, everything
// is computed along the axes of the space, and only what is visible is turned into the robot's axes. Angles and
// distances are computed for the blobs of many robots at once.
//
// Invariant: blobs come in the order of the sources, whatever is hidden, so that controllers see a fixed order.
#include "controller_host/devices/cameras/colour_camera.h"

#include <algorithm>

#include "common/math/elementary.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

// Returns whether a place is in a round view straight down.
inline bool IsBelow(double x, double y, double z, double tangent, double square_range)
{
  const double border = z * tangent;
  const double square = x * x + y * y;
  return (z < 0) & (square <= border * border) & (square <= square_range);
}

// Returns whether a place is in a square view.
inline bool IsInSquare(double x, double y, double z, double half_side, double eye_height)
{
  return (__builtin_fabs(x) < half_side) & (__builtin_fabs(y) < half_side) & (z < eye_height);
}

constexpr double kDiagonal = 1.4142135623730951;  // of a square, times its half side

}  // namespace

void ColourCamera::InitCamera(const DeviceSetup& setup, CameraModel model)
{
  model.aperture = DegreesToRadians(setup.parameters.Number("aperture"));
  model.range = setup.parameters.Number("range");
  model_ = model;
  space_ = &setup.space;
  robots_ = setup.robots;
  const SinCos aperture = SinCosOf(model.aperture);
  tangent_ = aperture.sin / aperture.cos;
  world_ = SensorWorld::Of(setup.space);
  sources_ = BlobSources::Of(world_);
  const double farthest = model.is_square ? kDiagonal * model.range : model.range;
  lines_ = std::make_unique<SightLines>(*world_, farthest + BlobSources::kStandOut);
  place_of_entity_.assign(setup.space.Size(), -1);
  for (std::size_t k = 0; k < robots_.size(); ++k) place_of_entity_[robots_[k]] = static_cast<std::int32_t>(k);
  InitDemand(robots_.size());
}

double ColourCamera::Reach() const
{
  // A camera that looks down sees the farther the more it is tilted and the higher it is.
  const auto stays_upright = [&](std::uint32_t robot)
  {
    return std::ranges::all_of(space_->GetExperiment().engines, [&](const EngineConfiguration& engine)
                               { return IsPlane(engine) || !std::ranges::binary_search(engine.entities, robot); });
  };
  if (sources_->HasLasers()) return kReachesEverywhere;
  if (model_.view == CameraModel::View::kDown && !std::ranges::all_of(robots_, stays_upright))
    return kReachesEverywhere;
  return model_.eye.norm() + (model_.is_square ? kDiagonal * model_.range : model_.range) + BlobSources::kStandOut;
}

void ColourCamera::RefreshShared(WorkerPool* pool)
{
  world_->Refresh(pool);
  sources_->Refresh();
}

void ColourCamera::MakeDue()
{
  // The order is that of the grid's cells, so that neighbours stay in the cache. Every robot has a body.
  for (const std::uint32_t entity : world_->Grid().Sorted())
    if (const std::int32_t k = place_of_entity_[entity]; k >= 0 && IsDue(static_cast<std::size_t>(k)))
      Look(static_cast<std::size_t>(k));
  ExtractAll();
}

bool ColourCamera::MakeAlone(std::size_t k)
{
  Look(k);
  ExtractAll();
  return true;
}

void ColourCamera::Seen::Reserve(std::size_t more)
{
  if (x.size() >= count + more + kLanes) return;
  for (std::vector<double>* values : {&x, &y, &z, &angle, &distance}) values->resize(2 * (count + more) + kLanes);
  source.resize(x.size());
}

ColourCamera::View ColourCamera::ViewOf(std::uint32_t robot) const
{
  const PoseArrays& poses = space_->Poses();
  View view;
  view.is_upright = IsUpright(poses, robot);
  view.heading = HeadingOf(poses, robot);
  if (view.is_upright && model_.view == CameraModel::View::kDown)
  {
    view.eye = Vector3(poses.x[robot], poses.y[robot], poses.z[robot]) + model_.eye;  // on the axis of the robot
    return view;
  }
  const Pose pose = space_->GetPose(robot);
  view.eye = pose.Apply(model_.eye);
  view.to_body = pose.orientation.toRotationMatrix().transpose();
  return view;
}

void ColourCamera::Look(std::size_t k)
{
  const std::uint32_t robot = robots_[k];
  View view = ViewOf(robot);
  const bool is_down = model_.view == CameraModel::View::kDown;
  if (model_.view == CameraModel::View::kTurned) axis_ = AxisOf(k);

  // A tilted camera sees farther to one side, down to the floor at most.
  double reach = model_.range;
  if (view.is_upright && is_down)
    reach = std::min(reach, std::max(view.eye.z() - sources_->LowestHeight(), 0.0) * tangent_);
  if (!view.is_upright && is_down)
  {
    const double cosine = std::min(__builtin_fabs(view.to_body(2, 2)), 1.0);
    reach += std::max(view.eye.z(), 0.0) * __builtin_sqrt(1 - cosine * cosine) / std::max(cosine, 0.1);
  }

  if (model_.is_square)
  {
    view.half_side = std::min(std::max(view.eye.z(), 0.0) * tangent_, model_.range);
    reach = kDiagonal * view.half_side;
  }

  const std::size_t first = seen_.count;
  lines_->LookFrom(robot, view.eye, reach + BlobSources::kStandOut);
  if (view.is_upright && is_down)
    LookDown(view);
  else
    LookAnywhere(view);
  if (sources_->HasCones()) KeepWithinCones(first, view.eye);
  viewed_.push_back({k, seen_.count});
  constexpr std::size_t kManyAtATime = 128;
  if (seen_.count >= kManyAtATime) ExtractAll();
}

// Computes the angles of many blobs at a time, since the steps for one blob depend on each other.
void ColourCamera::ExtractAll()
{
  // The loops run over whole lanes, since the values after the last blob do no harm.
  const std::size_t count = (seen_.count + kLanes - 1) / kLanes * kLanes;
  seen_.Reserve(kLanes);
  const double* const x = seen_.x.data();
  const double* const y = seen_.y.data();
  double* const distance = seen_.distance.data();
  Atan2Each({y, count}, {x, count}, {seen_.angle.data(), count});
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) distance[i] = __builtin_sqrt(x[i] * x[i] + y[i] * y[i]);
  Measure(seen_);

  std::size_t first = 0;
  for (const Viewed& viewed : viewed_)
  {
    Extract(viewed.k, seen_, first, viewed.behind);
    first = viewed.behind;
  }
  viewed_.clear();
  seen_.count = 0;
}

inline bool ColourCamera::IsInView(const Vector3& place) const
{
  if (model_.view == CameraModel::View::kDown)
    return IsBelow(place.x(), place.y(), place.z(), tangent_, model_.range * model_.range);
  if (model_.view == CameraModel::View::kTurned)
  {
    const double along = place.dot(axis_);
    const double border = along * tangent_;
    const double square = place.squaredNorm();
    return along > 0 && square - along * along <= border * border && square <= model_.range * model_.range;
  }
  const double border = place.x() * tangent_;
  const double beside = place.y() * place.y() + place.z() * place.z();
  return place.x() > 0 && beside <= border * border && place.squaredNorm() <= model_.range * model_.range;
}

// Keeps a source that is in view; there is room.
inline void ColourCamera::Add(std::size_t source, const View& view)
{
  const Vector3 offset = sources_->Source(source).position - view.eye;
  const Heading& heading = view.heading;
  Vector3 place;
  if (view.is_upright)
    place = {heading.cos * offset.x() + heading.sin * offset.y(), heading.cos * offset.y() - heading.sin * offset.x(),
             offset.z()};
  else
    place = view.to_body * offset;
  const std::size_t i = seen_.count;
  seen_.x[i] = place.x();
  seen_.y[i] = place.y();
  seen_.z[i] = place.z();
  seen_.source[i] = static_cast<std::uint32_t>(source);
  seen_.count +=
      model_.is_square ? IsInSquare(offset.x(), offset.y(), offset.z(), view.half_side, view.eye.z()) : IsInView(place);
}

// Writes the sources that are in view behind `first`, and their points for the lines of sight. Returns their number.
template <class IsIn>
std::size_t ColourCamera::KeepInView(std::span<const std::int32_t> found, const View& view, std::size_t first,
                                     const IsIn& is_in)
{
  SightPoints& points = lines_->Points();
  double* const xs = seen_.x.data() + first;
  double* const ys = seen_.y.data() + first;
  double* const zs = seen_.z.data() + first;
  std::uint32_t* const numbers = seen_.source.data() + first;
  std::int32_t* const owners = points.owner.data();
  const BlobSource* const sources = sources_->All().data();
  const double eye_x = view.eye.x(), eye_y = view.eye.y(), eye_z = view.eye.z();
  std::size_t count = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const auto number = static_cast<std::uint32_t>(found[i]);
    const BlobSource& source = sources[number];
    const double x = source.position.x() - eye_x;
    const double y = source.position.y() - eye_y;
    const double z = source.position.z() - eye_z;
    xs[count] = x;
    ys[count] = y;
    zs[count] = z;
    numbers[count] = number;
    owners[count] = static_cast<std::int32_t>(source.owner);
    count += static_cast<std::size_t>(is_in(x, y, z, i));
  }
  return count;
}

// The camera looks straight down from an upright robot. Only the visible blobs are turned into the robot's axes.
void ColourCamera::LookDown(const View& view)
{
  const std::size_t near = sources_->Collect(lines_->PlacesAround(), found_);
  const std::size_t first_free = near - sources_->Free().size();
  const std::size_t first = seen_.count;
  seen_.Reserve(near);
  SightPoints& points = lines_->Points();
  if (points.x.size() < near + kLanes) points.Reserve(2 * near);
  double* const xs = seen_.x.data() + first;
  double* const ys = seen_.y.data() + first;
  double* const zs = seen_.z.data() + first;
  const std::int32_t* const owners = points.owner.data();
  const double tangent = tangent_, square_range = model_.range * model_.range;
  const double half_side = view.half_side, eye_height = view.eye.z();
  const std::span<const std::int32_t> found(found_.data(), near);
  // The free ones are few: the lines of sight are for all.
  const std::size_t count = model_.is_square
                                ? KeepInView(found, view, first,
                                             [&](double x, double y, double z, std::size_t)
                                             { return IsInSquare(x, y, z, half_side, eye_height); })
                                : KeepInView(found, view, first,
                                             [&](double x, double y, double z, std::size_t i)
                                             { return IsBelow(x, y, z, tangent, square_range) | (i >= first_free); });
  float* const point_x = points.x.data();
  float* const point_y = points.y.data();
  float* const point_z = points.z.data();
  const std::size_t whole = (count + kLanes - 1) / kLanes * kLanes;
#pragma GCC ivdep
  for (std::size_t i = 0; i < whole; ++i)
  {
    point_x[i] = static_cast<float>(xs[i]);
    point_y[i] = static_cast<float>(ys[i]);
    point_z[i] = static_cast<float>(zs[i]);
  }
  // The spots of lasers come last.
  for (std::size_t i = count; i-- > 0 && owners[i] == static_cast<std::int32_t>(SightLines::kNobody);)
  {
    const Vector3 end = SightLines::InFrontOf({xs[i], ys[i], zs[i]});
    point_x[i] = static_cast<float>(end.x());
    point_y[i] = static_cast<float>(end.y());
    point_z[i] = static_cast<float>(end.z());
  }
  points.count = count;
  KeepSeen(first);
  if (!model_.is_square) KeepFreeInView(first);

  const double cosine = view.heading.cos, sine = view.heading.sin;
#pragma GCC ivdep
  for (std::size_t i = 0; i < (seen_.count - first + kLanes - 1) / kLanes * kLanes; ++i)
  {
    const double ahead = cosine * xs[i] + sine * ys[i];
    ys[i] = cosine * ys[i] - sine * xs[i];
    xs[i] = ahead;
  }
}

void ColourCamera::LookAnywhere(const View& view)
{
  const std::size_t near = sources_->Collect(lines_->PlacesAround(), found_);
  const std::size_t first = seen_.count;
  seen_.Reserve(near);
  for (std::size_t i = 0; i < near; ++i) Add(static_cast<std::size_t>(found_[i]), view);
  for (std::size_t i = first; i < seen_.count; ++i)
  {
    const BlobSource& source = sources_->Source(seen_.source[i]);
    const Vector3 offset = source.position - view.eye;
    lines_->AddPoint(source.owner == SightLines::kNobody ? SightLines::InFrontOf(offset) : offset, source.owner);
  }
  KeepSeen(first);
}

// The points of the lines of sight correspond to the blobs from `first` on.
void ColourCamera::KeepSeen(std::size_t first)
{
  const std::size_t count = lines_->Points().count;
  const SeenPoints& seen = lines_->Solve();
  auto* const source = reinterpret_cast<std::int32_t*>(seen_.source.data());
  std::size_t kept = first;
  for (std::size_t i = 0; i < count; i += kLanes)
  {
    const Selection selection(seen.Group(i));
    for (double* const values : {seen_.x.data(), seen_.y.data(), seen_.z.data()})
      selection.Store(values + first + i, values + kept);
    selection.Store(LoadLanes(source + first + i), source + kept);
    kept += selection.Count();
  }
  seen_.count = kept;
}

// LEDs that look elsewhere are left out.
void ColourCamera::KeepWithinCones(std::size_t first, const Vector3& eye)
{
  std::size_t kept = first;
  for (std::size_t i = first; i < seen_.count; ++i)
  {
    for (double* const values : {seen_.x.data(), seen_.y.data(), seen_.z.data()}) values[kept] = values[i];
    seen_.source[kept] = seen_.source[i];
    kept += static_cast<std::size_t>(sources_->IsSeenFrom(eye, seen_.source[i]));
  }
  seen_.count = kept;
}

void ColourCamera::KeepFreeInView(std::size_t first)
{
  std::size_t kept = seen_.count;
  while (kept > first && seen_.source[kept - 1] >= sources_->FirstFree()) --kept;
  for (std::size_t i = kept; i < seen_.count; ++i)
  {
    for (double* const values : {seen_.x.data(), seen_.y.data(), seen_.z.data()}) values[kept] = values[i];
    seen_.source[kept] = seen_.source[i];
    kept += static_cast<std::size_t>(IsInView({seen_.x[i], seen_.y[i], seen_.z[i]}));
  }
  seen_.count = kept;
}

}  // namespace swarmanoid
