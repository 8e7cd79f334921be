// FFmpeg encodes each picture while the caller waits, with two threads. Time stamps are in milliseconds of simulated
// time and always increase, since containers refuse equal ones: a picture that would come at the same millisecond is
// moved to the next one. Colours are converted to BT.709, as players assume for films of this size. Width and height
// are rounded down to even numbers, because the colours of four pixels share a value. A GIF has a palette instead, and
// counts time in hundredths of a second.
#include "visualiser/image/video_writer.h"

extern "C"
{
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "visualiser/scene/colour_palette.h"

namespace swarmanoid
{
namespace
{

constexpr AVRational kMilliseconds{1, 1000};

}  // namespace

struct VideoWriter::State
{
  std::string path;
  AVFormatContext* container = nullptr;
  AVCodecContext* encoder = nullptr;
  AVStream* stream = nullptr;
  AVFrame* frame = nullptr;
  AVPacket* packet = nullptr;
  SwsContext* converter = nullptr;
  std::unique_ptr<ColourPalette> palette;  // for GIF
  std::int64_t last = -1;
  std::int64_t duration = 40;  // ms: time of a picture
  bool open = false;

  ~State()
  {
    if (container != nullptr) avio_closep(&container->pb);
    sws_freeContext(converter);
    av_packet_free(&packet);
    av_frame_free(&frame);
    avcodec_free_context(&encoder);
    avformat_free_context(container);
  }

  [[noreturn]] void Fail(const std::string& what, int code = 0) const
  {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
    if (code != 0) av_strerror(code, text.data(), text.size());
    throw std::runtime_error("cannot write the video '" + path + "': " + what + (code != 0 ? ": " : "") + text.data());
  }
  void Check(int code, const char* what) const
  {
    if (code < 0) Fail(what, code);
  }

  void ChooseEncoder();
  void SetColours();
  void Convert(const Picture& picture);
  void Index(const Picture& picture);
  void Open(int width, int height, double seconds_per_picture);
  void Encode(const AVFrame* picture);
};

// H.264 and VP9 play everywhere. If FFmpeg was built without them, the container's default codec is used.
void VideoWriter::State::ChooseEncoder()
{
  const std::string format = container->oformat->name;
  const AVCodec* codec = avcodec_find_encoder_by_name(format == "webm" ? "libvpx-vp9" : "libx264");
  if (codec == nullptr || avformat_query_codec(container->oformat, codec->id, FF_COMPLIANCE_NORMAL) != 1)
    codec = avcodec_find_encoder(container->oformat->video_codec);
  if (codec == nullptr) Fail("FFmpeg has no video encoder for '" + format + "' files");
  encoder = avcodec_alloc_context3(codec);
}

void VideoWriter::State::SetColours()
{
  if (encoder->codec_id == AV_CODEC_ID_GIF)
  {
    encoder->pix_fmt = AV_PIX_FMT_PAL8;
    palette = std::make_unique<ColourPalette>();
    return;
  }
  encoder->pix_fmt = AV_PIX_FMT_YUV420P;
  encoder->color_primaries = AVCOL_PRI_BT709;
  encoder->color_trc = AVCOL_TRC_BT709;
  encoder->colorspace = AVCOL_SPC_BT709;
  encoder->color_range = AVCOL_RANGE_MPEG;
}

void VideoWriter::State::Open(int width, int height, double seconds_per_picture)
{
  av_log_set_level(AV_LOG_FATAL);
  avformat_alloc_output_context2(&container, nullptr, nullptr, path.c_str());
  // A format that opens files itself could write other files than this one.
  if (container == nullptr || (container->oformat->flags & AVFMT_NOFILE) != 0)
    Fail("its name must end in .mp4, .webm, .mkv or another ending of a video in one file");
  ChooseEncoder();
  duration = std::max<std::int64_t>(1, std::llround(1000 * seconds_per_picture));
  encoder->width = width & ~1;
  encoder->height = height & ~1;
  encoder->time_base = kMilliseconds;
  encoder->framerate = {1000, static_cast<int>(duration)};
  SetColours();
  encoder->gop_size = 50;
  encoder->thread_count = 2;
  if ((container->oformat->flags & AVFMT_GLOBALHEADER) != 0) encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  const std::string name = encoder->codec->name;
  if (name == "libx264")
  {
    av_opt_set(encoder->priv_data, "preset", "veryfast", 0);
    av_opt_set(encoder->priv_data, "crf", "20", 0);
  }
  else if (name == "libvpx-vp9")
  {
    encoder->bit_rate = 0;
    av_opt_set(encoder->priv_data, "crf", "28", 0);
    av_opt_set(encoder->priv_data, "deadline", "realtime", 0);
    av_opt_set(encoder->priv_data, "cpu-used", "7", 0);
    av_opt_set(encoder->priv_data, "row-mt", "1", 0);
  }
  else
    encoder->bit_rate = 4'000'000;
  Check(avcodec_open2(encoder, encoder->codec, nullptr), "the encoder does not start");

  stream = avformat_new_stream(container, nullptr);
  if (stream == nullptr) Fail("no memory");
  stream->time_base = kMilliseconds;
  stream->avg_frame_rate = encoder->framerate;
  Check(avcodec_parameters_from_context(stream->codecpar, encoder), "the encoder does not fit the file");
  Check(avio_open(&container->pb, ("file:" + path).c_str(), AVIO_FLAG_WRITE), "it cannot be opened");
  Check(avformat_write_header(container, nullptr), "its header cannot be written");

  frame = av_frame_alloc();
  packet = av_packet_alloc();
  if (frame == nullptr || packet == nullptr) Fail("no memory");
  frame->format = encoder->pix_fmt;
  frame->width = encoder->width;
  frame->height = encoder->height;
  Check(av_frame_get_buffer(frame, 0), "no memory");
  open = true;
}

void VideoWriter::State::Convert(const Picture& picture)
{
  if (converter == nullptr)
  {
    converter = sws_getContext(picture.width, picture.height, AV_PIX_FMT_RGB0, encoder->width, encoder->height,
                               AV_PIX_FMT_YUV420P, SWS_BILINEAR, nullptr, nullptr, nullptr);
    if (converter == nullptr) Fail("its pictures cannot be converted");
    const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
    sws_setColorspaceDetails(converter, bt709, 1, bt709, 0, 0, 1 << 16, 1 << 16);
  }
  const std::array<const std::uint8_t*, 1> rows{picture.pixels.data()};
  const std::array<int, 1> strides{4 * picture.width};
  sws_scale(converter, rows.data(), strides.data(), 0, picture.height, frame->data, frame->linesize);
}

void VideoWriter::State::Index(const Picture& picture)
{
  palette->Suit(picture);
  std::memcpy(frame->data[1], palette->Colours().data(), sizeof palette->Colours());
  for (int y = 0; y < encoder->height; ++y)
    for (int x = 0; x < encoder->width; ++x)
    {
      const std::uint8_t* pixel = picture.At(x, y);
      frame->data[0][y * frame->linesize[0] + x] = palette->Number(pixel[0], pixel[1], pixel[2]);
    }
}

void VideoWriter::State::Encode(const AVFrame* picture)
{
  Check(avcodec_send_frame(encoder, picture), "a picture cannot be encoded");
  while (true)
  {
    const int code = avcodec_receive_packet(encoder, packet);
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
    Check(code, "a picture cannot be encoded");
    if (packet->duration == 0) packet->duration = duration;
    av_packet_rescale_ts(packet, kMilliseconds, stream->time_base);
    packet->stream_index = stream->index;
    Check(av_interleaved_write_frame(container, packet), "it cannot be written");
  }
}

VideoWriter::VideoWriter(const std::string& path, int width, int height, double seconds_per_picture)
    : state_(std::make_unique<State>())
{
  state_->path = path;
  state_->Open(width, height, seconds_per_picture);
}

VideoWriter::~VideoWriter()
{
  try
  {
    Finish();
  }
  catch (const std::runtime_error&)
  {
    // A destructor has no caller that could handle the error.
  }
}

void VideoWriter::Add(const Picture& picture, double time)
{
  State& state = *state_;
  state.Check(av_frame_make_writable(state.frame), "no memory");
  if (state.palette)
    state.Index(picture);
  else
    state.Convert(picture);
  state.last = std::max<std::int64_t>(state.last + 1, std::llround(1000 * time));
  state.frame->pts = state.last;
  state.Encode(state.frame);
}

void VideoWriter::Finish()
{
  State& state = *state_;
  if (!state.open) return;
  state.open = false;
  state.Encode(nullptr);
  state.Check(av_write_trailer(state.container), "its end cannot be written");
}

}  // namespace swarmanoid
