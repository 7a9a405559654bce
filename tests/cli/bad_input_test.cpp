// Bad input: one line that says what was wrong, where, and what is allowed; exit code 2; no file.
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "rtl_gen/catalogue/design.hpp"
#include "sw_ref/scene/built_in.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::bad_input_test {
namespace {

namespace fs = std::filesystem;

/// The commands write into a folder where nothing may appear.
class BadInput : public testing::Test {
 protected:
  void SetUp() override { fs::create_directory(results_); }
  void TearDown() override { EXPECT_TRUE(fs::is_empty(results_)); }

  void rejected(const std::vector<std::string>& arguments, const std::string& message,
                const Variables& variables = {}) const {
    const Outcome outcome = run_hitpipe(arguments, variables);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "hitpipe: " + message + "\n");
    EXPECT_EQ(lines_of(outcome.err).size(), 1U);
  }
  [[nodiscard]] std::vector<std::string> cosim(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"cosim", "int_slabs", "--width", "8", "--height", "8", "--out", out()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  [[nodiscard]] std::vector<std::string> render(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{
        "render", "--width", "8", "--height", "8", "--out", (results_ / "image.png").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  void scene_rejected(const std::vector<std::string>& options, const std::string& message) const {
    rejected(cosim(options), message);
    rejected(render(options), message);
  }
  void mesh_rejected(const std::string& name, const std::string& text, const std::string& message) const {
    const std::string file = folder_.write(name, text).string();
    scene_rejected({"--scene", file}, "mesh file \"" + file + "\": " + message);
  }
  [[nodiscard]] std::vector<std::string> fit(const std::vector<std::string>& more,
                                             const std::string& folder) const {
    std::vector<std::string> arguments{"fit",      "--scene", "spheres", "--width", "8",
                                       "--height", "8",       "--out",   folder};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  [[nodiscard]] std::string out() const { return (results_ / "out").string(); }

  const sim::TemporaryFolder folder_;
  const fs::path results_ = folder_.path() / "results";
};

TEST_F(BadInput, UnknownDesignRejected) {
  const std::string message = "design pluecker: unknown; there are: " + rtl::design_names();
  rejected({"cosim", "pluecker", "--scene", "spheres", "--out", out()}, message);
  rejected({"rtl", "pluecker", "--out", out()}, message);
  rejected(fit({"--designs", "int_slabs,pluecker"}, out()), message);
}

TEST_F(BadInput, BitsRejected) {
  const std::string allowed =
      ": no format of int_slabs; allowed is n/t with n in 6..32 and t in 6..2n-1, for example 20/24";
  for (const std::string bits : {"5/6", "33/6", "20/40", "20/5", "abc", "20", "20/24x", "", "20/", "/24",
                                 "20/24/28", "-20/24", "20 /24", "99999999999/24"}) {
    rejected({"rtl", "int_slabs", "--bits", bits, "--out", out()}, "bits " + bits + allowed);
  }
  for (const std::string bits : {"5/6", "20/40"})
    rejected(cosim({"--scene", "spheres", "--bits", bits}), "bits " + bits + allowed);
  rejected({"rtl", "fp_slabs", "--bits", "20/24", "--out", out()},
           "bits 20/24: no format of fp_slabs; allowed is fp32, which is e8m23");
  rejected({"rtl", "int_slabs", "--bits", "fp32", "--out", out()},
           "bits fp32: no format of int_slabs; allowed is n/t with n in 6..32 and t in 6..2n-1, for example "
           "20/24");
}

TEST_F(BadInput, UnknownSceneRejected) {
  scene_rejected(
      {"--scene", "bunny"},
      "scene \"bunny\": no built-in scene and no file of that name; built-in are: " + ref::built_in_names());
}

TEST_F(BadInput, MissingMeshRejected) {
  const std::string file = (folder_.path() / "none.ply").string();
  scene_rejected({"--scene", file},
                 "mesh file \"" + file + "\": no such file; give a .obj, .ply, .stl, .gltf or .glb file");
}

TEST_F(BadInput, EmptyMeshRejected) {
  for (const char* const name : {"empty.obj", "empty.ply", "empty.stl", "empty.gltf", "empty.glb"})
    mesh_rejected(name, "", "is empty; at least one triangle is needed");
}

TEST_F(BadInput, UnknownExtensionRejected) {
  mesh_rejected("mesh.txt", "v 0 0 0\n",
                "unknown extension \".txt\"; allowed are .obj, .ply, .stl, .gltf and .glb");
}

constexpr const char* ply_header =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n";

TEST_F(BadInput, TruncatedPlyRejected) {
  mesh_rejected("cut.ply", std::string(ply_header) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                "cut short in element face 1; the header announces 2");
}

TEST_F(BadInput, VertexThatIsNotFiniteRejected) {
  mesh_rejected("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n",
                "a vertex lies at (0, nan, 0); coordinates must be finite");
  mesh_rejected("nan.ply", std::string(ply_header) + "0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n3 0 1 2\n",
                "a vertex lies at (0, nan, 0); coordinates must be finite");
}

TEST_F(BadInput, IndexOutOfRangeRejected) {
  mesh_rejected("index.ply", std::string(ply_header) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 3\n",
                "face 1 refers to vertex 3; the file has vertices 0 to 2");
}

TEST_F(BadInput, OnlyDegenerateTrianglesRejected) {
  mesh_rejected("flat.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\nf 1 1 2\n",
                "has only triangles without area (2); at least one with area is needed");
}

TEST_F(BadInput, FolderBelowAFileRejected) {
  const std::string below = folder_.write("file", "").string() + "/out";
  rejected({"rtl", "int_slabs", "--out", below}, below + ": cannot create the folder: Not a directory");
  rejected({"cosim", "int_slabs", "--scene", "spheres", "--out", below},
           below + ": cannot create the folder: Not a directory");
  rejected(fit({"--designs", "fp_slabs"}, below), below + ": cannot create the folder: Not a directory");
  EXPECT_EQ(files_below(folder_.path()), (std::vector<std::string>{"file"}));
}

/// Not even for the superuser: /proc takes no folder.
TEST_F(BadInput, FolderThatCannotBeMadeRejectedBeforeTheLongRun) {
  rejected(fit({"--designs", "int_slabs"}, "/proc/hitpipe"),
           "/proc/hitpipe: cannot create the folder: No such file or directory");
}

TEST_F(BadInput, BitsOfFloatDesignsAloneRejected) {
  rejected(fit({"--designs", "fp_slabs,fp_plucker", "--bits", "12/12"}, out()),
           "bits 12/12: no format of fp_slabs; allowed is fp32, which is e8m23");
}

TEST_F(BadInput, OverheadThatIsNoNumberRejected) {
  rejected(fit({"--overhead", "nan"}, out()),
           "--overhead: Value nan not in range 0 to 1000; see hitpipe fit --help");
}

TEST_F(BadInput, SceneWithoutATriangleInViewRejected) {
  const std::string mesh = folder_.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
  rejected({"fit", "--scene", mesh, "--eye", "0,0,2", "--target", "0,0,4", "--designs", "int_slabs",
            "--width", "8", "--height", "8", "--out", out()},
           "scene triangle: no ray of the image meets a triangle; a unit fitted to it would be of no use");
}

TEST_F(BadInput, FolderWithoutNameRejected) {
  rejected({"rtl", "int_slabs", "--out", ""},
           "--out: is empty; give the name of a folder; see hitpipe rtl --help");
  rejected({"cosim", "int_slabs", "--scene", "spheres", "--out", ""},
           "--out: is empty; give the name of a folder; see hitpipe cosim --help");
}

TEST_F(BadInput, ImageThatCannotBeWrittenRejected) {
  const std::string in_none = (folder_.path() / "none" / "image.png").string();
  const std::string none = (folder_.path() / "none").string();
  rejected({"render", "--scene", "spheres", "--width", "8", "--height", "8", "--out", in_none},
           "image file \"" + in_none + "\": no folder \"" + none + "\"; create it first");
  const std::string jpg = (results_ / "image.jpg").string();
  rejected({"render", "--scene", "spheres", "--width", "8", "--height", "8", "--out", jpg},
           "image file \"" + jpg + "\": unknown extension \".jpg\"; allowed are .png and .exr");
}

TEST_F(BadInput, CameraThatCannotBePlacedRejected) {
  scene_rejected({"--scene", "spheres", "--eye", "1,2,3", "--target", "1,2,3"},
                 "camera: eye and target are both (1, 2, 3); they must differ");
  scene_rejected({"--scene", "spheres", "--eye", "inf,0,0"}, "camera: eye (inf, 0, 0) must be finite");
  scene_rejected({"--scene", "spheres", "--up", "0,0,0"}, "camera: up (0, 0, 0) must be finite and not zero");
  for (const char* const fov : {"0", "180", "nan"}) {
    scene_rejected({"--scene", "spheres", "--fov", fov},
                   "camera: field of view of " + std::string(fov) +
                       " degrees; allowed is more than 0 and less than 180");
  }
}

TEST_F(BadInput, OrthographicImageWithoutHeightRejected) {
  scene_rejected({"--scene", "spheres", "--orthographic", "--fov", "0"},
                 "camera: field of view of 0 degrees; allowed is more than 0 and less than 180");
  scene_rejected({"--scene", "spheres", "--orthographic", "--eye", "1,2,3", "--target", "1,2,3"},
                 "camera: eye and target are both (1, 2, 3); they must differ");
  rejected(render({"--scene", "spheres", "--orthographic", "--perspective"}),
           "--orthographic excludes --perspective; see hitpipe render --help");
}

TEST_F(BadInput, SunWithoutDirectionRejected) {
  scene_rejected({"--scene", "spheres", "--sun", "0,0,0"},
                 "light 0: direction (0, 0, 0) must be finite and not zero");
  scene_rejected({"--scene", "spheres", "--light", "1,2,3", "--sun", "0,inf,0"},
                 "light 1: direction (0, inf, 0) must be finite and not zero");
}

TEST_F(BadInput, LightThatIsNotFiniteRejected) {
  scene_rejected({"--scene", "spheres", "--light", "nan,0,0"},
                 "light 0: position (nan, 0, 0) must be finite");
  scene_rejected({"--scene", "spheres", "--light", "1,2,3", "--light", "0,0,-inf"},
                 "light 1: position (0, 0, -inf) must be finite");
}

TEST_F(BadInput, WordsThatAreNoPointRejected) {
  const auto no_point = [&](const std::string& option, const std::string& words) {
    rejected(render({"--scene", "spheres", option, words}),
             option + ": " + words +
                 " is not X,Y,Z; give three numbers, for example 1,0.5,-2; see hitpipe render --help");
  };
  for (const char* const words : {"1,2", "1,2,3,4", "1 2 3", "1,2,x", "1,,3", ",1,2", "1,2,", ""})
    no_point("--eye", words);
  for (const char* const option : {"--target", "--up", "--light", "--sun"}) no_point(option, "1,2");
}

TEST_F(BadInput, NumbersOutOfRangeRejected) {
  const auto refused = [&](const std::string& option, const std::string& value, const std::string& most) {
    rejected(cosim({"--scene", "spheres", option, value}),
             option + ": Value " + value + " not in range 1 to " + most + "; see hitpipe cosim --help");
  };
  // A second --width would be refused because it is the second.
  rejected({"render", "--scene", "spheres", "--width", "0"},
           "--width: Value 0 not in range 1 to 16384; see hitpipe render --help");
  rejected({"render", "--scene", "spheres", "--height", "16385"},
           "--height: Value 16385 not in range 1 to 16384; see hitpipe render --help");
  rejected({"render", "--scene", "spheres", "--width", "12.5"},
           "--width: Value 12.5 not in range 1 to 16384; see hitpipe render --help");
  refused("--rays-in-flight", "0", "65536");
  refused("--rays-in-flight", "65537", "65536");
  refused("--threads", "0", "1024");
  refused("--threads", "-1", "1024");
  rejected({"rtl", "int_slabs", "--out", out(), "--clock-ps", "0"},
           "--clock-ps: Value 0 not in range 1 to 1000000000; see hitpipe rtl --help");
  rejected(cosim({"--scene", "spheres", "--fov", "wide"}),
           "Could not convert: --fov = wide; see hitpipe cosim --help");
}

#ifndef __SANITIZE_ADDRESS__  // it needs more address space than this test leaves
/// A picture that does not fit into memory gives one line in our own words.
TEST_F(BadInput, MoreThanMemoryHoldsRejected) {
  const fs::path err = folder_.path() / "err";
  const std::string command = "ulimit -v 1000000; exec " HITPIPE_PROGRAM
                              " render --scene spheres --width 16384 --height 16384 --threads 1 2>" +
                              err.string();
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(contents_of(err),
            "hitpipe: not enough memory; ask for fewer pixels, triangles or rays in flight, or for fewer "
            "threads\n");
}
#endif

TEST_F(BadInput, LibraryThatCannotBeReadRejected) {
  const std::string none = (folder_.path() / "none.json").string();
  rejected({"rtl", "int_slabs", "--out", out(), "--library", none},
           none + ": cannot read the component library");
  rejected(cosim({"--scene", "spheres", "--library", none}), none + ": cannot read the component library");
}

TEST_F(BadInput, MissingVerilatorRejected) {
  rejected(
      cosim({"--scene", "spheres"}),
      "/nonexistent/verilator: cannot be run; install the package verilator or set VERILATOR to the program",
      {{"VERILATOR", "/nonexistent/verilator"}});
}

TEST_F(BadInput, FailingVerilatorRejected) {
  const std::string verilator =
      folder_
          .write_program("verilator", "#!/bin/sh\nif [ \"$1\" = --version ]; then echo 1; exit; fi\nexit 3\n")
          .string();
  const fs::path cache = folder_.path() / "cache";
  rejected(
      cosim({"--scene", "spheres"}),
      verilator + ": failed with exit code 3; its output is in " + (cache / "failed-int_slabs.log").string(),
      {{"VERILATOR", verilator}, {"HITPIPE_CACHE", cache.string()}});
}

TEST_F(BadInput, CacheThatCannotBeWrittenRejected) {
  const std::string cache = folder_.write("file", "").string() + "/cache";
  rejected(cosim({"--scene", "spheres"}),
           cache + ": cannot write to the cache; set HITPIPE_CACHE to another folder",
           {{"HITPIPE_CACHE", cache}});
}

/// Nothing here needs a temporary folder before it is asked to draw.
TEST_F(BadInput, MissingTemporaryFolderIsNoHarmToCosim) {
  const Outcome outcome =
      run_hitpipe({"cosim", "int_slabs", "--scene", "spheres", "--width", "4", "--height", "4"},
                  {{"TMPDIR", "/nonexistent"}});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

}  // namespace
}  // namespace hitpipe::cli::bad_input_test
