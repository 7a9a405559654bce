// Files, folders and tools that a command cannot use (tests/cli/wrong_use.hpp).
#include <cstdlib>

#include <gmock/gmock.h>
#include <sys/wait.h>

#include "host/address_sanitizer.hpp"
#include "host/process.hpp"
#include "tests/cli/wrong_use.hpp"

namespace hitpipe::cli::wrong_files_test {
namespace {

namespace fs = std::filesystem;
using WrongFiles = WrongUseOf;

/// By any name of it.
TEST_F(WrongFiles, AnInputAsOutput) {
  folder_.write("rays.csv", "ox,oy,oz,dx,dy,dz\n0,0,0,1,0,0\n");
  folder_.write("boxes.csv", "min_x,min_y,min_z,max_x,max_y,max_z\n0,0,0,1,1,1\n");
  folder_.write("scene.json", "{\"mesh\": \"triangle.obj\"}");
  fs::copy_file(HITPIPE_SOURCE "/rtl_gen/component/libraries/thesis_250nm.json",
                folder_.path() / "int_slabs.json");
  fs::create_symlink("triangle.obj", folder_.path() / "link.obj");
  const auto lost = [](const std::string& file) {
    return file + ": is an input, which would be lost; give another file to write";
  };
  const std::string mesh = contents_of(folder_.path() / "triangle.obj");
  rejected({{"bvh --scene DIR/triangle.obj --out DIR/triangle.obj", lost("DIR/triangle.obj")},
            {"bvh --scene DIR/link.obj --out DIR/triangle.obj", lost("DIR/triangle.obj")},
            {"bvh --scene DIR/triangle.obj --out DIR/link.obj", lost("DIR/link.obj")},
            {"bvh --scene DIR/scene.json --out DIR/triangle.obj",
             "scene file \"DIR/scene.json\": " + lost("DIR/triangle.obj")},
            {"operands int_slabs --rays DIR/rays.csv --boxes DIR/boxes.csv --out DIR/rays.csv",
             lost("DIR/rays.csv")},
            {"operands int_slabs --rays DIR/rays.csv --boxes DIR/boxes.csv --out DIR/./boxes.csv",
             lost("DIR/./boxes.csv")},
            {"operands int_slabs --operands DIR/two.csv --out DIR/two.csv", lost("DIR/two.csv")},
            {"rtl int_slabs --library DIR/int_slabs.json --out DIR", lost("DIR/int_slabs.json")}});
  EXPECT_FALSE(fs::exists(folder_.path() / "int_slabs.v"));
  EXPECT_EQ(contents_of(folder_.path() / "triangle.obj"), mesh);
  const fs::path picture = folder_.path() / "a.png";
  ASSERT_EQ(hitpipe("render --scene spheres --width 8 --height 8 --out " + picture.string()).exit_code, 0);
  rejected({{"render --compare DIR/a.png DIR/a.png --out DIR/a.png", lost("DIR/a.png")}});
}

/// A mesh may have its materials and its vertices in other files.
TEST_F(WrongFiles, AFileOfTheMeshAsOutput) {
  folder_.write("m.obj", "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder_.write("m.mtl", "newmtl a\nKd 1 0 0\n");
  // Three vertices: each number is 0 or 1.
  const std::string zero(4, '\0');
  const std::string one("\0\0\x80\x3f", 4);
  const std::string vertices = zero + zero + zero + one + zero + zero + zero + one + zero;
  folder_.write("g.bin", vertices);
  folder_.write("g.gltf",
                R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "g.bin", "byteLength": 36}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
"min": [0, 0, 0], "max": [1, 1, 0]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0})");
  fs::create_hard_link(folder_.path() / "g.bin", folder_.path() / "same.bin");
  folder_.write("scene.json", "{\"mesh\": \"m.obj\"}");
  const auto lost = [](const std::string& mesh, const std::string& file) {
    return "mesh file \"DIR/" + mesh + "\": " + file +
           ": is an input, which would be lost; give another file to write";
  };
  const std::string materials = contents_of(folder_.path() / "m.mtl");
  rejected({{"bvh --scene DIR/g.gltf --records DIR/g.bin", lost("g.gltf", "DIR/g.bin")},
            {"bvh --scene DIR/g.gltf --records DIR/same.bin", lost("g.gltf", "DIR/same.bin")},
            {"bvh --scene DIR/m.obj --out DIR/m.mtl", lost("m.obj", "DIR/m.mtl")},
            {"sweep int_slabs --scene DIR/m.obj --out DIR/m.mtl", lost("m.obj", "DIR/m.mtl")},
            {"bvh --scene DIR/scene.json --out DIR/m.mtl",
             "scene file \"DIR/scene.json\": " + lost("m.obj", "DIR/m.mtl")}});
  EXPECT_EQ(contents_of(folder_.path() / "g.bin"), vertices);
  EXPECT_EQ(contents_of(folder_.path() / "m.mtl"), materials);
  EXPECT_EQ(hitpipe(filled("bvh --scene DIR/g.gltf --records DIR/new.bin")).exit_code, 0);
}

/// Whatever names lead to it.
TEST_F(WrongFiles, OneFileForTwoOutputs) {
  const auto shared = [](const std::string& file, const std::string& one, const std::string& other) {
    return file + ": is the file of " + one + " and of " + other + "; give each a file of its own";
  };
  folder_.write("a.png", "");
  fs::create_symlink("a.png", folder_.path() / "link.png");
  const std::string render = "render --scene spheres --width 8 --height 8 --out DIR/a.png ";
  rejected(
      {{render + "--depth-map DIR/a.png", shared("DIR/a.png", "--out", "--depth-map")},
       {render + "--box-map DIR/./a.png", shared("DIR/./a.png", "--out", "--box-map")},
       {render + "--triangle-map DIR/link.png", shared("DIR/link.png", "--out", "--triangle-map")},
       {"render --scene spheres --box-map DIR/b.png --extra-box-map DIR/b.png",
        shared("DIR/b.png", "--box-map", "--extra-box-map")},
       {"bvh --scene spheres --out OUT.hex --records OUT.hex", shared("OUT.hex", "--out", "--records")}});
  EXPECT_EQ(contents_of(folder_.path() / "a.png"), "");
}

/// A program that was copied alone.
TEST_F(WrongFiles, TheImageLibraryIsMissing) {
  fs::create_directory(folder_.path() / "bin");
  const fs::path program = folder_.path() / "bin" / "hitpipe";
  fs::copy_file(HITPIPE_PROGRAM, program);
  const host::Outcome outcome = host::run({program.string(), "render", "--scene", "spheres", "--width", "2",
                                           "--height", "2", "--out", filled("DIR/a.png")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              testing::MatchesRegex(filled(
                  "hitpipe: image file \"DIR/a.png\": images need DIR/lib[^ ]*/hitpipe/hitpipe_images.so, "
                  "which is not there; a build makes it if OpenImageIO is installed\n")));
}

/// A scene that cannot be read shows that nothing was read before.
TEST_F(WrongFiles, OutputsAreRefusedBeforeTheWork) {
  folder_.write("rows.csv", "rows");
  fs::create_directory(folder_.path() / "pictures.csv");
  fs::create_directory(folder_.path() / "spheres.png");
  const std::string below = ": cannot create the folder: Not a directory";
  const std::string lost = ": is an input, which would be lost; give another file to write";
  const std::string scene = " --scene DIR/none.obj ";
  rejected({{"report" + scene + "--rows DIR/rows.csv --out DIR", "DIR/rows.csv" + lost},
            {"report" + scene + "--out DIR", "DIR/pictures.csv: cannot write the file: Is a directory"},
            {"report" + scene + "--out DIR/file", "DIR/file" + below},
            {"bvh" + scene + "--out DIR/file/a.bvh", "DIR/file" + below},
            {"bvh" + scene + "--out DIR", "DIR: cannot write the file: Is a directory"},
            {"bvh" + scene + "--out ''", "--out: is empty; give the name of a file;"},
            {"bvh" + scene + "--records /dev/null", "/dev/null: is not a file that can be replaced"},
            {"sweep" + scene + "--out DIR/file/a.csv", "DIR/file" + below},
            {"render" + scene + "--out OUT.jpg",
             "image file \"OUT.jpg\": unknown extension \".jpg\"; allowed are .png and .exr"},
            {"render" + scene + "--depth-map DIR/none/a.png",
             "image file \"DIR/none/a.png\": no folder \"DIR/none\"; create it first"},
            {"cosim int_slabs" + scene + "--out DIR/file", "DIR/file" + below},
            {"cosim int_slabs --scene spheres --bvh DIR/none.bvh --out DIR",
             "DIR/spheres.png: cannot write the file: Is a directory"},
            {"fit int_slabs" + scene + "--out DIR/file", "DIR/file" + below},
            {"check --stiff" + scene + "--out DIR/file", "DIR/file" + below},
            {"implement int_slabs --target xc7 --out DIR/file", "DIR/file" + below},
            {"table --judge --scene Bunny=DIR/none.obj --out DIR/file/a.md", "DIR/file" + below}});
}

TEST_F(WrongFiles, FilesAndFolders) {
  const std::string below = "DIR/file/out: cannot create the folder: Not a directory";
  rejected({{"rtl int_slabs --out DIR/file/out", below},
            {"cosim int_slabs --scene spheres --out DIR/file/out", below},
            {"fit fp_slabs --scene spheres --out DIR/file/out", below},
            // Not even for the superuser: /proc takes no folder.
            {"fit int_slabs --scene spheres --out /proc/hitpipe",
             "/proc/hitpipe: cannot create the folder: No such file or directory"},
            {"rtl int_slabs --out ''", "--out: is empty; give the name of a folder;"},
            {"cosim int_slabs --scene spheres --out ''", "--out: is empty; give the name of a folder;"},
            {"cosim int_slabs --scene spheres --bvh ''", "--bvh: is empty; give the name of a file;"},
            {"check --stiff --out ''", "--out: is empty; give the name of a folder;"},
            {"render --scene spheres --width 8 --height 8 --out DIR/none/image.png",
             "image file \"DIR/none/image.png\": no folder \"DIR/none\"; create it first"},
            {"render --scene spheres --width 8 --height 8 --out OUT.jpg",
             "image file \"OUT.jpg\": unknown extension \".jpg\"; allowed are .png and .exr"},
            {"render --compare DIR/none.png DIR/none.png",
             "image file \"DIR/none.png\": no such file; check the name"},
            {"bvh --scene spheres --bvh DIR/none.bvh --out OUT", "BVH file \"DIR/none.bvh\": no such file"},
            {"cosim int_slabs --scene spheres --bvh DIR/two.csv --out OUT",
             "BVH file \"DIR/two.csv\": line 1: the first line must be \"hitpipe-bvh 1\""},
            {"rtl int_slabs --out OUT --library DIR/none.json",
             "DIR/none.json: cannot read the component library"},
            {"area --library DIR/none.json", "DIR/none.json: cannot read the component library"},
            {"cosim int_slabs --scene spheres --library DIR/none.json",
             "DIR/none.json: cannot read the component library"},
            {"sweep int_slabs --scene spheres --rows DIR/none.csv --out OUT.csv",
             "DIR/none.csv: cannot read the rows"},
            {"cosim int_slabs --scene spheres --rays DIR/none.csv",
             "DIR/none.csv: cannot read the file: No such file or directory"},
            {"sweep int_slabs --scene spheres --rays DIR/none.bin --out OUT.csv",
             "DIR/none.bin: cannot read the file"},
            {"core trace --scene spheres --rays DIR/two.csv",
             "DIR/two.csv: line 1: column \"a\" is not known; the first line must name the columns "
             "ox,oy,oz,dx,dy,dz[,length,any]"},
            {"operands int_slabs --rays DIR/none.csv --boxes DIR/two.csv --out OUT.csv",
             "DIR/none.csv: cannot read the file: No such file or directory"}});
}

TEST_F(WrongFiles, Tools) {
  const std::vector<std::string> cosim{"cosim",   "int_slabs", "--scene",  "spheres",
                                       "--width", "8",         "--height", "8"};
  rejected(
      cosim,
      "/nonexistent/verilator: cannot be run; install the package verilator or set VERILATOR to the program",
      {{"VERILATOR", "/nonexistent/verilator"}});
  const std::string verilator =
      folder_
          .write_program("verilator", "#!/bin/sh\nif [ \"$1\" = --version ]; then echo 1; exit; fi\nexit 3\n")
          .string();
  rejected(cosim, verilator + ": failed with exit code 3; its output is in DIR/cache/failed-int_slabs.log",
           {{"VERILATOR", verilator}, {"HITPIPE_CACHE", filled("DIR/cache")}});
  rejected(cosim, "DIR/file/cache: cannot write to the cache; set HITPIPE_CACHE to another folder",
           {{"HITPIPE_CACHE", filled("DIR/file/cache")}});
  rejected(
      {"check", "--stiff", "int_slabs", "--bits", "12/12", "--tests", "60", "--out", "OUT"},
      "check: no python3 with matplotlib and jinja2 was found; install the packages python3-matplotlib and "
      "python3-jinja2 or set PYTHON to the program",
      {{"PYTHON", "/bin/false"}});
  const std::string python =
      folder_
          .write_program("python",
                         "#!/bin/sh\ncase \"$*\" in *find_spec*) exit;; esac\necho no >&2\nexit 3\n")
          .string();
  rejected({"check", "--stiff", "int_slabs", "--bits", "12/12", "--tests", "60", "--out", "OUT"},
           "check: " + python + " failed with exit code 3: no", {{"PYTHON", python}});
  // Nothing here needs a temporary folder before it is asked to draw.
  EXPECT_EQ(run_hitpipe(cosim, {{"TMPDIR", "/nonexistent"}}).exit_code, 0);
}

#ifndef HITPIPE_ADDRESS_SANITIZER  // it needs more address space than this test leaves
/// A picture that does not fit into memory gives one line in our own words.
TEST_F(WrongFiles, MoreThanMemoryHolds) {
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

}  // namespace
}  // namespace hitpipe::cli::wrong_files_test
