// Seals: what only those can say who hold the key of the run, once, on one topic and as one writer.
#include "common/bus/seal.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <openssl/params.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "common/bus/message_type.h"
#include "common/bus/participant.h"
#include "tests/eventually.h"
#include "tests/unit/bus/server_fixture.h"

namespace swarmanoid
{
namespace
{

using test::Eventually;
using testing::HasSubstr;

const WriterId kWriter{1, 2, 3};

RunKey KeyOfByte(unsigned char byte)
{
  RunKey key;
  key.fill(byte);
  return key;
}

std::string Sealed(const std::string& text, std::uint64_t number)
{
  std::string payload = text + std::string(kSealBytes, '\0');
  Seal(payload, KeyOfByte(7), "Leave", kWriter, number);
  return payload;
}

TEST(Seals, OpenForTheKeyTheTopicAndTheWriterAlone)
{
  const std::string payload = Sealed("the message", 5);
  EXPECT_EQ(NumberUnderSeal(payload, KeyOfByte(7), "Leave", kWriter), 5U);
  EXPECT_FALSE(NumberUnderSeal(payload, KeyOfByte(8), "Leave", kWriter).has_value());
  EXPECT_FALSE(NumberUnderSeal(payload, KeyOfByte(7), "Join", kWriter).has_value());
  EXPECT_FALSE(NumberUnderSeal(payload, KeyOfByte(7), "Leave", WriterId{1, 2, 4}).has_value());
  for (std::size_t k = 0; k < payload.size(); ++k)
  {
    std::string changed = payload;
    changed[k] = static_cast<char>(changed[k] ^ 1);
    EXPECT_FALSE(NumberUnderSeal(changed, KeyOfByte(7), "Leave", kWriter).has_value()) << k;
    EXPECT_FALSE(NumberUnderSeal(payload.substr(0, k), KeyOfByte(7), "Leave", kWriter).has_value()) << k;
  }
}

// Whoever writes a member of the run in another language goes by docs/wire.md: the code by another way through
// libcrypto.
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
  const std::string payload = Sealed("the message", 5);
  const std::string of_writer =
      hmac(std::string(32, '\7'), "Leave" + std::string(1, '\0') + std::string(kWriter.data(), kWriter.size()));
  const std::string code = hmac(of_writer, "the message" + std::string("\5\0\0\0\0\0\0\0", 8));
  EXPECT_EQ(payload.substr(payload.size() - 16), code.substr(0, 16));
}

TEST(RunKeys, AreReadFromTextsAndFilesOfOneUser)
{
  const RunKey key = NewRunKey();
  EXPECT_NE(key, NewRunKey());
  EXPECT_EQ(KeyOfText(TextOfKey(key)), key);
  EXPECT_EQ(KeyOfText(" " + TextOfKey(key) + "\r\n"), key);
  for (const std::string& text : {std::string(), std::string(63, '0'), std::string(65, '0'), std::string(64, 'g')})
    EXPECT_FALSE(KeyOfText(text).has_value()) << text;

  const std::string file =
      (std::filesystem::temp_directory_path() / fmt::format("swarmanoid-key-{}", getpid())).string();
  std::ofstream(file) << TextOfKey(key) << "\n";
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
  const std::string file =
      (std::filesystem::temp_directory_path() / fmt::format("swarmanoid-digest-{}", getpid())).string();
  std::ofstream(file) << "abc";
  EXPECT_EQ(DigestOfFile(file), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");  // FIPS 180-4
  std::filesystem::remove(file);
  EXPECT_EQ(DigestOfFile(file), "");
}

class SealedBus : public test::ServerFixture
{
protected:
  SealedBus() : ServerFixture("sealed") {}
};

// A writer that says the same sealed message again, as whoever overheard it could.
TEST_F(SealedBus, AMessageIsHeardOnce)
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
  dds::Topic* topic =
      other.Internals().TopicOf("Status", [] { return dds::TypeSupport(new ColdType<StatusMessage>()); });
  WriterEnd writer(other, topic, "sealed", WriterQos(QosOf("Status")));
  ASSERT_TRUE(Eventually([&] { return writer.Matched() == 1 && in.Writers() == 1; }));
  const StatusMessage status{1, 2, "engine 'ground'", "text"};
  const auto write = [&](const RunKey& key, std::uint64_t number)
  {
    ColdCall<StatusMessage> call;
    call.out = &status;
    call.size = PayloadSize(status);
    call.seal = [&](std::span<char> payload) { Seal(payload, key, "Status", IdOf(writer->guid()), number); };
    EXPECT_TRUE(writer->write(&call));
  };
  write(*options_.key, 5);
  ASSERT_TRUE(Eventually([&] { return heard == 1; }));
  write(*options_.key, 5);
  write(*options_.key, 4);
  ASSERT_TRUE(Eventually([&] { return bus.Dropped() == 2; }));
  write(KeyOfByte(8), 6);
  ASSERT_TRUE(Eventually([&] { return bus.Dropped() == 3; }));
  write(*options_.key, 6);
  ASSERT_TRUE(Eventually([&] { return heard == 2; }));
  EXPECT_EQ(bus.Dropped(), 3U);
  const std::lock_guard lock(mutex);
  // Of one sender on one topic the first is told.
  EXPECT_THAT(refused, testing::ElementsAre("Status: it is a repetition of a message that has come before"));
}

// Another process says that it is one of the run's, and goes.
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
    // Of the same process, by its own word.
    Bus stranger(of_others, "engine 'ground'");
    Publisher<LeaveMessage> leave(stranger, "sealed");
    ASSERT_TRUE(Eventually([&] { return leave.Readers() == 1; }));
    leave.Write({world_.run, 3, "engine 'ground'", ProcessId(), "I failed"});
    ASSERT_TRUE(Eventually([&] { return session.GetBus().Dropped() > 0; }));
  }
  EXPECT_FALSE(Eventually([&] { return session.Failure().has_value(); }, std::chrono::milliseconds(500)));
  EXPECT_FALSE(session.FirstLeft().has_value());
}

}  // namespace
}  // namespace swarmanoid
