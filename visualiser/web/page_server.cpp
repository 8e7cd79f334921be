#include "visualiser/web/page_server.h"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <vector>

namespace swarmanoid
{
namespace
{

bool IsOfThisMachine(const std::string& address) { return address.starts_with("127.") || address == "::1"; }

// Returns nothing if the page does not use TLS.
std::optional<Certificate> CertificateFor(const Parameters& parameters)
{
  const std::string address = parameters.Text("address");
  const std::string wish = parameters.Text("tls");
  const std::string given = parameters.Text("certificate");
  if (wish == "off" && !given.empty()) throw std::runtime_error("web_render: a certificate is of no use with tls=off");
  if (wish == "off" || (wish == "auto" && given.empty() && IsOfThisMachine(address))) return std::nullopt;
  if (!given.empty()) return GivenCertificate(given);
  const bool everywhere = address == "0.0.0.0" || address == "::";
  std::vector<std::string> names = everywhere ? NamesOfThisMachine() : std::vector<std::string>{"localhost", address};
  const std::filesystem::path folder = StateFolder();
  return OwnCertificate(folder.empty() ? folder : folder / "certificate.pem", names);
}

}  // namespace

PageServer::PageServer(const Parameters& parameters, const std::string& key)
    : allow_control_(parameters.Boolean("allow_control"))
{
  settings_.address = parameters.Text("address");
  settings_.port = static_cast<std::uint16_t>(parameters.Integer("port"));
  settings_.max_clients = static_cast<std::size_t>(parameters.Integer("clients"));
  settings_.max_holders = allow_control_ ? settings_.max_clients : 0;
  settings_.max_connections = settings_.max_clients + settings_.max_holders + 48;
  settings_.max_connections_of_address = settings_.max_clients + settings_.max_holders + 24;
  settings_.certificate = CertificateFor(parameters);
  if (settings_.certificate) fingerprint_ = settings_.certificate->fingerprint;
  kept_ = std::make_unique<KeptAddress>(StateFolder(), key);
}

// Opens at the address of the last start, if it is free and no other is requested, so that open pages continue.
void PageServer::Open(WebServerEvents& events)
{
  std::string token = kept_->Token();
  // A token is valid for one port: the owner of the previous port could forward challenges from there.
  const bool moves = settings_.port != 0 && settings_.port != kept_->Port();
  if (allow_control_ && (token.empty() || moves)) token = MakeToken();
  if (settings_.port == 0 && kept_->Port() != 0)
  {
    settings_.port = kept_->Port();
    try
    {
      Start(token, events);
    }
    catch (const std::runtime_error&)
    {
      settings_.port = 0;  // another program has the port, and may know the token: use a new port and token
      if (allow_control_) token = MakeToken();
    }
  }
  if (!server_) Start(token, events);
  if (!kept_->Keep(server_->Port(), token)) trouble_ = kept_->Trouble();
}

void PageServer::Start(const std::string& token, WebServerEvents& events)
{
  const PageFiles files(InstalledPageFolder());
  const std::lock_guard lock(opening_);
  if (allow_control_) token_ = token;
  visitors_ = std::make_unique<Visitors>(AccessRules{allow_control_, token_});
  server_ = std::make_unique<WebServer>(settings_, files, events);
}

Authority PageServer::Prove(std::uint64_t client, std::string_view proof)
{
  const Authority authority = visitors_->Prove(client, proof);
  if (authority == Authority::kControl) Server().Admit(client);
  return authority;
}

std::string PageServer::Url() const { return server_->Url() + (token_.empty() ? "" : "#token=" + token_); }

std::string PageServer::Warning() const
{
  if (!fingerprint_.empty() || IsOfThisMachine(settings_.address)) return {};
  return allow_control_ ? "every user who reaches this address can look on, and every user who overhears it can "
                          "steer: it is not encrypted; tls=on is, or an ssh tunnel to address=127.0.0.1"
                        : "every user who reaches this address can look on: it is not encrypted";
}

}  // namespace swarmanoid
