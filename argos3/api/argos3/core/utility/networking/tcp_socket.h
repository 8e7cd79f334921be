// CTCPSocket: a connection to another program. What a controller of a simulation makes of it cannot be repeated.
#pragma once

#include <argos3/core/utility/datatypes/byte_array.h>

namespace argos
{

class CTCPSocket
{
public:
  // `stream`: a socket that is connected; it is closed at the end.
  explicit CTCPSocket(int stream = -1) : stream_(stream) {}
  ~CTCPSocket() { Disconnect(); }
  CTCPSocket(const CTCPSocket&) = delete;
  CTCPSocket& operator=(const CTCPSocket&) = delete;

  bool IsConnected() const { return stream_ != -1; }
  int GetStream() const { return stream_; }
  // All below throw CARGoSException for what the system refuses.
  void Connect(const std::string& host, SInt32 port);
  // Listens at the port and waits for the first one who connects: `client` is the other end.
  void Accept(CTCPSocket& client, SInt32 port, SInt32 queue_length = 10);
  void Disconnect();
  void SendBuffer(const UInt8* bytes, size_t size);
  // Waits until all are there. False if the other end is closed before.
  bool ReceiveBuffer(UInt8* bytes, size_t size);
  // With its length before it, as a UInt32 in network order.
  void SendByteArray(const CByteArray& bytes);
  bool ReceiveByteArray(CByteArray& bytes);

private:
  int stream_;
};

}  // namespace argos
