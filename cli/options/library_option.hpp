// The option that chooses a component library.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace hitpipe::cli {

/// --library. `library` holds the default; rtl::library_called() reads it.
void add_library_option(CLI::App& command, std::string& library);

}  // namespace hitpipe::cli
