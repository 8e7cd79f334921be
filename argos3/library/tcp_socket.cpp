// A blocking stream socket with the interface of ARGoS3. All addresses of a name are tried in the order of the system,
// IPv6 included. Buffers are sent and received completely, whatever the pieces in which the system transfers them; a
// byte array has its length in front, as 32 bits in network byte order. An error throws; the end of the stream makes
// Receive… return false.
#include <argos3/core/utility/networking/tcp_socket.h>

#include <arpa/inet.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

namespace argos
{
namespace
{

[[noreturn]] void Refuse(const std::string& what, const char* why) { THROW_ARGOSEXCEPTION(what << ": " << why); }

using Addresses = std::unique_ptr<::addrinfo, void (*)(::addrinfo*)>;

// Finds addresses. A `host` of nullptr means the addresses of this machine, for listening.
Addresses Find(const char* host, SInt32 port)
{
  ::addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = host == nullptr ? AI_PASSIVE : 0;
  ::addrinfo* found = nullptr;
  const int error = ::getaddrinfo(host, std::to_string(port).c_str(), &wanted, &found);
  if (error != 0)
    Refuse("no address of '" + std::string(host == nullptr ? "this machine" : host) + "'", ::gai_strerror(error));
  return {found, ::freeaddrinfo};
}

// Returns the first socket with which `use` succeeds; -1 for none.
template <class Use>
int FirstThat(const Addresses& addresses, Use use)
{
  for (const ::addrinfo* address = addresses.get(); address != nullptr; address = address->ai_next)
  {
    const int stream = ::socket(address->ai_family, address->ai_socktype | SOCK_CLOEXEC, address->ai_protocol);
    if (stream == -1) continue;
    if (use(stream, *address)) return stream;
    const int error = errno;
    ::close(stream);
    errno = error;
  }
  return -1;
}

}  // namespace

void CTCPSocket::Connect(const std::string& host, SInt32 port)
{
  Disconnect();
  stream_ = FirstThat(Find(host.c_str(), port), [](int stream, const ::addrinfo& address)
                      { return ::connect(stream, address.ai_addr, address.ai_addrlen) == 0; });
  if (stream_ == -1) Refuse("no connection to '" + host + "', port " + std::to_string(port), std::strerror(errno));
}

void CTCPSocket::Accept(CTCPSocket& client, SInt32 port, SInt32 queue_length)
{
  Disconnect();
  stream_ = FirstThat(Find(nullptr, port),
                      [&](int stream, const ::addrinfo& address)
                      {
                        const int yes = 1;
                        ::setsockopt(stream, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
                        return ::bind(stream, address.ai_addr, address.ai_addrlen) == 0 &&
                               ::listen(stream, queue_length) == 0;
                      });
  if (stream_ == -1) Refuse("no program can listen at port " + std::to_string(port), std::strerror(errno));
  int accepted = -1;
  do accepted = ::accept4(stream_, nullptr, nullptr, SOCK_CLOEXEC);
  while (accepted == -1 && errno == EINTR);
  if (accepted == -1) Refuse("no connection was accepted at port " + std::to_string(port), std::strerror(errno));
  client.Disconnect();
  client.stream_ = accepted;
}

void CTCPSocket::Disconnect()
{
  if (stream_ != -1) ::close(stream_);
  stream_ = -1;
}

void CTCPSocket::SendBuffer(const UInt8* bytes, size_t size)
{
  while (size > 0)
  {
    const ssize_t sent = ::send(stream_, bytes, size, MSG_NOSIGNAL);
    if (sent == -1 && errno == EINTR) continue;
    if (sent == -1) Refuse(std::to_string(size) + " bytes cannot be sent", std::strerror(errno));
    bytes += sent;
    size -= static_cast<size_t>(sent);
  }
}

bool CTCPSocket::ReceiveBuffer(UInt8* bytes, size_t size)
{
  while (size > 0)
  {
    const ssize_t received = ::recv(stream_, bytes, size, 0);
    if (received == -1 && errno == EINTR) continue;
    if (received == -1) Refuse(std::to_string(size) + " bytes cannot be received", std::strerror(errno));
    if (received == 0) return false;
    bytes += received;
    size -= static_cast<size_t>(received);
  }
  return true;
}

void CTCPSocket::SendByteArray(const CByteArray& bytes)
{
  CByteArray length;
  length << static_cast<UInt32>(bytes.Size());
  SendBuffer(length.ToCArray(), length.Size());
  SendBuffer(bytes.ToCArray(), bytes.Size());
}

bool CTCPSocket::ReceiveByteArray(CByteArray& bytes)
{
  CByteArray length(sizeof(UInt32));
  if (!ReceiveBuffer(length.ToCArray(), length.Size())) return false;
  bytes.Resize(length.PopFront<UInt32>());
  return ReceiveBuffer(bytes.ToCArray(), bytes.Size());
}

}  // namespace argos
