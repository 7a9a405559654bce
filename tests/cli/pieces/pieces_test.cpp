// Numbers of pieces, places and combinations of options that no command takes. What pieces do when they are
// asked rightly, killed_pieces.py shows.
#include "cli/pieces/pieces.hpp"

#include "tests/cli/wrong_use.hpp"

namespace hitpipe::cli::pieces_test {
namespace {

TEST_F(WrongUseOf, Pieces) {
  const std::string check = "check int_slabs --tests 5000 ";
  const std::string trace = "core trace --scene spheres --width 64 --height 64 ";
  const std::string sweep = "sweep int_slabs --bits 6/6,8/8 --scene spheres --out OUT ";
  rejected(
      {{check + "--pieces 0 --out OUT", "--pieces: Value 0 not in range 1 to 1000000;"},
       {check + "--pieces 2", "--pieces: needs --out, the folder of their files"},
       {check + "--pieces 4 --out OUT --category random",
        "--pieces: 4 pieces of 3 batches of tests; allowed is 1 to 3"},
       {check + "--piece 1/4 --out OUT --category random",
        "--piece: 4 pieces of 3 batches of tests; allowed is 1 to 3"},
       {check + "--piece 1/2", "--piece: needs --out, the file of the piece"},
       {check + "--piece 1/2 --out DIR", "DIR: cannot write the file: Is a directory"},
       {check + "--pieces 2 --out DIR/file", "DIR/file: cannot create the folder: Not a directory"},
       {check + "--piece 1/2 --pieces 2 --out OUT",
        "--piece excludes --pieces: one prints commands, the other does what one of them says;"},
       {check + "--replay x --piece 1/2 --out OUT", "--replay excludes --piece: it judges one case;"},
       {check + "--join a", "--join excludes design: the pieces say it;"},
       {"check --join DIR/file", "DIR/file: is no whole piece; run the command of this piece again"},
       {"check --join DIR/none", "DIR/none: cannot read the piece"},
       {check + "--out OUT", "--out: needs --stiff, --pieces or --piece"},
       {sweep + "--pieces 3", "--pieces: 3 pieces of 2 rows; allowed is 1 to 2"},
       {sweep + "--pieces 2 --rows DIR/file", "--rows excludes --pieces: a piece measures its own rows;"},
       {"sweep --join DIR/file", "--out is required;"},
       {"table 4.2 --pieces 2 --out OUT", "--pieces requires --judge;"},
       {"table 4.2 7.1 --judge --pieces 3 --out OUT", "--pieces: 3 pieces of 2 tables; allowed is 1 to 2"},
       {trace + "--parts 5", "--parts 5: there are 4 tiles; allowed is 1 to 4"},
       {trace + "--pieces 2 --out OUT", "--pieces: 2 pieces of 1 runs of cores; allowed is 1 to 1"},
       {"core trace --join DIR/none --out OUT", "--out: pieces make no picture"}});
  for (const std::string piece : {"0/2", "3/2", "1", "1/", "/2", "1/2/3", "-1/2", "1/1000001"})
    rejected({{check + "--out OUT --piece " + piece,
               "--piece: " + piece + " is not K/N, a piece from 1/N to N/N, N at most 1000000;"}});
}

}  // namespace
}  // namespace hitpipe::cli::pieces_test
