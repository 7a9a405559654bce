// A search is made once for all that decides it, and gives what share_widened() gives.
#include "rtl_gen/schedule/kept_searches.hpp"

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "rtl_gen/graph/canonical.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"
#include "tests/rtl_gen/text.hpp"

namespace hitpipe::rtl::kept_searches_test {
namespace {

/// Products, of which the C++ names a part. The part is no value of its own, so the graph's text does not name it.
Graph products(std::string_view part = "low_half", int last_width = 4) {
  Graph g("products");
  for (int i = 0; i < 3; ++i) {
    const std::string name = std::to_string(i);
    const NodeId a = g.input("a" + name, 4, true), b = g.input("b" + name, i == 2 ? last_width : 4, true);
    const NodeId product = g.binary(Op::mul, a, b, true);
    g.annotate(g.slice(product, 3, 0), part, {"products.hpp", 1});
    g.output("o" + name, product);
  }
  return canonical(g);
}

TEST(KeptSearches, GiveWhatTheSearchGives) {
  const Library library = unit_library();
  KeptSearches kept(2);
  const SharedGraph found = share_widened(products(), library, 3);
  for (int i = 0; i < 2; ++i) {
    const SharedGraph given = kept.share(products(), library, 3);
    EXPECT_EQ(to_text(given.graph), to_text(found.graph));
    EXPECT_EQ(given.shared.schedule.stages, found.shared.schedule.stages);
    EXPECT_EQ(given.shared.binding.instance_of, found.shared.binding.instance_of);
  }
  EXPECT_EQ(kept.searches(), 1U);
}

TEST(KeptSearches, DifferInAllThatDecidesThem) {
  const Library library = unit_library();
  const Library slower = Library::from_json(
      replaced(std::string(unit_json), R"({"bits": 4, "area_um2": 16, "delay_ps": 10, "stages": 0})",
               R"({"bits": 4, "area_um2": 16, "delay_ps": 9, "stages": 0})"),
      "unit.json");
  KeptSearches kept(10);
  (void)kept.share(products(), library, 3);
  (void)kept.share(products(), library, 2);
  (void)kept.share(products(), library, 3, 40);
  (void)kept.share(products(), slower, 3);
  (void)kept.share(products("low_half", 3), library, 3);
  EXPECT_EQ(kept.searches(), 5U);
  EXPECT_EQ(to_text(products()), to_text(products("rest")));
  const SharedGraph renamed = kept.share(products("rest"), library, 3);
  EXPECT_EQ(kept.searches(), 6U);
  std::string names;
  for (NodeId id = 0; id < renamed.graph.size(); ++id)
    for (const NamedPart& part : renamed.graph[id].parts) names += part.name;
  EXPECT_EQ(names, "restrestrest");
}

TEST(KeptSearches, AreTheLastOnes) {
  const Library library = unit_library();
  KeptSearches kept(2);
  for (const int interval : {2, 3, 4, 3, 4, 2}) (void)kept.share(products(), library, interval);
  EXPECT_EQ(kept.searches(), 4U);
}

}  // namespace
}  // namespace hitpipe::rtl::kept_searches_test
