// Temporary folders exist as long as their objects.
#include "host/scratch_folder.hpp"

#include <optional>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/environment.hpp"

namespace hitpipe::host {
namespace {

namespace fs = std::filesystem;
using testing::MatchesRegex;

TEST(ScratchFolder, IsNewAndGoesWithAllThatIsInIt) {
  std::optional<ScratchFolder> one(std::in_place);
  const ScratchFolder other;
  const fs::path path = one->path();
  EXPECT_NE(path, other.path());
  write_file(*one / "below" / "file", "text");
  one.reset();
  EXPECT_FALSE(fs::exists(path));
  EXPECT_TRUE(fs::is_directory(other.path()));
}

TEST(ScratchFolder, IsWhereTmpdirSays) {
  const ScratchFolder folder;
  const fs::path parent = folder / "it's a \"folder\"";
  fs::create_directory(parent);
  const sim::EnvironmentValue variable("TMPDIR", parent.string());
  const ScratchFolder inside;
  EXPECT_EQ(inside.path().parent_path(), parent);
  EXPECT_TRUE(fs::is_directory(inside.path()));
}

TEST(ScratchFolder, StaysWhereItWasMoved) {
  const ScratchFolder folder;
  {
    const ScratchFolder made(folder.path(), "building-");
    EXPECT_THAT(made.path().filename().string(), MatchesRegex("building-......"));
    write_file(made / "file", "text");
    fs::rename(made.path(), folder / "kept");
  }
  EXPECT_TRUE(fs::exists(folder / "kept" / "file"));
}

TEST(ScratchFolder, MissingParentRejected) {
  EXPECT_EQ(message_of<std::runtime_error>([] { const ScratchFolder folder("/nonexistent", "a-"); }),
            "/nonexistent: cannot create a folder in it: No such file or directory");
}

}  // namespace
}  // namespace hitpipe::host
