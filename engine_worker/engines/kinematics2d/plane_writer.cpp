#include "engine_worker/engines/kinematics2d/plane_writer.h"

#include <algorithm>

namespace swarmanoid
{

PlaneWriter::PlaneWriter(const PlaneFrame& frame, std::size_t bodies, std::vector<Stance> stances)
    : frame_(frame.Frame()), bodies_(bodies), stances_(std::move(stances))
{
  const auto upright = [](const Quaternion& q) { return q.x() == 0 && q.y() == 0 && q.z() == 0; };
  flat_ = upright(frame_.orientation) && std::all_of(stances_.begin(), stances_.end(),
                                                     [&](const Stance& stance) { return upright(stance.stance.lean); });
}

void PlaneWriter::Write(const kinematics2d::PoseStore& bodies, std::span<double> poses, WorkerPool* pool) const
{
  InParts(pool, bodies_, kinematics2d::kPadding,
          [&](unsigned, std::size_t begin, std::size_t end)
          {
            const auto is_before = [](const Stance& stance, std::size_t body) { return stance.body < body; };
            const auto stance = std::lower_bound(stances_.begin(), stances_.end(), begin, is_before);
            if (flat_)
              WriteFlat(bodies, begin, end, stance, poses.data());
            else
              WriteSome(bodies, begin, end, stance, poses.data());
          });
}

void PlaneWriter::WriteSome(const kinematics2d::PoseStore& bodies, std::size_t begin, std::size_t end,
                            Stances::const_iterator stance, double* poses) const
{
  const std::size_t count = bodies_;
  for (std::size_t k = begin; k < end; ++k)
  {
    PlaneStance own;
    if (stance != stances_.end() && stance->body == k) own = (stance++)->stance;
    const Vector3 local(bodies.x[k], bodies.y[k], own.height);
    const Vector3 position = frame_.Apply(local);
    const Quaternion orientation = frame_.orientation * (Quaternion(bodies.w[k], 0, 0, bodies.z[k]) * own.lean);
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
                            Stances::const_iterator stance, double* poses) const
{
  const std::size_t count = bodies_;
  for (std::size_t k = begin; k < end; ++k) poses[k] = frame_.position.x() + bodies.x[k];
  for (std::size_t k = begin; k < end; ++k) poses[count + k] = frame_.position.y() + bodies.y[k];
  std::fill(poses + 2 * count + begin, poses + 2 * count + end, frame_.position.z() + 0.0);
  for (; stance != stances_.end() && stance->body < end; ++stance)
    poses[2 * count + stance->body] = frame_.position.z() + stance->stance.height;
  std::fill(poses + 3 * count + begin, poses + 3 * count + end, 0.0);
  std::fill(poses + 4 * count + begin, poses + 4 * count + end, 0.0);
  std::copy_n(bodies.z.data() + begin, end - begin, poses + 5 * count + begin);
  std::copy_n(bodies.w.data() + begin, end - begin, poses + 6 * count + begin);
}

}  // namespace swarmanoid
