#include <snug/app/search_progress.h>

#include <gtest/gtest.h>

namespace snug {
namespace {
TEST(SearchProgress, ShowsTheBestFeasibleObjectiveAndTheTimeLeft)
{
  app::SearchProgress progress("peak", " MPa", 10, 1e-6);
  progress.begin();
  EXPECT_EQ(progress.text(), "evaluation 1 of at most 10");
  progress.end(800., 0.5, 3.);
  progress.begin();
  EXPECT_EQ(progress.text(),
            "evaluation 2 of at most 10, minimum violation of the constraints 0.5");
  progress.end(900., 0., 5.);
  progress.begin();
  // 8 evaluations of 2 s each remain.
  EXPECT_EQ(progress.text(), "evaluation 3 of at most 10, best peak 900 MPa, at most 16 s left");
  progress.end(700., 0.1, 7.); // violates a constraint
  progress.begin();
  EXPECT_EQ(progress.text(), "evaluation 4 of at most 10, best peak 900 MPa, at most 14 s left");
}
} // namespace
} // namespace snug
