extern "C"
{
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <array>
#include <stdexcept>

#include "tests/unit/visualiser/video_reader.h"

namespace swarmanoid
{
namespace
{

struct Decoder
{
  AVFormatContext* container = nullptr;
  AVCodecContext* codec = nullptr;
  AVFrame* frame = av_frame_alloc();
  AVPacket* packet = av_packet_alloc();

  ~Decoder()
  {
    av_packet_free(&packet);
    av_frame_free(&frame);
    avcodec_free_context(&codec);
    avformat_close_input(&container);
  }
};

Picture PictureOf(const AVFrame& frame)
{
  Picture picture{frame.width, frame.height, {}};
  picture.pixels.resize(4 * static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
  SwsContext* converter =
      sws_getContext(frame.width, frame.height, static_cast<AVPixelFormat>(frame.format), frame.width, frame.height,
                     AV_PIX_FMT_RGB0, SWS_BILINEAR, nullptr, nullptr, nullptr);
  const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
  sws_setColorspaceDetails(converter, bt709, 0, bt709, 1, 0, 1 << 16, 1 << 16);
  const std::array<std::uint8_t*, 1> rows{picture.pixels.data()};
  const std::array<int, 1> strides{4 * frame.width};
  sws_scale(converter, frame.data, frame.linesize, 0, frame.height, rows.data(), strides.data());
  sws_freeContext(converter);
  return picture;
}

}  // namespace

bool HasVideo() { return true; }

VideoContents ReadVideo(const std::string& path)
{
  const auto check = [&](bool right, const char* what)
  {
    if (!right) throw std::runtime_error("cannot read the video '" + path + "': " + what);
  };
  Decoder decoder;
  av_log_set_level(AV_LOG_FATAL);
  check(avformat_open_input(&decoder.container, path.c_str(), nullptr, nullptr) == 0, "it cannot be opened");
  check(avformat_find_stream_info(decoder.container, nullptr) >= 0, "it holds no stream");
  const AVCodec* codec = nullptr;
  const int number = av_find_best_stream(decoder.container, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
  check(number >= 0, "it holds no video");
  const AVStream& stream = *decoder.container->streams[number];
  decoder.codec = avcodec_alloc_context3(codec);
  check(avcodec_parameters_to_context(decoder.codec, stream.codecpar) >= 0 &&
            avcodec_open2(decoder.codec, codec, nullptr) >= 0,
        "its codec cannot be opened");

  VideoContents contents;
  contents.width = decoder.codec->width;
  contents.height = decoder.codec->height;
  contents.codec = codec->name;
  double start = 0;
  const auto receive = [&]
  {
    while (avcodec_receive_frame(decoder.codec, decoder.frame) >= 0)
    {
      const double time = static_cast<double>(decoder.frame->pts) * av_q2d(stream.time_base);
      if (contents.pictures == 0)
      {
        start = time;
        contents.first = PictureOf(*decoder.frame);
      }
      contents.last = PictureOf(*decoder.frame);
      contents.seconds = time - start;
      ++contents.pictures;
    }
  };
  while (av_read_frame(decoder.container, decoder.packet) >= 0)
  {
    if (decoder.packet->stream_index == number && avcodec_send_packet(decoder.codec, decoder.packet) >= 0) receive();
    av_packet_unref(decoder.packet);
  }
  avcodec_send_packet(decoder.codec, nullptr);
  receive();
  return contents;
}

}  // namespace swarmanoid
