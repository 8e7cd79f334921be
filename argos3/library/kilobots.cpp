// Kilobots: the controller that runs behaviours in C, and the objects of loop functions.
//
// Behaviours are programs, and each robot has a process of one (argos3/kilolib). A step sends the sensors to the
// process and waits for its answer. The process sleeps between the steps, so results do not depend on its speed.
#include <argos3/core/simulator/physics_engine/physics_engine.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_controller.h>
#include <argos3/plugins/robots/kilobot/simulator/kilobot_communication_medium.h>

#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include "argos3/library/running.h"

extern char** environ;

namespace argos
{
namespace
{

// Describes the end of a process.
std::string EndOf(int status)
{
  if (WIFSIGNALED(status)) return fmt::format("by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  return fmt::format("with exit code {}", WEXITSTATUS(status));
}

CColor ColourOf(UInt8 colour)
{
  const auto channel = [](int level) { return static_cast<UInt8>(255 * level / 3); };
  return {channel(RED(colour)), channel(GREEN(colour)), channel(BLUE(colour))};
}

// Waits for a process that ends by itself, and kills it if it does not.
void WaitFor(pid_t process)
{
  constexpr int kTries = 100, kPauseUs = 10'000;
  for (int i = 0; i < kTries; ++i)
  {
    if (waitpid(process, nullptr, WNOHANG) != 0) return;
    usleep(kPauseUs);
  }
  kill(process, SIGKILL);
  waitpid(process, nullptr, 0);
}

}  // namespace

CKilobotEntity::CKilobotEntity(const std::string& id, const std::string& controller, const CVector3& position,
                               const CQuaternion& orientation, Real)
    : CRobotWithController(id, kLeds, controller, position, orientation)
{
  AddComponent(wheels_);
}

void CKilobotCommunicationMedium::SendOHCMessageTo(CKilobotEntity& robot, message_t* message)
{
  auto& running = swarmanoid::argos3::TheRunning();
  const std::string id = running.OurId(robot.GetId());
  running.overhead_messages.erase(id);
  if (message != nullptr) running.overhead_messages.emplace(id, *message);
}

void CKilobotCommunicationMedium::SendOHCMessageTo(std::vector<CKilobotEntity*>& robots, message_t* message)
{
  for (CKilobotEntity* robot : robots) SendOHCMessageTo(*robot, message);
}

message_t* CKilobotCommunicationMedium::GetOHCMessageFor(CKilobotEntity& robot)
{
  auto& running = swarmanoid::argos3::TheRunning();
  const auto found = running.overhead_messages.find(running.OurId(robot.GetId()));
  return found == running.overhead_messages.end() ? nullptr : &found->second;
}

}  // namespace argos

using namespace argos;

CCI_KilobotController::CCI_KilobotController() = default;
CCI_KilobotController::~CCI_KilobotController()
{
  Stop();
  if (has_debug_info_) RemoveDebugInfo();
}

void CCI_KilobotController::Init(TConfigurationNode& params)
{
  if (HasActuator("differential_steering"))
    motors_ = GetActuator<CCI_DifferentialSteeringActuator>("differential_steering");
  if (HasActuator("kilobot_led")) led_ = GetActuator<CCI_KilobotLEDActuator>("kilobot_led");
  if (HasActuator("kilobot_communication"))
    sender_ = GetActuator<CCI_KilobotCommunicationActuator>("kilobot_communication");
  if (HasSensor("kilobot_communication"))
    receiver_ = GetSensor<CCI_KilobotCommunicationSensor>("kilobot_communication");
  if (HasSensor("kilobot_light")) light_ = GetSensor<CCI_KilobotLightSensor>("kilobot_light");
  random_ = CRandom::CreateRNG("argos");
  GetNodeAttribute(params, "behavior", behavior_);
  Start();
}

void CCI_KilobotController::ControlStep()
{
  if (light_ != nullptr) state_.ambientlight = light_->GetReading();
  if (receiver_ != nullptr)
  {
    const auto& packets = receiver_->GetPackets();
    const std::size_t count = std::min<std::size_t>(packets.size(), KILOBOT_MAX_RX);
    for (std::size_t i = 0; i < count; ++i)
    {
      state_.rx_message[i] = *packets[i].Message;
      state_.rx_distance[i] = packets[i].Distance;
    }
    state_.rx_state = static_cast<UInt8>(count);
    if (receiver_->MessageSent()) state_.tx_state = 2;
  }
  // The answer has the same length.
  const auto size = static_cast<ssize_t>(sizeof state_);
  if (send(socket_, &state_, sizeof state_, MSG_NOSIGNAL) != size ||
      recv(socket_, &state_, sizeof state_, MSG_WAITALL) != size)
  {
    close(std::exchange(socket_, -1));
    int status = 0;
    waitpid(std::exchange(process_, -1), &status, 0);
    THROW_ARGOSEXCEPTION("the behaviour '" << behavior_ << "' of the Kilobot '" << GetId() << "' ended "
                                           << EndOf(status));
  }
  // In ARGoS3, too, the right motor drives the left leg. 255 is 6 cm/s.
  if (motors_ != nullptr) motors_->SetLinearVelocity(6.0 * state_.right_motor / 255, 6.0 * state_.left_motor / 255);
  if (led_ != nullptr) led_->SetColor(ColourOf(state_.color));
  if (sender_ != nullptr && state_.tx_state == 1) sender_->SetMessage(&state_.tx_message);
}

void CCI_KilobotController::Reset()
{
  Stop();
  Start();
}

void CCI_KilobotController::Destroy() { Stop(); }

void CCI_KilobotController::Start()
{
  state_ = kilobot_state_t{};
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    THROW_ARGOSEXCEPTION("no socket for the behaviour of '" << GetId() << "': " << std::strerror(errno));
  socket_ = ends[0];
  constexpr int kTheirSocket = 3;
  const std::string seconds = fmt::format("{}", CPhysicsEngine::GetSimulationClockTick());
  const std::string seed = std::to_string(random_->Uniform(CRange<UInt32>(0, 0xffffffffU)));
  const std::string socket = std::to_string(kTheirSocket);
  std::array<const char*, 7> words{behavior_.c_str(), "swarmanoid",   GetId().c_str(), seconds.c_str(),
                                   seed.c_str(),      socket.c_str(), nullptr};
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[1], kTheirSocket);
  // Standard output has the status lines of the simulator.
  posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // The terminal's signals reach the simulator alone, which then ends the behaviours.
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int failure =
      posix_spawn(&process_, behavior_.c_str(), &files, &attributes, const_cast<char**>(words.data()), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  close(ends[1]);
  if (failure == 0) return;
  process_ = -1;
  THROW_ARGOSEXCEPTION("the behaviour '" << behavior_ << "' of the Kilobot '" << GetId()
                                         << "' cannot be started: " << std::strerror(failure));
}

void CCI_KilobotController::Stop()
{
  if (socket_ >= 0) close(std::exchange(socket_, -1));
  // The process waits for its next step, and ends since the socket is closed.
  if (process_ > 0) WaitFor(std::exchange(process_, -1));
}

std::string CCI_KilobotController::DebugName() const
{
  return fmt::format("/ARGoS_DEBUG_{}_{}", static_cast<long>(getpid()), GetId());
}

void CCI_KilobotController::RemoveDebugInfo()
{
  shm_unlink(DebugName().c_str());
  has_debug_info_ = false;
}

REGISTER_CONTROLLER(CCI_KilobotController, "kilobot_controller")
