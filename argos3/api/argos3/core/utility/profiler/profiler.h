// CProfiler: writes the time and memory that a program takes between Start and Stop into a file.
#pragma once

#include <sys/resource.h>

#include <chrono>
#include <fstream>
#include <string>

namespace argos
{

class CProfiler
{
public:
  // `truncates` empties the file first. Throws CARGoSException if it cannot be written.
  CProfiler(const std::string& file, bool truncates = true);
  void Start();
  void Stop();
  // Writes lines with names, or one line of numbers in the same order.
  void Flush(bool human_readable);
  // Does nothing, since the process is measured with all its threads.
  void CollectThreadResourceUsage() {}

private:
  std::ofstream file_;
  std::chrono::steady_clock::time_point start_, end_;
  ::rusage usage_at_start_{}, usage_at_end_{};
};

}  // namespace argos
