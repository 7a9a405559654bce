#include "rtl_gen/component/chip.hpp"

#include "rtl_gen/component/json_entry.hpp"

namespace hitpipe::rtl {

namespace {

constexpr Limits lut_inputs_limits{2, 16};
constexpr Limits block_width_limits{2, 64};
constexpr Limits percent_limits{0, 1000};
constexpr Limits bit_delay_limits{0, 100'000};
constexpr Limits luts_limits{0, 1'000'000};

Block block_from(const FileJson& json, const std::string& where) {
  Block block{.name = line_of_text(json, "name", where),
              .width_a = count_of(json, "width_a", where, block_width_limits),
              .width_b = count_of(json, "width_b", where, block_width_limits),
              .reads_unsigned = truth_of(json, "reads_unsigned", where),
              .operand_registers = truth_of(json, "operand_registers", where),
              .product_registers = truth_of(json, "product_registers", where),
              .stages = count_of(json, "stages", where, {1, stages_limits.most}),
              .delay_ps = count_of(json, "delay_ps", where, delay_limits),
              .luts = count_of(json, "luts", where, luts_limits)};
  if (block.width_a < block.width_b) {
    throw std::runtime_error(fmt::format("{}: \"width_a\" is {}, less than \"width_b\" of {}", where,
                                         block.width_a, block.width_b));
  }
  return block;
}

}  // namespace

bool Block::multiplies(int a, bool a_signed, int b, bool b_signed) const {
  const bool as_signed = a_signed || b_signed || !reads_unsigned;
  const int need_a = a + (as_signed && !a_signed ? 1 : 0);
  const int need_b = b + (as_signed && !b_signed ? 1 : 0);
  return std::max(need_a, need_b) <= width_a && std::min(need_a, need_b) <= width_b;
}

Chip chip_from(const nlohmann::json& json, std::string_view origin) {
  const std::string where = fmt::format("{}: chip", origin);
  const auto part = [&](const char* name) -> std::pair<const FileJson&, std::string> {
    return {required(json, name, where), fmt::format("{}: {}", where, name)};
  };
  const auto [latch, latch_where] = part("register");
  const auto [gate, gate_where] = part("gate");
  const auto [mux, mux_where] = part("mux2");
  const auto [carry, carry_where] = part("carry");
  Chip chip{.device = line_of_text(json, "device", where),
            .estimated = truth_of(json, "estimated", where),
            .lut_inputs = count_of(json, "lut_inputs", where, lut_inputs_limits),
            .register_delay_ps = count_of(latch, "delay_ps", latch_where, delay_limits),
            .gate_delay_ps = count_of(gate, "delay_ps", gate_where, delay_limits),
            .mux_delay_ps = count_of(mux, "delay_ps", mux_where, delay_limits),
            .carry_delay_ps = count_of(carry, "delay_ps", carry_where, delay_limits),
            .carry_delay_ps_per_bit = count_of(carry, "delay_ps_per_bit", carry_where, bit_delay_limits),
            .gate_luts_pct = count_of(gate, "luts_pct", gate_where, percent_limits),
            .mux_luts_pct = count_of(mux, "luts_pct", mux_where, percent_limits),
            .carry_luts_pct = count_of(carry, "luts_pct", carry_where, percent_limits),
            .block = std::nullopt};
  if (json.contains("block")) chip.block = block_from(json.at("block"), where + ": block");
  return chip;
}

}  // namespace hitpipe::rtl
