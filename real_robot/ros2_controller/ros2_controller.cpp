// ros2_controller: a node of ROS 2 controls a simulated robot. It publishes the robot's readings on the topics of a
// real robot, and drives as the node commands. It runs in the processes of controllers; all calls come from one thread.
//
// In lock step a run is repeatable although nodes are slow and DDS is not: a control step publishes the readings of its
// tick and waits until a command has come on each topic. Commands that were on the way before are dropped, so a command
// is an answer to these readings. To make a step of a hundred robots as short as that of the slowest node, the first
// robot of a host that is stepped publishes the readings of all (Group). In free running the newest commands count.
//
// Discovery is the delicate part. One end may know the other before it is known itself, and then loses the first
// messages; so the readings are repeated until the node has answered once, and the surplus answers are dropped.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <optional>
#include <sstream>
#include <thread>

#include "common/configuration/wording.h"
#include "common/control_interface/ci_controller.h"
#include "common/control_interface/footbot/ci_footbot_encoders_sensor.h"
#include "real_robot/drivers/ros2/joined_datagrams.h"
#include "real_robot/ros2_controller/device_commands.h"
#include "real_robot/ros2_controller/drive.h"
#include "real_robot/ros2_controller/readings.h"

namespace swarmanoid::ros2
{
namespace
{

constexpr double kSettle_s = 0.2;  // from the discovery by one end until both ends surely know each other
constexpr double kSayAgain_s = 1;  // until the node has answered once
constexpr double kLookAgain_s = 0.02;

class CRos2Controller;

// The robots of one host, which makes all their controllers before it calls Init of the first. They publish their
// readings together, and so wait for their nodes at the same time. Controllers that are made again later form their own
// groups.
struct Group
{
  std::vector<CRos2Controller*> members;
  bool is_complete = false;
  std::optional<std::uint64_t> dropping_of;  // the tick whose second answers are dropped
  double dropping_until = 0;
};

class CRos2Controller : public CCI_Controller
{
public:
  CRos2Controller()
  {
    static thread_local std::weak_ptr<Group> latest;
    group_ = latest.lock();
    if (group_ == nullptr || group_->is_complete) latest = group_ = std::make_shared<Group>();
    group_->members.push_back(this);
    All().push_back(this);
  }
  ~CRos2Controller() override
  {
    std::erase(group_->members, this);
    std::erase(All(), this);
  }

  int Init(const TConfigurationTree t_tree) override
  {
    group_->is_complete = true;
    try
    {
      Prepare(t_tree);
    }
    catch (const DriverError& error)
    {
      throw ConfigurationError(t_tree.Location(), error.what());
    }
    return RETURN_OK;
  }

  void ControlStep() override
  {
    const std::uint64_t tick = GetRobot()->GetTick();
    if (!ends_) OpenAll();
    if (lock_step_)
    {
      if (asked_tick_ != tick || stepped_tick_ == tick) AskAll(tick);
      if (asked_tick_ != tick) RefuseWithoutNode();
      AwaitCommands();
    }
    else
    {
      if (asked_tick_ != tick) TellAll(tick);
      while (const auto command = ends_->drive.Take(std::nullopt)) command_ = *command;
      for (const auto& topic : ends_->devices)
      {
        bool came = false;
        while (topic->Take()) came = true;
        if (came) topic->Apply();
      }
    }
    stepped_tick_ = tick;
    drive_->Command(command_);
  }

  void Destroy() override { ends_.reset(); }

  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override
  {
    state << std::setprecision(17) << command_.linear().x() << ' ' << command_.linear().y() << ' '
          << command_.linear().z() << ' ' << command_.angular().z();
    if (odometry_) odometry_->Save(state);
  }
  void LoadState(std::istream& state) override
  {
    double x = 0, y = 0, z = 0, turn = 0;
    state >> x >> y >> z >> turn;
    command_.linear().x(x);
    command_.linear().y(y);
    command_.linear().z(z);
    command_.angular().z(turn);
    if (odometry_) odometry_->Load(state);
  }

  std::string StatusText() const override
  {
    return fmt::format("{}{:.3g} m/s ahead, {:.3g} rad/s", timed_out_ ? "no answer; " : "", command_.linear().x(),
                       command_.angular().z());
  }

private:
  struct Ends
  {
    Ends(const ReadingSetup& setup, bool stamped, bool reliable)
        : readings(MakeReadings(setup)),
          drive(setup.driver, stamped, reliable),
          devices(MakeCommandTopics(*setup.robot, setup.driver, reliable))
    {
    }
    std::vector<std::unique_ptr<ReadingPublisher>> readings;
    Commands drive;
    std::vector<std::unique_ptr<CommandTopic>> devices;

    // Returns the topics of commands without a publisher.
    std::vector<std::string> Unheard() const
    {
      std::vector<std::string> names;
      if (drive.Publishers() == 0) names.push_back(drive.Name());
      for (const auto& topic : devices)
        if (topic->Publishers() == 0) names.push_back(topic->Name());
      return names;
    }
  };

  // Returns the controllers of this process.
  static std::vector<CRos2Controller*>& All()
  {
    static std::vector<CRos2Controller*> all;
    return all;
  }
  void OpenAll() const
  {
    for (CRos2Controller* each : group_->members)
      if (!each->ends_) each->Open();
  }

  // Throws DriverError for mistakes in the parameters.
  void Prepare(const TConfigurationTree& parameters)
  {
    parameters_ = parameters;
    const CCI_Robot& robot = *GetRobot();
    drive_.emplace(robot);
    for (const std::string& type : robot.SensorTypes())
      if (robot.GetSensor(type)->Columns().empty() && robot.GetSensor(type)->Rows().empty())
        throw DriverError(fmt::format("the sensor <{}> declares no columns, so it has no topic", type));
    if (robot.HasSensor("footbot_encoders")) encoders_ = &robot.Sensor<CCI_FootBotEncodersSensor>("footbot_encoders");
    if (drive_->HasWheels()) odometry_.emplace(drive_->Radius(), drive_->Distance());
    name_space_ = parameters.GetText("namespace");
    name_space_ += (name_space_.empty() ? "" : "/") + TopicWord(robot.GetId());
    TopicName(name_space_, "cmd_vel");  // refuses an invalid name
    for (const CRos2Controller* other : All())
      if (other != this && other->name_space_ == name_space_)
        throw DriverError(fmt::format("the topics {}/… would be those of two robots, '{}' and '{}'", name_space_,
                                      other->GetRobot()->GetId(), robot.GetId()));
    lock_step_ = parameters.GetText("mode") == "lock_step";
    on_timeout_ = parameters.GetText("on_timeout");
  }

  void Open()
  {
    const DriverSetup setup{Parameters({}, {}), GetRobot()->GetId(), GetRobot()->GetKind(), name_space_,
                            GetRobot()->GetTickSeconds()};
    const ReadingSetup readings{GetRobot(), setup, parameters_.GetNumber("range"), odometry_ ? &*odometry_ : nullptr,
                                lock_step_};
    ends_.emplace(readings, parameters_.GetBoolean("stamped"), lock_step_);
  }

  void AdvanceOdometry(std::uint64_t tick)
  {
    const double seconds = GetRobot()->GetTickSeconds();
    if (tick == 0) return;
    if (encoders_ != nullptr)
      odometry_->Advance(encoders_->GetLeftVelocity(), encoders_->GetRightVelocity(), seconds);
    else
      odometry_->Advance(drive_->WheelSpeed(command_, -1), drive_->WheelSpeed(command_, 1), seconds);
  }

  void Publish(const builtin_interfaces::msg::dds_::Time_& now)
  {
    Header header;
    header.stamp(now);
    header.frame_id(GetRobot()->GetId());
    for (const auto& reading : ends_->readings) reading->Publish(header);
  }

  unsigned Listeners() const
  {
    unsigned listeners = 0;
    for (const auto& reading : ends_->readings) listeners += reading->Listeners();
    return listeners;
  }

  bool IsHeard() const { return ends_->Unheard().empty() && Listeners() > 0; }

  // Returns whether its step is still to come; a stopped robot has none any more.
  bool TakesPartIn(std::uint64_t tick) const
  {
    return !asked_tick_ || (*asked_tick_ + 1 == tick && stepped_tick_ == asked_tick_);
  }

  // Publishes the readings of the tick for all robots of the group that take part in it, once their nodes are there.
  // The sensors of all robots are at this tick already.
  void AskAll(std::uint64_t tick)
  {
    std::vector<CRos2Controller*> asked;
    for (CRos2Controller* each : group_->members)
      if (each == this || (each->lock_step_ && each->TakesPartIn(tick))) asked.push_back(each);
    AwaitNodes(asked);
    const auto now = TimeOf(GetRobot()->GetTime());
    const JoinedDatagrams joined;
    for (CRos2Controller* each : asked)
      if (each->node_is_here_) each->Ask(tick, now);
  }

  // Publishes the readings of the tick for all robots of the group that had a step in the previous tick, and so have
  // one now. The sensors of all robots are at this tick already.
  void TellAll(std::uint64_t tick)
  {
    const JoinedDatagrams joined;
    const auto now = TimeOf(GetRobot()->GetTime());
    for (CRos2Controller* each : group_->members)
      if (each == this || (!each->lock_step_ && each->ends_ && each->asked_tick_ && each->TakesPartIn(tick)))
        each->Tell(tick, now);
  }

  void Tell(std::uint64_t tick, const builtin_interfaces::msg::dds_::Time_& now)
  {
    if (odometry_) AdvanceOdometry(tick);
    Publish(now);
    asked_tick_ = tick;
  }

  // Waits until the nodes of these robots hear and are heard, or until this robot's time is over, which its own step
  // reports.
  void AwaitNodes(const std::vector<CRos2Controller*>& robots)
  {
    const double begun = Now();
    const auto is_new = [](const CRos2Controller* each) { return !each->node_is_here_; };
    if (std::ranges::none_of(robots, is_new)) return;
    const double wait_s = parameters_.GetNumber("wait");
    const auto is_missing = [&](const CRos2Controller* each) { return is_new(each) && !each->IsHeard(); };
    while (std::ranges::any_of(robots, is_missing) && Now() - begun < wait_s)
      std::this_thread::sleep_for(std::chrono::duration<double>(kLookAgain_s));
    std::this_thread::sleep_for(std::chrono::duration<double>(kSettle_s));
    for (CRos2Controller* each : robots) each->node_is_here_ |= each->IsHeard();
  }

  [[noreturn]] void RefuseWithoutNode() const
  {
    const std::vector<std::string> unheard = ends_->Unheard();
    throw DriverError(
        fmt::format("{} after {:g} s: start the node before the run, with the same ROS_DOMAIN_ID, or give <wait> more",
                    unheard.empty() ? "no node hears the readings on topics rt/" + name_space_ + "/…"
                                    : "no node publishes " + Listed(unheard) + " with reliable quality of service",
                    parameters_.GetNumber("wait")));
  }

  void Ask(std::uint64_t tick, const builtin_interfaces::msg::dds_::Time_& now)
  {
    // Commands that came too late for an earlier tick are dropped.
    while (ends_->drive.Take(std::nullopt))
    {
    }
    for (const auto& topic : ends_->devices)
      while (topic->Take())
      {
      }
    Tell(tick, now);
    asked_at_ = said_at_ = Now();
    repetitions_ = 0;
  }

  // Waits for one command of each topic.
  void AwaitCommands()
  {
    const auto now = TimeOf(GetRobot()->GetTime());
    const double timeout_s = parameters_.GetNumber("timeout");
    std::optional<Twist> drive;
    std::vector<CommandTopic*> silent;
    for (const auto& topic : ends_->devices) silent.push_back(topic.get());
    const auto take = [&]
    {
      if (!drive) drive = ends_->drive.Take(now);
      std::erase_if(silent, [](CommandTopic* topic) { return topic->Take(); });
      return drive && silent.empty();
    };
    bool complete = take();
    const bool waited_for_it = !complete;
    for (double waited = Now() - asked_at_; !complete && waited < timeout_s; waited = Now() - asked_at_)
    {
      if (!has_answered_ && Now() - said_at_ > kSayAgain_s) SayAgain(now);
      const double longest = std::min(timeout_s - waited, kSayAgain_s);
      drive ? silent.front()->Wait(longest) : ends_->drive.Wait(longest);
      complete = take();
    }
    if (drive) command_ = *drive;
    for (const auto& topic : ends_->devices)
      if (std::ranges::find(silent, topic.get()) == silent.end()) topic->Apply();
    if (!complete) return TimeOut(timeout_s, drive ? silent.front()->Name() : ends_->drive.Name());
    if (timed_out_) GetRobot()->Log(ends_->drive.Name() + ": the node answers again");
    timed_out_ = false;
    has_answered_ = true;
    DropAnswers(waited_for_it);
  }

  // Repeats the readings. A peer that has discovered this end, but is not yet discovered by it, misses the first
  // messages. A node that waits for the readings of all robots answers none of them. So this repeats the readings of
  // all robots that were asked together with this one and have no answer yet.
  void SayAgain(const builtin_interfaces::msg::dds_::Time_& now)
  {
    for (CRos2Controller* each : group_->members)
    {
      if (each->asked_tick_ != asked_tick_ || each->stepped_tick_ == asked_tick_ || each->has_answered_) continue;
      each->Publish(now);
      each->said_at_ = Now();
      ++each->repetitions_;
    }
  }

  // Drops further answers. A node that has received each repetition of the readings may answer each one, and none of
  // these answers is for the next readings. Their number is unknown, so this waits for them for a limited time.
  void DropAnswers(bool waited_for_it)
  {
    if (repetitions_ == 0) return;
    if (waited_for_it || group_->dropping_of != asked_tick_) group_->dropping_until = Now() + kSayAgain_s;
    group_->dropping_of = asked_tick_;
    const double until = group_->dropping_until;
    const auto drop = [&](auto& topic, const auto& take)
    {
      for (unsigned dropped = 0; dropped < repetitions_ && Now() < until;)
        take() ? static_cast<void>(++dropped) : topic.Wait(std::max(until - Now(), 0.0));
    };
    drop(ends_->drive, [this] { return ends_->drive.Take(std::nullopt).has_value(); });
    for (const auto& topic : ends_->devices) drop(*topic, [&topic] { return topic->Take(); });
  }

  void TimeOut(double timeout_s, const std::string& topic)
  {
    const std::string what =
        fmt::format("{}: no command within {:g} s for the readings of {:g} s", topic, timeout_s, GetRobot()->GetTime());
    if (on_timeout_ == "abort")
      throw DriverError(what + "; see what the node does, give <timeout> more, or set <on_timeout> to hold or stop");
    const bool stops = on_timeout_ == "stop";
    if (!timed_out_) GetRobot()->Log(what + (stops ? "; the robot stands" : "; the command before it holds"));
    timed_out_ = true;
    if (stops) command_ = Twist();
  }

  std::shared_ptr<Group> group_;
  TConfigurationTree parameters_;
  std::string name_space_;
  bool lock_step_ = true;
  std::string on_timeout_;
  std::optional<Drive> drive_;
  std::optional<WheelOdometry> odometry_;
  const CCI_FootBotEncodersSensor* encoders_ = nullptr;
  std::optional<Ends> ends_;
  Twist command_;
  std::optional<std::uint64_t> asked_tick_;    // the tick whose readings were published last
  std::optional<std::uint64_t> stepped_tick_;  // the tick of the last ControlStep
  double asked_at_ = 0;
  double said_at_ = 0;        // the time of the latest repetition
  unsigned repetitions_ = 0;  // the number of repetitions of these readings
  bool node_is_here_ = false;
  bool has_answered_ = false;
  bool timed_out_ = false;
};

}  // namespace
}  // namespace swarmanoid::ros2

using swarmanoid::ros2::CRos2Controller;

REGISTER_CONTROLLER(
    CRos2Controller,
    {.label = "ros2_controller",
     .brief = "a node of ROS 2 controls the robot: its readings go out on the topics of a real one, cmd_vel comes in",
     .parameters = {
         {.name = "mode",
          .type = ParameterType::kChoice,
          .default_value = "lock_step",
          .description = "lock_step: each control step waits for the command that answers its readings. free_running: "
                         "the newest command counts; such a run cannot be repeated.",
          .choices = {"lock_step", "free_running"}},
         {.name = "on_timeout",
          .type = ParameterType::kChoice,
          .default_value = "abort",
          .description = "What follows if no command comes in time, in lock_step. hold: the command before it. stop: "
                         "the robot stands. abort: the run ends.",
          .choices = {"hold", "stop", "abort"}},
         {"timeout", ParameterType::kNumber, "s", "5", "Time that the node may take for a command, in lock_step.",
          0.001, 3600},
         {"wait", ParameterType::kNumber, "s", "10",
          "Time that the first step waits for the node to appear, in lock_step.", 0, 3600},
         {"stamped", ParameterType::kBoolean, "", "false",
          "Commands are geometry_msgs/msg/TwistStamped; in lock_step the one with the time stamp of the readings "
          "answers them."},
         {"range", ParameterType::kNumber, "m", "0.1",
          "Distance that the proximity sensors see, as their messages state it.", 0.001, 100},
         {"namespace", ParameterType::kText, "", "", "Put in front of the topics, before the id of the robot."}}})
