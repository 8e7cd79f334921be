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
  lines_ = std::make_unique<SightLines>(*world_, model.range);
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
  if (!upright && model_.view == CameraModel::View::kDown)
  {
    const double cosine = std::min(__builtin_fabs(to_body(2, 2)), 1.0);
    reach += std::max(eye.z(), 0.0) * __builtin_sqrt(1 - cosine * cosine) / std::max(cosine, 0.1);
  }

  candidates_.clear();
  lines_->LookFrom(robot, eye, reach);
  const auto consider = [&](const BlobSource& source)
  {
    const Vector3 offset = source.position - eye;
    const double away = offset.x() * offset.x() + offset.y() * offset.y();
    if (away > reach * reach) return;
    const Vector3 place = to_body * offset;
    if (model_.view == CameraModel::View::kDown)
    {
      const double border = -place.z() * tangent_;
      const double square = place.x() * place.x() + place.y() * place.y();
      if (place.z() >= 0 || square > border * border || square > model_.range * model_.range) return;
    }
    else
    {
      const double border = place.x() * tangent_;
      const double beside = place.y() * place.y() + place.z() * place.z();
      if (place.x() <= 0 || beside > border * border || offset.squaredNorm() > model_.range * model_.range) return;
    }
    lines_->AddPoint(offset, source.owner);
    candidates_.push_back({place, source.colour, 0});
  };
  for (const SightLines::Neighbour& neighbour : lines_->Around())
    for (const BlobSource& source : sources_->On(neighbour.entity)) consider(source);
  for (const BlobSource& source : sources_->Free()) consider(source);

  const std::span<const char> seen = lines_->Solve();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < candidates_.size(); ++i)
    if (seen[i]) candidates_[kept++] = candidates_[i];
  if (x_.size() < kept)
    for (std::vector<double>* values : {&x_, &y_, &angle_}) values->resize(2 * kept);
  for (std::size_t i = 0; i < kept; ++i)
  {
    x_[i] = candidates_[i].place.x();
    y_[i] = candidates_[i].place.y();
  }
  Atan2Each({y_.data(), kept}, {x_.data(), kept}, {angle_.data(), kept});
  for (std::size_t i = 0; i < kept; ++i) candidates_[i].angle = angle_[i];
  Extract(k, {candidates_.data(), kept});
}

}  // namespace swarmanoid
