// A link between two taps: carries frames both ways, late, and not all of them.
//
//     relay LEFT RIGHT LOSS DELAY_MS
//
// LEFT, RIGHT: open descriptors of the taps; LOSS: the fraction of the frames that is lost. SIGTERM ends it. Then it
// prints how many frames it was given, how many of them it lost, and the bytes of the largest.
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <random>
#include <vector>

namespace
{

using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t ended = 0;

struct Frame
{
  Clock::time_point due;
  int tap;  // where it goes
  std::vector<char> bytes;
};

// Whole milliseconds would be too coarse.
void WaitUntil(pollfd (&taps)[2], const std::deque<Frame>& waiting)
{
  auto left = std::chrono::nanoseconds(std::chrono::milliseconds(50));
  if (!waiting.empty())
    left = std::clamp<std::chrono::nanoseconds>(waiting.front().due - Clock::now(), std::chrono::nanoseconds(0), left);
  const timespec time{0, static_cast<long>(left.count())};
  ppoll(taps, 2, &time, nullptr);
}

}  // namespace

int main(int count, char** arguments)
{
  if (count != 5) return 2;
  pollfd taps[2] = {{std::atoi(arguments[1]), POLLIN, 0}, {std::atoi(arguments[2]), POLLIN, 0}};
  const double loss = std::atof(arguments[3]);
  const auto delay = std::chrono::microseconds(std::lround(1000 * std::atof(arguments[4])));
  for (const pollfd& tap : taps)
    if (fcntl(tap.fd, F_SETFL, O_NONBLOCK) != 0) return 2;
  std::signal(SIGTERM, [](int) { ended = 1; });

  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  std::deque<Frame> waiting;
  std::vector<char> frame(70000);
  long carried = 0;
  long lost = 0;
  long largest = 0;
  while (ended == 0)
  {
    WaitUntil(taps, waiting);
    for (int from = 0; from < 2; ++from)
      while (true)
      {
        const ssize_t size = read(taps[from].fd, frame.data(), frame.size());
        if (size <= 0) break;
        ++carried;
        largest = std::max(largest, static_cast<long>(size));
        if (uniform(random) < loss)
          ++lost;
        else
          waiting.push_back({Clock::now() + delay, taps[1 - from].fd, {frame.data(), frame.data() + size}});
      }
    for (; !waiting.empty() && waiting.front().due <= Clock::now(); waiting.pop_front())
    {
      const Frame& first = waiting.front();
      // The other end may be gone.
      [[maybe_unused]] const ssize_t written = write(first.tap, first.bytes.data(), first.bytes.size());
    }
  }
  std::printf("%ld %ld %ld\n", carried, lost, largest);
  return 0;
}
