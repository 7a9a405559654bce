// The C++ of a core's harness, before the core's name and options are put into it. core_module stands for the name of
// its module. The options say what stands for RAY_FIELDS, IDS, SPOIL, ASKS_ANY, DOOR_... and WEIGHTS_....
#pragma once

#include <string_view>

namespace hitpipe::rtl {

/// What the registers say in each cycle, and who writes and reads them. It begins the program.
extern const std::string_view harness_registers;
/// In place of streams, of a core with rings.
extern const std::string_view harness_rings;
/// The core behind AXI, and a memory.
extern const std::string_view harness_system;
/// What sends rays, damages the system and resets it. It ends the program.
extern const std::string_view harness_host;

}  // namespace hitpipe::rtl
