// One page that is connected to a WebServer: its waiting messages, and how they are sent. In the server's thread.
#pragma once

#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <utility>

#include "visualiser/web/page_stream.h"
#include "visualiser/web/web_server_impl.h"

namespace swarmanoid
{

namespace http = beast::http;
namespace websocket = beast::websocket;

class WebServer::Impl::Client final : public Droppable, public std::enable_shared_from_this<Client>
{
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kQueueLength = 512;
  // The buffer holds several frames of thousands of robots. A larger one would only add delay.
  static constexpr int kSocketBytes = 1 << 20;

public:
  enum class Place
  {
    kNone,  // all places are taken: it must prove the token soon
    kWatcher,
    kHolder  // it has proved the token
  };

  Client(Impl& server, PageStream stream, asio::ip::address from)
      : Droppable(server, std::move(from)),
        server_(server),
        stream_(std::move(stream)),
        pace_(server.context_),
        proof_(server.context_)
  {
  }

  void Run(http::request<http::empty_body> request)
  {
    request_ = std::move(request);
    ErrorCode ignored;
    auto& socket = beast::get_lowest_layer(stream_).socket();
    socket.set_option(tcp::no_delay(true), ignored);
    socket.set_option(asio::socket_base::send_buffer_size(kSocketBytes), ignored);
    beast::get_lowest_layer(stream_).expires_never();
    websocket::stream_base::timeout times = websocket::stream_base::timeout::suggested(beast::role_type::server);
    times.keep_alive_pings = true;
    times.idle_timeout = std::chrono::seconds(60);
    stream_.set_option(times);
    // Messages are sent whole, which halves the cost of sending.
    stream_.auto_fragment(false);
    stream_.write_buffer_bytes(65536);
    stream_.read_message_max(server_.settings_.max_message_bytes);
    stream_.async_accept(request_,
                         [self = shared_from_this()](ErrorCode error)
                         {
                           if (error) return self->Gone();
                           self->open_ = true;
                           self->server_.Join(self);
                           self->Read();
                           self->Write();
                         });
  }

  void Put(Slot slot, Bytes bytes)
  {
    if (slot == Slot::kKey) slots_[Index(Slot::kChange)] = nullptr;
    if (slot == Slot::kChange && frame_period_.count() > 0)
    {
      const auto now = Clock::now();
      if (now - frame_time_ < frame_period_) return;
      frame_time_ = now;
    }
    slots_[Index(slot)] = std::move(bytes);
    Write();
  }

  void Queue(Bytes text)
  {
    if (queue_.size() >= kQueueLength) queue_.pop_front();
    queue_.push_back(std::move(text));
    Write();
  }

  bool HasPlace() const { return place_ != Place::kNone; }
  void Take(Place place)
  {
    HoldPlace();
    proof_.cancel();
    if (place_ == Place::kWatcher) --server_.watchers_;
    if (place_ == Place::kHolder) --server_.holders_;
    place_ = place;
    if (place_ == Place::kWatcher) ++server_.watchers_;
    if (place_ == Place::kHolder) ++server_.holders_;
  }
  void WaitForProof()
  {
    GivePlace();
    proof_.expires_after(server_.settings_.proof_time);
    proof_.async_wait(
        [self = shared_from_this()](ErrorCode error)
        {
          if (error || self->HasPlace()) return;
          self->reason_ = {websocket::close_code::try_again_later, "as many pages look as may"};
          self->Close();
        });
  }
  void Drop() override { Gone(); }

  void SetFramePeriod(std::chrono::milliseconds period) { frame_period_ = period; }
  bool IsHungry() const
  {
    return HasPlace() && open_ && !writing_ && !slots_[Index(Slot::kKey)] && !slots_[Index(Slot::kChange)];
  }

  // Called when everything is sent.
  void Close()
  {
    closing_ = true;
    Write();
  }

  std::uint64_t id = 0;

private:
  void Read()
  {
    stream_.async_read(
        buffer_,
        [self = shared_from_this()](ErrorCode error, std::size_t)
        {
          if (error) return self->Gone();
          const auto data = self->buffer_.cdata();
          if (self->stream_.got_text())
            self->server_.events_.Received(self->id, {static_cast<const char*>(data.data()), data.size()});
          self->buffer_.consume(self->buffer_.size());
          self->ReadOn();
        });
  }

  // Limits the rate of reading; unread messages stay with the sender.
  void ReadOn()
  {
    const auto share = std::chrono::nanoseconds(std::chrono::seconds(1)) / server_.settings_.max_messages_per_second;
    const auto now = Clock::now();
    read_until_ = std::max(read_until_, now) + share;
    if (read_until_ <= now + std::chrono::seconds(1)) return Read();
    pace_.expires_at(read_until_ - std::chrono::seconds(1));
    pace_.async_wait(
        [self = shared_from_this()](ErrorCode)
        {
          if (!self->gone_) self->Read();
        });
  }

  void Write()
  {
    if (!open_ || writing_) return;
    bool binary = false;
    Bytes bytes = Next(binary);
    if (!bytes)
    {
      if (closing_) SendClose();
      return;
    }
    writing_ = true;
    stream_.binary(binary);
    const auto place = asio::buffer(*bytes);
    stream_.async_write(place,
                        [self = shared_from_this(), bytes](ErrorCode error, std::size_t)
                        {
                          self->writing_ = false;
                          if (error) return self->Gone();
                          self->Write();
                          self->server_.Count();
                        });
  }

  // Returns the next message to send: the queue first, then a key, then the other slots in turn.
  Bytes Next(bool& binary)
  {
    if (!queue_.empty())
    {
      Bytes bytes = std::move(queue_.front());
      queue_.pop_front();
      return bytes;
    }
    for (std::size_t i = 0; i < kSlots; ++i)
    {
      const std::size_t slot = slots_[Index(Slot::kKey)] ? Index(Slot::kKey) : (next_slot_ + i) % kSlots;
      if (!slots_[slot]) continue;
      next_slot_ = (slot + 1) % kSlots;
      binary = slot == Index(Slot::kKey) || slot == Index(Slot::kChange) || slot == Index(Slot::kPast) ||
               slot == Index(Slot::kDrawing);
      return std::exchange(slots_[slot], nullptr);
    }
    return nullptr;
  }

  void SendClose()
  {
    open_ = false;
    stream_.async_close(reason_, [self = shared_from_this()](ErrorCode) { self->Gone(); });
  }

  void Gone()
  {
    open_ = false;
    if (gone_) return;
    gone_ = true;
    Take(Place::kNone);
    server_.Gone(address);
    ErrorCode ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
    if (id != 0) server_.Leave(id);
  }

  Impl& server_;
  websocket::stream<PageStream> stream_;
  asio::steady_timer pace_;   // delays the reading of the next message
  asio::steady_timer proof_;  // limits the time of a client without a place until it proves the token
  Place place_ = Place::kNone;
  websocket::close_reason reason_ = websocket::close_code::going_away;
  Clock::time_point read_until_;
  http::request<http::empty_body> request_;
  beast::flat_buffer buffer_;
  std::deque<Bytes> queue_;
  std::array<Bytes, kSlots> slots_;
  std::size_t next_slot_ = 0;
  std::chrono::milliseconds frame_period_{0};
  Clock::time_point frame_time_;
  bool open_ = false;
  bool writing_ = false;
  bool closing_ = false;
  bool gone_ = false;
};

}  // namespace swarmanoid
