// The page as an editor. It has the server, token and pictures of web_render, without a run.
#include <cstdlib>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "common/space/space.h"
#include "visualiser/editor_page.h"
#include "visualiser/web/page_messages.h"
#include "visualiser/web/page_server.h"
#include "visualiser/web/state_frame.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kMostEditRequests = 1024;  // limit of waiting requests

WebServer::Bytes SharedText(std::string text) { return std::make_shared<const std::string>(std::move(text)); }

// Returns the port of "http://127.0.0.1:8080/#…"; 0 if there is none.
std::uint16_t PortOf(const std::string& url)
{
  const std::size_t host = url.find("//");
  const std::size_t colon = host == std::string::npos ? host : url.find(':', host);
  return colon == std::string::npos ? std::uint16_t{0}
                                    : static_cast<std::uint16_t>(std::strtoul(url.c_str() + colon + 1, nullptr, 10));
}

// Returns whether a request is about the file or its run, and not about the picture.
bool IsForEditor(std::string_view text)
{
  static const std::set<std::string> verbs{"document", "form",  "edit", "undo",    "redo",   "save",
                                           "reload",   "check", "run",  "end_run", "script", "save_script"};
  const auto json = nlohmann::json::parse(text, nullptr, false);
  return json.is_object() && json.contains("do") && json["do"].is_string() && verbs.contains(json["do"]);
}

class WebEditor : public EditorPage, private WebServerEvents
{
public:
  void Open(const Parameters& parameters, const std::string& key, EditorRequests& requests) override
  {
    requests_ = &requests;
    host_ = std::make_unique<PageServer>(parameters, key);
    host_->Open(*this);
  }

  std::string Url() const override { return host_->Url(); }
  std::string Fingerprint() const override { return host_->Fingerprint(); }
  std::string Warning() const override { return host_->Warning(); }

  void Show(const CSwarmanoidSpace& space, const Assignment& assignment) override
  {
    WebServer& server = host_->Server();
    server.SetGreeting(SharedText(WorldText(space, assignment, Viewpoints::Of(space.GetExperiment()), false)));
    server.Publish(WebServer::Slot::kKey, SharedText(FrameWriter(space).WriteKey()));
    server.Publish(WebServer::Slot::kColours, SharedText(ColoursText(space)));
  }

  void Tell(const std::string& document) override
  {
    document_ = SharedText(document);
    for (const std::uint64_t client : editors_)
      host_->Server().SendState(client, WebServer::Slot::kDocument, document_);
  }

  void ShowRun(const std::string& url) override { host_->Server().SetRelay(PortOf(url)); }

  void Idle() override
  {
    std::vector<std::pair<std::uint64_t, std::optional<std::string>>> waiting;
    {
      const std::lock_guard lock(mutex_);
      waiting.swap(waiting_);
    }
    for (const auto& [client, request] : waiting)
    {
      if (!request)
        editors_.erase(client);
      else
        Carry(client, *request);
    }
  }

private:
  void Carry(std::uint64_t client, const std::string& request)
  {
    if (editors_.insert(client).second && document_)
      host_->Server().SendState(client, WebServer::Slot::kDocument, document_);
    try
    {
      const std::string reply = requests_->Carry(request);
      if (!reply.empty()) host_->Server().Send(client, SharedText(reply));
    }
    catch (const std::invalid_argument& error)
    {
      host_->Server().Send(client, SharedText(RefusalText(error.what())));
    }
  }

  // The next functions are called in the server's thread.

  std::string Welcome(std::uint64_t client) override
  {
    return WelcomeText(true, host_->GetVisitors().Join(client), true);
  }

  void Received(std::uint64_t client, std::string_view text) override
  {
    try
    {
      if (IsForEditor(text))
      {
        if (!host_->GetVisitors().MayControl(client))
          throw std::invalid_argument("only the address with the token may edit the experiment");
        return Keep(client, std::string(text));
      }
      const PageRequest request = ParseRequest(text);
      if (const auto* answer = std::get_if<ProveRequest>(&request))
        host_->Server().Send(client, SharedText(AuthorityText(host_->Prove(client, answer->proof))));
      else if (std::holds_alternative<ControlOrder>(request))
        throw std::invalid_argument("this page edits an experiment; its run is on another page");
    }
    catch (const std::invalid_argument& error)
    {
      host_->Server().Send(client, SharedText(RefusalText(error.what())));
    }
  }

  void Left(std::uint64_t client) override
  {
    host_->GetVisitors().Leave(client);
    const std::lock_guard lock(mutex_);
    waiting_.emplace_back(client, std::nullopt);
  }

  void Keep(std::uint64_t client, std::string request)
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= kMostEditRequests) throw std::invalid_argument("too many requests at once");
    waiting_.emplace_back(client, std::move(request));
  }

  EditorRequests* requests_ = nullptr;
  std::set<std::uint64_t> editors_;  // clients with the token that have sent a request
  WebServer::Bytes document_;
  std::mutex mutex_;                                                           // guards waiting_
  std::vector<std::pair<std::uint64_t, std::optional<std::string>>> waiting_;  // nothing: the client has left
  std::unique_ptr<PageServer> host_;  // last, since its server's thread uses the members above
};

}  // namespace
}  // namespace swarmanoid

extern "C" __attribute__((visibility("default"))) swarmanoid::EditorPage* MakeSwarmanoidEditorPage()
{
  return new swarmanoid::WebEditor;
}
