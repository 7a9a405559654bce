#include "rtl_gen/emit/testbench.hpp"

#include <random>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::rtl {

namespace {

std::int64_t fit(std::uint64_t bits, const Port& port) {
  const int spare = 64 - port.width;
  const std::uint64_t high = bits << spare;
  return port.is_signed ? static_cast<std::int64_t>(high) >> spare : static_cast<std::int64_t>(high >> spare);
}

/// Most significant bit first.
std::string binary(std::int64_t value, int width) {
  std::string text;
  for (int i = width - 1; i >= 0; --i) text += (value >> i & 1) != 0 ? '1' : '0';
  return text;
}

std::string hexadecimal(std::string bits) {
  while (bits.size() % 4 != 0) bits.insert(bits.begin(), '0');
  std::string text;
  for (std::size_t i = 0; i < bits.size(); i += 4)
    text += fmt::format("{:x}", std::stoi(bits.substr(i, 4), nullptr, 2));
  return text;
}

/// The bits of a word, or its only bit.
std::string part_of(const char* word, int high, int low) {
  return high == low ? fmt::format("{}[{}]", word, low) : fmt::format("{}[{}:{}]", word, high, low);
}

/// The bits of each port in a word that holds them all, the last port lowest.
std::vector<std::string> fields(const char* word, const std::vector<Port>& ports, int width) {
  std::vector<std::string> all;
  for (const Port& port : ports) {
    all.push_back(part_of(word, width - 1, width - port.width));
    width -= port.width;
  }
  return all;
}

int total_width(const std::vector<Port>& ports) {
  int width = 0;
  for (const Port& p : ports) width += p.width;
  return width;
}

/// What the testbench's text has for each result.
struct ResultText {
  ResultText(const std::vector<hls::Result>& results, const char* word) {
    const std::vector<Port> ports = result_ports(results);
    const std::vector<std::string> expected = fields(word, ports, total_width(ports));
    for (std::size_t i = 0; i < ports.size(); ++i) {
      const std::string& name = ports[i].name;
      if (ports[i].width == 1) {
        bits += ", " + name;
      } else {
        wires += fmt::format("  wire [{}:0] {};\n", ports[i].width - 1, name);
      }
      connections.push_back(fmt::format("    .{0}({0})", name));
      differences.push_back(fmt::format("{} !== {}", name, expected[i]));
      formats += fmt::format("{} %b, expected %b, ", name);
      values += fmt::format("{}, {}, ", name, expected[i]);
    }
  }

  std::string bits;   ///< declared beside other wires of one bit
  std::string wires;  ///< declarations of wider ones
  std::vector<std::string> connections, differences;
  std::string formats, values;  ///< to print what differs
};

}  // namespace

std::vector<std::vector<std::int64_t>> operand_vectors(const std::vector<Port>& ports, int count,
                                                       std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::vector<std::int64_t>> vectors;
  // Corners as bit patterns: zero, one, minus one, most and least, alternating; each port draws its own.
  const std::vector<std::uint64_t> corners{
      0, 1, ~std::uint64_t{0}, ~std::uint64_t{0} >> 1, std::uint64_t{1} << 63, 0x5555555555555555U};
  for (int i = 0; i < count; ++i) {
    std::vector<std::int64_t> operands;
    for (const Port& port : ports) {
      std::uint64_t bits = random();
      if (i % 4 == 0) {
        const std::uint64_t corner = corners[bits % corners.size()];
        // Extremes sit at the top of the port's own width.
        bits = corner > 1 && corner != ~std::uint64_t{0} ? corner >> (64 - port.width) : corner;
      } else if (i % 4 == 1) {
        bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(bits) >> (64 - 4));  // close to zero
      }
      operands.push_back(fit(bits, port));
    }
    vectors.push_back(std::move(operands));
  }
  return vectors;
}

std::vector<Vector> judged(std::vector<std::vector<std::int64_t>> operands, const Evaluate& evaluate) {
  std::vector<Vector> vectors;
  for (std::vector<std::int64_t>& each : operands) vectors.push_back(judged(std::move(each), evaluate));
  return vectors;
}

std::string vector_file(const std::vector<Port>& ports, const std::vector<Port>& left,
                        const std::vector<hls::Result>& results, const std::vector<Vector>& vectors) {
  std::vector<std::size_t> places;
  for (const Port& port : left) places.push_back(index_of(ports, port.name));
  std::string text;
  for (const Vector& vector : vectors) {
    std::string bits;
    for (std::size_t i = 0; i < left.size(); ++i) bits += binary(vector.operands[places[i]], left[i].width);
    for (std::size_t i = 0; i < results.size(); ++i) bits += binary(vector.results[i], results[i].width);
    text += hexadecimal(std::move(bits)) + "\n";
  }
  return text;
}

std::string testbench(const std::string& module, const std::vector<Port>& ports,
                      const std::vector<hls::Result>& results, int count) {
  const int width = total_width(ports) + total_width(result_ports(results));
  const std::vector<std::string> operands = fields("operands", ports, width);
  std::string connections;
  for (std::size_t i = 0; i < ports.size(); ++i)
    connections += fmt::format("    .{}({}),\n", ports[i].name, operands[i]);
  const ResultText result(results, "expected");
  return fmt::format(R"(// Replays {1} against {0}.v with random gaps and stalls.
//   iverilog -g2001 -o tb {0}_tb.v ../{0}.v && vvp tb
module {0}_tb;
  localparam COUNT = {2};
  reg [{3}:0] vectors [0:COUNT-1];
  reg clk, rst, in_valid, out_ready;
  reg [15:0] sent, received;
  integer seed, errors, cycles;
  wire in_ready, out_valid{5};
{6}  wire [15:0] out_tag;
  wire [{3}:0] operands = vectors[sent];
  wire [{3}:0] expected = vectors[received];

  {0} #(.TAG_BITS(16)) dut (
    .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .in_tag(sent),
    .out_valid(out_valid), .out_ready(out_ready), .out_tag(out_tag),
{4}{7}
  );

  always #5 clk = ~clk;

  // Values change at the falling edge; handshakes are seen as they stand before the rising one.
  initial begin
    $readmemh("{1}", vectors);
    clk = 1'b0; rst = 1'b1; in_valid = 1'b0; out_ready = 1'b0;
    sent = 16'd0; received = 16'd0; seed = 1; errors = 0; cycles = 0;
    // Unread vectors would agree with themselves.
    if (^{{vectors[0], vectors[COUNT-1]}} === 1'bx) begin
      $display("FAIL {1}: not there, or not of %0d vectors", COUNT);
      errors = 1;
    end
    repeat (4) @(negedge clk);
    rst = 1'b0;
    while (received != COUNT && errors == 0 && cycles < 16 * COUNT + 1000) begin
      in_valid = sent != COUNT && ($random(seed) & 3) != 0;
      out_ready = ($random(seed) & 3) != 0;
      #1;
      if (out_valid && out_ready) begin
        if ({8} || out_tag !== received) begin
          $display("FAIL vector %0d (%h): {9}tag %0d", received, expected, {10}out_tag);
          errors = errors + 1;
        end
        received = received + 16'd1;
      end
      if (in_valid && in_ready) begin
        @(posedge clk);
        #1 sent = sent + 16'd1;
      end
      @(negedge clk);
      cycles = cycles + 1;
    end
    if (errors == 0 && received == COUNT) $display("PASS %0d vectors", received);
    else if (errors == 0) $display("FAIL %0d of %0d vectors came back", received, COUNT);
    $finish;
  end
endmodule
)",
                     module, module + "_vectors.hex", count, width - 1, connections, result.bits,
                     result.wires, fmt::join(result.connections, ",\n"),
                     fmt::join(result.differences, " || "), result.formats, result.values);
}

}  // namespace hitpipe::rtl
