// Fast DDS is set up here so that every node of ROS 2 understands the robot: names and types are written as the
// middlewares of ROS 2 write them, with the hash of each type, and the qualities of service are the ones that all
// listeners accept. One participant is shared by the whole process, since each one costs threads, sockets and a slot
// among the ports of a domain.
//
// Writers never let a control step wait: a message that does not fit into a full queue is replaced by the next one. The
// counts of listeners are written in threads of Fast DDS and are therefore atomic; all other members belong to the
// thread of the caller.
#include "real_robot/drivers/ros2/ros2_endpoints.h"

#include <atomic>
#include <cstdlib>
#include <ctime>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "common/bus/dds/fast_dds.h"
#include "common/configuration/configuration_tree.h"
#include "real_robot/drivers/ros2/joined_datagrams.h"

namespace swarmanoid::ros2
{
namespace
{

const DdsDuration kFlushTime{0, 500'000'000};
constexpr int kRecentMessages = 64;
const DdsDuration kSoon{0, 20'000'000};
// Each of these timers of Fast DDS wakes a thread that sorts the timers of all writers. With hundreds of writers, fast
// timers would cost more than the messages.
const DdsDuration kInTime{1, 0};
const DdsDuration kWriteTime{0, 20'000'000};  // a step must not wait for a slow listener

std::uint32_t Domain()
{
  const char* text = std::getenv("ROS_DOMAIN_ID");
  if (text == nullptr || *text == '\0') return 0;
  const auto number = ParseInteger(text);
  if (!number || *number < 0 || *number > 232)
    throw DriverError(fmt::format("ROS_DOMAIN_ID is '{}'; it must be 0 to 232", text));
  return static_cast<std::uint32_t>(*number);
}

bool LocalhostOnly()
{
  const char* text = std::getenv("ROS_LOCALHOST_ONLY");
  return text != nullptr && std::string(text) == "1";
}

// The participant of the process. All drivers share it, and it lives as long as one of them.
class Participant
{
public:
  static std::shared_ptr<Participant> Of()
  {
    static std::weak_ptr<Participant> shared;
    std::shared_ptr<Participant> participant = shared.lock();
    if (participant == nullptr) shared = participant = std::make_shared<Participant>();
    return participant;
  }

  Participant()
  {
    dds::DomainParticipantQos qos;
    qos.name("swarmanoid");
    SendNoTypeInformation(qos);
    // Only UDP is used. All vendors support it, and no shared memory is left behind when a robot loses power.
    qos.transport().use_builtin_transports = false;
    auto udp = std::make_shared<transport::UDPv4TransportDescriptor>();
    if (LocalhostOnly()) udp->interfaceWhiteList = {"127.0.0.1"};
    qos.transport().user_transports.push_back(JoiningTransport(udp));
    participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(Domain(), qos);
    if (participant_ == nullptr)
      throw DriverError(fmt::format("cannot join the DDS domain {}: no network, or too many programs in it", Domain()));
    publisher_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  }
  ~Participant()
  {
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  dds::Publisher* GetPublisher() const { return publisher_; }
  dds::Subscriber* GetSubscriber() const { return subscriber_; }

  dds::Topic* TopicOf(const std::string& name, const MessageType& message)
  {
    dds::TypeSupport type(static_cast<dds::TopicDataType*>(message.type_support));
    if (const auto found = topics_.find(name); found != topics_.end())
    {
      if (found->second->get_type_name() == type.get_type_name()) return found->second;
      throw DriverError(fmt::format("topic {} cannot be of type {}: another driver uses it as {}", name,
                                    type.get_type_name(), found->second->get_type_name()));
    }
    dds::Topic* topic = nullptr;
    if (!participant_->find_type(type.get_type_name()).empty() || Succeeded(type.register_type(participant_)))
      topic = participant_->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT);
    if (topic == nullptr) throw DriverError("cannot create topic " + name);
    return topics_[name] = topic;
  }

private:
  dds::DomainParticipant* participant_ = nullptr;
  dds::Publisher* publisher_ = nullptr;
  dds::Subscriber* subscriber_ = nullptr;
  std::map<std::string, dds::Topic*> topics_;
};

// Publishes the hash of a type as the middlewares of ROS 2 do (REP 2016), so that tools can compare message types.
std::vector<unsigned char> UserData(const MessageType& message)
{
  const std::string text = "typehash=" + message.hash + ";";
  return {text.begin(), text.end()};
}

}  // namespace

std::string TopicName(const std::string& name_space, const std::string& name)
{
  std::string full = name.starts_with('/') ? name : "/" + (name_space.empty() ? "" : name_space + "/") + name;
  if (!name.starts_with('/') && name_space.starts_with('/')) full.erase(0, 1);
  bool good = full.size() > 1 && !full.ends_with('/') && full.find("//") == std::string::npos;
  for (std::size_t k = 1; k < full.size(); ++k)
  {
    const char c = full[k];
    const bool digit = c >= '0' && c <= '9';
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    if (!(letter || c == '/' || (digit && full[k - 1] != '/'))) good = false;
  }
  if (good) return "rt" + full;
  throw DriverError(
      fmt::format("'{}' cannot be the name of a ROS 2 topic: words of letters, digits and '_', not "
                  "starting with a digit, separated by '/'",
                  full));
}

std::string TopicWord(std::string id)
{
  for (char& c : id)
    if (c == '.' || c == '-' || c == ':') c = '_';
  if (!id.empty() && id[0] >= '0' && id[0] <= '9') id.insert(id.begin(), '_');
  return id;
}

double Now()
{
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

struct Writer::Ends : dds::DataWriterListener
{
  std::shared_ptr<Participant> participant = Participant::Of();
  dds::DataWriter* writer = nullptr;
  bool latched = false;
  std::atomic<int> listeners = 0;  // a thread of Fast DDS writes it

  // Called in a thread of Fast DDS.
  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) override
  {
    listeners = status.current_count;
  }
};

// The writer is reliable, which all listeners of ROS 2 accept, whether they request reliability or not.
Writer::Writer(const std::string& topic, const MessageType& type, Keeps keeps) : ends_(std::make_unique<Ends>())
{
  dds::Topic* made = ends_->participant->TopicOf(topic, type);
  dds::DataWriterQos qos;
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.reliability().max_blocking_time = kWriteTime;
  const bool recent = keeps == Keeps::kRecent || keeps == Keeps::kAwaited;
  if (recent) SetHeartbeatPeriod(qos, keeps == Keeps::kAwaited ? kSoon : kInTime);
  if (keeps == Keeps::kRecent) SetNackSuppression(qos, kInTime);
  // The durability is that of ROS 2. The defaults of Fast DDS for writers and readers differ.
  qos.durability().kind = keeps == Keeps::kLatched ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = recent ? kRecentMessages : 1;
  qos.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  qos.user_data().setValue(UserData(type));
  ends_->latched = keeps == Keeps::kLatched;
  ends_->writer = ends_->participant->GetPublisher()->create_datawriter(made, qos, ends_.get(),
                                                                        dds::StatusMask::publication_matched());
  if (ends_->writer == nullptr) throw DriverError("cannot write topic " + topic);
}

Writer::~Writer()
{
  // Fast DDS 2.9 returns the messages of a writer one by one, while its heartbeat may be looking for gaps between them.
  // That loop never ends, and holds the lock that the next message needs.
  std::size_t removed = 0;
  ends_->writer->clear_history(&removed);
  ends_->participant->GetPublisher()->delete_datawriter(ends_->writer);
}

void Writer::Write(void* message)
{
  if (!ends_->latched && ends_->listeners == 0) return;  // no listener would ever get it
  // A full queue means that a listener is slow; the next value replaces this one.
  WriteMessage(*ends_->writer, message);
}

void Writer::Flush() { ends_->writer->wait_for_acknowledgments(kFlushTime); }

unsigned Writer::Listeners() const { return static_cast<unsigned>(ends_->listeners.load()); }

struct Reader::Ends
{
  std::shared_ptr<Participant> participant = Participant::Of();
  dds::DataReader* reader = nullptr;
};

// A best-effort reader hears reliable and best-effort publishers. A lost message is replaced by the next one. A few are
// kept, since several programs may publish one topic, each for some of the robot's joints.
Reader::Reader(const std::string& topic, const MessageType& type, bool reliable) : ends_(std::make_unique<Ends>())
{
  dds::Topic* made = ends_->participant->TopicOf(topic, type);
  dds::DataReaderQos qos;
  qos.reliability().kind = reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 10;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  qos.user_data().setValue(UserData(type));
  ends_->reader = ends_->participant->GetSubscriber()->create_datareader(made, qos);
  if (ends_->reader == nullptr) throw DriverError("cannot read topic " + topic);
}

Reader::~Reader() { ends_->participant->GetSubscriber()->delete_datareader(ends_->reader); }

bool Reader::Take(void* message)
{
  dds::SampleInfo about;
  while (Succeeded(ends_->reader->take_next_sample(message, &about)))
    if (about.valid_data) return true;
  return false;
}

void Reader::Wait(double seconds) { ends_->reader->wait_for_unread_message(Seconds(seconds)); }

unsigned Reader::Publishers() const
{
  dds::SubscriptionMatchedStatus status;
  ends_->reader->get_subscription_matched_status(status);
  return static_cast<unsigned>(status.current_count);
}

}  // namespace swarmanoid::ros2
