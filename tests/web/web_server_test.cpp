#include "visualiser/web/web_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "tests/eventually.h"
#include "tests/web/blocking_client.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using test::Eventually;
using testing::HasSubstr;

WebServer::Bytes Shared(std::string text) { return std::make_shared<const std::string>(std::move(text)); }

class WebServerTest : public testing::Test, public WebServerEvents
{
protected:
  WebServerTest()
  {
    files_.Add("/index.html", "text/html; charset=utf-8", "<p>page</p>");
    files_.Add("/main.js", "text/javascript; charset=utf-8", "let x;");
    settings_.max_clients = 3;
    settings_.max_message_bytes = 1000;
  }
  void Start() { server_ = std::make_unique<WebServer>(settings_, files_, *this); }
  BlockingClient Connect() { return BlockingClient(server_->Port()); }

  std::string Welcome(std::uint64_t client) override
  {
    return R"({"type": "welcome", "client": )" + std::to_string(client) + "}";
  }
  void Received(std::uint64_t client, std::string_view text) override
  {
    server_->Send(client, Shared(R"({"type": "echo", "text": ")" + std::string(text) + "\"}"));
  }
  void Left(std::uint64_t) override { ++left_; }

  PageFiles files_;
  WebServerSettings settings_;
  std::atomic<int> left_{0};
  std::unique_ptr<WebServer> server_;
};

TEST_F(WebServerTest, FilesAreServedWithTheirTypesAndNothingElseIs)
{
  Start();
  BlockingClient client = Connect();
  const auto page = client.Get("/");
  EXPECT_EQ(page.result_int(), 200u);
  EXPECT_EQ(page.body(), "<p>page</p>");
  EXPECT_EQ(page["Content-Type"], "text/html; charset=utf-8");
  EXPECT_EQ(page["X-Content-Type-Options"], "nosniff");
  EXPECT_THAT(std::string(page["Content-Security-Policy"]), HasSubstr("default-src 'self'"));
  // The connection stays for the next one.
  EXPECT_EQ(client.Get("/main.js?v=1")["Content-Type"], "text/javascript; charset=utf-8");
  for (const char* path :
       {"/nothing", "/../etc/passwd", "//etc/passwd", "/%2e%2e/etc/passwd", "/index.html/", "main.js"})
    EXPECT_EQ(Connect().Get(path).result_int(), 404u) << path;
}

TEST_F(WebServerTest, FilesAreSentCompressedAndOnlyIfTheyHaveChanged)
{
  files_.Add("/main.js", "text/javascript; charset=utf-8", "let x;", std::make_shared<const std::string>("compressed"));
  Start();
  const std::string head = "GET /main.js HTTP/1.1\r\nHost: localhost\r\n";
  const auto plain = Connect().Ask(head + "\r\n");
  EXPECT_EQ(plain.body(), "let x;");
  EXPECT_EQ(plain.count("Content-Encoding"), 0u);
  EXPECT_EQ(plain["Vary"], "Accept-Encoding");
  for (const char* wish : {"gzip", "deflate, GZIP;q=0.5", "br, gzip"})
  {
    const auto compressed = Connect().Ask(head + "Accept-Encoding: " + wish + "\r\n\r\n");
    EXPECT_EQ(compressed.body(), "compressed") << wish;
    EXPECT_EQ(compressed["Content-Encoding"], "gzip");
    EXPECT_EQ(compressed["Content-Type"], "text/javascript; charset=utf-8");
  }
  for (const char* wish : {"br", "gzip;q=0", "gzipped", ""})
    EXPECT_EQ(Connect().Ask(head + "Accept-Encoding: " + wish + "\r\n\r\n").body(), "let x;") << wish;
  const std::string tag(plain["ETag"]);
  const auto kept = Connect().Ask(head + "If-None-Match: " + tag + "\r\n\r\n");
  EXPECT_EQ(kept.result_int(), 304u);
  EXPECT_EQ(kept.body(), "");
  EXPECT_EQ(kept["ETag"], tag);
  EXPECT_EQ(Connect().Ask(head + "If-None-Match: \"other\"\r\n\r\n").result_int(), 200u);
  files_.Add("/main.js", "text/javascript; charset=utf-8", "let y;");
  EXPECT_NE(files_.Find("/main.js")->tag, tag);
}

TEST_F(WebServerTest, TheStreamOfAnotherServerIsRelayedByteByByte)
{
  Start();
  EXPECT_EQ(Connect().Open("/run/stream"), 503u);
  WebServerSettings settings;
  WebServer other(settings, {}, *this);
  server_->SetRelay(other.Port());
  BlockingClient client = Connect();
  ASSERT_EQ(client.Open("/run/stream", "http://" + client.Host()), 101u);
  EXPECT_THAT(client.Read(), HasSubstr("welcome"));
  // It is a client of the other server only.
  EXPECT_TRUE(Eventually([&] { return other.Clients() == 1; }));
  EXPECT_EQ(server_->Clients(), 0u);
  const std::string large(300000, 'x');
  other.Publish(WebServer::Slot::kKey, Shared(large));
  EXPECT_EQ(client.Read(), large);
  EXPECT_TRUE(client.GotBinary());
  EXPECT_EQ(Connect().Open("/run/stream", "http://evil.example"), 403u);
  EXPECT_EQ(Connect().Open("/run/other"), 404u);

  // A page that leaves, leaves the other server, too.
  {
    BlockingClient second = Connect();
    ASSERT_EQ(second.Open("/run/stream"), 101u);
    EXPECT_TRUE(Eventually([&] { return other.Clients() == 2; }));
  }
  EXPECT_TRUE(Eventually([&] { return other.Clients() == 1; }));
  server_->SetRelay(0);
  EXPECT_EQ(Connect().Open("/run/stream"), 503u);
  EXPECT_EQ(Connect().Get("/").result_int(), 200u);
}

TEST_F(WebServerTest, OddRequestsAreRefused)
{
  Start();
  const std::string host = "Host: localhost\r\n";
  EXPECT_EQ(Connect().Get("/", "evil.example").result_int(), 403u);
  EXPECT_EQ(Connect().Ask("GET / HTTP/1.1\r\n\r\n").result_int(), 403u);
  EXPECT_EQ(Connect().Ask("DELETE / HTTP/1.1\r\n" + host + "\r\n").result_int(), 405u);
  EXPECT_EQ(Connect().Ask("POST / HTTP/1.1\r\n" + host + "Content-Length: 5\r\n\r\nabcde").result_int(), 413u);
  EXPECT_EQ(Connect().Ask("GET / HTTP/1.1\r\n" + host + "X: " + std::string(9000, 'x') + "\r\n\r\n").result_int(),
            431u);
  EXPECT_EQ(Connect().Get("/").result_int(), 200u);
}

TEST_F(WebServerTest, PagesOfOtherSitesMayNotLook)
{
  Start();
  BlockingClient own = Connect();
  EXPECT_EQ(own.Open("/stream", "http://" + own.Host()), 101u);
  EXPECT_EQ(Connect().Open("/stream", "http://evil.example"), 403u);
  EXPECT_EQ(Connect().Open("/stream", "null"), 403u);
  // It is the name of another site that points here (DNS rebinding).
  EXPECT_EQ(Connect().Open("/stream", "http://evil.example", "evil.example"), 403u);
  EXPECT_EQ(Connect().Open("/other"), 404u);
}

TEST_F(WebServerTest, WhoComesLateGetsGreetingHistoryAndLatestState)
{
  Start();
  server_->SetGreeting(Shared(R"({"type": "world"})"));
  server_->SendAll(Shared(R"({"type": "log", "text": "one"})"));
  server_->Publish(WebServer::Slot::kStatus, Shared(R"({"type": "status", "tick": 1})"));
  server_->Publish(WebServer::Slot::kStatus, Shared(R"({"type": "status", "tick": 2})"));
  BlockingClient client = Connect();
  ASSERT_EQ(client.Open(), 101u);
  EXPECT_EQ(nlohmann::json::parse(client.Read())["type"], "welcome");
  EXPECT_EQ(nlohmann::json::parse(client.Read())["type"], "world");
  EXPECT_EQ(nlohmann::json::parse(client.Read())["text"], "one");
  EXPECT_EQ(nlohmann::json::parse(client.Read())["tick"], 2);
}

TEST_F(WebServerTest, AClientThatDoesNotReadGetsTheLatestFrameAndHoldsUpNobody)
{
  Start();
  BlockingClient slow = Connect();
  BlockingClient fast = Connect();
  ASSERT_EQ(slow.Open(), 101u);
  ASSERT_EQ(fast.Open(), 101u);
  fast.ReadUntil("welcome");
  constexpr int kFrames = 300;
  constexpr std::size_t kBytes = 240000;  // more than the system holds for a connection, many times over
  for (int i = 1; i <= kFrames; ++i)
  {
    server_->Publish(WebServer::Slot::kChange, Shared(std::to_string(i) + ' ' + std::string(kBytes, '.')));
    const std::string frame = fast.Read();
    EXPECT_TRUE(fast.GotBinary());
    EXPECT_EQ(std::stoi(frame), i);
  }
  // The slow one is not asked for again until it has taken what it was sent.
  EXPECT_EQ(server_->Clients(), 2u);
  ASSERT_TRUE(Eventually([&] { return server_->Hungry() == 1; }));
  slow.ReadUntil("welcome");
  int read = 0;
  int last = 0;
  while (last < kFrames)
  {
    last = std::stoi(slow.Read());
    ++read;
  }
  EXPECT_LT(read, kFrames / 2);
  ASSERT_TRUE(Eventually([&] { return server_->Hungry() == 2; }));
}

TEST_F(WebServerTest, ClientsAboveTheLimitAreRefusedUntilOneLeaves)
{
  Start();
  auto first = std::make_unique<BlockingClient>(server_->Port());
  BlockingClient second = Connect();
  BlockingClient third = Connect();
  EXPECT_EQ(first->Open(), 101u);
  EXPECT_EQ(second.Open(), 101u);
  EXPECT_EQ(third.Open(), 101u);
  ASSERT_TRUE(Eventually([&] { return server_->Clients() == 3; }));
  EXPECT_EQ(Connect().Open(), 503u);
  first.reset();
  ASSERT_TRUE(Eventually([&] { return server_->Clients() == 2; }));
  EXPECT_EQ(left_, 1);
  EXPECT_EQ(Connect().Open(), 101u);
}

// A client opens connections without end and requests nothing. Other clients still get the page.
TEST_F(WebServerTest, ConnectionsThatAskNothingMakeRoomForOthers)
{
  Start();
  std::vector<std::unique_ptr<BlockingClient>> idle;
  for (int k = 0; k < 300; ++k)
  {
    idle.push_back(std::make_unique<BlockingClient>(server_->Port()));
    if (k % 50 != 49) continue;
    BlockingClient asking(server_->Port());
    EXPECT_EQ(asking.Get("/").result_int(), 200U) << k;
    BlockingClient looking(server_->Port());
    EXPECT_EQ(looking.Open(), 101U) << k;
  }
}

TEST_F(WebServerTest, AClientThatShowsTheTokenHasAPlaceWhenStrangersHoldAllOthers)
{
  settings_.max_holders = 1;
  settings_.proof_time = 1h;
  Start();
  server_->SetGreeting(Shared(R"({"type": "world"})"));
  std::vector<std::unique_ptr<BlockingClient>> strangers;
  for (int k = 0; k < 3; ++k)
  {
    strangers.push_back(std::make_unique<BlockingClient>(server_->Port()));
    ASSERT_EQ(strangers.back()->Open(), 101U);
  }
  BlockingClient owner = Connect();
  ASSERT_EQ(owner.Open(), 101U);
  const std::uint64_t id = owner.ReadUntil("welcome")["client"];
  EXPECT_TRUE(Eventually([&] { return server_->Clients() == 3; }));
  // Nothing of the run is sent before the token is shown: the echo comes first.
  owner.Send("proof");
  EXPECT_EQ(nlohmann::json::parse(owner.Read())["type"], "echo");
  server_->Admit(id);
  owner.ReadUntil("world");
  EXPECT_TRUE(Eventually([&] { return server_->Clients() == 4; }));
  // If the places of holders are taken too, no further client is let in.
  EXPECT_EQ(Connect().Open(), 503U);
}

TEST_F(WebServerTest, AClientThatShowsTheTokenLeavesItsFirstPlaceToOthers)
{
  settings_.max_clients = 1;
  settings_.max_holders = 1;
  settings_.proof_time = 1h;
  Start();
  BlockingClient owner = Connect();
  ASSERT_EQ(owner.Open(), 101U);
  server_->Admit(owner.ReadUntil("welcome")["client"]);
  BlockingClient watcher = Connect();
  ASSERT_EQ(watcher.Open(), 101U);
  watcher.ReadUntil("welcome");
  EXPECT_TRUE(Eventually([&] { return server_->Clients() == 2; }));
}

TEST_F(WebServerTest, NoMoreClientsGetAPlaceByTheTokenThanThereAre)
{
  settings_.max_clients = 0;
  settings_.max_holders = 1;
  settings_.proof_time = 1h;
  Start();
  server_->SetGreeting(Shared(R"({"type": "world"})"));
  BlockingClient first = Connect(), second = Connect();
  ASSERT_EQ(first.Open(), 101U);
  ASSERT_EQ(second.Open(), 101U);
  const std::uint64_t first_id = first.ReadUntil("welcome")["client"];
  const std::uint64_t second_id = second.ReadUntil("welcome")["client"];
  server_->Admit(first_id);
  server_->Admit(second_id);
  first.ReadUntil("world");
  second.Send("proof");
  EXPECT_EQ(nlohmann::json::parse(second.Read())["type"], "echo") << "the second has heard nothing of the run";
  EXPECT_EQ(server_->Clients(), 1U);
}

TEST_F(WebServerTest, AClientWithoutAPlaceThatDoesNotShowTheTokenIsSentAway)
{
  settings_.max_clients = 0;
  settings_.max_holders = 1;
  settings_.proof_time = 0ms;
  Start();
  BlockingClient client = Connect();
  ASSERT_EQ(client.Open(), 101U);
  client.ReadUntil("welcome");
  BlockingClient::ErrorCode error;
  client.Read(error);
  EXPECT_EQ(error, boost::beast::websocket::error::closed);
  EXPECT_EQ(client.CloseReason().code, boost::beast::websocket::close_code::try_again_later);
}

TEST_F(WebServerTest, ClientsWithoutAPlaceMakeRoomForOthers)
{
  settings_.max_clients = 0;
  settings_.max_holders = 1;
  settings_.proof_time = 1h;
  Start();
  std::vector<std::unique_ptr<BlockingClient>> strangers;
  for (int k = 0; k < 100; ++k)
  {
    strangers.push_back(std::make_unique<BlockingClient>(server_->Port()));
    ASSERT_EQ(strangers.back()->Open(), 101U) << k;
  }
  BlockingClient owner = Connect();
  EXPECT_EQ(owner.Get("/").result_int(), 200U);
  ASSERT_EQ(owner.Open(), 101U);
  server_->Admit(owner.ReadUntil("welcome")["client"]);
  EXPECT_TRUE(Eventually([&] { return server_->Clients() == 1; }));
  for (int k = 0; k < 100; ++k)
  {
    strangers.push_back(std::make_unique<BlockingClient>(server_->Port()));
    strangers.back()->Get("/");
  }
  owner.Send("still here");
  EXPECT_EQ(owner.ReadUntil("echo")["text"], "still here");
}

// A stranger asks for files and does not read them.
TEST_F(WebServerTest, ConnectionsThatDoNotReadMakeRoomForOthers)
{
  files_.Add("/large.js", "text/javascript; charset=utf-8", std::string(std::size_t{8} << 20U, ' '));
  Start();
  std::vector<std::unique_ptr<BlockingClient>> slow;
  for (int k = 0; k < 100; ++k)
  {
    slow.push_back(std::make_unique<BlockingClient>(server_->Port()));
    slow.back()->Write("GET /large.js HTTP/1.1\r\nHost: localhost\r\n\r\n");
    if (k % 20 != 19) continue;
    EXPECT_EQ(Connect().Get("/").result_int(), 200U) << k;
  }
}

// One of two machines takes all connections that it may. The other machine still gets in.
TEST_F(WebServerTest, OneAddressLeavesConnectionsForOthers)
{
  settings_.max_clients = 20;
  settings_.max_connections = 12;
  settings_.max_connections_of_address = 8;
  Start();
  std::vector<std::unique_ptr<BlockingClient>> looking;
  for (int k = 0; k < 8; ++k)
  {
    looking.push_back(std::make_unique<BlockingClient>(server_->Port()));
    EXPECT_EQ(looking.back()->Open(), 101U);
  }
  boost::asio::io_context context;
  const auto comes_from = [&](const char* address)
  {
    using Tcp = boost::asio::ip::tcp;
    Tcp::socket socket(context, Tcp::endpoint(boost::asio::ip::make_address(address), 0));
    socket.connect({boost::asio::ip::make_address("127.0.0.1"), server_->Port()});
    const std::string request = "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";
    boost::beast::error_code error;
    boost::asio::write(socket, boost::asio::buffer(request), error);
    boost::beast::flat_buffer buffer;
    boost::beast::http::response<boost::beast::http::string_body> response;
    boost::beast::http::read(socket, buffer, response, error);
    return !error && response.result_int() == 200;
  };
  EXPECT_FALSE(comes_from("127.0.0.1"));
  EXPECT_TRUE(comes_from("127.0.0.2"));
  looking.pop_back();
  EXPECT_TRUE(Eventually([&] { return comes_from("127.0.0.1"); }));
}

// The client's messages of one second are read at once, and later ones at a limited pace.
TEST_F(WebServerTest, WhoSendsWithoutEndIsReadAtAPace)
{
  settings_.max_messages_per_second = 50;
  Start();
  BlockingClient client = Connect();
  ASSERT_EQ(client.Open(), 101U);
  client.ReadUntil("welcome");
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < 100; ++k) client.Send(std::to_string(k));
  for (int k = 0; k < 100; ++k) EXPECT_EQ(client.ReadUntil("echo")["text"], std::to_string(k));
  EXPECT_GE(std::chrono::steady_clock::now() - start, 900ms);
}

TEST_F(WebServerTest, MessagesAreHeardAndTooLongOnesEndTheConnection)
{
  Start();
  BlockingClient client = Connect();
  ASSERT_EQ(client.Open(), 101u);
  client.Send("join");
  EXPECT_EQ(client.ReadUntil("echo")["text"], "join");
  client.Send(std::string(1001, 'x'));
  BlockingClient::ErrorCode error;
  for (int i = 0; i < 3 && !error; ++i) client.Read(error);
  EXPECT_TRUE(error);
  ASSERT_TRUE(Eventually([&] { return server_->Clients() == 0; }));
}

TEST_F(WebServerTest, AHiddenPageGetsFewerFramesAndTheLatestWhenItIsShownAgain)
{
  Start();
  BlockingClient client = Connect();
  ASSERT_EQ(client.Open(), 101u);
  client.ReadUntil("welcome");
  server_->SetFramePeriod(1, 60000);
  for (int i = 1; i <= 20; ++i) server_->Publish(WebServer::Slot::kChange, Shared(std::to_string(i)));
  EXPECT_EQ(client.Read(), "1");
  server_->SetFramePeriod(1, 0);
  EXPECT_EQ(client.Read(), "20");
}

TEST_F(WebServerTest, AKeyComesBeforeItsChangesAndEndsThoseOfTheOneBefore)
{
  Start();
  const auto publish = [&](WebServer::Slot slot, const char* text) { server_->Publish(slot, Shared(text)); };
  publish(WebServer::Slot::kKey, "key 1");
  publish(WebServer::Slot::kChange, "change of 1");
  BlockingClient late = Connect();
  ASSERT_EQ(late.Open(), 101u);
  late.ReadUntil("welcome");
  EXPECT_EQ(late.Read(), "key 1");
  EXPECT_EQ(late.Read(), "change of 1");
  publish(WebServer::Slot::kKey, "key 2");
  EXPECT_EQ(late.Read(), "key 2");
  // There is no change of it yet.
  BlockingClient later = Connect();
  ASSERT_EQ(later.Open(), 101u);
  later.ReadUntil("welcome");
  EXPECT_EQ(later.Read(), "key 2");
  EXPECT_TRUE(later.GotBinary());
  publish(WebServer::Slot::kChange, "change of 2");
  EXPECT_EQ(later.Read(), "change of 2");
}

TEST_F(WebServerTest, AHiddenPageGetsEachKeyForTheChangesThatItWillGet)
{
  Start();
  BlockingClient client = Connect();
  ASSERT_EQ(client.Open(), 101u);
  client.ReadUntil("welcome");
  server_->SetFramePeriod(1, 60000);
  for (int i = 1; i <= 5; ++i)
  {
    server_->Publish(WebServer::Slot::kKey, Shared("key " + std::to_string(i)));
    server_->Publish(WebServer::Slot::kChange, Shared("change of " + std::to_string(i)));
  }
  server_->SetFramePeriod(1, 0);
  std::string key = "none";
  for (std::string text; text != "change of 5";)
  {
    text = client.Read();
    if (text.starts_with("key ")) key = text.substr(4);
  }
  EXPECT_EQ(key, "5");
}

TEST_F(WebServerTest, AClosingServerSendsWhatIsReadyAndSaysGoodbye)
{
  Start();
  BlockingClient client = Connect();
  ASSERT_EQ(client.Open(), 101u);
  client.ReadUntil("welcome");
  std::thread closing(
      [&]
      {
        server_->Publish(WebServer::Slot::kChange, Shared("the last"));
        server_.reset();
      });
  EXPECT_EQ(client.Read(), "the last");
  BlockingClient::ErrorCode error;
  client.Read(error);
  EXPECT_EQ(error, boost::beast::websocket::error::closed);
  EXPECT_EQ(client.CloseReason().code, boost::beast::websocket::close_code::going_away);
  closing.join();
}

TEST_F(WebServerTest, AClosingServerWaitsForNobodyWhoDoesNotRead)
{
  Start();
  BlockingClient client = Connect();
  ASSERT_EQ(client.Open(), 101u);
  ASSERT_TRUE(Eventually([&] { return server_->Clients() == 1; }));
  for (int i = 0; i < 20; ++i)
  {
    server_->Publish(WebServer::Slot::kChange, Shared(std::string(4000000, '.')));
    std::this_thread::sleep_for(5ms);
  }
  // Without that it would wait for ever.
  server_.reset();
}

TEST_F(WebServerTest, ATakenPortIsAnErrorWithItsCure)
{
  Start();
  WebServerSettings same = settings_;
  same.port = server_->Port();
  const std::string mistake = test::MessageOf<std::runtime_error>([&] { WebServer second(same, files_, *this); });
  EXPECT_THAT(mistake, HasSubstr("Address already in use"));
  EXPECT_THAT(mistake, HasSubstr("port 0 takes a free one"));
  same.address = "nowhere";
  EXPECT_THROW(WebServer(same, files_, *this), std::runtime_error);
}

TEST(PageFiles, AFolderWithoutAPageIsAnErrorWithItsCure)
{
  EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { const PageFiles files("/nonexistent"); }), HasSubstr("nodejs"));
}

}  // namespace
}  // namespace swarmanoid
