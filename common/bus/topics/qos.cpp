#include "common/bus/topics/qos.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "idl/topics.h"

namespace swarmanoid
{

const TopicQos& QosOf(std::string_view topic)
{
  const auto* found = std::ranges::find(kTopics, topic, &TopicQos::topic);
  if (found == std::end(kTopics))
    throw std::logic_error("no quality of service is declared for topic " + std::string(topic));
  return *found;
}

}  // namespace swarmanoid
