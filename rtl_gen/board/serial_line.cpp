#include "rtl_gen/board/serial_line.hpp"

#include <fmt/format.h>

namespace hitpipe::rtl {

std::string serial_line(const std::string& prefix) {
  return fmt::format(
      R"(
// Receives bytes. A byte without its stop bit is dropped.
module {0}_rx #(
  parameter [15:0] CLOCKS_PER_BIT = 16'd12
) (
  input  wire clk,
  input  wire rst,
  input  wire line,
  output reg  valid,  // for one cycle
  output reg  [7:0] data
);
  localparam [15:0] WHOLE = CLOCKS_PER_BIT - 16'd1;
  localparam [15:0] HALF = (CLOCKS_PER_BIT >> 1) - 16'd1;

  reg [1:0] seen;  // the line changes at any time: two registers bring it to the clock
  wire level = seen[1];
  reg idle_seen;   // the line was high since the last byte
  reg receiving;
  reg [3:0] place;
  reg [15:0] ticks;
  always @(posedge clk) begin
    seen <= {{seen[0], line}};
    valid <= 1'b0;
    if (rst) begin
      idle_seen <= 1'b0;
      receiving <= 1'b0;
    end else if (~receiving) begin
      if (level) idle_seen <= 1'b1;
      else if (idle_seen) begin
        idle_seen <= 1'b0;
        receiving <= 1'b1;
        place <= 4'd0;
        ticks <= HALF;
      end
    end else if (ticks != 16'd0) ticks <= ticks - 16'd1;
    else begin
      ticks <= WHOLE;
      place <= place + 4'd1;
      if (place == 4'd0) begin
        if (level) receiving <= 1'b0;  // no start bit, a glitch
      end else if (place == 4'd9) begin
        receiving <= 1'b0;
        valid <= level;
      end else data <= {{level, data[7:1]}};
    end
  end
endmodule

// Sends bytes. One is taken at an edge with valid and ready high.
module {0}_tx #(
  parameter [15:0] CLOCKS_PER_BIT = 16'd12
) (
  input  wire clk,
  input  wire rst,
  input  wire valid,
  output wire ready,
  input  wire [7:0] data,
  output wire line
);
  localparam [15:0] WHOLE = CLOCKS_PER_BIT - 16'd1;

  reg [8:0] bits;  // on the line is the lowest
  reg [3:0] left;  // bits that have not ended, with start and stop
  reg [15:0] ticks;
  assign ready = left == 4'd0;
  assign line = bits[0];
  always @(posedge clk) begin
    if (rst) begin
      bits <= 9'h1ff;
      left <= 4'd0;
    end else if (ready) begin
      if (valid) begin
        bits <= {{data, 1'b0}};
        left <= 4'd10;
        ticks <= WHOLE;
      end
    end else if (ticks != 16'd0) ticks <= ticks - 16'd1;
    else begin
      bits <= {{1'b1, bits[8:1]}};
      left <= left - 4'd1;
      ticks <= WHOLE;
    end
  end
endmodule
)",
      prefix);
}

}  // namespace hitpipe::rtl
