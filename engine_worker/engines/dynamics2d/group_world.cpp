#include "engine_worker/engines/dynamics2d/group_world.h"

namespace swarmanoid::dynamics2d
{
namespace
{

// Box2D fills a table of functions when it makes its first contact. Threads that make their first contacts at the same
// time would write it together.
void FillTableOfContacts()
{
  static const bool is_filled = []
  {
    b2World world(b2Vec2(0, 0));
    b2CircleShape circle;
    circle.m_radius = 1;
    b2BodyDef definition;
    definition.type = b2_dynamicBody;
    for (int i = 0; i < 2; ++i) world.CreateBody(&definition)->CreateFixture(&circle, 1);
    world.Step(0.01F, 1, 1);
    return world.GetContactCount() > 0;
  }();
  static_cast<void>(is_filled);
}

}  // namespace

void GroupWorld::Open()
{
  FillTableOfContacts();
  box2d.emplace(b2Vec2(0, 0));
  box2d->SetAllowSleeping(false);
  // The ground is kinematic, so that it joins all bodies to one island. Box2D takes the wall clock several times for
  // each island.
  b2BodyDef definition;
  definition.type = b2_kinematicBody;
  ground = box2d->CreateBody(&definition);
  Clear();
}

void GroupWorld::OpenIn(std::uint32_t region)
{
  remote.emplace(Remote{region, {}, 0, 0});
  Clear();
}

void GroupWorld::Clear()
{
  fixed.clear();
  size = 0;
  last_step = 0;
  steps_done = 0;
  goes_too_far = false;
}

void GroupWorld::Close()
{
  box2d.reset();
  remote.reset();
  ground = nullptr;
  fixed.clear();
}

}  // namespace swarmanoid::dynamics2d
