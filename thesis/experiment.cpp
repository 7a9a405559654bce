#include "thesis/experiment.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "thesis/proposals.hpp"
#include "thesis/tables.hpp"

namespace hitpipe::thesis {

std::span<const Experiment> experiments() {
  static constexpr std::array all{Experiment{"3.1", box_test_times},
                                  Experiment{"3.2", box_test_times},
                                  Experiment{"4.1", traversal_times},
                                  Experiment{"4.2", child_orders},
                                  Experiment{"4.3", traversal_times},
                                  Experiment{"4.4", traversal_times},
                                  Experiment{"5.1", hierarchical_encoding},
                                  Experiment{"5.2", hierarchical_encoding},
                                  Experiment{"5.3", hierarchical_encoding},
                                  Experiment{"5.4", hierarchical_encoding},
                                  Experiment{"5.5", hierarchical_encoding},
                                  Experiment{"5.6", hierarchical_encoding},
                                  Experiment{"5.7", hierarchical_encoding},
                                  Experiment{"5.8", out_of_core},
                                  Experiment{"5.9", out_of_core},
                                  Experiment{"6.1", integer_sizes},
                                  Experiment{"6.2", integer_traversal},
                                  Experiment{"6.3", integer_traversal},
                                  Experiment{"6.4", integer_traversal},
                                  Experiment{"6.5", integer_traversal},
                                  Experiment{"6.6", integer_traversal},
                                  Experiment{"6.7", integer_traversal},
                                  Experiment{"7.1", component_library},
                                  Experiment{"7.2", unit_prices},
                                  Experiment{"B.1", leaf_sizes},
                                  Experiment{"B.2", leaf_sizes},
                                  Experiment{"B.3", leaf_sizes},
                                  Experiment{"B.4", leaf_sizes},
                                  Experiment{"B.5", leaf_sizes},
                                  Experiment{"B.6", leaf_sizes},
                                  Experiment{"B.7", leaf_sizes},
                                  Experiment{"B.8", leaf_sizes},
                                  Experiment{"text", statements}};
  return all;
}

std::span<const Experiment> experiments_and_proposals() {
  static const std::vector<Experiment> all = [] {
    std::vector<Experiment> made(experiments().begin(), experiments().end());
    made.push_back({"adaptive", adaptive_precision});
    made.push_back({"grid", grid_cells});
    made.push_back({"kd", kd_planes});
    return made;
  }();
  return all;
}

const Experiment& find_experiment(std::string_view number, std::span<const Experiment> among) {
  std::vector<std::string_view> numbers;
  for (const Experiment& experiment : among) {
    if (experiment.number == number) return experiment;
    numbers.push_back(experiment.number);
  }
  throw std::runtime_error(
      fmt::format("{}: no experiment of that number; there are {}", number, fmt::join(numbers, ", ")));
}

}  // namespace hitpipe::thesis
