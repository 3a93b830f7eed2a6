// Events of EventPackets by the EVT3 decoder of event_camera_codecs; see check_codecs.py.
// stdin: u32 width, u32 height; per message u32 length and its bytes.
// stdout: per event u64 time (ns), u16 x, u16 y, u8 polarity.
#include <event_camera_codecs/event_processor.h>
#include <event_camera_codecs/evt3_decoder.h>

#include <cstdint>
#include <cstdio>
#include <vector>

struct Message
{
  std::vector<uint8_t> events;
  uint64_t time_base{0};
};

struct Printer : event_camera_codecs::EventProcessor
{
  void eventCD(uint64_t time, uint16_t x, uint16_t y, uint8_t polarity) override
  {
    fwrite(&time, 8, 1, stdout);
    fwrite(&x, 2, 1, stdout);
    fwrite(&y, 2, 1, stdout);
    fwrite(&polarity, 1, 1, stdout);
  }
  void eventExtTrigger(uint64_t, uint8_t, uint8_t) override {}
  void finished() override {}
  void rawData(const char *, size_t) override {}
};

int main()
{
  uint32_t width, height, length;
  if (fread(&width, 4, 1, stdin) != 1 || fread(&height, 4, 1, stdin) != 1) return 1;
  event_camera_codecs::evt3::Decoder<Message, Printer> decoder;
  event_camera_codecs::Decoder<Message, Printer> & base = decoder;
  base.setGeometry(width, height);
  Printer printer;
  while (fread(&length, 4, 1, stdin) == 1) {
    Message message;
    message.events.resize(length);
    if (fread(message.events.data(), 1, length, stdin) != length) return 1;
    base.decode(message, &printer);
  }
  return 0;
}
