// A file of answers that somebody recorded: what it may say, and the line for each way to write a wrong one.
#include "sim/core/recorded_answers.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::recorded_answers_test {
namespace {

class RecordedAnswers : public testing::Test {
 protected:
  [[nodiscard]] std::vector<AnswerOfRay> read(const std::string& text) const {
    folder_.write("a.csv", text);
    return read_recorded_answers(file_, rays_, "r.csv");
  }
  /// The message behind the file's name.
  [[nodiscard]] std::string refused(const std::string& text) const {
    try {
      static_cast<void>(read(text));
    } catch (const std::runtime_error& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find(file_ + ": "), 0U) << message;
      return message.substr(file_.size() + 2);
    }
    return "it was read";
  }

  const std::vector<AskedRay> rays_{{}, {.ray = {}, .query = ref::Query::any}, {}};
  const TemporaryFolder folder_;
  const std::string file_ = folder_.path() / "a.csv";
};

TEST_F(RecordedAnswers, AreThoseOfTheRaysInTheirOrder) {
  const std::vector<AnswerOfRay> read = this->read("hit,number,t\n1,7,-9\n0,,\n1,8,\n");
  ASSERT_EQ(read.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(read[i].ray, i);
  EXPECT_EQ(read[0].answer.triangle, 7U);
  EXPECT_EQ(read[0].answer.t, -9);
  EXPECT_TRUE(read[1].answer.given);
  EXPECT_EQ(read[1].answer.triangle, std::nullopt);
  EXPECT_EQ(read[2].answer.t, std::nullopt);
}

TEST_F(RecordedAnswers, MayNameTheirRays) {
  const std::vector<AnswerOfRay> read = this->read("failed,ray,hit,number,t\n0,2,1,7,9\n4,0,,,\n,1,,,\n");
  EXPECT_EQ(read.at(0).ray, 2U);
  EXPECT_EQ(read.at(1).ray, 0U);
  EXPECT_EQ(read[1].answer.failed, hls::outside_image);
  EXPECT_FALSE(read[1].answer.given);
  EXPECT_EQ(read[2].answer.failed, hls::not_failed);
  EXPECT_FALSE(read[2].answer.given);
}

TEST_F(RecordedAnswers, MayBeOfSeveralCores) {
  EXPECT_EQ(read("rays_in_flight,hit,number,t\n1,0,,\n4,0,,\n1,0,,\n4,0,,\n1,0,,\n4,0,,\n").at(3).ray, 1U);
  EXPECT_EQ(refused("rays_in_flight,hit,number,t\n1,0,,\n1,0,,\n1,0,,\n4,0,,\n"),
            "ray 1 has no answer with rays_in_flight 4; each of the 3 rays of r.csv needs one");
}

TEST_F(RecordedAnswers, AreRefusedWhereTheyAreNone) {
  const std::string head = "ray,query,failed,hit,number,t\n";
  EXPECT_EQ(refused("hit,t\n0,\n"),
            "line 1: column \"number\" is missing; the first line must name the columns "
            "hit,number,t[,ray,query,failed,rays_in_flight,face,distance,w0,w1,w2,exact_hit,exact_number,"
            "exact_face,exact_t,exact_distance]");
  EXPECT_EQ(refused("hit,number,t\n"), "holds no answer");
  EXPECT_EQ(refused("hit,number,t\n0,,\n0,,\n"),
            "ray 2 has no answer; each of the 3 rays of r.csv needs one");
  EXPECT_EQ(refused("hit,number,t\n0,,\n0,,\n0,,\n0,,\n"),
            "line 5: is one answer too many; r.csv has 3 rays");
  EXPECT_EQ(refused(head + "2,,,0,,\n2,,,0,,\n"), "line 3: ray 2 has an answer already; allowed is one");
  EXPECT_EQ(refused(head + "3,,,0,,\n"),
            "line 2: ray is \"3\"; allowed is a whole number from 0 to 2, a ray of r.csv");
  EXPECT_EQ(refused(head + "1,nearest,,0,,\n"), "line 2: query is \"nearest\"; ray 1 of r.csv asks for any");
  EXPECT_EQ(refused(head + "0,all,,0,,\n"), "line 2: query is \"all\"; ray 0 of r.csv asks for nearest");
  EXPECT_EQ(refused(head + "0,,6,,,\n"), "line 2: failed is \"6\"; allowed is a whole number from 0 to 5");
  EXPECT_EQ(refused(head + "0,,,yes,,\n"),
            "line 2: hit is \"yes\"; allowed are 1, 0, and nothing where there is no answer");
  EXPECT_EQ(refused(head + "0,,,1,,9\n"),
            "line 2: number is \"\"; allowed is a whole number from 0 to 4294967294");
  EXPECT_EQ(refused(head + "0,,,1,4294967295,9\n"),
            "line 2: number is \"4294967295\"; allowed is a whole number from 0 to 4294967294");
  EXPECT_EQ(refused(head + "0,,,1,2,1.5\n"), "line 2: t is \"1.5\"; allowed is a whole number, or nothing");
  EXPECT_EQ(refused(head + "0,,,1,2\n"), "line 2: has 5 cells; the first line names 6 columns");
}

}  // namespace
}  // namespace hitpipe::sim::recorded_answers_test
