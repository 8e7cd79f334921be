#include "common/activity/signal_stack.h"

#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <cstddef>

namespace swarmanoid
{
namespace
{

constexpr std::size_t kSize = 64 * 1024;
// Functions with large local arrays can pass the end of the stack by more than a page.
constexpr std::uintptr_t kBelow = 8U << 20;

// It is the lowest address of this thread's stack, or 0 if the thread has no signal stack.
__attribute__((tls_model("initial-exec"))) thread_local std::uintptr_t lowest = 0;

std::uintptr_t LowestOfStack()
{
  pthread_attr_t attributes;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0) return 1;
  void* address = nullptr;
  std::size_t size = 0;
  std::size_t guard = 0;
  pthread_attr_getstack(&attributes, &address, &size);
  pthread_attr_getguardsize(&attributes, &guard);
  pthread_attr_destroy(&attributes);
  return reinterpret_cast<std::uintptr_t>(address) + guard;
}

class SignalStack
{
public:
  SignalStack()
  {
    stack_t known{};
    // A sanitizer or the user's program may have set a signal stack already.
    if (sigaltstack(nullptr, &known) == 0 && (known.ss_flags & SS_DISABLE) == 0) return;
    memory_ = mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) return;
    stack_t stack{};
    stack.ss_sp = memory_;
    stack.ss_size = kSize;
    sigaltstack(&stack, nullptr);
  }
  ~SignalStack()
  {
    if (memory_ == MAP_FAILED) return;
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    sigaltstack(&none, nullptr);
    munmap(memory_, kSize);
  }
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

private:
  void* memory_ = MAP_FAILED;
};

}  // namespace

void EnsureSignalStack()
{
  if (lowest != 0) return;
  lowest = LowestOfStack();
  static thread_local const SignalStack stack;
}

bool IsStackOverflow(std::uintptr_t address)
{
  return lowest > 1 && address < lowest + 4096 && address + kBelow > lowest;
}

}  // namespace swarmanoid
