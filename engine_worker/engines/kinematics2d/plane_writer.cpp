#include "engine_worker/engines/kinematics2d/plane_writer.h"

#include <algorithm>

namespace swarmanoid
{

PlaneWriter::PlaneWriter(const PlaneFrame& frame, std::vector<PlaneStance> stances)
    : frame_(frame.Frame()), stances_(std::move(stances))
{
  const auto upright = [](const Quaternion& q) { return q.x() == 0 && q.y() == 0 && q.z() == 0; };
  flat_ = upright(frame_.orientation) && std::all_of(stances_.begin(), stances_.end(),
                                                     [&](const PlaneStance& stance) { return upright(stance.lean); });
}

void PlaneWriter::Write(const kinematics2d::PoseStore& bodies, std::span<double> poses, WorkerPool* pool) const
{
  InParts(pool, stances_.size(), kinematics2d::kPadding,
          [&](unsigned, std::size_t begin, std::size_t end)
          {
            if (flat_)
              WriteFlat(bodies, begin, end, poses.data());
            else
              WriteSome(bodies, begin, end, poses.data());
          });
}

void PlaneWriter::WriteSome(const kinematics2d::PoseStore& bodies, std::size_t begin, std::size_t end,
                            double* poses) const
{
  const std::size_t count = stances_.size();
  for (std::size_t k = begin; k < end; ++k)
  {
    const Vector3 local(bodies.x[k], bodies.y[k], stances_[k].height);
    const Vector3 position = frame_.Apply(local);
    const Quaternion orientation = frame_.orientation * (Quaternion(bodies.w[k], 0, 0, bodies.z[k]) * stances_[k].lean);
    poses[k] = position.x();
    poses[count + k] = position.y();
    poses[2 * count + k] = position.z();
    poses[3 * count + k] = orientation.x();
    poses[4 * count + k] = orientation.y();
    poses[5 * count + k] = orientation.z();
    poses[6 * count + k] = orientation.w();
  }
}

void PlaneWriter::WriteFlat(const kinematics2d::PoseStore& bodies, std::size_t begin, std::size_t end,
                            double* poses) const
{
  const std::size_t count = stances_.size();
  for (std::size_t k = begin; k < end; ++k) poses[k] = frame_.position.x() + bodies.x[k];
  for (std::size_t k = begin; k < end; ++k) poses[count + k] = frame_.position.y() + bodies.y[k];
  for (std::size_t k = begin; k < end; ++k) poses[2 * count + k] = frame_.position.z() + stances_[k].height;
  std::fill(poses + 3 * count + begin, poses + 3 * count + end, 0.0);
  std::fill(poses + 4 * count + begin, poses + 4 * count + end, 0.0);
  std::copy_n(bodies.z.data() + begin, end - begin, poses + 5 * count + begin);
  std::copy_n(bodies.w.data() + begin, end - begin, poses + 6 * count + begin);
}

}  // namespace swarmanoid
