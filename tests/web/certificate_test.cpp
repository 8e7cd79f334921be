#include "visualiser/web/certificate.h"

#include <gmock/gmock.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <boost/asio/ssl.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <filesystem>
#include <fstream>

#include "tests/web/blocking_client.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"
#include "visualiser/web/web_server.h"

namespace swarmanoid
{
namespace
{

namespace asio = boost::asio;
namespace beast = boost::beast;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

class CertificateTest : public testing::Test, public WebServerEvents
{
protected:
  CertificateTest()
  {
    files_.Add("/index.html", "text/html; charset=utf-8", "<p>page</p>");
    context_.set_verify_mode(asio::ssl::verify_peer);
  }

  void Start(const Certificate& certificate)
  {
    settings_.certificate = certificate;
    server_ = std::make_unique<WebServer>(settings_, files_, *this);
    context_.add_certificate_authority(asio::buffer(certificate.chain));
  }

  // Returns a connection whose certificate was checked against the name. Throws if another server answers.
  template <class Stream>
  void ShakeHands(Stream& stream, const std::string& name = "127.0.0.1")
  {
    beast::get_lowest_layer(stream).connect({asio::ip::make_address("127.0.0.1"), server_->Port()});
    stream.set_verify_callback(asio::ssl::host_name_verification(name));
    stream.handshake(asio::ssl::stream_base::client);
  }
  std::string Host() const { return "127.0.0.1:" + std::to_string(server_->Port()); }

  std::string Welcome(std::uint64_t) override { return R"({"type": "welcome"})"; }
  void Received(std::uint64_t client, std::string_view text) override
  {
    server_->Send(client, std::make_shared<const std::string>(text));
  }
  void Left(std::uint64_t) override {}

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "certificate.pem";
  PageFiles files_;
  WebServerSettings settings_;
  std::unique_ptr<WebServer> server_;
  asio::io_context io_;
  asio::ssl::context context_{asio::ssl::context::tls_client};
};

TEST_F(CertificateTest, IsKeptForTheNextRunAndOnlyForItsUser)
{
  const Certificate first = OwnCertificate(file_, {"localhost", "127.0.0.1"});
  EXPECT_THAT(first.fingerprint, MatchesRegex("([0-9A-F][0-9A-F]:){31}[0-9A-F][0-9A-F]"));
  struct stat status
  {
  };
  ASSERT_EQ(stat(file_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
  EXPECT_EQ(OwnCertificate(file_, {"127.0.0.1"}).fingerprint, first.fingerprint);
  // The certificate is not used for other names, and not if other users may have read its key.
  const Certificate other = OwnCertificate(file_, {"127.0.0.1", "10.1.2.3"});
  EXPECT_NE(other.fingerprint, first.fingerprint);
  std::filesystem::permissions(file_, std::filesystem::perms::others_read, std::filesystem::perm_options::add);
  EXPECT_NE(OwnCertificate(file_, {"127.0.0.1"}).fingerprint, other.fingerprint);
}

TEST_F(CertificateTest, IsThatOfAServerAndOfNoAuthority)
{
  const std::string chain = OwnCertificate(file_, {"localhost", "127.0.0.1"}).chain;
  BIO* const memory = BIO_new_mem_buf(chain.data(), static_cast<int>(chain.size()));
  X509* const certificate = PEM_read_bio_X509(memory, nullptr, nullptr, nullptr);
  BIO_free(memory);
  ASSERT_NE(certificate, nullptr);
  int is_critical = -1;
  auto* const constraints =
      static_cast<BASIC_CONSTRAINTS*>(X509_get_ext_d2i(certificate, NID_basic_constraints, &is_critical, nullptr));
  ASSERT_NE(constraints, nullptr);
  EXPECT_EQ(is_critical, 1);
  EXPECT_EQ(constraints->ca, 0);
  BASIC_CONSTRAINTS_free(constraints);
  EXPECT_EQ(X509_check_purpose(certificate, X509_PURPOSE_SSL_SERVER, 0), 1);
  EXPECT_EQ(X509_check_purpose(certificate, X509_PURPOSE_SSL_CLIENT, 0), 0);
  EXPECT_EQ(X509_get_key_usage(certificate), static_cast<std::uint32_t>(KU_DIGITAL_SIGNATURE));
  EXPECT_EQ(X509_check_host(certificate, "localhost", 0, 0, nullptr), 1);
  EXPECT_EQ(X509_check_ip_asc(certificate, "127.0.0.1", 0), 1);
  EXPECT_EQ(X509_check_host(certificate, "example.org", 0, 0, nullptr), 0);
  X509_free(certificate);
}

TEST_F(CertificateTest, ABrokenFileIsMadeAnew)
{
  std::ofstream(file_) << "no certificate";
  std::filesystem::permissions(file_, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  const Certificate made = OwnCertificate(file_, {"localhost"});
  EXPECT_EQ(test::TextOf(file_), made.chain);
  EXPECT_THAT(OwnCertificate({}, {"localhost"}).chain, StartsWith("-----BEGIN CERTIFICATE-----"));
}

TEST_F(CertificateTest, AGivenOneIsCheckedWhenTheServerStarts)
{
  const Certificate one = OwnCertificate(file_, {"localhost"});
  const Certificate two = OwnCertificate({}, {"localhost"});
  EXPECT_EQ(GivenCertificate(file_).fingerprint, one.fingerprint);
  const auto mistake = [&](const std::string& text)
  {
    std::ofstream(folder_ / "given.pem") << text;
    return test::MessageOf<std::runtime_error>([&] { GivenCertificate(folder_ / "given.pem"); });
  };
  const std::string end = "-----END CERTIFICATE-----\n";
  const std::string chain = one.chain.substr(0, one.chain.find(end) + end.size());
  const std::string key = two.chain.substr(two.chain.find(end) + end.size());
  EXPECT_THAT(mistake("nothing"), HasSubstr("given.pem' has no certificate"));
  EXPECT_THAT(mistake(chain), HasSubstr("given.pem' has no private key"));
  EXPECT_THAT(mistake(chain + key), HasSubstr("the private key is not that of the first certificate"));
  EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { GivenCertificate(folder_ / "missing.pem"); }),
              HasSubstr("missing.pem': No such file or directory"));
}

TEST_F(CertificateTest, PageAndStreamAreServedByTls)
{
  Start(OwnCertificate({}, {"127.0.0.1"}));
  EXPECT_EQ(server_->Url(), "https://" + Host() + "/");
  {
    beast::ssl_stream<asio::ip::tcp::socket> stream(io_, context_);
    ShakeHands(stream);
    const std::string request = "GET / HTTP/1.1\r\nHost: " + Host() + "\r\n\r\n";
    asio::write(stream, asio::buffer(request));
    beast::flat_buffer buffer;
    beast::http::response<beast::http::string_body> response;
    beast::http::read(stream, buffer, response);
    EXPECT_EQ(response.body(), "<p>page</p>");
    EXPECT_THAT(std::string(response["Content-Security-Policy"]), HasSubstr("wss://" + Host()));
  }
  const auto open = [&](const std::string& origin)
  {
    beast::websocket::stream<beast::ssl_stream<asio::ip::tcp::socket>> stream(io_, context_);
    ShakeHands(stream.next_layer());
    stream.set_option(beast::websocket::stream_base::decorator([&](beast::websocket::request_type& request)
                                                               { request.set(beast::http::field::origin, origin); }));
    beast::error_code refused;
    stream.handshake(Host(), "/stream", refused);
    if (refused) return std::string("refused");
    std::string all;
    stream.write(asio::buffer(std::string("hello")));
    for (int k = 0; k < 2; ++k)
    {
      beast::flat_buffer buffer;
      stream.read(buffer);
      all += beast::buffers_to_string(buffer.data());
    }
    return all;
  };
  EXPECT_EQ(open("https://" + Host()), R"({"type": "welcome"})"
                                       "hello");
  EXPECT_EQ(open("http://" + Host()), "refused") << "a page that somebody changed on its way";
}

TEST_F(CertificateTest, AnotherServerIsNotTakenForThisOne)
{
  Start(OwnCertificate({}, {"127.0.0.1"}));
  asio::ssl::context knows_another(asio::ssl::context::tls_client);
  knows_another.set_verify_mode(asio::ssl::verify_peer);
  knows_another.add_certificate_authority(asio::buffer(OwnCertificate({}, {"127.0.0.1"}).chain));
  beast::ssl_stream<asio::ip::tcp::socket> stream(io_, knows_another);
  EXPECT_THROW(ShakeHands(stream), std::exception);
  beast::ssl_stream<asio::ip::tcp::socket> another_name(io_, context_);
  EXPECT_THROW(ShakeHands(another_name, "10.1.2.3"), std::exception);
}

TEST_F(CertificateTest, PlainHttpIsSentToTheOtherAddressAndOldTlsIsRefused)
{
  Start(OwnCertificate({}, {"127.0.0.1"}));
  BlockingClient plain(server_->Port());
  const auto answer = plain.Get("/?x=1");
  EXPECT_EQ(answer.result_int(), 308U);
  EXPECT_EQ(answer["Location"], "https://" + Host() + "/?x=1");
  EXPECT_EQ(BlockingClient(server_->Port()).Open(), 308U);
  EXPECT_EQ(BlockingClient(server_->Port()).Get("/", "evil.example").result_int(), 403U);

  SSL_CTX_set_security_level(context_.native_handle(), 0);
  SSL_CTX_set_min_proto_version(context_.native_handle(), TLS1_1_VERSION);
  SSL_CTX_set_max_proto_version(context_.native_handle(), TLS1_1_VERSION);
  beast::ssl_stream<asio::ip::tcp::socket> old(io_, context_);
  EXPECT_THROW(ShakeHands(old), std::exception);
}

// Clients that say nothing, and clients that stop in the middle of a handshake, keep no others out.
TEST_F(CertificateTest, WhoDoesNotShakeHandsMakesRoom)
{
  Start(OwnCertificate({}, {"127.0.0.1"}));
  std::vector<asio::ip::tcp::socket> idle;
  const std::string begin("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11);
  for (int k = 0; k < 300; ++k)
  {
    idle.emplace_back(io_).connect({asio::ip::make_address("127.0.0.1"), server_->Port()});
    beast::error_code ignored;
    if (k % 2 == 0) asio::write(idle.back(), asio::buffer(begin), ignored);
    if (k % 50 != 49) continue;
    beast::ssl_stream<asio::ip::tcp::socket> stream(io_, context_);
    EXPECT_NO_THROW(ShakeHands(stream)) << k;
  }
}

}  // namespace
}  // namespace swarmanoid
