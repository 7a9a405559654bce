// The functions in the registry of experiments, one file for each chapter.
#pragma once

#include "thesis/experiment.hpp"

namespace hitpipe::thesis {

/// Tables 3.1 (binary32) and 3.2 (binary64): box tests alone.
[[nodiscard]] ResultTable box_test_times(std::string_view number, const ExperimentOptions& options);

/// Tables 4.1, 4.3 and 4.4: traversal algorithms.
[[nodiscard]] ResultTable traversal_times(std::string_view number, const ExperimentOptions& options);

/// Table 4.2: the order of children by direction.
[[nodiscard]] ResultTable child_orders(std::string_view number, const ExperimentOptions& options);

/// Tables 5.1 to 5.7: hierarchically encoded nodes; single rays, bundles of 64 and of 256.
[[nodiscard]] ResultTable hierarchical_encoding(std::string_view number, const ExperimentOptions& options);

/// Tables 5.8 and 5.9: the same when the float hierarchy does not fit into memory, by the paging model.
[[nodiscard]] ResultTable out_of_core(std::string_view number, const ExperimentOptions& options);

/// Table 6.1: sizes of integer hierarchies.
[[nodiscard]] ResultTable integer_sizes(std::string_view number, const ExperimentOptions& options);

/// Tables 6.2 to 6.4 (slabs) and 6.5 to 6.7 (Pluecker): extra work of integer box tests.
[[nodiscard]] ResultTable integer_traversal(std::string_view number, const ExperimentOptions& options);

/// Table 7.1: area and delay of components.
[[nodiscard]] ResultTable component_library(std::string_view number, const ExperimentOptions& options);

/// Table 7.2: the prices of the six units.
[[nodiscard]] ResultTable unit_prices(std::string_view number, const ExperimentOptions& options);

/// Tables B.1 to B.8: the size of leaves.
[[nodiscard]] ResultTable leaf_sizes(std::string_view number, const ExperimentOptions& options);

/// "text": statements of chapters 4 to 6 without a table.
[[nodiscard]] ResultTable statements(std::string_view number, const ExperimentOptions& options);

}  // namespace hitpipe::thesis
