// SimulatedNetwork delivers the messages of simulated processes. simulated_bus.cpp builds common/bus/bus.h on it.
//
// It guarantees what DDS guarantees, and no more. The messages of one writer keep their order; those of different
// writers do not. Messages of a tick may be lost on one machine, and late on a network. Other messages may be late, but
// arrive. A slow reader loses the oldest messages.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.h"
#include "common/bus/topics/qos.h"
#include "idl/messages.h"
#include "tests/simulated_cluster/simulated_processes.h"

namespace swarmanoid::test
{

struct NetworkFaults
{
  bool has_network = false;  // several machines; otherwise all processes share the memory of one
  double latency_factor = 1;
  double loss = 0;           // probability for a message of a tick
  double duplicates = 0;     // probability for a repeated message, which comes later
  double lost_at_match = 0;  // probability for messages kept for processes that join later
  double slow_copies = 0;    // probability that a message of a tick is copied while other threads of its process run
};

// It holds a message for one reader.
struct Sample
{
  std::shared_ptr<const void> message;
  MessageHeader header{};  // header, for a message of a tick
  std::string process;     // process of the writer
  std::string name;
};

// A reader does this with a message of a tick that it takes, after it has chosen the place.
struct SimulatedCopy
{
  std::function<void()> spoil;  // as the place is while the bytes are copied
  std::function<void()> end;    // the message is there
};

struct SimulatedReader
{
  SimulatedProcess* process = nullptr;
  std::string topic;
  std::string partition;
  std::size_t depth = 0;  // limit for unread messages; 0: none
  bool is_open = true;
  std::deque<Sample> samples;
  std::function<SimulatedCopy(const Sample&)> take;  // without `end`: nothing is copied
  std::function<void()> end_of_copy;                 // set while a message is copied
};

struct SimulatedWriter
{
  struct Link
  {
    std::shared_ptr<SimulatedReader> reader;
    RunTime met_by_writer, met_by_reader;
    RunTime newest{};  // arrival of the newest message
    bool is_cut = false;
  };

  SimulatedProcess* process = nullptr;
  std::string topic;
  std::string partition;
  std::string name;  // name of its process on the bus
  TopicQos qos;
  bool is_open = true;
  std::vector<Link> links;
  std::deque<Sample> kept;
  std::shared_ptr<int> underway = std::make_shared<int>(0);
};

struct SimulatedBus
{
  SimulatedProcess* process = nullptr;
  std::string name;
  std::function<void(const std::string&, const std::string&, bool)> on_gone{};
  std::function<bool(const BadMessageReport&)> on_bad{};
  std::function<void(const BadMessageReport&)> on_refused{};
  std::uint64_t dropped = 0;
};

class SimulatedNetwork
{
public:
  SimulatedNetwork(Simulation& simulation, const NetworkFaults& faults, Duration lease);
  ~SimulatedNetwork();
  static SimulatedNetwork& Current();

  std::shared_ptr<SimulatedBus> Join(const std::string& name);
  void Leave(const std::shared_ptr<SimulatedBus>& bus);
  std::shared_ptr<SimulatedWriter> AddWriter(SimulatedBus& bus, const std::string& topic, const std::string& base,
                                             const std::string& partition);
  void Add(const std::shared_ptr<SimulatedReader>& reader);
  void Close(SimulatedWriter& writer);
  void Close(SimulatedReader& reader);
  void Send(SimulatedWriter& writer, Sample sample);
  unsigned Readers(const SimulatedWriter& writer) const;
  unsigned Writers(const SimulatedReader& reader) const;

  // Faults of processes. After the lease the others report the process as gone.
  void Died(SimulatedProcess& process);
  void Stopped(SimulatedProcess& process, Duration time);
  // Stops all messages between that machine and the others for a time.
  void Cut(const std::string& machine, Duration time);
  bool IsCut(const std::string& machine) const;

  std::function<void(const SimulatedWriter&, const SimulatedReader&, const Sample&)> on_send;

private:
  void Meet(const std::shared_ptr<SimulatedWriter>& writer, const std::shared_ptr<SimulatedReader>& reader,
            Duration after);
  void Deliver(const SimulatedWriter& writer, SimulatedWriter::Link& link, const Sample& sample, bool may_be_lost);
  void Arrive(const std::shared_ptr<SimulatedReader>& reader, const Sample& sample,
              const std::shared_ptr<int>& underway, RunTime at);
  void TakeOldest(const std::shared_ptr<SimulatedReader>& reader);
  bool AreApart(const SimulatedProcess& a, const SimulatedProcess& b) const;
  // Changes whether one of them receives messages of the other.
  void Part(SimulatedProcess& of, SimulatedProcess& from, bool died);
  void MeetAgain(SimulatedProcess& a, SimulatedProcess& b);

  Simulation& simulation_;
  NetworkFaults faults_;
  SeededRandom copies_{1};
  Duration lease_;
  std::vector<std::shared_ptr<SimulatedBus>> buses_;
  std::vector<std::shared_ptr<SimulatedWriter>> writers_;
  std::vector<std::shared_ptr<SimulatedReader>> readers_;
  std::map<std::string, RunTime> cut_until_;  // by machine
};

std::string IdOf(const SimulatedProcess& process);

}  // namespace swarmanoid::test
