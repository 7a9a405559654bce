// Files that the run reads and files that it was told to write. They are compared before the work begins,
// whatever names lead to them, so that nothing is lost and nobody waits for a result that cannot be written.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hitpipe::host {

/// The run reads this file, so no PendingFile takes its place. "-" is standard input. What is no regular file
/// is ignored. Throws std::runtime_error if an output was announced that would replace it.
void never_replace(const std::string& file);

/// The files that the run reads, as they were named to never_replace().
[[nodiscard]] std::vector<std::string> inputs();

/// The run will write this file, as this option says. Throws std::runtime_error, naming file and reason, if
/// it cannot be written, if it is an input, or if another option names it too. Makes nothing. "-" is standard
/// output and may be announced by anyone.
void announce_output(std::string_view option, const std::filesystem::path& file);

/// The run will write files to this folder. Throws std::runtime_error, naming folder and reason, if it
/// cannot. Makes nothing.
void announce_output_folder(const std::filesystem::path& folder);

/// Throws std::runtime_error if a file may not take this place: it is a folder, a device such as /dev/null or
/// an input.
void check_replaceable(const std::filesystem::path& place);

}  // namespace hitpipe::host
