// ContactFreeSet: the robots on wheels that ODE need not move. A closed form moves those that touch only level ground,
// and PlanarSolver those that meet only upright walls and one another. Once a tick it finds the robots that cannot meet
// another body before the tick ends, and those that can meet no other things than these. Robots are compared with
// bodies near them in each step. The result follows from the bodies at the start of the tick. Owned by SolverGroups.
// Bodies are numbered as assemblies (ode_world.h). Several threads may call BeforeStep, AfterStep, PlanarStep and
// IsAnyTooFar for different bodies.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine_worker/engines/dynamics3d/planar_solver.h"
#include "engine_worker/engines/dynamics3d/upright_contacts.h"
#include "engine_worker/engines/dynamics3d/wheeled.h"
#include "engine_worker/engines/rigid_bodies/islands.h"
#include "engine_worker/engines/rigid_bodies/separation_test.h"

namespace swarmanoid::dynamics3d
{

class ContactFreeSet
{
public:
  // `solve_all`: no robot is free.
  ContactFreeSet(Scene& scene, int steps, double step_seconds, bool solve_all)
      : scene_(scene), steps_(steps), step_seconds_(step_seconds), solve_all_(solve_all)
  {
  }

  // Adds an area without ground.
  void AddHole(StaticOutline outline) { holes_.push_back(std::move(outline)); }

  // Adds the next model before it is placed, since nothing may depend on its position.
  void Add(Model& model, bool owned);

  // Some models are left out now, or no longer.
  void ConfigureAgain() { solids_ = 0; }

  void BeginTick();
  // Searches again before a step.
  void SearchAgain(int step);
  // Returns whether a body can meet nothing but level ground in the rest of the tick.
  bool IsFar(std::uint32_t body) const { return is_searched_ && bodies_[body].may_be_free && !bodies_[body].is_near; }
  // Returns whether the planar solver or the closed form moves a body in the rest of the tick, near others. Its group
  // has only such bodies.
  bool IsInPlane(std::uint32_t body) const { return bodies_[body].is_in_plane; }
  // Bodies, of which one may be free, that are compared with each other in each step; or a body and a static outline.
  std::span<const kinematics2d::Pair> NearPairs() const { return pairs_; }

  // Decides which of the bodies the solver moves in a step, and adds their models to `solved`. `pairs` are the near
  // pairs of these bodies. Returns false if the answer is "none" in all steps that are left.
  bool BeforeStep(std::span<const std::uint32_t> bodies, std::span<const kinematics2d::Pair> pairs, int step,
                  std::vector<Model*>& solved);
  void AfterStep(std::span<const std::uint32_t> bodies, int step);
  // Moves those of the bodies that PlanarSolver moves. Returns the number of their contacts.
  int PlanarStep(std::span<const std::uint32_t> bodies, std::span<const kinematics2d::Pair> pairs,
                 PlanarSolver& solver);
  // Returns true if a solved body has left, or leaves in the next step, the area that the search assumed for it.
  bool IsAnyTooFar(std::span<const std::uint32_t> bodies) const;
  // Ends the tick of one body.
  void EndTick(std::uint32_t body);

  // Save and restore the decisions of the last search about a body, and how far its closed form is, so that its steps
  // can be made in another process.
  void SaveTick(std::uint32_t body, ByteWriter& state) const;
  void LoadTick(std::uint32_t body, ByteReader& state);
  bool IsSearched() const { return is_searched_; }
  // Takes over the results of a search in another process, before LoadTick.
  void FollowSearch(bool is_searched);
  std::size_t OutlineCount() const { return bodies_.size() + isolation_.Statics().size(); }

  // Returns the number of free robots in the last step.
  std::size_t Count() const;

private:
  struct Body
  {
    Model* model = nullptr;
    WheeledModel* robot = nullptr;  // the same, if it has wheels
    bool owned = false;
    double radius = 0;          // m, around its middle, however it turns
    bool may_be_free = false;   // in this tick
    bool is_near = false;       // there is a body that it may meet in this tick
    bool touches = false;       // or nearly
    bool is_in_plane = false;   // in the rest of the tick, and all that it can meet
    double step_way = 0;        // m, by which it can come nearer to others in this step
    bool needs_ode = false;     // in this step: itself, or one of the island that begins with it
    std::uint32_t island = 0;   // another body that it touches, or itself
    int advanced = 0;           // steps of this tick that the closed form has done
    std::size_t in_solver = 0;  // its number in the planar solver, within a step

    bool IsLeftOut() const { return model->IsLeftOut(); }
    bool IsFree() const { return robot != nullptr && robot->IsFree(); }
    bool IsPlanar() const { return robot != nullptr && robot->IsPlanar(); }
  };
  // It describes a thing that never moves, as the planar solver meets it.
  struct Upright
  {
    bool is_upright = false;           // else ODE solves all that comes near
    double low = 0, high = 0;          // m
    Vector2 normal = Vector2::Zero();  // of a wall without end
    double distance = 0;
    Prism prism;
    Vector2 along_x = Vector2::Zero(), along_y = Vector2::Zero();  // sides of a box
    Vector2 half = Vector2::Zero();                                // m, of it
    Touch touch;
  };

  void Configure();
  bool HasLevelGround() const;
  std::vector<StaticOutline> FindStatics();
  // Returns whether a box, of heights in [4] and [5], is not above or below all robots on wheels.
  bool IsBesideRobots(const Box& box) const;
  std::array<double, 6> BoxOf(const Body& body) const { return scene_.world.BoxOf(body.model->MainBody()); }
  dBodyID MainBodyOf(const Body& body) const { return scene_.world.Body(body.model->MainBody()); }
  void Search(int step);
  void FindInPlane(int step);
  bool MeetInPlane(const Body& robot, std::uint32_t other) const;
  PlaneContact MeetUpright(const Prism& robot, const Upright& upright) const;
  void AddContacts(const kinematics2d::Pair& pair, PlanarSolver& solver) const;
  void Outline(const Body& body, double seconds, MovingOutline& outline);
  bool IsTooFar(const Body& body, const MovingOutline& outline) const;
  void FindTouching(std::span<const std::uint32_t> bodies, std::span<const kinematics2d::Pair> pairs);
  std::uint32_t IslandOf(std::uint32_t body) const;
  double GapBetween(const Body& robot, std::uint32_t other) const;
  double LargestStep(const Body& body) const;
  void Decide(Body& body, int step);
  void AdvanceTo(Body& body, int step) const;

  Scene& scene_;
  int steps_;
  double step_seconds_;
  bool solve_all_;
  std::vector<StaticOutline> holes_;
  std::vector<Body> bodies_;
  double top_ = 0;  // m, of the highest robot on wheels that stands on the ground

  std::size_t solids_ = 0;  // that Configure saw
  bool has_level_ground_ = false;
  SeparationTest isolation_;
  std::vector<Upright> uprights_;  // by static outline
  std::vector<MovingOutline> outlines_;
  std::vector<Nearness> nearness_;
  std::vector<kinematics2d::Pair> pairs_;  // of which one is a robot on wheels
  std::vector<std::uint8_t> has_links_;    // by entity
  bool is_searched_ = false;               // false: all are solved until the tick ends
  Islands islands_;
  std::vector<std::uint8_t> needs_ode_;  // by body
};

}  // namespace swarmanoid::dynamics3d
