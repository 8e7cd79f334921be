// Problem: Box2D takes the wall clock some 14 times in each step for a profile that the simulator does not read. That
// is a seventh of the time of a swarm whose groups are small.
//
// Method: a timer that reads no clock. Box2D's library calls its timer as a dynamic symbol. The dynamic linker takes
// the first definition in the order of the libraries, and this library stands before Box2D's, since it needs it.
//
// Invariant: no result depends on it. If another definition comes first, steps only take longer.
#include <box2d/b2_timer.h>

b2Timer::b2Timer() : m_start_sec(0), m_start_usec(0) {}

void b2Timer::Reset() {}

float b2Timer::GetMilliseconds() const { return 0; }
