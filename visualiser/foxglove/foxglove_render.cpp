// foxglove_render: shows a run in Foxglove and Lichtblick, by the Foxglove WebSocket protocol. Clients cannot control
// the run.
#include <fmt/format.h>

#include <array>
#include <memory>
#include <numeric>

#include "common/logging/log.h"
#include "common/space/space.h"
#include "visualiser/foxglove/foxglove_messages.h"
#include "visualiser/foxglove/foxglove_server.h"
#include "visualiser/render.h"
#include "visualiser/renderer_library.h"

namespace swarmanoid
{
namespace
{

// Events are lines of a file of the run, so that only exports have them.
constexpr std::size_t kTopics = FoxgloveMessages::kEvents;

class CFoxgloveRender : public CRender
{
public:
  void Init(const RenderSetup& setup) override
  {
    space_ = &setup.space;
    every_ = static_cast<std::uint64_t>(setup.parameters.Integer("every"));
    std::vector<std::size_t> all(space_->Size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    messages_ = std::make_unique<FoxgloveMessages>(*space_, std::move(all));
    std::vector<FoxgloveChannel> channels;
    for (const FoxgloveTopic& topic : messages_->Topics())
      channels.push_back({topic.topic, topic.schema_name, topic.schema});
    channels.resize(kTopics);
    FoxgloveServerSettings settings;
    settings.address = setup.parameters.Text("address");
    settings.port = static_cast<std::uint16_t>(setup.parameters.Integer("port"));
    settings.origins = SplitWords(setup.parameters.Text("origins"), ", ");
    settings.name = "Swarmanoid: " + space_->GetExperiment().name;
    server_ = std::make_unique<FoxgloveServer>(settings, std::move(channels));
    if (settings.address != "127.0.0.1" && settings.address != "::1")
      LogWarning("every user who reaches {}:{} may look: this protocol has no passwords", settings.address,
                 server_->Port());
    LogInfo("in Foxglove or Lichtblick: open the connection ws://{}:{}", settings.address, server_->Port());
  }

  void Draw() override { Show(space_->GetTick() % every_ == 0); }
  void Idle() override { Show(false); }
  void Finish() override { server_.reset(); }

private:
  // New clients get the current content, also of a paused run.
  bool IsNew(std::size_t topic)
  {
    const std::uint64_t subscriptions = server_->Subscriptions(topic);
    return std::exchange(seen_[topic], subscriptions) != subscriptions;
  }

  void Show(bool due)
  {
    using enum FoxgloveMessages::Topic;
    const std::uint64_t time = messages_->Time();
    if (due) server_->SetTime(time);
    const auto publish = [&](std::size_t topic, std::string json) { server_->Publish(topic, time, std::move(json)); };
    if (IsNew(kFixed)) publish(kFixed, messages_->Transforms(false));
    if (IsNew(kMoving) || (due && server_->Subscribers(kMoving) > 0)) publish(kMoving, messages_->Transforms(true));
    const bool again = IsNew(kScene);
    if (again) messages_->ForgetScene();
    if (again || (due && server_->Subscribers(kScene) > 0))
      if (auto scene = messages_->ChangedScene()) publish(kScene, std::move(*scene));
    if (IsNew(kAttributes) || (due && server_->Subscribers(kAttributes) > 0))
      publish(kAttributes, messages_->Attributes());
  }

  const CSwarmanoidSpace* space_ = nullptr;
  std::uint64_t every_ = 1;
  std::unique_ptr<FoxgloveMessages> messages_;
  std::unique_ptr<FoxgloveServer> server_;
  std::array<std::uint64_t, kTopics> seen_{};  // subscriptions at the last look
};

}  // namespace
}  // namespace swarmanoid

EXPORT_RENDERER(::swarmanoid::CFoxgloveRender)
