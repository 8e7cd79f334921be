#include "controller_host/devices/colour_camera.h"

#include "common/math/elementary.h"

namespace swarmanoid
{

std::vector<ParameterSpec> ColourCamera::ViewParameters(const char* aperture_degrees, const char* range_m)
{
  return {{.name = "aperture",
           .unit = "degrees",
           .default_value = aperture_degrees,
           .description = "Angle between the axis of the camera and the border of its view.",
           .minimum = 0.1,
           .maximum = 89.9},
          {.name = "range",
           .unit = "m",
           .default_value = range_m,
           .description = "Distance beyond which blobs are too small to be extracted.",
           .minimum = 0.001}};
}

void ColourCamera::InitCamera(const DeviceSetup& setup, CameraModel model)
{
  model.aperture = DegreesToRadians(setup.parameters.Number("aperture"));
  model.range = setup.parameters.Number("range");
  model_ = model;
  space_ = &setup.space;
  robots_ = setup.robots;
  stream_ = setup.stream;
  const SinCos aperture = SinCosOf(model.aperture);
  tangent_ = aperture.sin / aperture.cos;
  world_ = SensorWorld::Of(setup.space);
  sources_ = BlobSources::Of(world_);
  lines_ = std::make_unique<SightLines>(*world_, model.range + BlobSources::kStandOut);
  place_of_entity_.assign(setup.space.Size(), -1);
  for (std::size_t k = 0; k < robots_.size(); ++k) place_of_entity_[robots_[k]] = static_cast<std::int32_t>(k);
}

void ColourCamera::Update(const ChannelView&)
{
  world_->Refresh();
  sources_->Refresh();
  // In the order of the grid's cells: neighbours stay in the cache. Every robot has a body.
  for (const std::uint32_t entity : world_->Grid().Sorted())
    if (const std::int32_t k = place_of_entity_[entity]; k >= 0) Look(static_cast<std::size_t>(k));
}

void ColourCamera::Look(std::size_t k)
{
  const std::uint32_t robot = robots_[k];
  const Pose pose = space_->GetPose(robot);
  const Vector3 eye = pose.Apply(model_.eye);
  const Eigen::Matrix3d to_body = pose.orientation.toRotationMatrix().transpose();
  const bool upright = IsUpright(space_->Poses(), robot);

  // A tilted camera sees farther to one side, down to the floor at most.
  double reach = model_.range;
  if (upright && model_.view == CameraModel::View::kDown)
    reach = std::min(reach, std::max(eye.z() - sources_->LowestHeight(), 0.0) * tangent_);
  if (!upright && model_.view == CameraModel::View::kDown)
  {
    const double cosine = std::min(__builtin_fabs(to_body(2, 2)), 1.0);
    reach += std::max(eye.z(), 0.0) * __builtin_sqrt(1 - cosine * cosine) / std::max(cosine, 0.1);
  }

  lines_->LookFrom(robot, eye, reach + BlobSources::kStandOut);
  const bool is_level_down = upright && model_.view == CameraModel::View::kDown;
  const View view{eye, to_body, HeadingOf(space_->Poses(), robot), upright};
  count_ = 0;
  if (is_level_down)
    LookDown(robot, view, reach);
  else
    LookAnywhere(view);

  if (x_.size() < count_)
    for (std::vector<double>* values : {&x_, &y_, &angle_}) values->resize(2 * count_);
  for (std::size_t i = 0; i < count_; ++i)
  {
    x_[i] = seen_[i].place.x();
    y_[i] = seen_[i].place.y();
  }
  Atan2Each({y_.data(), count_}, {x_.data(), count_}, {angle_.data(), count_});
  for (std::size_t i = 0; i < count_; ++i) seen_[i].angle = angle_[i];
  Extract(k, {seen_.data(), count_});
}

inline bool ColourCamera::IsInView(const Vector3& place) const
{
  if (model_.view == CameraModel::View::kDown)
  {
    const double border = -place.z() * tangent_;
    const double square = place.x() * place.x() + place.y() * place.y();
    return place.z() < 0 && square <= border * border && square <= model_.range * model_.range;
  }
  const double border = place.x() * tangent_;
  const double beside = place.y() * place.y() + place.z() * place.z();
  return place.x() > 0 && beside <= border * border && place.squaredNorm() <= model_.range * model_.range;
}

// Keeps a source that is in view.
inline void ColourCamera::Add(const BlobSource& source, const View& view)
{
  if (count_ == seen_.size()) seen_.resize(2 * count_ + 16);
  Seen& seen = seen_[count_];
  seen.offset = source.position - view.eye;
  const Vector3& offset = seen.offset;
  const Heading& heading = view.heading;
  if (view.is_upright)
    seen.place = {heading.cos * offset.x() + heading.sin * offset.y(),
                  heading.cos * offset.y() - heading.sin * offset.x(), offset.z()};
  else
    seen.place = view.to_body * offset;
  seen.colour = source.colour;
  seen.owner = source.owner;
  if (IsInView(seen.place)) ++count_;
}

// Upright, with the axis straight down: the search for sources tests the view too, several at a time.
void ColourCamera::LookDown(std::uint32_t robot, const View& view, double reach)
{
  SightPoints& points = lines_->Points();
  sources_->CollectBelow(view.eye, reach, tangent_, robot, points, found_);
  const std::size_t on_bodies = points.count;
  for (const BlobSource& source : sources_->Free()) lines_->AddPoint(source.position - view.eye, source.owner);
  const std::span<const char> seen = lines_->Solve();
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (seen[i])
      Add(i < on_bodies ? sources_->Source(static_cast<std::size_t>(found_[i])) : sources_->Free()[i - on_bodies],
          view);
}

void ColourCamera::LookAnywhere(const View& view)
{
  for (const std::int32_t place : lines_->PlacesAround())
    for (const BlobSource& source : sources_->At(static_cast<std::uint32_t>(place))) Add(source, view);
  for (const BlobSource& source : sources_->Free()) Add(source, view);
  for (std::size_t i = 0; i < count_; ++i) lines_->AddPoint(seen_[i].offset, seen_[i].owner);
  const std::span<const char> seen = lines_->Solve();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i)
    if (seen[i]) seen_[kept++] = seen_[i];
  count_ = kept;
}

}  // namespace swarmanoid
