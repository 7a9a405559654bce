// The main function of the test programs. Arguments are source files, such as tests/host/text_test.cpp: only
// their tests run, or all if there is none.
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/foreign_design/foreign_design.hpp"

namespace {

/// The filter that selects the tests of a file.
std::string tests_of(std::string_view file) {
  std::string filter;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j) {
      const testing::TestInfo& test = *suite.GetTestInfo(j);
      if (test.file() == file) filter += std::string(suite.name()) + "." + test.name() + ":";
    }
  }
  if (filter.empty()) throw std::invalid_argument("no test is in the file " + std::string(file));
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  if (hitpipe::add_foreign_design != nullptr) hitpipe::add_foreign_design();
  if (hitpipe::add_foreign_software != nullptr) hitpipe::add_foreign_software();
  testing::InitGoogleMock(&argc, argv);
  try {
    std::string filter;
    for (int i = 1; i < argc; ++i) filter += tests_of(argv[i]);
    if (!filter.empty()) GTEST_FLAG_SET(filter, filter);
    return RUN_ALL_TESTS();
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << "\n";
    return 1;
  }
}
