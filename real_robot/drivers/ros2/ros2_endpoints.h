// Publishers and subscribers with the topic and type names of ROS 2, over DDS. It is the only code of the robot that
// knows DDS. Its users are the drivers of this folder (in the thread of the controller), the visualiser for ROS 2
// (visualiser/ros2), and the controller that connects a simulated robot to a node (real_robot/ros2_controller).
//
// A topic of ROS 2 is "rt/<name>" on DDS, and a type "<package>::msg::dds_::<Name>_". The DDS domain is that of the
// environment variable ROS_DOMAIN_ID, else 0. With ROS_LOCALHOST_ONLY=1 nothing leaves this machine.
#pragma once

#include <memory>
#include <string>

#include "real_robot/driver.h"

namespace swarmanoid::ros2
{

// Defined in ros2_types.cpp for each message in use.
struct MessageType
{
  std::string name;    // "geometry_msgs/msg/Twist"
  std::string hash;    // "RIHS01_…": the hash of its fields, by the rule of ROS 2
  void* type_support;  // a new TopicDataType of Fast DDS
};
template <class Message>
MessageType TypeOf();

// Returns the name on DDS: rt/<name space>/<name>. A name that starts with '/' is outside the name space. Throws
// DriverError for names that ROS 2 does not allow.
std::string TopicName(const std::string& name_space, const std::string& name);

// Returns the id of a robot as a word of topics. '.', '-' and ':' become '_', and a leading digit gets one before it.
std::string TopicWord(std::string id);

class Writer
{
public:
  enum class Keeps
  {
    kLatest,   // the next value replaces one that has not arrived
    kLatched,  // the same; later subscribers still get the last message
    kRecent,   // some tens, so that reliable listeners miss none; a lost one is sent again within 2 s
    kAwaited   // the same, within some 10 ms, because a listener waits for each; costs more
  };
  Writer(const std::string& topic, const MessageType& type, Keeps keeps = Keeps::kLatest);
  ~Writer();
  // Publishes a message of the type. It waits at most 20 ms for slow listeners.
  void Write(void* message);
  // Waits until all reliable listeners have it, half a second at most.
  void Flush();
  // Returns the number of known listeners.
  unsigned Listeners() const;

private:
  struct Ends;
  std::unique_ptr<Ends> ends_;
};

class Reader
{
public:
  // With `reliable`, no message is lost, and best-effort publishers are not heard.
  Reader(const std::string& topic, const MessageType& type, bool reliable = false);
  ~Reader();
  // Takes the next message, oldest first; returns false if none exists.
  bool Take(void* message);
  // Waits until there is a message to take, so many seconds at most.
  void Wait(double seconds);
  // Returns the number of known publishers.
  unsigned Publishers() const;

private:
  struct Ends;
  std::unique_ptr<Ends> ends_;
};

template <class Message>
class Publisher
{
public:
  Publisher(const DriverSetup& setup, const std::string& topic, Writer::Keeps keeps = Writer::Keeps::kLatest)
      : topic_(TopicName(setup.name_space, topic)), type_(TypeOf<Message>()), writer_(topic_, type_, keeps)
  {
  }
  void Publish(Message& message) { writer_.Write(&message); }
  void Flush() { writer_.Flush(); }
  unsigned Listeners() const { return writer_.Listeners(); }
  std::string Name() const { return "topic " + topic_ + " (" + type_.name + ")"; }

private:
  std::string topic_;
  MessageType type_;
  Writer writer_;
};

// Returns seconds on a monotonic clock.
double Now();

template <class Message>
class Subscriber
{
public:
  Subscriber(const DriverSetup& setup, const std::string& topic, bool reliable = false)
      : topic_(TopicName(setup.name_space, topic)),
        type_(TypeOf<Message>()),
        reader_(topic_, type_, reliable),
        latest_at_(Now())
  {
  }
  // Takes the next message, if there is one. Several may have come since the last call.
  bool TakeNext()
  {
    if (!reader_.Take(&message_)) return false;
    heard_ = true;
    latest_at_ = Now();
    return true;
  }
  // Takes the latest of all messages that came. Returns false if none did.
  bool TakeLatest()
  {
    bool taken = false;
    while (TakeNext()) taken = true;
    return taken;
  }
  void Wait(double seconds) { reader_.Wait(seconds); }
  unsigned Publishers() const { return reader_.Publishers(); }
  const Message& Latest() const { return message_; }
  std::string Name() const { return "topic " + topic_ + " (" + type_.name + ")"; }
  DriverSource Source() const { return {Name(), heard_, Now() - latest_at_}; }

private:
  std::string topic_;
  MessageType type_;
  Reader reader_;
  Message message_;
  bool heard_ = false;
  double latest_at_;
};

}  // namespace swarmanoid::ros2
