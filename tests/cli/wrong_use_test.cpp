// Words, names and numbers that no command takes (tests/cli/wrong_use.hpp).
#include "tests/cli/wrong_use.hpp"

#include "sw_ref/scene/built_in.hpp"

namespace hitpipe::cli::wrong_use_test {
namespace {

TEST_F(WrongUseOf, TheCommandLine) {
  rejected({{"rtl int_slabs --colour 3 --out OUT", "--colour: no such option; the nearest is --out;"},
            {"rtl int_slabs 3 --bit", "--bit: no such option; the nearest is --bits;"},
            {"rtl int_slabs 3 4 --out OUT", "3: a word too many;"},
            {"cosim int_slabs --sceen spheres", "--sceen: no such option; the nearest is --scene;"},
            {"cosim int_slabs --rays-in=3", "--rays-in=3: no such option; the nearest is --rays-in-flight;"},
            {"bvh --scene spheres --width 4", "--width: no such option; the nearest is --bits;"},
            {"cosim", "design is required;"},
            {"cosim int_slabs", "--scene is required;"},
            {"rtl int_slabs", "--out is required;"},
            {"render", "--scene is required;"},
            {"bvh", "--scene is required;"},
            {"sweep --out OUT", "--scene is required;"},
            {"sweep --scene spheres", "--out is required;"},
            {"list", "what is required;"},
            {"list colours", "what: colours is none of designs, machines, features, libraries, scenes;"}});
  const std::string cut(60'000, 'x');
  rejected({"rtl", "--" + cut},
           "--" + cut.substr(0, 48) + "... (60002 bytes): no such option; the nearest is --axi-stream;");
}

/// On the command line and in files.
TEST_F(WrongUseOf, LongWords) {
  const std::string word(60'000, 'x');
  const std::string cut = std::string(50, 'x') + "... (60000 bytes)";
  const auto told = [&](const std::string& words) {
    std::vector<std::string> arguments;
    for (std::string each : host::words_of(filled(words))) {
      if (const std::size_t at = each.find("WORD"); at != std::string::npos) each.replace(at, 4, word);
      arguments.push_back(each);
    }
    const Outcome outcome = run_hitpipe(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << words;
    return outcome.err;
  };
  for (const std::string words : {"WORD",
                                  "rtl WORD --out OUT",
                                  "area int_slabs --bits WORD",
                                  "area int_slabs --library WORD",
                                  "check int_slabs --category WORD",
                                  "check int_slabs --seed WORD",
                                  "check int_slabs --tests WORD",
                                  "list WORD",
                                  "list designs --format WORD",
                                  "implement int_slabs --target WORD --out OUT",
                                  "board --simulate --board WORD",
                                  "sweep WORD --out OUT --scene spheres",
                                  "table WORD",
                                  "render --scene spheres --eye WORD",
                                  "render --scene spheres --fov WORD",
                                  "render --scene WORD",
                                  "render --scene spheres --padding WORD",
                                  "render --scene spheres --out OUT.WORD",
                                  "render --scene spheres --rescale --scale WORD",
                                  "bvh --scene spheres --records OUT.WORD",
                                  "render --scene WORD.obj",
                                  "render --scene WORD.json",
                                  "bvh --scene spheres --out WORD",
                                  "rtl int_slabs --out WORD",
                                  "rtl int_slabs --out OUT --name WORD",
                                  "table 7.1 --scene WORD",
                                  "area int_slabs --library WORD.json",
                                  "operands int_slabs --rays WORD --boxes WORD --out OUT.csv",
                                  "cosim int_slabs --scene spheres --unit WORD"}) {
    const std::string line = told(words);
    EXPECT_LT(line.size(), 1000U) << words;
    EXPECT_NE(line.find("... (600"), std::string::npos) << words << '\n' << line.substr(0, 1000);
  }
  const auto file = [&](const std::string& name, std::string text) {
    for (std::size_t at = 0; (at = text.find("WORD")) != std::string::npos;) text.replace(at, 4, word);
    folder_.write(name, text);
  };
  file("key.json", R"({"WORD": 1})");
  file("twice.json", R"({"built_in": "spheres", "WORD": 1, "WORD": 1})");
  file("scene.json", R"({"built_in": "WORD"})");
  file("material.json", R"({"built_in": "spheres", "materials": {"WORD": {"albedo": 2}}})");
  file("none.json", R"({"built_in": "spheres", "materials": {"WORD": {}}, "default_material": "b"})");
  const std::string begin = "hitpipe: scene file \"" + filled("DIR/");
  EXPECT_EQ(
      told("bvh --scene DIR/key.json").substr(0, begin.size() + 100),
      (begin + "key.json\": unknown key \"" + cut + "\"; allowed are: mesh, built_in, triangles, camera")
          .substr(0, begin.size() + 100));
  EXPECT_EQ(told("bvh --scene DIR/twice.json"),
            begin + "twice.json\": the key \"" + cut + "\" stands twice in one object\n");
  EXPECT_EQ(told("bvh --scene DIR/scene.json"), begin + "scene.json\": built_in: there is no scene \"" + cut +
                                                    "\"; there are: " + ref::built_in_names() + "\n");
  EXPECT_EQ(told("bvh --scene DIR/material.json"),
            begin + "material.json\": materials." + cut +
                ".albedo: 2 is out of range; numbers must be each in 0 to 1\n");
  EXPECT_EQ(told("bvh --scene DIR/none.json"), begin +
                                                   "none.json\": default_material: there is no material "
                                                   "\"b\"; there are: " +
                                                   cut + "\n");
}

TEST_F(WrongUseOf, AnImageInPlaceOfAScene) {
  rejected(
      {{"core trace --image a --scene spheres", "--image excludes --scene: the image has its triangles;"},
       {"core trace --image a --cube 0,0,0,1",
        "--image excludes --cube: the image has its triangles and its cube;"},
       {"core board --port x --image a --builder sah",
        "--image excludes --builder: the image has its hierarchy;"},
       {"core board --simulate --image a", "--simulate excludes --image: the other side has the scene;"}});
}

TEST_F(WrongUseOf, OptionsThatExcludeEachOther) {
  rejected({{"cosim int_slabs --scene spheres --bits 9/9 --unit DIR",
             "--unit excludes --bits: the unit in the folder has its own, which its manifest says;"},
            {"cosim int_slabs --scene spheres --unit DIR --flow-control none",
             "--unit excludes --flow-control: the unit in the folder has its own, which its manifest says;"},
            {"render --scene spheres --orthographic --perspective",
             "--perspective excludes --orthographic: an image has one projection;"},
            {"bvh --scene spheres --builder sah --bvh a.bvh",
             "--bvh excludes --builder: the hierarchy of the file is built already;"},
            {"render --scene spheres --max-depth 7 --bvh a.bvh",
             "--bvh excludes --max-depth: the hierarchy of the file is built already;"},
            {"bvh --scene spheres --sweep --max-triangles 4",
             "--sweep excludes --max-triangles: it builds a hierarchy for each leaf size;"},
            {"bvh --scene spheres --sweep --bvh a.bvh",
             "--sweep excludes --bvh: it builds a hierarchy for each leaf size;"},
            {"report --scene spheres --bits 9/9 --rows a.csv --out OUT",
             "--bits excludes --rows: the rows of the file have their formats;"},
            {"cosim int_slabs --scene spheres --rays r --width 9",
             "--rays excludes --width: the rays of a file make no picture;"},
            {"sweep --scene spheres --out OUT --rays r --diffuse 1",
             "--rays excludes --diffuse: the rays of a file make no picture;"},
            {"core trace --scene spheres --rays r --height 9",
             "--rays excludes --height: the rays of a file make no picture;"},
            {"render --scene spheres --rays r --width 9",
             "--rays excludes --width: the rays of a file make no picture;"},
            {"render --scene spheres --rays r --out OUT.png",
             "--rays excludes --out: the rays of a file make no picture;"},
            {"render --scene spheres --rays r --depth-map OUT.png",
             "--rays excludes --depth-map: the rays of a file make no picture;"},
            {"sweep --scene spheres --out OUT --rays r --answers OUT.csv --rows DIR/two.csv",
             "--answers excludes --rows: their rays were traced elsewhere;"},
            {"sweep --scene spheres --out OUT --rays r --answers OUT.csv --piece 1/2",
             "--answers excludes --piece: pieces keep counts only;"},
            {"core trace --scene spheres --rays r --answers OUT.csv --out OUT --pieces 2",
             "--answers excludes --pieces: pieces keep counts only;"},
            {"fit --scene spheres --rays r --out OUT", "--rays: no such option; the nearest is --eye;"},
            {"board --port x --simulate", "--simulate excludes --port: the other side sends the tests;"},
            {"implement --board icebreaker --simulate 9 --out OUT",
             "--simulate excludes --board: the vectors are for the unit alone, and on a board it stands "
             "behind a "
             "serial line;"},
            {"fit --scene spheres --out OUT --rate-rays 1e6 --ii 2",
             "--rate-rays excludes --ii: the rate decides the interval;"},
            {"check int_slabs --stiff --rtl",
             "--stiff excludes --rtl: stiff rays have cases of their own, and the C++ answers;"},
            {"render --rescale --scene spheres --out OUT",
             "--rescale excludes --out: it builds the hierarchy of each picture, and writes "
             "none;"},
            {"cosim int_slabs --rescale --scene spheres --referee",
             "--rescale excludes --referee: it builds the hierarchy of each picture, and writes "
             "none;"},
            {"render --compare a b --scene spheres",
             "--compare excludes --scene: two images are compared, and nothing is rendered;"},
            {"render --scene spheres --crossings --light 0,9,0",
             "--crossings excludes --light: crossings are counted by exact integers, and nothing is shaded;"},
            {"render --scene spheres --crossings --padding 0",
             "--crossings excludes --padding: crossings are counted by exact integers, and nothing is "
             "shaded;"},
            {"render --scene spheres --world integer --crossings --box-map OUT.png",
             "--crossings excludes --box-map: crossings are counted by exact integers, and nothing is "
             "shaded;"},
            {"render --scene spheres --crossings --traversal plu",
             "--crossings excludes --traversal: crossings are counted by exact integers, and nothing is "
             "shaded;"},
            {"render --scene spheres --crossings --world float",
             "--crossings: not for --world float, which has no exact counts; leave it out"},
            {"operands int_slabs --operands a --rays b --out OUT",
             "--operands excludes --rays: operands are what the unit takes, without a ray and a box;"}});
}

TEST_F(WrongUseOf, NamesOfDesignsAndFormats) {
  for (const std::string command :
       {"cosim pluecker --scene spheres --out OUT", "rtl pluecker --out OUT", "area pluecker",
        "check pluecker", "check --stiff pluecker", "fit int_slabs,pluecker --scene spheres --out OUT",
        "sweep int_slabs pluecker --scene spheres --out OUT"})
    rejected({{command, "design pluecker: unknown; there are: DESIGNS"}});
  const std::string allowed =
      ": no format of int_slabs; allowed is n/t with n in 6..32 and t in 6..2n-1, for example 20/24";
  for (const std::string bits : {"5/6", "33/6", "20/40", "20/5", "abc", "20", "20/24x", "''", "20/", "/24",
                                 "20/24/28", "-20/24", "99999999999/24"})
    rejected({{"rtl int_slabs --out OUT --bits " + bits, "bits " + (bits == "''" ? "" : bits) + allowed}});
  for (const std::string command :
       {"cosim int_slabs --scene spheres --out OUT", "area int_slabs", "check int_slabs", "check --stiff",
        "sweep int_slabs --scene spheres --out OUT", "fit int_slabs --scene spheres --out OUT"})
    rejected({{command + " --bits 5/5", "bits 5/5" + allowed}});
  const std::string floats = "bits 12/12: no format of fp_slabs; allowed is fp32, which is e8m23";
  for (const std::string command :
       {"rtl fp_slabs --out OUT", "area fp_slabs", "check fp_slabs",
        "sweep fp_slabs --scene spheres --out OUT", "fit fp_slabs,fp_plucker --scene spheres --out OUT"})
    rejected({{command + " --bits 12/12", floats}});
  rejected(
      {{"area --bits 20/24", "--bits requires design;"},
       {"check", "check: name designs, or give --safe; there are: DESIGNS"},
       {"check --safe int_slabs", "--safe excludes design: it takes the designs that never miss;"},
       {"check --safe --stiff", "--safe excludes --stiff: --stiff without a design takes the same designs;"},
       {"check int_slabs int_triangle",
        "design int_triangle: tests triangles; check it alone, in one format"},
       {"check int_slabs int_ray", "design int_ray: there is no set-up of rays and boxes for its operands"},
       {"check --stiff int_slabs --bits 6/6,7/7,8/8,9/9,10/10,11/11,12/12,13/13,14/14",
        "--bits: 9 formats for int_slabs; allowed are 8 at most;"},
       {"bvh int_slabs --scene spheres", "bvh: a design and --bits belong to --records; give --records FILE"},
       {"bvh int_slabs --scene spheres --records OUT.hex",
        "design int_slabs: there is no record of a node that its unit reads"},
       {"bvh --scene spheres --records OUT.txt",
        "--records OUT.txt: unknown extension \".txt\"; allowed are .hex and .bin"}});
}

TEST_F(WrongUseOf, Scenes) {
  scene_rejected("bunny", "scene \"bunny\": no built-in scene and no file of that name; built-in are: " +
                              ref::built_in_names());
  scene_rejected("DIR/none.ply",
                 "mesh file \"DIR/none.ply\": no such file; give a .obj, .ply, .stl, .gltf or .glb file");
  for (const char* const name : {"empty.obj", "empty.ply", "empty.stl", "empty.gltf", "empty.glb"})
    mesh_rejected(name, "", "is empty; at least one triangle is needed");
  mesh_rejected("mesh.txt", "v 0 0 0\n",
                "unknown extension \".txt\"; allowed are .obj, .ply, .stl, .gltf and .glb");
  mesh_rejected("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n",
                "line 3: a vertex lies at (0, nan, 0); coordinates must be finite");
  rejected(
      {{"fit int_slabs --scene DIR/triangle.obj --eye 0,0,2 --target 0,0,4 --width 8 --height 8 --out OUT",
        "scene triangle: no ray of the image meets a triangle; a unit fitted to it would be of no use"},
       {"render --scene statue --triangles 9999",
        "scene \"statue\": 9999 triangles; allowed are 10000 to 50000000"},
       {"render --scene spheres --triangles 100",
        "scene \"spheres\": has 24578 triangles; their number can be chosen for: " + ref::scaling_names()}});
}

TEST_F(WrongUseOf, CameraAndLights) {
  const std::string fov = " degrees; allowed is more than 0 and less than 180";
  scene_rejected("spheres --eye 1,2,3 --target 1,2,3",
                 "camera: eye and target are both (1, 2, 3); they must differ");
  scene_rejected("spheres --eye inf,0,0", "camera: eye (inf, 0, 0) must be finite");
  scene_rejected("spheres --up 0,0,0", "camera: up (0, 0, 0) must be finite and not zero");
  for (const std::string angle : {"0", "180", "nan"})
    scene_rejected("spheres --fov " + angle, "camera: field of view of " + angle + fov);
  scene_rejected("spheres --orthographic --fov 0", "camera: field of view of 0" + fov);
  scene_rejected("spheres --sun 0,0,0", "light 0: direction (0, 0, 0) must be finite and not zero");
  scene_rejected("spheres --light 1,2,3 --sun 0,inf,0",
                 "light 1: direction (0, inf, 0) must be finite and not zero");
  scene_rejected("spheres --light nan,0,0", "light 0: position (nan, 0, 0) must be finite");
  const auto no_point = [&](const std::string& option, const std::string& words) {
    rejected({"render", "--scene", "spheres", option, words},
             option + ": " + words + " is not X,Y,Z; give three numbers, for example 1,0.5,-2;");
  };
  for (const char* const words : {"1,2", "1,2,3,4", "1 2 3", "1,2,x", "1,,3", ",1,2", "1,2,"})
    no_point("--eye", words);
  for (const char* const option : {"--target", "--up", "--light", "--sun"}) no_point(option, "1,2");
}

TEST_F(WrongUseOf, Numbers) {
  const std::string cosim = "cosim int_slabs --scene spheres --out OUT ";
  const std::string seeds = " not in range 0 to 18446744073709551615;";
  rejected(
      {{"render --scene spheres --width 0", "--width: Value 0 not in range 1 to 16384;"},
       {"render --scene spheres --height 16385", "--height: Value 16385 not in range 1 to 16384;"},
       {"render --scene spheres --width 12.5", "--width: Value 12.5 not in range 1 to 16384;"},
       {"render --scene statue --triangles -5", "--triangles: Value -5 not in range 1 to 100000000;"},
       {"render --scene spheres --bounces 65", "--bounces: Value 65 not in range 0 to 64;"},
       {"report --scene spheres --out OUT --diffuse 257", "--diffuse: Value 257 not in range 0 to 256;"},
       {"fit --scene spheres --out OUT --occlusion -1", "--occlusion: Value -1 not in range 0 to 256;"},
       {"sweep --scene spheres --out OUT --light-seed x", "--light-seed: Value x" + seeds},
       {"board --port x --scene spheres --diffuse many", "--diffuse: Value many not in range 0 to 256;"},
       {cosim + "--rays-in-flight 0", "--rays-in-flight: Value 0 not in range 1 to 65536;"},
       {cosim + "--rays-in-flight 65537", "--rays-in-flight: Value 65537 not in range 1 to 65536;"},
       {cosim + "--threads 0", "--threads: Value 0 not in range 1 to 1024;"},
       {cosim + "--threads -1", "--threads: Value -1 not in range 1 to 1024;"},
       {cosim + "--fov wide", "Could not convert: --fov = wide;"},
       {"rtl int_slabs --out OUT --clock-ps 0", "--clock-ps: Value 0 not in range 1 to 1000000000;"},
       {"rtl int_slabs --out OUT --clock-ps 3175",
        "int_slabs: a clock of 3175 ps is too short for int_multiply:20; the smallest that can be met is "
        "3176 ps"},
       {"rtl int_slabs --out OUT --vectors 10000001",
        "--vectors: Value 10000001 not in range 1 to 10000000;"},
       {"check int_slabs --tests 0", "--tests: Value 0 not in range 1 to 10000000000000;"},
       {"check int_slabs --tests 10000000000001",
        "--tests: Value 10000000000001 not in range 1 to 10000000000000;"},
       {"check int_slabs --stiff --tests 1000000001", "--tests: with --stiff allowed is 1 to 1000000000"},
       {"check --stiff --rays 0", "--rays: Value 0 not in range 1 to 1000000000;"},
       {"sweep --scene spheres --out OUT --rays-in-flight 1,0",
        "--rays-in-flight: Value 0 not in range 1 to 65536;"},
       {"fit --scene spheres --out OUT --overhead nan", "--overhead: Value nan not in range 0 to 1000;"},
       {"fit --scene spheres --out OUT --overhead -1", "--overhead: Value -1 not in range 0 to 1000;"},
       {"fit --scene spheres --out OUT --rate-boxes 0",
        "--rate-boxes: Value 0 not in range 1 to 1000000000000;"},
       {"fit --scene spheres --out OUT --rate-rays nan",
        "--rate-rays: Value nan not in range 1 to 1000000000000;"},
       {"fit --scene spheres --out OUT --vectors -1", "--vectors: Value -1 not in range 0 to 1000000000;"},
       {"bvh --scene spheres --max-triangles 0", "--max-triangles: Value 0 not in range 1 to 2147483647;"},
       {"bvh --scene spheres --max-depth 61", "--max-depth: Value 61 not in range 1 to 60;"},
       {"bvh --scene spheres --grid-bits 5", "--grid-bits: Value 5 not in range 6 to 32;"}});
  for (const std::string seed : {"-1", "1.5", "1e3", "0x10", "18446744073709551616", "one"})
    rejected({{"check int_slabs --seed " + seed, "--seed: Value " + seed + seeds},
              {"report --scene spheres --out OUT --seed " + seed, "--seed: Value " + seed + seeds}});
  for (const std::string cost : {"-1", "nan", "x"})
    rejected({{"sweep --scene spheres --out OUT --triangle-ns " + cost,
               "--triangle-ns: Value " + cost + " not in range 0 to 1000000;"}});
  for (const std::string padding : {"-1e-7", "0.001", "nan", "5e-7x"})
    rejected({{"bvh --scene spheres --padding " + padding,
               "--padding: " + padding + " is not a padding; allowed is 0 to 2^-10 = 0.000977;"}});
  for (const std::string scale : {"0", "2^", "2^2000", "inf", "1x", "three"})
    rejected({{"render --scene spheres --rescale --scale " + scale,
               "--scale: " + scale +
                   " is not a scale; give a number above 0 or a power of two, for example 0.1 or 2^-10;"}});
  for (const std::string offset : {"1", "1,2", "1,2,3,4", "1,2,x", "1,2,3,", "1,2,inf"})
    rejected({{"render --scene spheres --rescale --offset " + offset,
               "--offset: " + offset + " is not X,Y,Z; give three numbers, for example 1000,0,-0.5;"}});
}

TEST_F(WrongUseOf, Words) {
  const std::string render = "render --scene spheres --width 8 --height 8 ";
  rejected(
      {{"render --scene spheres --bits 20/24",
        "--bits 20/24: only --arithmetic integer has them; leave --bits out"},
       {render + "--traversal dsa",
        "--traversal: dsa is none of slabs, plu, slabs-dist, slabs-dsa, plu-dsa;"},
       {render + "--arithmetic half", "--arithmetic: half is none of float, double, conservative, integer;"},
       {render + "--encoding h5",
        "--encoding: h5 is none of plain, h4, h8, h12, h16, wide4, wide8, wide4-float, wide8-float, pair6, "
        "pair8, pair10;"},
       {render + "--bundle 32", "--bundle: 32 is none of 1, 64, 256;"},
       {render + "--triangle-test no", "--triangle-test: no is none of exact, float, double;"},
       {"render --compare a.png", "render: 1 images; --compare takes two"},
       {render + "a.png", "render: 1 images; --compare takes two"},
       {"cosim int_slabs --scene spheres --scale 2", "--scale requires --rescale;"},
       {"cosim int_slabs --scene spheres --answers OUT.csv", "--answers requires --rays;"},
       {"core trace --scene spheres --answers OUT.csv", "--answers requires --rays;"},
       {"sweep --scene spheres --out OUT --answers OUT.csv", "--answers requires --rays;"},
       {"render --scene spheres --answers OUT.csv", "--answers requires --rays;"},
       {"bvh --scene spheres --builder best", "--builder: best is none of median, sah;"},
       {"area --account thesis", "--account: thesis is none of printed, built;"},
       {"area --account printed --flow-control none",
        "--flow-control: the printed account counts latches as the thesis does; allowed with --account "
        "built"},
       {"area --account printed --library xc7",
        "library xc7: it is a chip's and has no areas, so there is no printed account, only the built one"},
       {"rtl int_slabs --out OUT --flow-control ready", "--flow-control: ready is none of stall, none;"},
       {"rtl int_slabs --out OUT --flow-control stall --fifo",
        "result FIFO: flow control stall; allowed is none, because a unit that stalls holds its results"},
       {"operands int_slabs --out OUT", "operands: give --rays and --boxes, or --operands"},
       {"operands int_slabs --rays - --boxes - --out OUT",
        "--rays and --boxes are both -; only one can be standard input"},
       {"operands int_slabs --rays a --boxes b --out OUT.csv --as xml",
        "--as: xml is none of csv, json, hex;"},
       {"operands int_slabs --rays a --boxes b --out OUT.txt",
        "--out OUT.txt: unknown extension \".txt\"; allowed are .csv, .json, .jsonl and .hex, or give --as"},
       {"table", "table: 0 tables; allowed is one, or any number with --judge"},
       {"table 5.1 5.2", "table: 2 tables; allowed is one, or any number with --judge"},
       {"table 4.1 --out page.md", "--out requires --judge;"},
       {"table --judge 4.2 --out page.txt", "--out: page.txt does not end in .md;"},
       {"table 4.1 --scene Bunny", "--scene: Bunny is not NAME=SCENE; give for example Bunny=bunny.ply;"},
       {"board int_slabs", "--port or --simulate is required;"},
       {"core board --port x", "--port requires --scene or --image;"},
       {"core trace", "--scene or --image or --join is required;"},
       {"core trace --image ''", "--image: is empty; give the name of a file;"},
       {"core replay --rays a --answers b", "image is required;"},
       {"core replay a --answers b", "--rays is required;"},
       {"core replay a --rays b", "--answers is required;"},
       {"core replay DIR/none --rays a --answers b", "DIR/none: cannot read the file"},
       {"core board --simulate --scene spheres",
        "--simulate excludes --scene: the other side has the scene;"},
       {"core", "a command is needed; there are: COMMANDS_OF_CORE; see hitpipe core --help"},
       {"core follow", "follow: no such command; there are: COMMANDS_OF_CORE; see hitpipe core --help"},
       {"help core follow", "hitpipe core has no command follow; there are: COMMANDS_OF_CORE"},
       {"board int_slabs --simulate --tests 9",
        "--simulate excludes --tests: the other side sends the tests;"},
       {"check --scene spheres int_slabs", "--scene requires --stiff;"}});
  for (const std::string bounds : {"0,0,0,1,1", "0,0,0,1,1,1,1", "0,0,0,1,1,x", "0,0,0,1,1,1,"})
    rejected({{"operands int_slabs --rays a --boxes b --out OUT.csv --bounds " + bounds,
               "--bounds: " + bounds +
                   " is not min_x,min_y,min_z,max_x,max_y,max_z; give six numbers, for example "
                   "-10,-10,0,10,10,5;"}});
  // A user's word that is quoted may hold anything.
  rejected({"rtl", "two\nlines\t", "--out", "x"}, "design two lines : unknown; there are: DESIGNS");
}

TEST_F(WrongUseOf, TargetsAndBoards) {
  const std::string named = "--target or --board is required;";
  const std::string on_board = "implement --out OUT --board ";
  const std::string on_chip = "implement int_slabs --bits 6/6 --out OUT --target ";
  const std::string none = ": no such option; the nearest is --...";
  rejected(
      {{"implement int_slabs --out OUT", named},
       {"implement --target ice40_up5k --out OUT", "--target requires design;"},
       {on_board + "arty", "board arty: unknown; there are: icebreaker"},
       {on_board + "icebreaker --target xc7", "--target excludes --board: a board has a target of its own;"},
       {on_board + "icebreaker --baud 5000000",
        "5000000 baud: the clock of icebreaker (12000000 Hz) must be 4 to 65535 times as fast and a whole "
        "multiple within 2 %; 1000000 is usual"},
       {on_chip + "stratix",
        "target stratix: unknown; there are ecp5, ice40_hx, ice40_up5k, osu018, xc7, and any file whose name "
        "ends "
        "in .json"},
       {on_chip + "xc7 --rays 8", "--rays" + none},
       {"core implement --out OUT", named},
       {"core implement --out OUT --target xc7 --bits 20/24",
        "bits 20/24: allowed is n+g/psS or n+g/pfBsStF with n in 8..24, g in 0..3, p in 4..32, B in -2..3, S "
        "in "
        "8..32, F in 1..8 and B at most g+F, for example 20+1/11s20"},
       {"core implement --out OUT --target xc7 --stack 6",
        "--stack 6: allowed is a power of two from 2 to 64;"},
       {"core implement --out OUT --target xc7 --simulate 9", "--simulate" + none},
       {"core implement --out OUT --target xc7 --flow-control none", "--flow-control" + none},
       {"core implement --out OUT --target xc7 --ii 2", "--ii" + none},
       {"core implement --out OUT --target xc7 --clock-ps auto",
        "--clock-ps: Value auto not in range 1 to 1000000000;"},
       {"core implement --out OUT --board icebreaker --rays 3",
        "--rays excludes --board: a board has a core of its own;"},
       {"core implement --out OUT --board icebreaker --data-bits 64",
        "--data-bits excludes --board: a board has a core of its own;"},
       {"core implement --out OUT --target ice40_hx --seeds 1", "--seeds requires --board;"},
       {on_chip + "xc7 --seeds 101", "--seeds: Value 101 not in range 0 to 100;"},
       {on_chip + "xc7 --simulate 9",
        "target xc7: has no simulation models of its cells, so its netlist cannot be simulated"}});
}

}  // namespace
}  // namespace hitpipe::cli::wrong_use_test
