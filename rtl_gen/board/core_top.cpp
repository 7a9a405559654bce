#include "rtl_gen/board/core_top.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hls/machines/scene_memory.hpp"
#include "host/text.hpp"
#include "rtl_gen/board/frame_text.hpp"
#include "rtl_gen/board/serial_line.hpp"
#include "rtl_gen/board/top.hpp"
#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/machine/module.hpp"

namespace hitpipe::rtl {

namespace {

constexpr int board_tag_bits = 8;
constexpr int number_bytes = 2;  // of a word or a block
constexpr int word_bytes = 8;

/// With the names that they have at the core.
std::vector<Port> named(std::vector<Port> ports, std::string_view before) {
  for (Port& port : ports) port.name.insert(0, before);
  return ports;
}

int width_of_pin(const Core& core, std::string_view name) {
  const auto found = std::find_if(core.ports.begin(), core.ports.end(),
                                  [&](const CorePort& port) { return port.pin.name == name; });
  return found->pin.width;
}

/// What is done with a frame that has come. A word of the image has left `operands` long before the next
/// frame's bytes come.
constexpr const char* taking_frames = R"(  reg offered;  // a ray, until the core takes it
  reg storing;  // a word of the image, until the memory takes it
  reg [{0}:0] last;
  wire word_ready;
  wire ray_ready;
  wire asked = (who | word | ending) & ~sending;
  always @(posedge clk) begin
    if (rst) begin
      offered <= 1'b0;
      storing <= 1'b0;
      last <= {1}'d0;
    end else begin
      if (ray) offered <= 1'b1;
      else if (ray_ready) offered <= 1'b0;
      if (word & ~sending) storing <= 1'b1;
      else if (word_ready) storing <= 1'b0;
      if (ending & ~sending) last <= {2};
    end
  end
)";

/// {0}: the fields of a hit, and zeros above.
constexpr const char* beginning_of_core = R"(    if (rst) sending <= 1'b0;
    else if (asked) begin
      sending <= 1'b1;
      about_who <= is_who;
      about_hit <= 1'b0;
      about_word <= is_word;
      answer_tag <= tag;
    end else if (hit_valid & ~sending) begin
      sending <= 1'b1;
      about_who <= 1'b0;
      about_hit <= 1'b1;
      answer_tag <= hit_tag;
      answer <= {0};
)";

/// An instance whose pins have wires of their names, but for some.
std::string instance_of(const ModuleInterface& inside, const std::string& name,
                        const std::map<std::string, std::string, std::less<>>& others) {
  std::vector<std::string> list;
  for (const Pin& pin : inside.pins) {
    const auto found = others.find(pin.name);
    list.push_back(fmt::format("    .{}({})", pin.name, found == others.end() ? pin.name : found->second));
  }
  return fmt::format("  {} {} (\n{}\n  );\n", inside.module, name, fmt::join(list, ",\n"));
}

}  // namespace

std::vector<Port> board_ray_ports(const Core& core) {
  return named(records_of(core).ray.ports, "ray_");
}
std::vector<Port> board_hit_ports(const Core& core) {
  return named(records_of(core).hit.ports, "hit_");
}

std::string core_identity(const Core& core) {
  const CoreOptions& options = core.options;
  std::string text = fmt::format("{} rays, stack of 2^{}, {} levels, 2^{} blocks\n", options.rays,
                                 options.stack_bits, options.levels, options.address_bits);
  for (const auto& each : {board_ray_ports(core), board_hit_ports(core)}) {
    for (const Port& port : each)
      text += fmt::format("{} {} {}\n", port.name, port.width, port.is_signed ? "signed" : "unsigned");
  }
  return fmt::format("hitpipe {} core {} {:016x}", board_protocol, to_string(Format(options.bits)),
                     host::fnv1a(std::as_bytes(std::span(text))));
}

int rays_on_their_way(const Core& core) {
  return core.options.rays + 1;
}

std::size_t board_blocks(const Core& core) {
  return std::size_t{1} << core.options.address_bits;
}

std::string core_board_top(const Core& core, int clocks_per_bit) {
  const CoreOptions& options = core.options;
  if (!core.place_of(hls::channels::ray_error) || options.tag_bits != board_tag_bits ||
      options.byte_bits != options.address_bits + 5)
    throw std::logic_error("a core on a board takes integers, tags of eight bits and blocks of its memory");
  const std::vector<Port> fields = board_ray_ports(core), hit = board_hit_ports(core);
  const int ray_bytes = packed_bytes(fields), hit_bytes = packed_bytes(hit);
  const int hit_bits = total_width(hit);
  const int operand_bytes = std::max(ray_bytes, number_bytes + word_bytes);
  const std::string identity = core_identity(core);
  const int text_bytes = static_cast<int>(identity.size());
  const std::string module = board_module(core.module), serial = module + "_serial";
  const int place_bits = place_bits_of(std::max(text_bytes, hit_bytes));
  const auto at = [&](int n) { return decimal(place_bits, n); };
  // A body's last byte is the uppermost of the operands.
  const auto operand = [&](int from_end, int low, int width) {
    const int first = 8 * (operand_bytes - from_end) + low;
    return fmt::format("operands[{}:{}]", first + width - 1, first);
  };

  ReceiverText receiver{.serial = serial,
                        .kinds = {{"ray", 'T', ray_bytes},
                                  {"word", 'M', number_bytes + word_bytes},
                                  {"ending", 'S', number_bytes},
                                  {"who", 'I', 0}},
                        .body_bytes = operand_bytes,
                        .taking = fmt::format(taking_frames, options.address_bits - 1, options.address_bits,
                                              operand(number_bytes, 0, options.address_bits)),
                        .held = "offered"};
  const int count_bits = count_bits_of(receiver);
  receiver.body_end =
      fmt::format("(is_ray ? {} : is_word ? {} : {})", decimal(count_bits, ray_bytes + 2),
                  decimal(count_bits, number_bytes + word_bytes + 2), decimal(count_bits, number_bytes + 2));
  std::vector<std::string> hit_names;
  for (const Port& port : hit) hit_names.insert(hit_names.begin(), port.name);
  if (8 * hit_bytes > hit_bits) hit_names.insert(hit_names.begin(), decimal(8 * hit_bytes - hit_bits, 0));
  const SenderText sender{
      .serial = serial,
      .place_bits = place_bits,
      .answer_bytes = hit_bytes,
      .registers = "  reg about_hit;\n  reg about_word;\n",
      .body_end =
          fmt::format("about_who ? {} : about_hit ? {} : {}", at(3 + text_bytes), at(3 + hit_bytes), at(3)),
      .kind = R"(about_who ? "I" : about_hit ? "T" : about_word ? "M" : "S")",
      .beginning = fmt::format(beginning_of_core, fmt::format("{{{}}}", fmt::join(hit_names, ", ")))};

  const Format memory_bits = hls::SceneMemoryBits{options.address_bits, options.ray_bits()};
  const MachineGraph memory = machine_called("scene_memory")->graph(memory_bits);
  const std::string memory_module = module + "_memory";
  const ModuleInterface memory_interface = machine_interface(memory_module, memory);
  const int word_place = number_bytes + word_bytes;
  std::map<std::string, std::string, std::less<>> pins{
      {"ray_valid", "offered"},
      {"ray_tag", "tag"},
      {"hit_ready", "(~sending & ~asked)"},
      {"base", decimal(width_of_pin(core, "base"), 0)},
      {"most_steps", fmt::format("{{{}{{1'b1}}}}", width_of_pin(core, "most_steps"))},
      {"most_rays", decimal(width_of_pin(core, "most_rays"), options.rays)},
      {"word_valid", "storing"},
      {"word_place", operand(word_place, 0, options.address_bits + 2)},
      {"word", operand(word_bytes, 0, 8 * word_bytes)}};
  const std::vector<std::string> bits = fields_of_word(fields, "operands", 8 * (operand_bytes - ray_bytes));
  for (std::size_t i = 0; i < fields.size(); ++i) pins[fields[i].name] = bits[i];

  std::string wires = "  reg sending;  // an answer\n  wire hit_valid;\n  wire [7:0] hit_tag;\n";
  for (const Port& port : hit) wires += fmt::format("  wire {}{};\n", vector_range(port.width), port.name);
  using namespace hls::channels;
  for (const std::string_view name : field_names<hls::Join<Request, Request::Back, BlockRead>>)
    wires += fmt::format("  wire {}{};\n", vector_range(width_of_pin(core, name)), name);

  return fmt::format(
             R"(// {0} as the whole of a chip, on a serial line: an image and rays come in frames, hits go back. docs/chips.md
// of hitpipe describes the bytes. The red lamp is lit after a frame that was damaged or not taken, the green
// one after the first answer; the button resets.
// Generated by hitpipe; do not edit.
)",
             core.module) +
         top_opening(module, clocks_per_bit, identity, place_bits) + wires + receiver_text(receiver) +
         sender_text(sender) + "\n" + instance_of(memory_interface, "memory", pins) +
         instance_of(core.interface(), "core_i", pins) + "\n" +
         lamps_text(
             fmt::format("byte_valid & flag & (count != {}) & ~ray & ~asked", decimal(count_bits, 0))) +
         fmt::format("  wire unused = &{{1'b0, operands}};  // padding\nendmodule\n") + serial_line(serial) +
         "\n" + to_verilog(memory, {.module = memory_module, .bits = to_string(memory_bits)});
}

}  // namespace hitpipe::rtl
