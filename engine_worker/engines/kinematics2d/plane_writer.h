// Writes the poses of bodies on a plane as poses of the space, in the layout of EngineUpdate. Cheap if the plane is
// perpendicular to z: then the heading of a body is its orientation in the space.
#pragma once

#include <span>
#include <vector>

#include "common/threads/worker_pool.h"
#include "engine_worker/engines/kinematics2d/motion.h"
#include "engine_worker/engines/plane_frame.h"

namespace swarmanoid
{

class PlaneWriter
{
public:
  struct Stance
  {
    std::uint32_t body;
    PlaneStance stance;
  };

  PlaneWriter() = default;
  // Writes the first `bodies` bodies. `stances`, by body, are those of bodies that may not stand upright on the plane.
  PlaneWriter(const PlaneFrame& frame, std::size_t bodies, std::vector<Stance> stances);

  // Writes the poses: 7 doubles a body, structure of arrays x y z qx qy qz qw. The threads of `pool`, if there is one,
  // share the work.
  void Write(const kinematics2d::PoseStore& bodies, std::span<double> poses, WorkerPool* pool = nullptr) const;

private:
  using Stances = std::vector<Stance>;
  // From body `begin` to before `end`; `stance` is the first of these, or of later ones.
  void WriteSome(const kinematics2d::PoseStore& bodies, std::size_t begin, std::size_t end,
                 Stances::const_iterator stance, double* poses) const;
  void WriteFlat(const kinematics2d::PoseStore& bodies, std::size_t begin, std::size_t end,
                 Stances::const_iterator stance, double* poses) const;

  Pose frame_;
  bool flat_ = true;  // perpendicular to z, all bodies upright
  std::size_t bodies_ = 0;
  Stances stances_;
};

}  // namespace swarmanoid
