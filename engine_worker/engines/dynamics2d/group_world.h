// GroupWorld: the world of Box2D that solves one contact group: its moving bodies and the static bodies near them.
// Dynamics2dWorld has all of them; one thread at a time steps a world. A region of a split engine may have the world of
// Box2D instead (remote_groups.h).
#pragma once

#include <box2d/box2d.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "common/serialisation/bytes.h"
#include "engine_worker/engines/plane_frame.h"

namespace swarmanoid::dynamics2d
{

struct GroupWorld
{
  // A static body. The same one may be in several worlds.
  struct Fixed
  {
    std::uint32_t body;
    b2Body* b2;
  };
  // How far a body may get until the groups are found again, and where it began.
  struct Way
  {
    double x, y, angle;  // decimetres, radians
    double most;         // decimetres
  };

  // A body before a step.
  struct Before
  {
    b2Vec2 position;
    PlanePose pose;  // if its wheels are measured
  };

  // The part of a world that a region has.
  struct Remote
  {
    std::uint32_t region;
    ByteWriter orders;     // all since the world was opened: its history, from which any region can make it again
    std::size_t done = 0;  // bytes of `orders` that the region has executed
    int contacts = 0;
  };

  // Makes an empty world. Box2D's part is new: an emptied one would number bodies by those that it had before, and
  // results would depend on which worlds happen to be free.
  void Open();
  // Makes an empty world of a region.
  void OpenIn(std::uint32_t region);
  void Close();
  bool IsOpen() const { return box2d || remote; }

  std::optional<b2World> box2d;
  std::optional<Remote> remote;
  b2Body* ground = nullptr;            // without shape: ground joints hold on to it
  std::vector<Fixed> fixed;            // ascending
  std::size_t size = 0;                // the number of bodies that move
  std::vector<std::uint32_t> dynamic;  // bodies, ascending
  std::vector<Way> ways;               // of `dynamic`
  std::vector<Before> before;          // of `dynamic`
  double last_step = 0;                // seconds; 0 in a new world
  int steps_done = 0;                  // of the tick
  bool goes_too_far = false;           // a body was pushed farther than its way allows, or is about to be

private:
  void Clear();
};

}  // namespace swarmanoid::dynamics2d
