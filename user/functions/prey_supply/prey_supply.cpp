// A supply of preys. Every few ticks it puts a prey into the arena at random, and it removes preys that reach the nest.
// Robots may join in the same way. The experiment is done when enough preys were delivered. It publishes "delivered",
// the number of preys, and "net_energy", the income of all deliveries less what the batteries of all robots gave (J).
//
//   <prey_supply id="supply" library="prey_supply">
//     <preys>prey</preys>       id of their <reserve>
//     <robots>late</robots>     id of the <reserve> of robots that join; empty: none
//     <every>20</every>         ticks between two preys
//     <nest>nest</nest>         id of the patch, a disc
//     <enough>5</enough>        deliveries
//     <log>supply.csv</log>     file in the folder of the run; empty: none
//     <income>0</income>        J for the swarm with each delivery
//   </prey_supply>
#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <istream>
#include <memory>
#include <ostream>
#include <stdexcept>

#include "common/math/elementary.h"
#include "common/space/battery_slots.h"
#include "common/space/publish.h"
#include "space_server/experiment_functions.h"

namespace
{

using namespace swarmanoid;

struct Close
{
  void operator()(std::FILE* file) const { std::fclose(file); }
};

class CPreySupply : public CExperimentFunctions
{
public:
  static PluginDescription Description()
  {
    PluginDescription description;
    description.label = "prey_supply";
    description.brief = "adds preys and robots from reserves while the experiment runs, and removes preys at the nest";
    description.parameters = {
        {.name = "preys", .type = ParameterType::kText, .description = "Id of the <reserve> of preys."},
        {.name = "robots",
         .type = ParameterType::kText,
         .default_value = "",
         .description = "Id of the <reserve> of robots that join, one with each prey; empty: none."},
        {.name = "every",
         .type = ParameterType::kInteger,
         .unit = "ticks",
         .default_value = "20",
         .description = "Time between two preys; none is added while the reserve is used up.",
         .minimum = 1,
         .maximum = 1e6},
        {.name = "nest", .type = ParameterType::kText, .description = "Id of the nest, a disc."},
        {.name = "enough",
         .type = ParameterType::kInteger,
         .default_value = "5",
         .description = "The experiment is done when so many preys were delivered.",
         .minimum = 1,
         .maximum = 1e6},
        {.name = "log",
         .type = ParameterType::kText,
         .default_value = "",
         .description = "CSV file in the folder of the run: tick, what happened, id; empty: none."},
        {.name = "income",
         .unit = "J",
         .default_value = "0",
         .description = "Energy that the swarm gains with each delivery, for the published net_energy.",
         .minimum = 0,
         .maximum = 1e9}};
    return description;
  }

  void Init(const TConfigurationTree t_tree, SpaceEditor& space) override
  {
    preys_ = t_tree.GetText("preys");
    robots_ = t_tree.GetText("robots");
    every_ = static_cast<std::uint64_t>(t_tree.GetInteger("every"));
    enough_ = static_cast<std::uint64_t>(t_tree.GetInteger("enough"));
    nest_ = space.GetSpace().FindEntity(t_tree.GetText("nest"));
    income_j_ = t_tree.GetNumber("income");
    for (std::uint32_t e = 0; e < space.GetSpace().Size(); ++e)
      if (const auto battery = BatteryView::Of(space.GetSpace(), e)) batteries_.push_back(*battery);
    if (nest_ == nullptr || DescriptionOf(nest_->GetKind()).role != EntityRole::kPatch)
      throw ConfigurationError(t_tree.ValueLocation("nest"), "the nest must be the id of a patch of the floor");
    for (const char* name : {"preys", "robots"})
      if (const std::string reserve = t_tree.GetText(name); !reserve.empty() && !HasReserve(space, reserve))
        throw ConfigurationError(t_tree.ValueLocation(name), "there is no <reserve> of '" + reserve + "' in the arena");
    const std::string log = t_tree.GetText("log");
    if (log.empty()) return;
    const std::string path = space.MakeOutputFile(t_tree, "log");
    file_.reset(std::fopen(path.c_str(), "w"));
    if (file_ == nullptr) throw std::runtime_error("cannot write '" + path + "': " + std::strerror(errno));
    std::fputs("tick,event,id\n", file_.get());
  }

  void PostStep(SpaceEditor& space) override
  {
    const CSwarmanoidSpace& all = space.GetSpace();
    for (const BatteryView& battery : batteries_) used_j_ += battery.Power_W() * all.GetTickSeconds();
    for (std::size_t i = 0; i < all.Size(); ++i)
    {
      const CSwarmanoidSpaceEntity& entity = all.GetEntity(i);
      if (!all.IsPresent(i) || entity.GetConfiguration().reserve != preys_ || !IsInNest(entity)) continue;
      space.RemoveEntity(entity.GetId());
      ++delivered_;
      Write(all, "delivered", entity.GetId());
    }
    Publish(all, "delivered", static_cast<double>(delivered_));
    Publish(all, "net_energy", static_cast<double>(delivered_) * income_j_ - used_j_);
    if (all.GetTick() % every_ != 0) return;
    RandomStream& random = space.GetRandom();
    AddOne(space, preys_, random);
    if (!robots_.empty()) AddOne(space, robots_, random);
  }

  Outcome IsFinished(const SpaceEditor&) override { return delivered_ >= enough_ ? Outcome::kDone : Outcome::kRunning; }

  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override
  {
    state << delivered_ << ' ' << std::bit_cast<std::uint64_t>(used_j_);
  }
  void LoadState(std::istream& state) override
  {
    std::uint64_t used = 0;
    state >> delivered_ >> used;
    used_j_ = std::bit_cast<double>(used);
  }

private:
  static bool HasReserve(const SpaceEditor& space, const std::string& reserve)
  {
    const auto& entities = space.GetSpace().GetExperiment().entities;
    return std::ranges::any_of(entities, [&](const auto& entity) { return entity.reserve == reserve; });
  }

  bool IsInNest(const CSwarmanoidSpaceEntity& entity) const
  {
    return (entity.GetPosition() - nest_->GetPosition()).head<2>().norm() < nest_->GetSize().x();
  }

  // Adds an entity at a free place, if one is found in a few attempts and the reserve has one left.
  void AddOne(SpaceEditor& space, const std::string& reserve, RandomStream& random)
  {
    constexpr double kClearance = 0.3;  // m
    const CSwarmanoidSpace& all = space.GetSpace();
    bool left = false;
    for (std::size_t i = 0; i < all.Size() && !left; ++i)
      left = !all.IsPresent(i) && all.GetEntity(i).GetConfiguration().reserve == reserve;
    const Vector3& size = all.GetExperiment().arena_size;
    for (int attempt = 0; left && attempt < 20; ++attempt)
    {
      const double x = random.Uniform(kClearance, size.x() - kClearance);
      const double y = random.Uniform(kClearance, size.y() - kClearance);
      const double heading = random.Uniform(-kPi, kPi);
      const Pose pose{{x, y, 0}, QuaternionFromEuler({0, 0, heading})};
      // Large bodies extend farther than the clearance of their middles.
      if (!space.GetQuery().FindWithin(pose.position, kClearance).empty() || !space.IsFree(reserve, pose)) continue;
      Write(all, "added", space.AddEntity(reserve, pose));
      return;
    }
  }

  void Write(const CSwarmanoidSpace& space, const char* event, const std::string& id) const
  {
    if (file_ != nullptr)
      std::fprintf(file_.get(), "%llu,%s,%s\n", static_cast<unsigned long long>(space.GetTick()), event, id.c_str());
  }

  std::string preys_;
  std::string robots_;
  std::uint64_t every_ = 0;
  std::uint64_t enough_ = 0;
  std::uint64_t delivered_ = 0;
  double income_j_ = 0, used_j_ = 0;
  std::vector<BatteryView> batteries_;
  const CSwarmanoidSpaceEntity* nest_ = nullptr;
  std::unique_ptr<std::FILE, Close> file_;
};

REGISTER_EXPERIMENT_FUNCTIONS(CPreySupply, CPreySupply::Description())

}  // namespace
