// Files of pieces are read back. If they are not all pieces of one command, a message names the file or the
// piece.
#include "cli/pieces/piece_file.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::cli::piece_file_test {
namespace {

const std::string program = "hitpipe 1.2.3";

class Pieces : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.path() / name; }
  /// Writes pieces 1 to 4 of 4, changed as a test wants, and returns their files.
  [[nodiscard]] std::vector<std::string> written(const std::function<void(PieceFile&)>& change = {}) const {
    std::vector<std::string> files;
    for (std::uint64_t number = 1; number <= 4; ++number) {
      PieceFile piece{.file = file(std::to_string(number)),
                      .note = {.program = program,
                               .command = "hitpipe check int_slabs --seed 1",
                               .inputs = {{"a.obj", "fnv1a-0"}},
                               .piece = {number, 4},
                               .parts = 10},
                      .result = {{"sum", number}}};
      if (change) change(piece);
      write_piece(piece);
      files.push_back(piece.file.string());
    }
    return files;
  }
  static std::string refusal(const std::vector<std::string>& files) {
    return message_of<std::runtime_error>([&] { (void)read_pieces(files, program, "hitpipe check"); });
  }

  const sim::TemporaryFolder folder_;
};

TEST_F(Pieces, AreReadInOrder) {
  std::vector<std::string> files = written();
  std::swap(files[0], files[3]);
  std::swap(files[1], files[0]);
  const std::vector<PieceFile> read = read_pieces(files, program, "hitpipe check");
  ASSERT_EQ(read.size(), 4U);
  for (std::uint64_t i = 0; i < 4; ++i) {
    EXPECT_EQ(read[i].result, Row({{"sum", i + 1}}));
    EXPECT_EQ(to_row(read[i].note), to_row(read_piece(file(std::to_string(i + 1))).note));
    EXPECT_EQ(read[i].note.parts, 10U);
  }
}

TEST_F(Pieces, MissingOnesAreNamed) {
  const std::vector<std::string> all = written();
  const std::string of = " of 4 of \"hitpipe check int_slabs --seed 1\" is missing";
  EXPECT_EQ(refusal({all[0], all[1], all[2]}), "--join: piece 4" + of);
  EXPECT_EQ(refusal({all[1], all[3]}), "--join: piece 1, 3" + of);
}

TEST_F(Pieces, OneThatIsThereTwiceIsNamed) {
  std::vector<std::string> all = written();
  write_piece({file("again"), read_piece(all[2]).note, {}});
  all.push_back(file("again"));
  EXPECT_EQ(refusal(all), file("again") + ": is piece 3 of 4, as " + all[2] + " is; give each once");
}

TEST_F(Pieces, CutOrForeignFilesAreNamed) {
  const std::vector<std::string> all = written();
  const std::string no_piece = ": is no whole piece; run the command of this piece again";
  const auto refused = [&](const std::string& text) {
    folder_.write("2", text);
    EXPECT_EQ(refusal(all), all[1] + no_piece) << text;
  };
  Row row = to_row(PieceNote{.program = program, .command = "hitpipe check", .piece = {2, 4}});
  row["result"] = 1;
  const std::string whole = row.dump();
  for (std::size_t cut = 0; cut < whole.size(); cut += 7) refused(whole.substr(0, cut));
  for (const char* const key : {"program", "command", "inputs", "piece", "pieces", "parts", "result"}) {
    Row less = row;
    less.erase(key);
    refused(less.dump());
    if (std::string(key) == "result") continue;
    less[key] = true;
    refused(less.dump());
  }
  row["piece"] = 5;
  refused(row.dump());
  EXPECT_EQ(refusal({file("none")}), file("none") + ": cannot read the piece");
}

TEST_F(Pieces, OfAnotherProgramCommandOrInputAreNamed) {
  const auto second = [](auto change) {
    return [change](PieceFile& piece) {
      if (piece.note.piece.number == 2) change(piece.note);
    };
  };
  const std::string name = file("2") + ": ";
  EXPECT_EQ(refusal(written(second([](PieceNote& note) { note.program = "hitpipe 1.2.4"; }))),
            name + "was made by hitpipe 1.2.4, and this is hitpipe 1.2.3");
  EXPECT_EQ(
      refusal(written(second([](PieceNote& note) { note.command = "hitpipe check int_slabs --seed 2"; }))),
      name +
          "is piece 2 of 4 of \"hitpipe check int_slabs --seed 2\", and the first file is piece 1 of 4 "
          "of \"hitpipe check int_slabs --seed 1\"");
  EXPECT_EQ(refusal(written(second([](PieceNote& note) { note.piece.of = 5; }))),
            name +
                "is piece 2 of 5 of \"hitpipe check int_slabs --seed 1\", and the first file is piece 1 of 4 "
                "of \"hitpipe check int_slabs --seed 1\"");
  EXPECT_EQ(refusal(written(second([](PieceNote& note) { note.inputs["a.obj"] = "fnv1a-1"; }))),
            name + "was made with another a.obj than the first file");
  EXPECT_EQ(refusal(written(second([](PieceNote& note) { note.inputs["b.obj"] = "fnv1a-0"; }))),
            name + "was made with other files than the first file");
  EXPECT_EQ(refusal(written([](PieceFile& piece) { piece.note.command = "hitpipe core trace --seed 1"; })),
            file("1") +
                ": is piece 1 of 4 of \"hitpipe core trace --seed 1\"; allowed are pieces of hitpipe check");
}

TEST_F(Pieces, ResultsOfAnotherFormAreNamed) {
  const PieceFile piece = read_piece(written()[0]);
  EXPECT_EQ(message_of<std::runtime_error>(
                [&] { (void)result_of(piece, [](const Row& row) { return row.at("none").get<int>(); }); }),
            file("1") + ": is no whole piece; run the command of this piece again");
}

}  // namespace
}  // namespace hitpipe::cli::piece_file_test
