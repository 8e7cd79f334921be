// Publishers and subscribers with the topic and type names of ROS 2, over DDS. The only code of the robot that knows
// DDS; the drivers of this folder use it, from the thread of the controller, and the visualiser that shows a simulation
// to ROS 2 (visualiser/ros2).
//
// A topic of ROS 2 is "rt/<name>" on DDS, and a type "<package>::msg::dds_::<Name>_". The DDS domain is that of the
// environment variable ROS_DOMAIN_ID, else 0; with ROS_LOCALHOST_ONLY=1 nothing leaves this machine.
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
  void* type_support;  // a new eprosima::fastdds::dds::TopicDataType
};
template <class Message>
MessageType TypeOf();

// The name on DDS: rt/<name space>/<name>; a name that starts with '/' is outside the name space. Throws DriverError
// for what ROS 2 does not allow.
std::string TopicName(const std::string& name_space, const std::string& name);

class Writer
{
public:
  // Latched: who comes later still gets the last message.
  Writer(const std::string& topic, const MessageType& type, bool latched = false);
  ~Writer();
  void Write(void* message);
  // Waits until all who listen reliably have it, half a second at most.
  void Flush();

private:
  struct Ends;
  std::unique_ptr<Ends> ends_;
};

class Reader
{
public:
  Reader(const std::string& topic, const MessageType& type);
  ~Reader();
  // The next message, oldest first; false if there is none.
  bool Take(void* message);

private:
  struct Ends;
  std::unique_ptr<Ends> ends_;
};

template <class Message>
class Publisher
{
public:
  Publisher(const DriverSetup& setup, const std::string& topic)
      : topic_(TopicName(setup.name_space, topic)), type_(TypeOf<Message>()), writer_(topic_, type_)
  {
  }
  void Publish(Message& message) { writer_.Write(&message); }
  void Flush() { writer_.Flush(); }
  std::string Name() const { return "topic " + topic_ + " (" + type_.name + ")"; }

private:
  std::string topic_;
  MessageType type_;
  Writer writer_;
};

// Seconds on a clock that only goes forward.
double Now();

template <class Message>
class Subscriber
{
public:
  Subscriber(const DriverSetup& setup, const std::string& topic)
      : topic_(TopicName(setup.name_space, topic)), type_(TypeOf<Message>()), reader_(topic_, type_), latest_at_(Now())
  {
  }
  // Takes over the next message, if there is one. Several may have come since the last call.
  bool TakeNext()
  {
    if (!reader_.Take(&message_)) return false;
    heard_ = true;
    latest_at_ = Now();
    return true;
  }
  // The latest of all that came. False if none did.
  bool TakeLatest()
  {
    bool taken = false;
    while (TakeNext()) taken = true;
    return taken;
  }
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
