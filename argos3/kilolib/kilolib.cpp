// The library of behaviours of Kilobots in C: main() and the functions of kilolib.h. A behaviour is a program, so that
// each robot has its own variables. The simulator starts it as
//
//   PROGRAM swarmanoid ROBOT SECONDS_OF_A_STEP SEED SOCKET
//
// and sends the state of the robot (kilobot_state_t) over the socket at the beginning of each step. The program answers
// with the new state at the end of the step, or when it calls delay(). It ends when the socket is closed.
//
// The rules for ticks, delays and messages are those of argos3-kilobot. The code needs no C++ library, since behaviours
// are linked as C.
#include <argos3/plugins/robots/kilobot/control_interface/kilolib.h>

#include <sys/socket.h>

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#undef main

extern "C"
{
  char* kilo_str_id = nullptr;
  uint32_t kilo_ticks = 0;
  uint16_t kilo_tx_period = 100;
  uint16_t kilo_uid = 0;
  uint8_t kilo_turn_left = 77;
  uint8_t kilo_turn_right = 77;
  uint8_t kilo_straight_left = 48;
  uint8_t kilo_straight_right = 48;

  static void IgnoreMessage(message_t*, distance_measurement_t*) {}
  static message_t* NoMessage() { return nullptr; }
  static void IgnoreSuccess() {}

  message_rx_t kilo_message_rx = IgnoreMessage;
  message_tx_t kilo_message_tx = NoMessage;
  message_tx_success_t kilo_message_tx_success = IgnoreSuccess;

  int __kilobot_main(int argc, char* argv[]);
}

namespace
{

kilobot_state_t state;
int simulator = -1;
bool is_in_step = false;  // the simulator waits for an answer
double ticks_of_step = 0, ms_of_step = 0;
double rest_of_tick = 0;   // ticks
double ms_since_sent = 0;  // since the latest message
uint64_t hard_random = 0;

// Waits for the next step. What the behaviour commands stays, also if setup() commanded it.
void Receive()
{
  const kilobot_state_t before = state;
  size_t received = 0;
  while (received < sizeof state)
  {
    const ssize_t part = recv(simulator, reinterpret_cast<char*>(&state) + received, sizeof state - received, 0);
    if (part <= 0) exit(0);
    received += static_cast<size_t>(part);
  }
  state.left_motor = before.left_motor;
  state.right_motor = before.right_motor;
  state.color = before.color;
  is_in_step = true;
}

// Does nothing in setup(), before the first step.
void Answer()
{
  if (!is_in_step) return;
  is_in_step = false;
  if (send(simulator, &state, sizeof state, MSG_NOSIGNAL) != static_cast<ssize_t>(sizeof state)) exit(0);
}

void BeginStep()
{
  Receive();
  constexpr double kRounding = 1e-9;
  rest_of_tick += ticks_of_step + kRounding;
  const auto whole = static_cast<uint32_t>(rest_of_tick);
  kilo_ticks += whole;
  rest_of_tick -= whole + kRounding;
  if (state.tx_state == 2)
  {
    state.tx_state = 0;
    ms_since_sent = 0;
    kilo_message_tx_success();
  }
  else
    ms_since_sent += ms_of_step;
  for (uint8_t i = 0; i < state.rx_state; ++i) kilo_message_rx(&state.rx_message[i], &state.rx_distance[i]);
  state.rx_state = 0;
}

void EndStep()
{
  if (state.tx_state == 0 && ms_since_sent > kilo_tx_period)
    if (const message_t* message = kilo_message_tx())
    {
      state.tx_state = 1;
      state.tx_message = *message;
    }
  Answer();
}

// Returns the first number of an id, 0 if there is none.
uint16_t NumberIn(const char* id)
{
  while (*id != 0 && isdigit(static_cast<unsigned char>(*id)) == 0) ++id;
  return static_cast<uint16_t>(strtoul(id, nullptr, 10));
}

}  // namespace

extern "C"
{
  uint16_t message_crc(const message_t*) { return 0; }

  uint8_t estimate_distance(const distance_measurement_t* distance)
  {
    return static_cast<uint8_t>(distance->high_gain);
  }

  void delay(uint16_t ms)
  {
    if (ms < ms_of_step) return;
    double left = ms;
    EndStep();
    for (;;)
    {
      BeginStep();
      if (left <= ms_of_step) return;
      left -= ms_of_step;
      EndStep();
    }
  }

  // SplitMix64 (G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", 2014).
  uint8_t rand_hard()
  {
    hard_random += 0x9e3779b97f4a7c15;
    uint64_t mixed = hard_random;
    mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9;
    mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111eb;
    return static_cast<uint8_t>(mixed ^ (mixed >> 31));
  }

  static uint8_t soft_seed = 0xaa;
  static uint8_t soft_count = 0;

  uint8_t rand_soft()
  {
    soft_seed = static_cast<uint8_t>(soft_seed ^ (soft_seed << 3));
    soft_seed = static_cast<uint8_t>(soft_seed ^ (soft_seed >> 5));
    soft_seed = static_cast<uint8_t>(soft_seed ^ (soft_count >> 2));
    ++soft_count;
    return soft_seed;
  }

  void rand_seed(uint8_t seed) { soft_seed = seed; }

  int16_t get_ambientlight() { return state.ambientlight; }
  int16_t get_voltage() { return state.voltage; }
  int16_t get_temperature() { return state.temperature; }

  void set_motors(uint8_t left, uint8_t right)
  {
    state.left_motor = left;
    state.right_motor = right;
  }

  void spinup_motors() { set_motors(255, 255); }
  void set_color(uint8_t color) { state.color = color; }
  void kilo_init() {}

  void kilo_start(void (*setup)(), void (*loop)())
  {
    setup();
    for (;;)
    {
      BeginStep();
      loop();
      EndStep();
    }
  }
}

int main(int argc, char* argv[])
{
  if (argc != 6 || strcmp(argv[1], "swarmanoid") != 0)
  {
    fprintf(stderr,
            "%s is the behaviour of a Kilobot: name it in <params behavior=\"%s\"/> of a <kilobot_controller>\n",
            argv[0], argv[0]);
    return 1;
  }
  kilo_str_id = argv[2];
  kilo_uid = NumberIn(kilo_str_id);
  const double seconds = strtod(argv[3], nullptr);
  ticks_of_step = seconds * TICKS_PER_SEC;
  ms_of_step = seconds * 1000;
  hard_random = strtoull(argv[4], nullptr, 10);
  simulator = static_cast<int>(strtol(argv[5], nullptr, 10));
  return __kilobot_main(argc, argv);
}
