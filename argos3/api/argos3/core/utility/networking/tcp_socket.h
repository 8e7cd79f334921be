// CTCPSocket: a connection to another program. The behaviour of a simulated controller that uses it cannot be repeated.
#pragma once

#include <argos3/core/utility/datatypes/byte_array.h>

namespace argos
{

class CTCPSocket
{
public:
  // `stream` is a connected socket, which is closed at the end.
  explicit CTCPSocket(int stream = -1) : stream_(stream) {}
  ~CTCPSocket() { Disconnect(); }
  CTCPSocket(const CTCPSocket&) = delete;
  CTCPSocket& operator=(const CTCPSocket&) = delete;

  bool IsConnected() const { return stream_ != -1; }
  int GetStream() const { return stream_; }
  // All functions below throw CARGoSException if a system call fails.
  void Connect(const std::string& host, SInt32 port);
  // Listens at the port and waits for the first connection; `client` becomes its end here.
  void Accept(CTCPSocket& client, SInt32 port, SInt32 queue_length = 10);
  void Disconnect();
  void SendBuffer(const UInt8* bytes, size_t size);
  // Waits until all bytes have come. Returns false if the other end closes before.
  bool ReceiveBuffer(UInt8* bytes, size_t size);
  // Sends the bytes after their length, a UInt32 in network order.
  void SendByteArray(const CByteArray& bytes);
  bool ReceiveByteArray(CByteArray& bytes);

private:
  int stream_;
};

}  // namespace argos
