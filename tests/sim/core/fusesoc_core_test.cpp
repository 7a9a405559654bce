// The FuseSoC core file of a traversal core.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "rtl_gen/core/files.hpp"
#include "sim/core/core_vectors.hpp"
#include "tests/rtl_gen/emit/fusesoc_cores.hpp"

namespace hitpipe::sim::fusesoc_core_test {
namespace {

nlohmann::json core_file(const rtl::Library& library) {
  const host::ScratchFolder folder("fusesoc-core");
  const rtl::Core core = rtl::make_core({.bits = {12, 1, 7, 0, 12, 0}}, library, "tracer");
  for (const host::File& file : rtl::core_files(core, library, core_test(core, 10, 7)))
    if (file.name == "tracer.core") host::write_files(folder.path(), {file});
  return rtl::cores_in(folder.path()).at("tracer.core");
}

TEST(FuseSoCCore, HasHeaderAndRegistersByDefault) {
  const nlohmann::json core = core_file(rtl::Library::thesis());
  const nlohmann::json& targets = core.at("targets");
  EXPECT_EQ(targets.at("default").at("filesets"), (nlohmann::json{"rtl", "axi", "header", "registers"}));
  EXPECT_EQ(targets.at("harness").at("filesets"), (nlohmann::json{"rtl", "axi", "header", "harness"}));
  const nlohmann::json& header = core.at("filesets").at("header");
  EXPECT_EQ(header.at("file_type"), "cSource");
  EXPECT_EQ(header.at("files"), (nlohmann::json::parse(R"([{"tracer.h": {"is_include_file": true}}])")));
  EXPECT_EQ(core.at("filesets").at("registers").at("files"), (nlohmann::json{"tracer.rdl"}));
}

TEST(FuseSoCCore, IsSynthesisedAsTheLibrarySays) {
  for (const std::string& name : rtl::built_in_names()) {
    const rtl::Library library = rtl::library_called(name);
    const nlohmann::json core = core_file(library);
    const nlohmann::json& targets = core.at("targets");
    EXPECT_EQ(targets.size(), 5 + library.synthesis_targets().size()) << name;
    for (const nlohmann::json& target : targets)
      EXPECT_FALSE(target.at("description").get<std::string>().empty()) << name;
    for (const rtl::SynthesisTarget& target : library.synthesis_targets()) {
      const nlohmann::json& written = targets.at(target.name);
      EXPECT_EQ(written.at("flow"), target.flow) << name;
      EXPECT_EQ(written.at("filesets"), (nlohmann::json{"rtl", "axi"})) << name;
      EXPECT_EQ(written.at("toplevel"), "tracer_axi") << name;
    }
  }
}

}  // namespace
}  // namespace hitpipe::sim::fusesoc_core_test
