// The goal of the prey retrieval experiment. It is reached when the prey that the guide chose is in the nest. The
// experiment fails if that takes too long, or if another prey is brought. The chosen prey is the one below the guide
// when a footbot grips for the first time. Writes the distance of each prey to the nest as CSV, and publishes the least
// of them for studies: "to_nest".
//
//   <prey_retrieval_goal id="goal" library="prey_retrieval_goal">
//     <preys>prey_yellow, prey_magenta</preys>
//     <guide>eb</guide>     the eyebot that chooses; empty: any prey will do
//     <nest>nest</nest>
//     <metrics>retrieval.csv</metrics>
//   </prey_retrieval_goal>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <istream>
#include <limits>
#include <memory>
#include <ostream>
#include <stdexcept>

#include "common/space/publish.h"
#include "space_server/experiment_functions.h"

namespace
{

using namespace swarmanoid;

struct Close
{
  void operator()(std::FILE* file) const { std::fclose(file); }
};

class CPreyRetrievalGoal : public CExperimentFunctions
{
public:
  static PluginDescription Description()
  {
    PluginDescription description;
    description.label = "prey_retrieval_goal";
    description.brief = "done when the chosen prey stands in the nest, failed with another one; writes the distances";
    description.parameters = {
        {.name = "preys", .type = ParameterType::kText, .description = "Ids of the preys, separated by commas."},
        {.name = "guide",
         .type = ParameterType::kText,
         .default_value = "",
         .description = "Id of the eyebot that chooses a prey: the one below it when a footbot grips for the first "
                        "time; empty: any prey will do."},
        {.name = "nest", .type = ParameterType::kText, .description = "Id of the nest."},
        {.name = "metrics",
         .type = ParameterType::kText,
         .default_value = "",
         .description = "CSV file in the folder of the run; empty: none."}};
    return description;
  }

  void Init(const TConfigurationTree t_tree, SpaceEditor& space) override
  {
    const auto find = [&](const std::string& id) -> const CSwarmanoidSpaceEntity*
    {
      if (const auto* entity = space.GetSpace().FindEntity(id)) return entity;
      throw ConfigurationError(t_tree.Location(), "there is no entity '" + id + "'");
    };
    nest_ = find(t_tree.GetText("nest"));
    if (const std::string guide = t_tree.GetText("guide"); !guide.empty()) guide_ = find(guide);
    std::string list = t_tree.GetText("preys");
    for (std::size_t start = 0; start < list.size();)
    {
      const std::size_t end = std::min(list.find(',', start), list.size());
      preys_.push_back(find(std::string(TrimBlanks(std::string_view(list).substr(start, end - start)))));
      start = end + 1;
    }
    if (const std::string metrics = t_tree.GetText("metrics"); !metrics.empty())
    {
      const std::string path = space.MakeOutputFile(t_tree, "metrics");
      file_.reset(std::fopen(path.c_str(), "w"));
      if (file_ == nullptr) throw std::runtime_error("cannot write '" + path + "': " + std::strerror(errno));
      std::fputs("tick", file_.get());
      for (const auto* prey : preys_) std::fprintf(file_.get(), ",%s_m", prey->GetId().c_str());
      std::fputs("\n", file_.get());
    }
  }

  void PostStep(SpaceEditor& space) override
  {
    if (guide_ != nullptr && chosen_ == nullptr && AFootbotGrips(space.GetSpace())) chosen_ = Nearest(*guide_);
    double nearest_m = std::numeric_limits<double>::max();
    for (const auto* prey : preys_) nearest_m = std::min(nearest_m, Distance(*prey));
    Publish(space.GetSpace(), "to_nest", nearest_m);
    if (file_ == nullptr) return;
    std::fprintf(file_.get(), "%llu", static_cast<unsigned long long>(space.GetSpace().GetTick()));
    for (const auto* prey : preys_) std::fprintf(file_.get(), ",%.4f", Distance(*prey));
    std::fputs("\n", file_.get());
  }

  Outcome IsFinished(const SpaceEditor& space) override
  {
    for (const auto* prey : preys_)
    {
      if ((guide_ != nullptr && chosen_ == nullptr) || !IsInNest(*prey)) continue;
      if (chosen_ == nullptr || prey == chosen_) return Outcome::kDone;
      return Failed(fmt::format("'{}' is in the nest, but the nearest prey was '{}'", prey->GetId(), chosen_->GetId()));
    }
    const std::uint64_t last = space.GetSpace().GetExperiment().max_clock;
    if (last == 0 || space.GetSpace().GetTick() < last) return Outcome::kRunning;
    return Failed("no prey is in the nest at the last tick");
  }

  void Destroy(SpaceEditor&) override { file_.reset(); }

  // The file of a restored run starts at the tick of the restored state.
  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override
  {
    state << (std::find(preys_.begin(), preys_.end(), chosen_) - preys_.begin());
  }
  void LoadState(std::istream& state) override
  {
    std::size_t number = 0;
    state >> number;
    chosen_ = number < preys_.size() ? preys_[number] : nullptr;
  }

private:
  static bool AFootbotGrips(const CSwarmanoidSpace& space)
  {
    for (std::size_t i = 0; i < space.Size(); ++i)
      if (space.GetEntity(i).GetKind() == EntityKind::kFootbot && space.GetEntity(i).GetAttribute("gripped") > 0)
        return true;
    return false;
  }
  const CSwarmanoidSpaceEntity* Nearest(const CSwarmanoidSpaceEntity& guide) const
  {
    const auto away = [&](const CSwarmanoidSpaceEntity* prey)
    { return (prey->GetPosition() - guide.GetPosition()).head<2>().norm(); };
    return *std::min_element(preys_.begin(), preys_.end(),
                             [&](const auto* a, const auto* b) { return away(a) < away(b); });
  }
  double Distance(const CSwarmanoidSpaceEntity& prey) const
  {
    return (prey.GetPosition() - nest_->GetPosition()).head<2>().norm();
  }
  // Returns whether the centre of the prey is over the patch.
  bool IsInNest(const CSwarmanoidSpaceEntity& prey) const
  {
    const Vector3 seen = nest_->GetPose().Inverse().Apply(prey.GetPosition());
    if (nest_->GetSize().y() == 0) return seen.head<2>().norm() <= nest_->GetSize().x();  // a disc
    return std::abs(seen.x()) <= nest_->GetSize().x() / 2 && std::abs(seen.y()) <= nest_->GetSize().y() / 2;
  }

  const CSwarmanoidSpaceEntity* nest_ = nullptr;
  const CSwarmanoidSpaceEntity* guide_ = nullptr;
  const CSwarmanoidSpaceEntity* chosen_ = nullptr;  // nullptr: not known yet, so none has been brought
  std::vector<const CSwarmanoidSpaceEntity*> preys_;
  std::unique_ptr<std::FILE, Close> file_;
};

REGISTER_EXPERIMENT_FUNCTIONS(CPreyRetrievalGoal, CPreyRetrievalGoal::Description())

}  // namespace
