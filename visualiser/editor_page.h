// The page in the browser as an editor of an experiment file: it shows a start state and hands over what people ask
// for. The file itself is the business of `swarmanoid edit`. The code is in the library of web_render, which is loaded.
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
  // Carries out what a page asks for that has the token: a JSON object with a text "do". Gives what is for this page
  // alone, JSON or nothing. Throws std::invalid_argument with a text for the user.
  virtual std::string Carry(std::string_view request) = 0;
};

// For one thread; the server of the pages has another one, and nothing here waits for it.
class EditorPage
{
public:
  virtual ~EditorPage() = default;
  // `parameters`: those of web_render. `key`: whose address and token are kept for the next start. Throws
  // std::runtime_error.
  virtual void Open(const Parameters& parameters, const std::string& key, EditorRequests& requests) = 0;
  virtual std::string Url() const = 0;          // with the token
  virtual std::string Fingerprint() const = 0;  // of the certificate; empty without TLS
  virtual std::string Warning() const = 0;      // of who can look or edit; empty if there is nothing to say
  // From now on all pages show this space, which is not used after the call.
  virtual void Show(const CSwarmanoidSpace& space, const Assignment& assignment) = 0;
  // JSON for all pages with the token, now and later, in the place of what was told before.
  virtual void Tell(const std::string& document) = 0;
  // Carries out what pages have asked for; to be called every 10 to 20 ms.
  virtual void Idle() = 0;
};

// Throws ConfigurationError, naming the packages, if web_render is not part of this build.
std::unique_ptr<EditorPage> MakeEditorPage();

}  // namespace swarmanoid
