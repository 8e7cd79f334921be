// ContactFreeSet: the robots on wheels that touch only level ground, so that a closed form moves them instead of the
// solver. Once a tick it finds the robots that cannot meet another body before the tick ends. The other robots are
// compared with bodies near them in each step. The result follows from the bodies at the start of the tick. Owned by
// the engine.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine_worker/engines/dynamics3d/wheeled.h"
#include "engine_worker/engines/separation_test.h"

namespace swarmanoid::dynamics3d
{

class ContactFreeSet
{
public:
  ContactFreeSet(Scene& scene, int steps, double step_seconds)
      : scene_(scene), steps_(steps), step_seconds_(step_seconds)
  {
  }

  // Adds an area without ground.
  void AddHole(StaticOutline outline) { holes_.push_back(std::move(outline)); }
  // Adds a model before it is placed, since nothing may depend on its position.
  void AddOwned(Model& model) { Add(model, true); }
  void AddMirror(Model& model) { Add(model, false); }

  void BeginTick();
  // The models that the next step of the solver moves.
  std::span<Model* const> BeforeStep();
  void AfterStep();
  void EndTick();

  // Returns the number of free robots in the last step.
  std::size_t Count() const;

private:
  struct Body
  {
    Model* model = nullptr;
    WheeledModel* robot = nullptr;  // the same, if it has wheels
    bool owned = false;
    double radius = 0;         // m, around its middle, however it turns
    bool may_be_free = false;  // in this tick
    bool is_near = false;      // there is a body that it may meet in this tick
    bool touches = false;      // or nearly
    int advanced = 0;          // steps of this tick that the closed form has done

    bool IsFree() const { return robot != nullptr && robot->IsFree(); }
  };

  void Add(Model& model, bool owned);
  void Configure();
  bool HasLevelGround() const;
  std::vector<StaticOutline> StaticOutlines() const;
  std::array<double, 6> BoxOf(const Body& body) const { return scene_.world.BoxOf(body.model->MainBody()); }
  dBodyID MainBodyOf(const Body& body) const { return scene_.world.Body(body.model->MainBody()); }
  void Search();
  void Outline(const Body& body, double seconds, MovingOutline& outline);
  bool IsSomebodyTooFar() const;
  bool IsTooFar(const Body& body, const MovingOutline& outline) const;
  void FindTouching();
  double GapBetween(const Body& robot, std::uint32_t other) const;
  double LargestStep(const Body& body) const;
  void Decide(Body& body);
  void AdvanceTo(Body& body, int step) const;

  Scene& scene_;
  int steps_;
  double step_seconds_;
  std::vector<StaticOutline> holes_;
  std::vector<Body> bodies_;
  std::vector<Model*> solved_;
  double top_ = 0;  // m, of the highest robot on wheels that stands on the ground

  std::size_t solids_ = 0;  // that Configure saw
  bool has_level_ground_ = false;
  SeparationTest isolation_;
  std::vector<MovingOutline> outlines_;
  std::vector<Nearness> nearness_;
  std::vector<kinematics2d::Pair> pairs_;  // of which one is a robot on wheels
  std::vector<std::uint8_t> has_links_;    // by entity
  bool is_searched_ = false;               // false: all are solved until the tick ends
  int step_ = 0;                           // of the tick
};

}  // namespace swarmanoid::dynamics3d
