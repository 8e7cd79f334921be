// The loop functions of the scenes of tests/bench/beside_argos3. Each measures what papers report of its scene, and
// writes result.txt into the working folder at the end: a line for each quantity, its name and its value with a tab
// between. Written for ARGoS3's interface alone, like the controllers.
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/e-puck/simulator/epuck_entity.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/simulator/entities/battery_equipped_entity.h>
#include <argos3/plugins/simulator/entities/box_entity.h>
#include <argos3/plugins/simulator/entities/gripper_equipped_entity.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "rules.h"

using namespace argos;

namespace
{

constexpr Real kPi = 3.14159265358979323846;
constexpr Real kTick = 0.1;  // s, in all scenes

Real Heading(const CEmbodiedEntity& body)
{
  CRadians z, y, x;
  body.GetOriginAnchor().Orientation.ToEulerAngles(z, y, x);
  return z.GetValue();
}

CVector2 Flat(const CVector3& position) { return CVector2(position.GetX(), position.GetY()); }

// Measures the processor time of steps, and writes the result.
class CMeasureSpeed : public CLoopFunctions
{
public:
  void Init(TConfigurationNode& node) override { GetNodeAttributeOrDefault(node, "output", output_, output_); }

  void PostStep() override
  {
    if (ticks_ == 0) started_ = std::clock();
    ++ticks_;
  }

  void PostExperiment() override
  {
    const Real seconds = static_cast<Real>(std::clock() - started_) / CLOCKS_PER_SEC;
    Finish();
    std::ofstream file(output_);
    file.precision(17);
    for (const auto& one : results_) file << one.first << '\t' << one.second << '\n';
    // The first step only starts the clock.
    file << "ticks per second\t" << (ticks_ - 1) / seconds << '\n';
  }

  // Lights mark the nest of experiments of foraging, and so does the floor.
  CColor GetFloorColor(const CVector2& position) override
  {
    return position.GetX() < kNest ? CColor::GRAY50 : CColor::WHITE;
  }

protected:
  static constexpr Real kNest = -1;  // m; the nest is west of it

  virtual void Finish() {}
  void Write(const std::string& quantity, Real value) { results_.emplace_back(quantity, value); }

  int ticks_ = 0;

private:
  std::string output_ = "result.txt";
  std::vector<std::pair<std::string, Real>> results_;
  std::clock_t started_ = 0;
};

// Follows the bodies of all robots.
class CMeasure : public CMeasureSpeed
{
public:
  void Init(TConfigurationNode& node) override
  {
    CMeasureSpeed::Init(node);
    auto& types = GetSpace().GetEntityMapPerTypePerId();
    if (types.count("foot-bot") != 0)
      for (auto& robot : types["foot-bot"])
      {
        auto* footbot = any_cast<CFootBotEntity*>(robot.second);
        footbots_.push_back(footbot);
        bodies_.push_back(&footbot->GetEmbodiedEntity());
      }
    if (types.count("e-puck") != 0)
      for (auto& robot : types["e-puck"])
        bodies_.push_back(&any_cast<CEPuckEntity*>(robot.second)->GetEmbodiedEntity());
    for (const auto* body : bodies_)
    {
      first_.push_back(Position(*body));
      last_.push_back(Position(*body));
      heading_.push_back(Heading(*body));
    }
    Begin();
  }

  void PostStep() override
  {
    CMeasureSpeed::PostStep();
    for (size_t i = 0; i < bodies_.size(); ++i)
    {
      const CVector2 now = Position(*bodies_[i]);
      path_ += (now - last_[i]).Length();
      last_[i] = now;
      const Real heading = Heading(*bodies_[i]);
      turned_ += std::abs(std::remainder(heading - heading_[i], 2 * kPi));
      heading_[i] = heading;
    }
    Observe();
  }

protected:
  virtual void Begin() {}
  virtual void Observe() {}

  static CVector2 Position(const CEmbodiedEntity& body) { return Flat(body.GetOriginAnchor().Position); }
  Real Seconds() const { return ticks_ * kTick; }
  Real Robots() const { return static_cast<Real>(bodies_.size()); }
  // The mean of what a function says of each robot by its number.
  Real Mean(const std::function<Real(size_t)>& value) const
  {
    Real sum = 0;
    for (size_t i = 0; i < bodies_.size(); ++i) sum += value(i);
    return sum / Robots();
  }
  CVector2 Centroid() const
  {
    CVector2 sum;
    for (const CVector2& position : last_) sum += position;
    return sum / Robots();
  }
  Real MeanSpeed() const { return 100 * path_ / Robots() / Seconds(); }
  Real MeanTurn() const { return 180 / kPi * turned_ / Robots() / Seconds(); }
  // The mean square of the distance from the start.
  Real Spread() const
  {
    return Mean([&](size_t i) { return (last_[i] - first_[i]).SquareLength(); });
  }
  template <class Controller>
  Controller& ControllerOf(size_t robot)
  {
    return dynamic_cast<Controller&>(footbots_[robot]->GetControllableEntity().GetController());
  }
  // The robots of the largest group in which each is nearer than a distance to another one.
  size_t LargestGroup(Real distance) const
  {
    std::vector<bool> taken(last_.size(), false);
    size_t largest = 0;
    for (size_t i = 0; i < last_.size(); ++i)
    {
      if (taken[i]) continue;
      std::vector<size_t> group{i};
      taken[i] = true;
      for (size_t k = 0; k < group.size(); ++k)
        for (size_t j = 0; j < last_.size(); ++j)
          if (!taken[j] && (last_[group[k]] - last_[j]).Length() < distance)
          {
            taken[j] = true;
            group.push_back(j);
          }
      largest = std::max(largest, group.size());
    }
    return largest;
  }
  // Notes the first time at which something is so; writes the whole length if it never is.
  struct FirstTime
  {
    Real time = -1;
    void Look(bool is_so, Real now)
    {
      if (is_so && time < 0) time = now;
    }
    Real Or(Real length) const { return time < 0 ? length : time; }
  };

  std::vector<CFootBotEntity*> footbots_;
  std::vector<CEmbodiedEntity*> bodies_;
  std::vector<CVector2> first_, last_;  // m
  std::vector<Real> heading_;

private:
  Real path_ = 0;    // m, of all robots together
  Real turned_ = 0;  // rad, of all robots together
};

class CMeasureDiffusion : public CMeasure
{
  void Observe() override
  {
    for (const CVector2& position : last_)
      visited_.insert(
          {static_cast<int>(std::floor(position.GetX() / 0.25)), static_cast<int>(std::floor(position.GetY() / 0.25))});
  }
  void Finish() override
  {
    Write("mean speed, cm/s", MeanSpeed());
    Write("mean turn, degrees/s", MeanTurn());
    Write("mean square displacement, m2", Spread());
    Write("cells of 25 cm visited", static_cast<Real>(visited_.size()));
  }

  std::set<std::pair<int, int>> visited_;
};

class CMeasureForaging : public CMeasure
{
  void Begin() override
  {
    random_ = CRandom::CreateRNG("argos");
    for (CVector2& item : items_) item = Somewhere();
  }
  void Observe() override
  {
    for (size_t i = 0; i < footbots_.size(); ++i)
    {
      auto& forager = ControllerOf<CForager>(i);
      if (forager.carries_ && last_[i].GetX() < kNest - 0.1)
      {
        forager.carries_ = false;
        ++delivered_;
        first_delivery_.Look(true, Seconds());
        fifth_.Look(delivered_ == 5, Seconds());
      }
      for (CVector2& item : items_)
        if (!forager.carries_ && (last_[i] - item).Length() < 0.1)
        {
          forager.carries_ = true;
          item = Somewhere();
        }
    }
    carrying_ += Mean([&](size_t i) { return ControllerOf<CForager>(i).carries_ ? 1 : 0; });
  }
  void Finish() override
  {
    Write("items delivered", delivered_);
    Write("time of the first delivery, s", first_delivery_.Or(Seconds()));
    Write("time of the fifth delivery, s", fifth_.Or(Seconds()));
    Write("robots that carry", carrying_ / ticks_);
    Write("mean speed, cm/s", MeanSpeed());
  }
  CVector2 Somewhere() const
  {
    return CVector2(random_->Uniform(CRange<Real>(-0.7, 1.8)), random_->Uniform(CRange<Real>(-1.8, 1.8)));
  }

  std::vector<CVector2> items_ = std::vector<CVector2>(8);
  CRandom::CRNG* random_ = nullptr;
  int delivered_ = 0;
  Real carrying_ = 0;
  FirstTime first_delivery_, fifth_;
};

class CMeasureFlocking : public CMeasure
{
  void Begin() override { start_ = Centroid(); }
  void Observe() override
  {
    CVector2 sum;
    for (const Real heading : heading_) sum += CVector2(std::cos(heading), std::sin(heading));
    order_ += sum.Length() / Robots();
    if (LargestGroup(1) == footbots_.size()) ++together_;
  }
  void Finish() override
  {
    const CVector2 middle = Centroid();
    Write("mean order (polarisation)", order_ / ticks_);
    Write("distance to the centroid, m", Mean([&](size_t i) { return (last_[i] - middle).Length(); }));
    Write("nearest neighbour, m", Mean(
                                      [&](size_t i)
                                      {
                                        Real nearest = 100;
                                        for (size_t j = 0; j < last_.size(); ++j)
                                          if (j != i) nearest = std::min(nearest, (last_[i] - last_[j]).Length());
                                        return nearest;
                                      }));
    Write("way of the centroid, m", (middle - start_).Length());
    Write("time in one group, s", together_ * kTick);
  }

  CVector2 start_;
  Real order_ = 0;
  int together_ = 0;
};

class CMeasureSynchronisation : public CMeasure
{
  void Observe() override
  {
    const Real flash = Mean([&](size_t i) { return ControllerOf<CFirefly>(i).flashes_ ? 1 : 0; });
    flashes_ += flash * Robots();
    most_.Look(flash >= 0.75, Seconds());
    half_.Look(flash >= 0.5, Seconds());
    if (Seconds() > 60) largest_ = std::max(largest_, flash);
  }
  void Finish() override
  {
    Write("time until half flash at once, s", half_.Or(Seconds()));
    Write("time until three quarters do, s", most_.Or(Seconds()));
    Write("flashes of a robot", flashes_ / Robots());
    Write("largest group after 60 s", largest_);
  }

  FirstTime most_, half_;
  Real flashes_ = 0;
  Real largest_ = 0;
};

class CMeasureTransport : public CMeasure
{
  void Begin() override
  {
    for (auto& box : GetSpace().GetEntitiesByType("box"))
    {
      auto& body = any_cast<CBoxEntity*>(box.second)->GetEmbodiedEntity();
      if (body.IsMovable()) load_ = &body;
    }
    start_ = Position(*load_);
  }
  void Observe() override
  {
    const Real pushed = (Position(*load_) - start_).GetX();
    if (ticks_ == 64)
    {
      pushed_ = pushed;
      gripping_ = Mean([&](size_t i) { return footbots_[i]->GetGripperEquippedEntity().IsGripping() ? 1 : 0; });
    }
    if (ticks_ == 199) pulled_ = pushed_ - pushed;
    if (ticks_ > 64) back_.Look(pushed < pushed_ - 0.1, Seconds());
  }
  void Finish() override
  {
    Write("robots that grip", gripping_ * Robots());
    Write("pushed until then, cm", 100 * pushed_);
    Write("pulled in 13.5 s, cm", 100 * pulled_);
    Write("time until pulled by 10 cm, s", back_.Or(Seconds()));
    Write("turn of the load, degrees", 180 / kPi * std::abs(Heading(*load_)));
    Write("way of a robot, cm", MeanSpeed() * Seconds());
  }

  CEmbodiedEntity* load_ = nullptr;
  CVector2 start_;
  Real gripping_ = 0;
  Real pushed_ = 0;
  Real pulled_ = 0;
  FirstTime back_;
};

class CMeasureAggregation : public CMeasure
{
  void Observe() override
  {
    half_.Look(2 * LargestGroup(0.4) >= bodies_.size(), Seconds());
    if (Seconds() <= 100) return;
    largest_ += static_cast<Real>(LargestGroup(0.4)) / Robots();
    const CVector2 middle = Centroid();
    dispersion_ += Mean([&](size_t i) { return (last_[i] - middle).Length(); });
    ++late_;
  }
  void Finish() override
  {
    Write("largest group, after 100 s", largest_ / late_);
    Write("distance to the centroid, m", dispersion_ / late_);
    Write("time until half are one group, s", half_.Or(Seconds()));
    Write("mean speed, cm/s", MeanSpeed());
  }

  FirstTime half_;
  Real largest_ = 0;
  Real dispersion_ = 0;
  int late_ = 0;
};

class CMeasurePhototaxis : public CMeasure
{
  void Begin() override { arrived_.resize(bodies_.size()); }
  void Observe() override
  {
    for (size_t i = 0; i < bodies_.size(); ++i) arrived_[i].Look(ToLight(i) < 0.8, Seconds());
  }
  void Finish() override
  {
    Write("mean time to 0.8 m, s", Mean([&](size_t i) { return arrived_[i].Or(Seconds()); }));
    Write("robots that arrive", Mean([&](size_t i) { return arrived_[i].time >= 0 ? 1 : 0; }));
    Write("distance to the light, m", Mean([&](size_t i) { return ToLight(i); }));
    Write("mean speed, cm/s", MeanSpeed());
  }
  Real ToLight(size_t i) const { return (last_[i] - CVector2(1.5, 0)).Length(); }

  std::vector<FirstTime> arrived_;
};

class CMeasureChain : public CMeasure
{
  void Observe() override
  {
    int members = 0;
    longest_ = 0;
    reach_ = 0;
    for (size_t i = 0; i < footbots_.size(); ++i)
    {
      const int place = ControllerOf<CChainLink>(i).place_;
      if (place < 2) continue;
      ++members;
      longest_ = std::max(longest_, place);
      reach_ = std::max(reach_, last_[i].Length());
    }
    fourth_.Look(members >= 4, Seconds());
    members_ += members;
  }
  void Finish() override
  {
    Write("members, mean over time", members_ / ticks_);
    Write("links of the longest chain", longest_);
    Write("reach, m", reach_);
    Write("time of the fourth member, s", fourth_.Or(Seconds()));
  }

  Real members_ = 0;
  int longest_ = 0;
  Real reach_ = 0;
  FirstTime fourth_;
};

class CMeasureGradient : public CMeasure
{
  void Observe() override
  {
    const Real all = Mean([&](size_t i) { return Hops(i) < kUnreached ? 1 : 0; });
    most_.Look(all >= 0.9, Seconds());
    reached_ += all;
  }
  void Finish() override
  {
    Real hops = 0;
    int most = 0;
    int count = 0;
    for (size_t i = 0; i < footbots_.size(); ++i)
    {
      if (Hops(i) >= kUnreached) continue;
      hops += Hops(i);
      most = std::max(most, Hops(i));
      ++count;
    }
    Write("mean hops", hops / count);
    Write("most hops", most);
    Write("robots reached, mean over time", reached_ / ticks_);
    Write("time until 90 % are reached, s", most_.Or(Seconds()));
  }
  int Hops(size_t i) { return ControllerOf<CHopCounter>(i).hops_; }

  static constexpr int kUnreached = 60;  // islands of robots count up for ever
  Real reached_ = 0;
  FirstTime most_;
};

class CMeasureBattery : public CMeasure
{
  void Observe() override
  {
    for (size_t i = 0; i < footbots_.size(); ++i)
    {
      auto& battery = footbots_[i]->GetBatterySensorEquippedEntity();
      if (ControllerOf<CPowered>(i).wants_charge_ && last_[i].GetX() < -1)
        battery.SetAvailableCharge(std::min<Real>(1, battery.GetAvailableCharge() + 0.02));
      empty_.Look(ControllerOf<CPowered>(i).charge_ <= 0, Seconds());
      low_.Look(ControllerOf<CPowered>(i).wants_charge_, Seconds());
      charged_ += ControllerOf<CPowered>(i).wants_charge_ && last_[i].GetX() < -1 ? 1 : 0;
    }
    charge_ += Mean([&](size_t i) { return ControllerOf<CPowered>(i).charge_; });
  }
  void Finish() override
  {
    Write("mean charge over time", charge_ / ticks_);
    Write("charge at the end", Mean([&](size_t i) { return ControllerOf<CPowered>(i).charge_; }));
    Write("first low battery, s", low_.Or(Seconds()));
    Write("first empty battery, s", empty_.Or(Seconds()));
    Write("time at the charger, s", charged_ * kTick / Robots());
    Write("mean speed, cm/s", MeanSpeed());
  }

  Real charge_ = 0;
  Real charged_ = 0;
  FirstTime low_, empty_;
};

}  // namespace

REGISTER_LOOP_FUNCTIONS(CMeasureSpeed, "measure_speed")
REGISTER_LOOP_FUNCTIONS(CMeasureDiffusion, "measure_diffusion")
REGISTER_LOOP_FUNCTIONS(CMeasureForaging, "measure_foraging")
REGISTER_LOOP_FUNCTIONS(CMeasureFlocking, "measure_flocking")
REGISTER_LOOP_FUNCTIONS(CMeasureSynchronisation, "measure_synchronisation")
REGISTER_LOOP_FUNCTIONS(CMeasureTransport, "measure_transport")
REGISTER_LOOP_FUNCTIONS(CMeasureAggregation, "measure_aggregation")
REGISTER_LOOP_FUNCTIONS(CMeasurePhototaxis, "measure_phototaxis")
REGISTER_LOOP_FUNCTIONS(CMeasureChain, "measure_chain")
REGISTER_LOOP_FUNCTIONS(CMeasureGradient, "measure_gradient")
REGISTER_LOOP_FUNCTIONS(CMeasureBattery, "measure_battery")
