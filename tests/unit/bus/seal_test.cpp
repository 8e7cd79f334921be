// Seals: only holders of the run's key can send a message, once, on one topic and as one writer.
#include "common/bus/security/seal.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <openssl/core_names.h>
#include <openssl/evp.h>
#include <openssl/params.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>

#include "common/bus/security/datagram_signatures.h"
#include "common/run/access/digest.h"
#include "tests/eventually.h"
#include "tests/unit/bus/key_of_byte.h"
#include "tests/unit/bus/listener.h"
#include "tests/unit/bus/server_fixture.h"
#include "tests/unit/bus/stranger.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using test::Eventually;
using test::KeyOfByte;
using testing::HasSubstr;

const WriterId kWriter{1, 2, 3};

// Returns a payload with that text in the place of its fields.
std::string Sealed(Sealer& sealer, const std::string& text, const WriterId& writer = kWriter)
{
  std::string payload = std::string("\0\1\0\0", 4) + std::string(kSealedFieldsAt - 4, '\0') + text;
  payload += std::string(kCodeBytes, '\0');
  sealer.Seal(payload, writer);
  return payload;
}

std::optional<std::string> TextIn(Opener& opener, const RunKey& key, const std::string& payload)
{
  std::vector<char> room;
  const auto opened = opener.Knows(payload) ? opener.Open(payload, room) : opener.OpenBy(key, payload, room);
  if (!opened) return std::nullopt;
  return std::string(opened->payload.begin() + 4, opened->payload.end());
}

TEST(Seals, OpenForTheKeyAndTheTopicAlone)
{
  Sealer sealer(KeyOfByte(7), "Leave");
  const std::string payload = Sealed(sealer, "the message");
  EXPECT_EQ(payload.find("the message"), std::string::npos);
  Opener right("Leave");
  EXPECT_EQ(TextIn(right, KeyOfByte(7), payload), "the message");
  Opener wrong_key("Leave");
  EXPECT_FALSE(TextIn(wrong_key, KeyOfByte(8), payload).has_value());
  Opener wrong_topic("Join");
  EXPECT_FALSE(TextIn(wrong_topic, KeyOfByte(7), payload).has_value());
  // The receiver is one that has opened a message of this writer, and one that has not.
  for (std::size_t k = 0; k < payload.size(); ++k)
  {
    std::string changed = payload;
    changed[k] = static_cast<char>(changed[k] ^ 1);
    Opener fresh("Leave");
    for (Opener* const opener : {&right, &fresh})
    {
      EXPECT_FALSE(TextIn(*opener, KeyOfByte(7), changed).has_value()) << k;
      EXPECT_FALSE(TextIn(*opener, KeyOfByte(7), payload.substr(0, k)).has_value()) << k;
    }
  }
}

TEST(Seals, TellTheWriterAndWhetherAMessageIsNew)
{
  Sealer sealer(KeyOfByte(7), "Leave");
  const std::string first = Sealed(sealer, "first");
  const std::string second = Sealed(sealer, "second", WriterId{4, 5});
  Opener opener("Leave");
  std::vector<char> room;
  const auto opened = opener.OpenBy(KeyOfByte(7), first, room);
  ASSERT_TRUE(opened.has_value());
  EXPECT_EQ(opened->writer, kWriter);
  EXPECT_TRUE(opener.IsNew(*opened));
  opener.Note(*opened);
  EXPECT_FALSE(opener.IsNew(*opened));
  EXPECT_TRUE(opener.IsNew(*opened, "another instance"));
  const auto next = opener.Open(second, room);
  ASSERT_TRUE(next.has_value());
  EXPECT_EQ(next->writer, (WriterId{4, 5}));
  EXPECT_TRUE(opener.IsNew(*next));
  opener.Note(*next);
  EXPECT_FALSE(opener.IsNew(*opener.Open(first, room)));
}

// Two messages under one key and nonce would reveal each other. A process that replaces another one has its identity,
// and begins with number 1 again.
TEST(Seals, OfEqualMessagesOfTwoProcessesHaveNothingInCommon)
{
  Sealer one(KeyOfByte(7), "Leave");
  Sealer other(KeyOfByte(7), "Leave");
  const std::string text(1000, 'x');
  const std::string first = Sealed(one, text);
  const std::string again = Sealed(one, text);
  const std::string second = Sealed(other, text);
  EXPECT_NE(first.substr(4, kSaltBytes), second.substr(4, kSaltBytes));
  EXPECT_EQ(first.substr(4, kSaltBytes), again.substr(4, kSaltBytes));
  const auto equal_bytes = [&](const std::string& a, const std::string& b)
  {
    std::size_t equal = 0;
    for (std::size_t k = kSealedFieldsAt; k < a.size(); ++k) equal += a[k] == b[k] ? 1 : 0;
    return equal;
  };
  // One in 256 does so by chance.
  EXPECT_LT(equal_bytes(first, second), 30U);
  EXPECT_LT(equal_bytes(first, again), 30U);
}

// A program in another language that joins a run uses docs/wire.md. So this test makes HKDF by its two steps of HMAC,
// and AES-256-GCM with a nonce that is put together by hand.
TEST(Seals, AreWhatTheWireSaysTheyAre)
{
  const auto hmac = [](const std::string& key, const std::string& text)
  {
    std::string code(32, '\0');
    std::size_t length = 0;
    char digest[] = "SHA256";
    const OSSL_PARAM parameters[] = {OSSL_PARAM_construct_utf8_string("digest", digest, 0), OSSL_PARAM_construct_end()};
    EXPECT_NE(EVP_Q_mac(nullptr, "HMAC", nullptr, nullptr, parameters, key.data(), key.size(),
                        reinterpret_cast<const unsigned char*>(text.data()), text.size(),
                        reinterpret_cast<unsigned char*>(code.data()), code.size(), &length),
              nullptr);
    EXPECT_EQ(length, code.size());
    return code;
  };
  Sealer sealer(KeyOfByte(7), "Leave");
  const std::string payload = Sealed(sealer, "the message");
  const std::string salt = payload.substr(4, 12);
  const std::string number = payload.substr(16, 8);
  EXPECT_EQ(number, std::string("\1\0\0\0\0\0\0\0", 8));
  const std::string key = hmac(hmac(salt, std::string(32, '\7')), "swarmanoid message Leave\1");
  const std::string nonce = std::string(4, '\0') + number;
  const std::string head = payload.substr(0, 24);
  const std::string secret = payload.substr(24, payload.size() - 24 - 16);
  std::string code = payload.substr(payload.size() - 16);
  std::string plain(secret.size(), '\0');
  const auto bytes = [](const std::string& text) { return reinterpret_cast<const unsigned char*>(text.data()); };
  const Cipher cipher(EVP_CIPHER_CTX_new());
  int count = 0;
  EXPECT_EQ(EVP_DecryptInit_ex(cipher.get(), EVP_aes_256_gcm(), nullptr, bytes(key), bytes(nonce)), 1);
  EXPECT_EQ(EVP_DecryptUpdate(cipher.get(), nullptr, &count, bytes(head), static_cast<int>(head.size())), 1);
  EXPECT_EQ(EVP_DecryptUpdate(cipher.get(), reinterpret_cast<unsigned char*>(plain.data()), &count, bytes(secret),
                              static_cast<int>(secret.size())),
            1);
  EXPECT_EQ(EVP_CIPHER_CTX_ctrl(cipher.get(), EVP_CTRL_AEAD_SET_TAG, 16, code.data()), 1);
  EXPECT_EQ(EVP_DecryptFinal_ex(cipher.get(), reinterpret_cast<unsigned char*>(plain.data()), &count), 1);
  EXPECT_EQ(plain, std::string(kWriter.data(), kWriter.size()) + "the message");
}

TEST(RunKeys, AreReadFromTextsAndFilesOfOneUser)
{
  const RunKey key = NewRunKey();
  EXPECT_NE(key, NewRunKey());
  EXPECT_EQ(KeyOfText(TextOfKey(key)), key);
  EXPECT_EQ(KeyOfText(" " + TextOfKey(key) + "\r\n"), key);
  for (const std::string& text : {std::string(), std::string(63, '0'), std::string(65, '0'), std::string(64, 'g')})
    EXPECT_FALSE(KeyOfText(text).has_value()) << text;

  const test::TemporaryFolder folder;
  const std::string file = folder.Write("key", TextOfKey(key) + "\n");
  std::filesystem::permissions(file, std::filesystem::perms(0600));
  EXPECT_EQ(KeyOfFile(file), key);
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  EXPECT_EQ(KeyOfDescriptor(descriptor), key);
  EXPECT_THROW(KeyOfDescriptor(descriptor), BusError);
  close(descriptor);
  std::filesystem::permissions(file, std::filesystem::perms(0640));
  EXPECT_THROW(KeyOfFile(file), BusError);
  std::filesystem::remove(file);
  EXPECT_THROW(KeyOfFile(file), BusError);
}

TEST(Digests, AreThoseOfSha256)
{
  const test::TemporaryFolder folder;
  const std::string file = folder.Write("file", "abc");
  EXPECT_EQ(DigestOfFile(file), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");  // FIPS 180-4
  std::filesystem::remove(file);
  EXPECT_EQ(DigestOfFile(file), "");
}

class SealedBus : public test::ServerFixture
{
protected:
  SealedBus() : ServerFixture("sealed") {}
};

// A writer that sends sealed messages unchanged, as an eavesdropper could.
TEST_F(SealedBus, AMessageIsHeardOnceAndOfItsWriterAlone)
{
  Bus bus(options_, "reader");
  Bus other(options_, "writer");
  std::atomic<int> heard = 0;
  std::mutex mutex;
  std::vector<std::string> refused;
  bus.OnRefused(
      [&](const BadMessageReport& report)
      {
        const std::lock_guard lock(mutex);
        refused.push_back(report.topic + ": " + report.what);
      });
  const Subscription<StatusMessage> in(bus, "sealed", [&](const StatusMessage&) { ++heard; });
  test::Stranger stranger(options_.domain, "sealed");
  ASSERT_TRUE(stranger.Met("Status", 1));
  const StatusMessage status{1, 2, "engine 'ground'", "text"};
  const std::string plain = test::PayloadOf(status);
  Sealer sealer(*options_.key, "Status");
  const auto sealed = [&](Sealer& by, const WriterId& writer)
  {
    std::string payload = plain.substr(0, 4) + std::string(kSealedFieldsAt - 4, '\0') + plain.substr(4);
    payload += std::string(PaddingOf(plain.size()) + kCodeBytes, '\0');
    by.Seal(payload, writer);
    return payload;
  };
  const WriterId writer = stranger.Writer("Status");
  const std::string first = sealed(sealer, writer);
  const std::string second = sealed(sealer, writer);
  ASSERT_TRUE(stranger.Send("Status", {second}));
  ASSERT_TRUE(Eventually([&] { return heard == 1; }));
  ASSERT_TRUE(stranger.Send("Status", {second, first}));
  ASSERT_TRUE(Eventually([&] { return bus.Dropped() == 2; }));
  Sealer of_others(KeyOfByte(8), "Status");
  ASSERT_TRUE(stranger.Send("Status", {sealed(of_others, writer), plain, sealed(sealer, WriterId{1})}));
  ASSERT_TRUE(Eventually([&] { return bus.Dropped() == 5; }));
  ASSERT_TRUE(stranger.Send("Status", {sealed(sealer, writer)}));
  ASSERT_TRUE(Eventually([&] { return heard == 2; }));
  EXPECT_EQ(bus.Dropped(), 5U);
  const std::lock_guard lock(mutex);
  // Only the first refusal for a sender and a topic is reported.
  EXPECT_THAT(refused, testing::ElementsAre("Status: it is a repetition of a message that has come before"));
}

// The bytes on the wire reveal nothing.
TEST_F(SealedBus, NobodyWithoutTheKeyReadsAMessage)
{
  Bus bus(options_, "writer");
  BusOptions of_others = options_;
  of_others.key = KeyOfByte(8);
  Bus stranger(of_others, "stranger");
  std::atomic<int> heard = 0;
  const Subscription<StatusMessage> in(stranger, "sealed", [&](const StatusMessage&) { ++heard; });
  Publisher<StatusMessage> out(bus, "sealed");
  test::Listener listener(options_.domain, "sealed", "Status");
  ASSERT_TRUE(Eventually([&] { return out.Readers() == 2; }));
  out.Write({1, 2, "engine 'ground'", "a secret text"});
  ASSERT_TRUE(Eventually([&] { return stranger.Dropped() == 1 && !listener.Heard().empty(); }));
  EXPECT_EQ(heard, 0);
  EXPECT_THAT(listener.Heard(), testing::Not(HasSubstr("secret")));
  EXPECT_THAT(listener.Heard(), testing::Not(HasSubstr("ground")));
}

// All datagrams that come to the announcements of a domain on loopback, from processes of this one on.
class Announcements
{
public:
  explicit Announcements(int domain) : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0))
  {
    const int yes = 1;
    setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    setsockopt(socket_, SOL_SOCKET, SO_REUSEPORT, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    // DDSI-RTPS 2.2, 9.6.1.1
    address.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * domain));
    inet_pton(AF_INET, "239.255.0.1", &address.sin_addr);
    const ip_mreq group{address.sin_addr, {htonl(INADDR_LOOPBACK)}};
    is_open_ = bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
               setsockopt(socket_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group) == 0;
  }
  ~Announcements() { close(socket_); }
  Announcements(const Announcements&) = delete;
  Announcements& operator=(const Announcements&) = delete;

  bool IsOpen() const { return is_open_; }
  std::optional<std::string> Next()
  {
    std::string datagram(65536, '\0');
    const ssize_t size = recv(socket_, datagram.data(), datagram.size(), 0);
    if (size < 0) return std::nullopt;
    datagram.resize(static_cast<std::size_t>(size));
    return datagram;
  }

private:
  const int socket_;
  bool is_open_ = false;
};

// A process that has signed once is not heard without a signature. So what it sent before must not be on its way still.
TEST_F(SealedBus, AProcessThatJoinsARunOfThisUserSignsItsFirstDatagram)
{
  ServerSession session(options_, world_, {"engine 'ground'"}, {[](const auto&) {}, [] {}, [](const auto&) {}});
  session.Open();
  Announcements announcements(options_.domain);
  ASSERT_TRUE(announcements.IsOpen());
  BusOptions without = options_;
  without.key.reset();
  const Bus bus(without, "watcher", "sealed");
  // The announcement holds the name of the process.
  std::string first;
  const auto is_announced = [&]
  {
    while (const auto next = announcements.Next())
      if (first = *next; first.find("watcher") != std::string::npos) return true;
    return false;
  };
  ASSERT_TRUE(Eventually(is_announced));
  DatagramSignatures signatures(std::make_shared<KeyRing>(options_.domain, options_.key));
  EXPECT_FALSE(signatures.Check(first).is_of_stranger);
}

// Another process announces itself as one of the run's, and leaves.
TEST_F(SealedBus, WhoHasNotSpokenUnderTheKeyIsNotMissed)
{
  ServerSession session(options_, world_, {"engine 'ground'"}, {[](const auto&) {}, [] {}, [](const auto&) {}});
  session.Open();
  Bus engine(options_, "engine 'ground'");
  Publisher<JoinMessage> join(engine, "sealed");
  join.Write({ProcessId(), kProtocolVersion, world_.run, "engine 'ground'", true});
  ASSERT_TRUE(Eventually([&] { return session.Missing().empty(); }));
  BusOptions of_others = options_;
  of_others.key = KeyOfByte(8);
  {
    // The stranger announces the name of the same process.
    Bus stranger(of_others, "engine 'ground'");
    Publisher<LeaveMessage> leave(stranger, "sealed");
    ASSERT_TRUE(Eventually([&] { return leave.Readers() == 1; }));
    leave.Write({world_.run, 3, "engine 'ground'", ProcessId(), "I failed"});
    ASSERT_TRUE(Eventually([&] { return session.GetBus().Dropped() > 0; }));
  }
  EXPECT_FALSE(Eventually([&] { return session.Failure().has_value(); }, std::chrono::milliseconds(500)));
  EXPECT_FALSE(session.FirstLeft().has_value());
}

// Departures are reported in their order, so the departure of a known process ends the wait.
TEST_F(SealedBus, OnlyWhoHasSpokenUnderTheKeyIsToldToBeGone)
{
  Bus bus(options_, "space server");
  std::mutex mutex;
  std::vector<std::string> gone;
  bus.OnProcessGone(
      [&](const std::string&, const std::string& name, bool)
      {
        const std::lock_guard lock(mutex);
        gone.push_back(name);
      });
  std::atomic<int> heard = 0;
  const Subscription<StatusMessage> in(bus, "sealed", [&](const StatusMessage&) { ++heard; });
  {
    Bus engine(options_, "engine 'ground'");
    Publisher<StatusMessage> out(engine, "sealed");
    ASSERT_TRUE(Eventually([&] { return out.Readers() == 1; }));
    out.Write({1, 2, "engine 'ground'", "text"});
    ASSERT_TRUE(Eventually([&] { return heard == 1; }));
    BusOptions of_others = options_;
    of_others.key = KeyOfByte(8);
    Bus stranger(of_others, "engine 'air'");
    Publisher<StatusMessage> strange(stranger, "sealed");
    ASSERT_TRUE(Eventually([&] { return strange.Readers() == 1; }));
    strange.Write({1, 2, "engine 'air'", "text"});
    ASSERT_TRUE(Eventually([&] { return bus.Dropped() == 1; }));
  }  // the stranger goes first
  ASSERT_TRUE(Eventually(
      [&]
      {
        const std::lock_guard lock(mutex);
        return std::find(gone.begin(), gone.end(), "engine 'ground'") != gone.end();
      }));
  const std::lock_guard lock(mutex);
  EXPECT_THAT(gone, testing::ElementsAre("engine 'ground'"));
}

}  // namespace
}  // namespace swarmanoid
