// How much the program says on standard error beside errors.
#pragma once

#include <string>

namespace hitpipe::host {

/// Errors alone; progress and notes too; steps and programs that are started too.
enum class Talk { quiet, usual, verbose };

/// Before threads are started.
void set_talk(Talk talk);
[[nodiscard]] Talk talk();

/// "hitpipe: TEXT", a line that is no error, unless the program is quiet. On a terminal it takes the place of
/// the progress, which may be there.
void note(const std::string& text);

/// The same for a step, if the program is verbose.
void note_step(const std::string& text);

}  // namespace hitpipe::host
