#include "simulation/playback/recorded_run.h"

#include <fmt/format.h>

#include <bit>
#include <filesystem>

#include "common/errors/exit_codes.h"
#include "common/messages/assignment.h"
#include "common/program/usage_error.h"
#include "common/space/attributes.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"
#include "simulation/load.h"

namespace swarmanoid
{
namespace
{

std::unique_ptr<Experiment> ExperimentOf(const std::string& folder)
{
  const std::string file = folder + "/experiment.xml";
  if (!std::filesystem::exists(file))
    throw UsageError(fmt::format("'{}' is no folder of a run: it has no experiment.xml", folder));
  LoadOptions options;
  options.check_files = false;
  auto experiment = LoadOrComplain(file, options);
  if (!experiment) throw UsageError(fmt::format("the experiment of the run '{}' cannot be read", folder));
  return experiment;
}

std::unique_ptr<JournalReader> JournalOf(const std::string& folder)
{
  try
  {
    return std::make_unique<JournalReader>(JournalFile(folder));
  }
  catch (const std::runtime_error& error)
  {
    throw UsageError(fmt::format(
        "{} (runs as a cluster, or with loop functions of ARGoS3, keep a journal, unless they have --no-journal)",
        error.what()));
  }
}

bool SameNumber(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

std::string TextOfSlot(const CSwarmanoidSpace& space, std::uint32_t slot)
{
  const CSwarmanoidSpaceEntity& entity = space.GetEntity(EntityOfSlot(space, slot));
  if (slot >= space.PresenceSlot(0)) return fmt::format("the presence of '{}'", entity.GetId());
  std::uint32_t element = slot - entity.FirstSlot();
  for (const AttributeSpec& spec : AttributesOf(entity.GetKind()))
  {
    const auto count = static_cast<std::uint32_t>(spec.count);
    if (element < count) return fmt::format("{}[{}] of '{}'", spec.name, element, entity.GetId());
    element -= count;
  }
  return fmt::format("message[{}] of '{}'", element + FindAttribute(entity.GetKind(), "message")->count,
                     entity.GetId());
}

}  // namespace

RecordedRun::RecordedRun(const std::string& folder)
    : folder_(folder), experiment_(ExperimentOf(folder)), journal_(JournalOf(folder))
{
  if (journal_->HasStart() && journal_->Start().origin.experiment != FingerprintOf(*experiment_))
    throw UsageError(fmt::format("the journal of '{}' is of another experiment", folder));
  loss_ = FindLoss(*journal_, RecordedEndOf(folder));
  const JournalStart& start = journal_->StartAsFarAsKnown();
  if (ReadableTicks(start, journal_->Places()).empty())
  {
    PrintLoss(loss_);
    throw UsageError(
        fmt::format("the journal of '{}' has no tick {}", folder, loss_.is_damaged ? "that can be read" : "yet"));
  }
  states_.emplace(*experiment_, *journal_, start);
}

std::uint64_t RecordedRun::LastTick() const { return EndTickOf(journal_->StartAsFarAsKnown(), journal_->Places()) - 1; }

int RecordedRun::ExitCode(int code) const
{
  return code == kExitDone && loss_.is_damaged ? static_cast<int>(kExitProcessFailed) : code;
}

std::string FirstDifference(const CSwarmanoidSpace& a, const CSwarmanoidSpace& b)
{
  const auto text = [](const std::string& what, double first, double second)
  { return fmt::format("{} is {} and {}", what, first, second); };
  for (std::size_t k = 0; k < a.Size(); ++k)
  {
    const auto& p = a.Poses();
    const auto& q = b.Poses();
    using Member = std::vector<double> PoseArrays::*;
    constexpr std::pair<const char*, Member> kMembers[] = {
        {"x", &PoseArrays::x},   {"y", &PoseArrays::y},   {"z", &PoseArrays::z},  {"qx", &PoseArrays::qx},
        {"qy", &PoseArrays::qy}, {"qz", &PoseArrays::qz}, {"qw", &PoseArrays::qw}};
    for (const auto& [name, member] : kMembers)
      if (!SameNumber((p.*member)[k], (q.*member)[k]))
        return text(fmt::format("{} of '{}'", name, a.GetEntity(k).GetId()), (p.*member)[k], (q.*member)[k]);
  }
  for (std::uint32_t slot = 0; slot < a.Attributes().size(); ++slot)
    if (!SameNumber(a.Attributes()[slot], b.Attributes()[slot]))
      return text(TextOfSlot(a, slot), a.Attributes()[slot], b.Attributes()[slot]);
  return {};
}

}  // namespace swarmanoid
