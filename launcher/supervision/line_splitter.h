// LineSplitter: cuts the bytes that a process writes into lines.
#pragma once

#include <string>
#include <string_view>

namespace swarmanoid
{

class LineSplitter
{
public:
  // Calls take(line) for each line that the bytes complete, without its end ("\n" or "\r\n").
  template <class Take>
  void Add(std::string_view bytes, Take&& take)
  {
    for (std::size_t end = bytes.find('\n'); end != std::string_view::npos; end = bytes.find('\n'))
    {
      rest_ += bytes.substr(0, end);
      bytes.remove_prefix(end + 1);
      Give(take);
    }
    rest_ += bytes;
    if (rest_.size() > kLongestLine) Give(take);
  }

  // Takes a last line without an end.
  template <class Take>
  void Finish(Take&& take)
  {
    if (!rest_.empty()) Give(take);
  }

private:
  static constexpr std::size_t kLongestLine = 64 * 1024;

  template <class Take>
  void Give(Take&& take)
  {
    if (rest_.ends_with('\r')) rest_.pop_back();
    take(std::string_view(rest_));
    rest_.clear();
  }

  std::string rest_;
};

}  // namespace swarmanoid
