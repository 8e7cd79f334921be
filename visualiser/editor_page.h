// The page in the browser as an editor of an experiment file. It shows a start state and passes on users' requests;
// `swarmanoid edit` changes the file. The code is in the library of web_render, which is loaded on demand.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "common/configuration/parameter.h"
#include "common/messages/assignment.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

class EditorRequests
{
public:
  virtual ~EditorRequests() = default;
  // Carries out the request of a page that has the token: a JSON object with a text "do". Returns the reply for this
  // page alone, JSON or nothing. Throws std::invalid_argument with a text for the user.
  virtual std::string Carry(std::string_view request) = 0;
};

// Used by one thread. The server of the pages has its own thread, and no function here waits for it.
class EditorPage
{
public:
  virtual ~EditorPage() = default;
  // Opens the page. `parameters`: those of web_render. `key`: address and token are kept under it for the next start.
  // Throws std::runtime_error.
  virtual void Open(const Parameters& parameters, const std::string& key, EditorRequests& requests) = 0;
  virtual std::string Url() const = 0;          // with the token
  virtual std::string Fingerprint() const = 0;  // that of the certificate; empty without TLS
  virtual std::string Warning() const = 0;      // states which other users can look or edit; empty if none
  // From now on all pages show this space. The space is not used after the call.
  virtual void Show(const CSwarmanoidSpace& space, const Assignment& assignment) = 0;
  // Sends JSON to all present and future pages with the token. It replaces the document of the previous call.
  virtual void Tell(const std::string& document) = 0;
  // From now on pages reach the run at this address of this machine, with its token, under /run/stream. Empty: no run.
  virtual void ShowRun(const std::string& url) = 0;
  // Carries out the requests of pages. Call it every 10 to 20 ms.
  virtual void Idle() = 0;
};

// Throws ConfigurationError, naming the packages, if web_render is not part of this build.
std::unique_ptr<EditorPage> MakeEditorPage();

}  // namespace swarmanoid
