#include "tests/simulated_cluster/simulated_network.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace swarmanoid::test
{
namespace
{

using namespace std::chrono_literals;

SimulatedNetwork* current_network = nullptr;

}  // namespace

std::string IdOf(const SimulatedProcess& process) { return fmt::format("{}:{}", process.machine, process.pid); }

SimulatedNetwork::SimulatedNetwork(Simulation& simulation, const NetworkFaults& faults, Duration lease)
    : simulation_(simulation), faults_(faults), lease_(lease)
{
  current_network = this;
}

SimulatedNetwork::~SimulatedNetwork() { current_network = nullptr; }

SimulatedNetwork& SimulatedNetwork::Current() { return *current_network; }

std::shared_ptr<SimulatedBus> SimulatedNetwork::Join(const std::string& name)
{
  buses_.push_back(std::make_shared<SimulatedBus>(SimulatedBus{&simulation_.CurrentProcess(), name}));
  return buses_.back();
}

void SimulatedNetwork::Leave(const std::shared_ptr<SimulatedBus>& bus)
{
  bus->on_gone = nullptr;
  bus->on_bad = nullptr;
  bus->on_refused = nullptr;
  std::erase(buses_, bus);
  if (!bus->process->is_alive) return;
  bus->process->has_left_bus = true;
  SimulatedProcess& process = *bus->process;
  simulation_.After(simulation_.Random().Between(1ms, 20ms),
                    [this, &process]
                    {
                      for (const auto& other : simulation_.Processes())
                        if (other->is_alive && other.get() != &process) Part(process, *other, false);
                    });
}

std::shared_ptr<SimulatedWriter> SimulatedNetwork::AddWriter(SimulatedBus& bus, const std::string& topic,
                                                             const std::string& base, const std::string& partition)
{
  auto writer = std::make_shared<SimulatedWriter>();
  writer->process = bus.process;
  writer->topic = topic;
  writer->partition = partition;
  writer->name = bus.name;
  writer->qos = QosOf(base);
  writers_.push_back(writer);
  for (const auto& reader : readers_) Meet(writer, reader, 0ms);
  return writer;
}

void SimulatedNetwork::Add(const std::shared_ptr<SimulatedReader>& reader)
{
  readers_.push_back(reader);
  for (const auto& writer : writers_) Meet(writer, reader, 0ms);
}

void SimulatedNetwork::Close(SimulatedWriter& writer)
{
  writer.is_open = false;
  std::erase_if(writers_, [&](const auto& other) { return other.get() == &writer; });
}

void SimulatedNetwork::Close(SimulatedReader& reader)
{
  reader.is_open = false;
  reader.take = nullptr;
  reader.end_of_copy = nullptr;
  reader.samples.clear();
  std::erase_if(readers_, [&](const auto& other) { return other.get() == &reader; });
  for (const auto& writer : writers_)
    std::erase_if(writer->links, [&](const SimulatedWriter::Link& link) { return link.reader.get() == &reader; });
}

// Discovery takes a while, and the two sides end it at different times.
void SimulatedNetwork::Meet(const std::shared_ptr<SimulatedWriter>& writer,
                            const std::shared_ptr<SimulatedReader>& reader, Duration after)
{
  if (writer->topic != reader->topic) return;
  if (writer->partition != reader->partition && reader->partition != "*") return;
  if (!writer->process->is_alive || !reader->process->is_alive) return;
  if (AreApart(*writer->process, *reader->process)) return;  // they meet when the cut is over
  SeededRandom& random = simulation_.Random();
  const RunTime begin = simulation_.Now() + after;
  writer->links.push_back({reader, begin + random.Between(100us, 20ms), begin + random.Between(100us, 20ms), {}});
  if (!writer->qos.transient_local) return;
  simulation_.At(writer->links.back().met_by_writer,
                 [this, writer, reader]
                 {
                   if (!writer->is_open || !reader->is_open) return;
                   const auto link =
                       std::find_if(writer->links.begin(), writer->links.end(),
                                    [&](const SimulatedWriter::Link& candidate) { return candidate.reader == reader; });
                   if (link == writer->links.end()) return;
                   for (const Sample& sample : writer->kept)
                     if (!simulation_.Random().Happens(faults_.lost_at_match)) Deliver(*writer, *link, sample, false);
                 });
}

void SimulatedNetwork::Send(SimulatedWriter& writer, Sample sample)
{
  if (!writer.process->is_alive || !writer.is_open) return;
  sample.process = IdOf(*writer.process);
  sample.name = writer.name;
  if (writer.qos.transient_local)
  {
    writer.kept.push_back(sample);
    while (writer.kept.size() > static_cast<std::size_t>(writer.qos.writer_depth)) writer.kept.pop_front();
  }
  for (SimulatedWriter::Link& link : writer.links)
    if (link.met_by_writer <= simulation_.Now()) Deliver(writer, link, sample, writer.qos.hot);
}

void SimulatedNetwork::Deliver(const SimulatedWriter& writer, SimulatedWriter::Link& link, const Sample& sample,
                               bool may_be_lost)
{
  if (on_send) on_send(writer, *link.reader, sample);
  SeededRandom& random = simulation_.Random();
  const auto latency = [&]
  {
    return Duration(
        static_cast<Duration::rep>(static_cast<double>(random.Between(20us, 200us).count()) * faults_.latency_factor));
  };
  const bool is_best_effort = writer.qos.hot && !faults_.has_network;
  RunTime arrival = simulation_.Now() + latency();
  if (AreApart(*writer.process, *link.reader->process))
  {
    if (is_best_effort) return;
    arrival +=
        std::max(cut_until_[writer.process->machine], cut_until_[link.reader->process->machine]) - simulation_.Now();
  }
  if (may_be_lost && random.Happens(faults_.loss))
  {
    if (is_best_effort) return;
    arrival += random.Between(1ms, 100ms);
  }
  arrival = std::max(arrival, link.newest);
  link.newest = arrival;
  ++*writer.underway;
  Arrive(link.reader, sample, writer.underway, arrival);
  if (!writer.qos.hot || !random.Happens(faults_.duplicates)) return;
  ++*writer.underway;
  Arrive(link.reader, sample, writer.underway, arrival + random.Between(0us, 50ms));
}

void SimulatedNetwork::Arrive(const std::shared_ptr<SimulatedReader>& reader, const Sample& sample,
                              const std::shared_ptr<int>& underway, RunTime at)
{
  simulation_.At(at,
                 [this, reader, sample, underway]
                 {
                   --*underway;
                   if (!reader->is_open || !reader->process->is_alive) return;
                   reader->samples.push_back(sample);
                   if (reader->depth > 0 && reader->samples.size() > reader->depth) reader->samples.pop_front();
                   simulation_.Post(*reader->process, [this, reader] { TakeOldest(reader); });
                 });
}

// A reader takes one message at a time, and the others of its process go on meanwhile.
void SimulatedNetwork::TakeOldest(const std::shared_ptr<SimulatedReader>& reader)
{
  if (!reader->is_open || reader->end_of_copy || reader->samples.empty()) return;
  const Sample oldest = std::move(reader->samples.front());
  reader->samples.pop_front();
  SimulatedCopy copy = reader->take(oldest);
  if (!copy.end) return;
  if (!copies_.Happens(faults_.slow_copies)) return copy.end();
  copy.spoil();
  reader->end_of_copy = std::move(copy.end);
  const auto end = [this, reader]
  {
    if (!reader->is_open) return;
    std::exchange(reader->end_of_copy, nullptr)();
    for (std::size_t waiting = reader->samples.size(); waiting > 0; --waiting) TakeOldest(reader);
  };
  simulation_.After(copies_.Between(1us, 1ms), [this, reader, end] { simulation_.Post(*reader->process, end); });
}

unsigned SimulatedNetwork::Readers(const SimulatedWriter& writer) const
{
  return static_cast<unsigned>(std::count_if(writer.links.begin(), writer.links.end(),
                                             [this](const SimulatedWriter::Link& link)
                                             { return link.met_by_writer <= simulation_.Now(); }));
}

unsigned SimulatedNetwork::Writers(const SimulatedReader& reader) const
{
  unsigned count = 0;
  for (const auto& writer : writers_)
    for (const SimulatedWriter::Link& link : writer->links)
      count += link.reader.get() == &reader && link.met_by_reader <= simulation_.Now() ? 1 : 0;
  return count;
}

void SimulatedNetwork::Died(SimulatedProcess& process)
{
  if (process.has_left_bus) return;
  std::erase_if(buses_, [&](const auto& bus) { return bus->process == &process; });
  simulation_.After(lease_,
                    [this, &process]
                    {
                      for (const auto& other : simulation_.Processes())
                        if (other->is_alive) Part(process, *other, true);
                    });
}

void SimulatedNetwork::Stopped(SimulatedProcess& process, Duration time)
{
  if (time <= lease_) return;
  simulation_.After(lease_,
                    [this, &process]
                    {
                      if (process.stopped_until <= simulation_.Now() || !process.is_alive) return;
                      for (const auto& other : simulation_.Processes())
                        if (other->is_alive && other.get() != &process) Part(process, *other, true);
                      simulation_.At(process.stopped_until,
                                     [this, &process]
                                     {
                                       for (const auto& other : simulation_.Processes())
                                         if (other.get() != &process) MeetAgain(process, *other);
                                     });
                    });
}

void SimulatedNetwork::Cut(const std::string& machine, Duration time)
{
  RunTime& until = cut_until_[machine];
  until = std::max(until, simulation_.Now() + time);
  simulation_.At(until,
                 [this]
                 {
                   for (std::size_t a = 0; a < simulation_.Processes().size(); ++a)
                     for (std::size_t b = 0; b < a; ++b)
                       MeetAgain(*simulation_.Processes()[a], *simulation_.Processes()[b]);
                 });
  if (time <= lease_) return;
  simulation_.After(lease_,
                    [this, machine]
                    {
                      if (!IsCut(machine)) return;
                      for (const auto& here : simulation_.Processes())
                        for (const auto& there : simulation_.Processes())
                          if (here->is_alive && there->is_alive && AreApart(*here, *there)) Part(*here, *there, true);
                    });
}

bool SimulatedNetwork::IsCut(const std::string& machine) const
{
  const auto cut = cut_until_.find(machine);
  return cut != cut_until_.end() && cut->second > simulation_.Now();
}

bool SimulatedNetwork::AreApart(const SimulatedProcess& a, const SimulatedProcess& b) const
{
  return a.machine != b.machine && (IsCut(a.machine) || IsCut(b.machine));
}

void SimulatedNetwork::Part(SimulatedProcess& of, SimulatedProcess& from, bool died)
{
  for (const auto& writer : writers_)
    std::erase_if(writer->links,
                  [&](const SimulatedWriter::Link& link)
                  {
                    const auto* const a = writer->process;
                    const auto* const b = link.reader->process;
                    return (a == &of && b == &from) || (a == &from && b == &of);
                  });
  for (const auto& bus : buses_)
    if (bus->process == &from)
      simulation_.Post(from,
                       [bus, id = IdOf(of), name = of.name, died]
                       {
                         if (bus->on_gone) bus->on_gone(id, name, died);
                       });
}

void SimulatedNetwork::MeetAgain(SimulatedProcess& a, SimulatedProcess& b)
{
  if (!a.is_alive || !b.is_alive || AreApart(a, b)) return;
  for (const auto& writer : writers_)
    for (const auto& reader : readers_)
    {
      const bool is_between =
          (writer->process == &a && reader->process == &b) || (writer->process == &b && reader->process == &a);
      const auto is_met = [&](const SimulatedWriter::Link& link) { return link.reader == reader; };
      if (is_between && std::none_of(writer->links.begin(), writer->links.end(), is_met)) Meet(writer, reader, 0ms);
    }
}

}  // namespace swarmanoid::test
