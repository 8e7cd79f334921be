// The links of a robot that joints move (common/experiment/moving_links.h): a body for each, on a hinge or slider with
// stops and a motor. A jointed robot has a base and links, and a robot on wheels may carry links on its chassis.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "common/experiment/moving_links.h"
#include "engine_worker/engines/dynamics3d/model.h"

namespace swarmanoid::dynamics3d
{

class JointedLinks
{
public:
  // Adds the bodies and joints of the entity's kind. `base` is the body that carries them, whose frame has the axes of
  // the entity. `add_body(mass, in_entity)` adds a body to the model and returns its number.
  JointedLinks(Scene& scene, const CSwarmanoidSpaceEntity& entity, int base,
               const std::function<int(const dMass&, const Pose&)>& add_body);

  // Adds the shapes of the links, after the shapes of their base.
  void AddSolids();

  // Puts the links where their joints are, with the entity at this pose, at rest.
  void Put(const Pose& entity);
  // Brings the joints to the attributes of the entity.
  void FollowAttributes(const Pose& entity);
  // Reads the positions of the joints from the bodies. Needed after bodies were placed or loaded.
  void Measure();

  void Command(std::span<const double> values);
  void Sense(std::span<double> values) const;
  void BeforeStep(double seconds);
  void AfterStep();
  void Report(AttributeReport& report) const;

  void Save(ByteWriter& state) const;
  void Load(ByteReader& state);
  void SaveTick(ByteWriter& state) const;
  void LoadTick(ByteReader& state);

  // Returns the largest speed (m/s) that a point of a link has, or can reach by its motors.
  double LargestSpeed() const;
  // Returns how far (m) from the base's centre of mass any point of the robot can come by its joints.
  double Reach() const { return reach_; }

private:
  struct Link
  {
    const MovingLink* row = nullptr;
    int body = 0, inner = 0;  // numbers of bodies
    int joint = 0;
    Vector3 in_inner =
        Vector3::Zero();  // the way (m) from the inner centre of mass to that of the link, all joints at 0
    double radius = 0;    // m, around the centre of mass
    double mobility = 0;  // rad/s² for 1 N m, or m/s² for 1 N, at most
    JointCommand command;
    double reference = 0;  // rad or m
    double position = 0;   // rad or m, at the end of the last step
    double effort = 0;     // N m or N, of the last step
  };

  double PositionOf(const Link& link) const;
  double SpeedOf(const Link& link) const;
  void Drive(Link& link, double seconds);
  void Damp(const Link& link, double seconds) const;

  Scene& scene_;
  const CSwarmanoidSpaceEntity& entity_;
  const std::vector<MovingLink>& rows_;
  std::vector<Link> links_;
  double reach_ = 0;
  double swing_ = 0;  // m/s
};

// A robot that stands on its links or its base.
class JointedModel : public Model
{
public:
  JointedModel(Scene& scene, const CSwarmanoidSpaceEntity& entity);

  void Place(const Pose& pose) override;
  double LargestSpeed() const override;
  double Reach() const override { return links_->Reach(); }
  void Command(std::string_view channel, std::span<const double> values) override;
  void Sense(std::string_view channel, std::span<double> values) const override;
  void BeforeStep(double seconds) override { links_->BeforeStep(seconds); }
  void AfterStep(double /*seconds*/) override { links_->AfterStep(); }
  void Report(AttributeReport& report) const override { links_->Report(report); }
  void Save(ByteWriter& state) const override { links_->Save(state); }
  void Load(ByteReader& state) override { links_->Load(state); }
  void SaveTick(ByteWriter& state) const override { links_->SaveTick(state); }
  void LoadTick(ByteReader& state) override { links_->LoadTick(state); }

protected:
  void FollowAttributes() override { links_->FollowAttributes(CurrentPose()); }

private:
  std::unique_ptr<JointedLinks> links_;
};

}  // namespace swarmanoid::dynamics3d
