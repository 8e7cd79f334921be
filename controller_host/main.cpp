// The program that runs the controllers of some robots of an experiment: the controller host's role at the bus.
#include <fmt/format.h>
#include <array>

#include "common/builtins/builtins.h"
#include "common/bus/replica.h"
#include "common/bus/saved_states.h"
#include "common/bus/tick_inputs.h"
#include "common/bus/worker_program.h"
#include "common/bus/worker_session.h"
#include "controller_host/cluster/robot_inspection.h"
#include "controller_host/controller_host.h"

namespace swarmanoid
{
namespace
{

// Steps the controllers in the threads of the bus, as soon as the state and all sensor frames of a tick are here.
class HostNode
{
public:
  HostNode(WorkerSession& session, Replica& replica, std::size_t host)
      : session_(session),
        replica_(replica),
        host_(static_cast<std::uint32_t>(host)),
        role_(*replica.space, replica.assignment, host),
        saved_(session, HostName(host), role_),
        inputs_(session, replica, Engines(*replica.experiment, role_.Layout())),
        commands_(session.GetBus(), session.Scope(replica.limits->CommandBytes(), 1)),
        inspection_(session, role_, host_, inputs_.Mutex())
  {
    const auto& from = role_.Layout().frames_from;
    for (auto& frames : frames_) frames.resize(from.size());
    frames_here_.resize(from.size());
    replica.Restore(HostName(host), role_);
    // Nobody sends the frames of the first tick: there are none, or the engines saved them first of all.
    for (std::size_t k = 0; k < from.size(); ++k)
    {
      inputs_.HaveFirst(k);
      if (!replica.checkpoint) continue;
      ByteReader state(replica.checkpoint->StateOf(EngineName(*replica.experiment, from[k])));
      frames_[replica.FirstTick() % 2][k].values = state.GetArray<double>();
    }
    inputs_.Open({[this](std::size_t k, std::uint64_t tick) { return &frames_[tick % 2][k]; }, [this] { Tick(); },
                  [this] { AnswerAgain(); }},
                 replica.limits->FrameBytes(), FrameWriters());
  }
  ~HostNode() { inputs_.Close(); }

  // Until all whom this host hears or speaks to are there.
  void WaitForOthers()
  {
    unsigned readers = 0;
    for (const EngineLayout& engine : replica_.assignment.engines) readers += engine.commands_from.empty() ? 0 : 1;
    for (const HostLayout& host : replica_.assignment.hosts)
      if (ServerHears(host))
      {
        ++readers;
        break;
      }
    session_.WaitUntil(
        [&]
        {
          return inputs_.ServerIsHere() && inputs_.MissingWriters() == 0 && commands_.Readers() >= readers &&
                 saved_.Matched();
        },
        [&] { return std::string("the engines"); });
  }

  std::optional<std::string> Stall()
  {
    return inputs_.Stall([] { return "runs " + CurrentActivity(); });
  }

  void Flush() { saved_.Flush(); }
  void Destroy() { role_.Destroy(); }

private:
  using Inputs = TickInputs<SensorFrame>;

  // Engines do not wait for their frames to be read: they may be one tick ahead.
  static std::vector<Inputs::Other> Engines(const Experiment& experiment, const HostLayout& layout)
  {
    std::vector<Inputs::Other> engines;
    for (const std::uint32_t engine : layout.frames_from)
      engines.push_back({engine, {EngineName(experiment, engine), true}});
    return engines;
  }

  unsigned FrameWriters() const
  {
    unsigned writers = 0;
    for (const EngineLayout& engine : replica_.assignment.engines) writers += engine.sensor_size > 0 ? 1 : 0;
    return writers;
  }

  void Tick()
  {
    for (std::size_t k = 0; k < frames_here_.size(); ++k) frames_here_[k] = &frames_[inputs_.Tick() % 2][k];
    const bool first = inputs_.Tick() == 0;
    answer_ =
        &role_.Tick(first ? std::span<const SensorFrame* const>() : std::span<const SensorFrame* const>(frames_here_));
    inputs_.Next();
    saved_.Ready(inputs_.Tick(), role_);
    Answer(false);
    inspection_.Stepped();
  }

  void AnswerAgain()
  {
    if (answer_ != nullptr) Answer(true);
  }

  void Answer(bool repeated)
  {
    MessageHeader header = session_.Header(answer_->tick, host_);
    header.repeated = repeated;
    commands_.Write(header, *answer_);
  }

  WorkerSession& session_;
  Replica& replica_;
  std::uint32_t host_;
  ControllerHost role_;
  SavedStates saved_;
  Inputs inputs_;                                   // its mutex guards the role and what follows
  std::array<std::vector<SensorFrame>, 2> frames_;  // of even and odd ticks
  std::vector<const SensorFrame*> frames_here_;
  const ControlCommands* answer_ = nullptr;
  HotPublisher<ControlCommands> commands_;
  RobotInspection inspection_;
};

int Run(const WorkerSettings& settings, const BusOptions& bus)
{
  const std::size_t host = settings.host;
  WorkerSession session(bus, settings.experiment, HostName(host));
  return session.Work(
      [&]
      {
        Replica replica(session.World(), true);
        const std::size_t hosts = replica.assignment.hosts.size();
        if (host >= hosts)
          throw ConfigurationError(fmt::format("experiment '{}' has {} controller host{}, numbered from 0",
                                               replica.experiment->name, hosts, hosts == 1 ? "" : "s"));
        HostNode node(session, replica, host);
        node.WaitForOthers();
        session.ReportReady();
        session.Wait(std::chrono::milliseconds(500), [&] { return node.Stall(); });
        node.Flush();
        node.Destroy();
      });
}

}  // namespace
}  // namespace swarmanoid

int main(int count, char** arguments)
{
  using namespace swarmanoid;

  const ProgramDescription program{
      "controller_host",
      "Runs the controllers of some robots of a Swarmanoid experiment.",
      "Examples:\n"
      "  controller_host                                host 0 of the experiment that runs on this machine\n"
      "  controller_host --host 1 --experiment diffusion_10 --domain 7\n"
      "  controller_host --host 1 --interface eth0          space server on another machine",
      []
      {
        DescribeBuiltins();
        RegisterBuiltinDevices();
      },
      true,
      true};
  return RunWorker(program, count, arguments, HostOptionTable, Run);
}
