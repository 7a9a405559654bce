// Covers small enough to see that no better one exists.
#include "area_model/gate_network.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace hitpipe::area::gate_network_test {
namespace {

using Signal = GateNetwork::Signal;

std::vector<Signal> leaves(GateNetwork& network, int n) {
  std::vector<Signal> all;
  for (int i = 0; i < n; ++i) all.push_back(network.leaf());
  return all;
}

Signal all_of(GateNetwork& network, const std::vector<Signal>& signals) {
  Signal all = GateNetwork::one;
  for (const Signal s : signals) all = network.both(all, s);
  return all;
}

TEST(GateNetwork, FillsTables) {
  for (const auto& [inputs, tables] : {std::pair{4, 5}, {6, 3}, {16, 1}}) {
    GateNetwork network;
    network.reads(all_of(network, leaves(network, 16)));
    EXPECT_EQ(network.tables(inputs, 1), std::vector{tables}) << inputs;
  }
}

TEST(GateNetwork, FourToOneIsATableOfSix) {
  GateNetwork network;
  const auto x = leaves(network, 6);
  network.reads(network.select(x[0], network.select(x[1], x[2], x[3]), network.select(x[1], x[4], x[5])));
  EXPECT_EQ(network.tables(6, 1), std::vector{1});
}

TEST(GateNetwork, ConstantsEqualGatesAndInvertersTakeNothing) {
  GateNetwork network;
  const auto x = leaves(network, 2);
  network.reads(network.both(x[0], GateNetwork::zero));
  network.reads(network.both(x[0], GateNetwork::one));
  network.reads(network.differ(x[0], x[0] ^ 1U));
  network.reads(network.select(x[0], x[1], x[1]));
  EXPECT_EQ(network.tables(6, 1), std::vector{0});
  network.reads(network.either(x[0], x[1]));
  network.reads(network.both(x[1] ^ 1U, x[0] ^ 1U));
  EXPECT_EQ(network.tables(6, 1), std::vector{1});
  network.reads(network.differ(x[0], x[1]));
  network.reads(network.differ(x[1], x[0] ^ 1U));
  network.reads(network.select(x[0], x[1], x[1] ^ 1U));
  EXPECT_EQ(network.tables(6, 1), std::vector{2});
}

TEST(GateNetwork, AnInvertedLeafIsATableForWhatReadsItAsItIs) {
  GateNetwork network;
  const auto x = leaves(network, 2);
  network.reads_as_is(x[0]);
  network.reads_as_is(GateNetwork::one);
  network.reads_as_is(network.both(x[0], x[1]) ^ 1U);
  EXPECT_EQ(network.tables(4, 1), std::vector{1});
  network.reads_as_is(x[0] ^ 1U);
  network.reads_as_is(x[0] ^ 1U);
  EXPECT_EQ(network.tables(4, 1), std::vector{2});
}

TEST(GateNetwork, WhatIsReadHasATableOfItsOwnerAndWhatIsNotHasNone) {
  GateNetwork network;
  const auto x = leaves(network, 4);
  network.begin_owner(0);
  const Signal first = network.both(x[0], x[1]);
  network.begin_owner(1);
  const Signal second = network.both(first, x[2]);
  network.begin_owner(2);
  network.both(second, x[3]);
  network.reads(second);
  EXPECT_EQ(network.tables(6, 3), (std::vector{0, 1, 0}));
  network.reads(first);
  EXPECT_EQ(network.tables(6, 3), (std::vector{1, 1, 0}));
}

}  // namespace
}  // namespace hitpipe::area::gate_network_test
